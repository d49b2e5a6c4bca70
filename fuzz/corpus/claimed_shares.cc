// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/claimed_shares.h"

#include <fmt/format.h>
#include <rapidjson/error/en.h>

#include <cmath>
#include <optional>
#include <utility>

#include "fuzz/text/rational_text.h"
#include "gnomon/result/classes.h"
#include "report/sides/part_area.h"
#include "scene/json/json_value.h"

namespace gnomon::fuzz {

namespace {

tl::unexpected<Error> wrong(const std::string& pointer, std::string what,
                            std::string expected = {}) {
  return fail(ErrorCode::kFormat, std::move(what), std::move(expected),
              ErrorPlace{{}, 0, 0, pointer});
}

Expected<void> parse(std::string_view text, rapidjson::Document& document) {
  document.Parse<rapidjson::kParseIterativeFlag>(text.data(), text.size());
  if (!document.HasParseError()) return {};
  return fail(ErrorCode::kSyntax, rapidjson::GetParseError_En(document.GetParseError()),
              "a result in JSON");
}

/// Empty if there is no such text.
std::string member_text(const JsonValue& object, std::string_view key) {
  return text_of(find_member(object, key)).value_or("");
}

/// The polygons of a light, or null.
const JsonValue* list_of(const JsonValue& object, std::string_view key) {
  const JsonValue* list = object.IsObject() ? find_member(object, key) : nullptr;
  return list != nullptr && list->IsArray() ? list : nullptr;
}

std::optional<double> fraction_of(const JsonValue& value) {
  if (value.IsNumber()) return value.GetDouble();
  if (!value.IsString()) return std::nullopt;
  const auto exact = parse_fraction({value.GetString(), value.GetStringLength()});
  return exact ? std::optional(exact->get_d()) : std::nullopt;
}

/// The share of one class; `area` is the polygon's.
Expected<std::optional<double>> share_of(const JsonValue& polygon, std::string_view shade,
                                         const mpq_class& area, const std::string& pointer) {
  const JsonValue* member = find_member(polygon, shade);
  if (member == nullptr) return std::optional<double>();
  const JsonValue& value = *member;
  std::optional<double> share;
  if (!value.IsObject()) {
    share = fraction_of(value);
  } else if (value.HasMember("fraction")) {
    share = fraction_of(value["fraction"]);
  } else if (value.HasMember("area") && value["area"].IsNumber()) {
    const double own = value["area"].GetDouble();
    if (std::isfinite(own)) share = mpq_class(mpq_class(own) / area).get_d();
  }
  if (share && std::isfinite(*share)) return share;
  return wrong(fmt::format("{}/{}", pointer, shade), "no share of the polygon",
               "a fraction, or an area");
}

class Comparison {
 public:
  Comparison(const Scene& scene, const PreparedScene& prepared, double tolerance)
      : scene_(scene), prepared_(prepared), tolerance_(tolerance) {}

  Expected<std::string> compare(const JsonValue& light, const std::string& pointer, bool per_caster,
                                const RecordedLight& recorded) const {
    const JsonValue* polygons = list_of(light, "polygons");
    if (polygons == nullptr) return wrong(pointer, "no list \"polygons\"");
    for (const RecordedSide& side : recorded.sides) {
      rapidjson::SizeType found = polygons->Size();
      for (rapidjson::SizeType i = 0; i < polygons->Size(); ++i) {
        const JsonValue& one = (*polygons)[i];
        if (one.IsObject() && member_text(one, "id") == side.polygon &&
            is_side(one, side, recorded)) {
          found = i;
          break;
        }
      }
      const std::string place = fmt::format("light '{}', polygon '{}' ({})", recorded.id,
                                            side.polygon, name_of(side.side));
      if (found == polygons->Size()) return place + " is missing";
      auto differs = compare_side((*polygons)[found], fmt::format("{}/polygons/{}", pointer, found),
                                  per_caster || !recorded.area, recorded.area, side);
      if (!differs) return differs;
      if (!differs->empty()) return place + ": " + *differs;
    }
    return std::string();
  }

 private:
  /// A side that is not named is the only one that there is.
  static bool is_side(const JsonValue& one, const RecordedSide& side, const RecordedLight& light) {
    const std::string name = member_text(one, "side");
    if (!name.empty()) return name == name_of(side.side);
    for (const RecordedSide& other : light.sides) {
      if (other.polygon == side.polygon && other.side != side.side)
        return side.side == Side::kFront;
    }
    return true;
  }

  Expected<std::string> compare_side(const JsonValue& polygon, const std::string& pointer, bool all,
                                     bool area_light, const RecordedSide& side) const {
    mpq_class area = 0;
    for (std::uint32_t i = 0; i < scene_.polygons.size(); ++i) {
      if (scene_.polygons[i].id == side.polygon) area = report::precise_area(prepared_, i);
    }
    const auto names = share_names(area_light);
    std::vector<std::optional<double>> shares;
    double sum = 0;
    std::size_t missing = 0;
    for (const std::string_view shade : names) {
      auto share = share_of(polygon, shade, area, pointer);
      if (!share) return tl::unexpected(share.error());
      missing += *share ? 0 : 1;
      sum += share->value_or(0);
      shares.push_back(*share);
    }
    if (missing > 1 && !shares[0]) {
      return wrong(pointer, "neither fragments nor fractions", "\"lit\" at least");
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (!shares[k] && missing == 1) shares[k] = 1 - sum;
      if (!shares[k] || (k > 0 && !all)) continue;
      const double truth = side.shares[k].nearest;
      if (std::fabs(*shares[k] - truth) <= tolerance_) continue;
      return fmt::format("{} {:.9g} instead of {:.9g}", names[k], *shares[k], truth);
    }
    return std::string();
  }

  const Scene& scene_;
  const PreparedScene& prepared_;
  double tolerance_;
};

}  // namespace

Expected<bool> has_shares_alone(std::string_view result_json) {
  rapidjson::Document document;
  if (auto done = parse(result_json, document); !done) return tl::unexpected(done.error());
  const JsonValue* lights = list_of(document, "lights");
  if (lights == nullptr) return false;
  bool any = false;
  for (const JsonValue& light : lights->GetArray()) {
    const JsonValue* polygons = list_of(light, "polygons");
    if (polygons == nullptr) continue;
    for (const JsonValue& polygon : polygons->GetArray()) {
      if (list_of(polygon, "fragments") != nullptr) return false;
      any = true;
    }
  }
  return any;
}

Expected<std::string> compare_shares(std::string_view result_json, const Scene& scene,
                                     const PreparedScene& prepared,
                                     const std::vector<RecordedLight>& recorded, double tolerance) {
  rapidjson::Document document;
  if (auto done = parse(result_json, document); !done) return tl::unexpected(done.error());
  const JsonValue* lights = list_of(document, "lights");
  if (lights == nullptr) return wrong("", "no list \"lights\"", "a result");
  const bool for_all = member_text(document, "umbra") == "per-caster";
  const Comparison comparison(scene, prepared, tolerance);
  for (const RecordedLight& light : recorded) {
    bool found = false;
    for (rapidjson::SizeType i = 0; i < lights->Size() && !found; ++i) {
      const JsonValue& one = (*lights)[i];
      if (!one.IsObject() || member_text(one, "id") != light.id) continue;
      found = true;
      const bool per_caster = for_all || member_text(one, "umbra") == "per-caster";
      auto differs = comparison.compare(one, fmt::format("/lights/{}", i), per_caster, light);
      if (!differs || !differs->empty()) return differs;
    }
    if (!found) return fmt::format("light '{}' is missing", light.id);
  }
  return std::string();
}

}  // namespace gnomon::fuzz
