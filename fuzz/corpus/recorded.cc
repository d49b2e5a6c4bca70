// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/recorded.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "fuzz/check/subject.h"
#include "gnomon/scene/rational_text.h"
#include "kernel/signs/nearest_double.h"
#include "report/sides/part_area.h"

namespace gnomon::fuzz {

namespace {

std::string text_of(const RecordedShare& share) {
  return share.exact ? text_for_people(*share.exact) : fmt::format("{}", share.nearest);
}

std::string place_of(const RecordedLight& light, const RecordedSide& side) {
  return fmt::format("light '{}', polygon '{}' ({})", light.id, side.polygon, name_of(side.side));
}

// A record of several parts is rounded; the enclosure of double arithmetic is far closer.
constexpr double kRounding = 1e-12;

bool same(const RecordedShare& a, const RecordedShare& b) {
  if (a.exact && b.exact) return *a.exact == *b.exact;
  return !a.exact && !b.exact && std::fabs(a.nearest - b.nearest) <= kRounding;
}

/// Areas of parts in one plane are in the ratio of these.
mpz_class weight_of(const PreparedScene& prepared, std::uint32_t part) {
  mpz_class sum = 0;
  for (const mpz_class& component : report::doubled_area_vector(prepared, prepared.parts[part])) {
    sum += abs(component);
  }
  return sum;
}

std::vector<mpq_class> exact_shares(const oracle::TrueFractions& truth, bool area) {
  if (!area) return {*truth.lit.exact, *truth.shadow.exact};
  return {*truth.lit.exact, *truth.penumbra.exact, *truth.umbra.exact};
}

/// What the record says of a group of coplanar parts.
std::vector<mpq_class> recorded_group(const PreparedScene& prepared, std::uint32_t first_part,
                                      const oracle::ReceiverGroup& group,
                                      const RecordedSide& side) {
  std::vector<mpq_class> sums(side.shares.size());
  mpq_class whole = 0;
  for (const std::uint32_t part : group.parts) {
    const mpq_class weight(weight_of(prepared, part));
    whole += weight;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] +=
          weight * (side.parts.empty() ? *side.shares[k].exact : side.parts[part - first_part][k]);
    }
  }
  for (mpq_class& sum : sums) sum /= whole;
  return sums;
}

std::vector<std::string_view> names_of(bool area_light) {
  std::vector<std::string_view> names;
  for (const LightState state : report::light_states(area_light)) names.push_back(name_of(state));
  return names;
}

}  // namespace

std::span<const std::string_view> share_names(bool area_light) {
  static const std::vector<std::string_view> kPoint = names_of(false), kArea = names_of(true);
  return area_light ? kArea : kPoint;
}

Expected<std::vector<RecordedLight>> recorded_of(const Scene& scene, const PreparedScene& prepared,
                                                 const ShadowResult& result,
                                                 const report::SidesByLight& sides) {
  std::vector<RecordedLight> lights;
  for (std::size_t l = 0; l < result.lights.size(); ++l) {
    const LightResult& light = result.lights[l];
    RecordedLight& own = lights.emplace_back();
    own.id = scene.lights[prepared.lights[light.light].light].id;
    own.area = prepared.lights[light.light].has_area();
    const auto states = report::light_states(own.area);
    for (const report::ClassifiedSide& side : sides[l]) {
      RecordedSide& one = own.sides.emplace_back();
      one.polygon = scene.polygons[side.polygon].id;
      one.side = side.side;
      bool exact = true;
      for (const LightState state : states) {
        RecordedShare& share = one.shares.emplace_back();
        share.exact = report::exact_share_of(side, state);
        if (share.exact) {
          share.nearest = nearest_double(*share.exact);
          continue;
        }
        exact = false;
        const Interval& bounds = report::share_of(side, state);
        share.nearest = nearest_double(report::precise_share(prepared, side, state));
        if (!(bounds.upper - bounds.lower <= kRounding)) {
          return fail(ErrorCode::kLimit,
                      place_of(own, one) + ": its fractions are known too roughly");
        }
      }
      if (exact) continue;
      for (const report::PartSide& part : side.parts) {
        std::vector<mpq_class>& shares = one.parts.emplace_back();
        for (const LightState state : states) shares.push_back(report::exact_share(part, state));
      }
    }
  }
  return lights;
}

std::string difference(const std::vector<RecordedLight>& recorded,
                       const std::vector<RecordedLight>& found) {
  if (recorded.size() != found.size()) {
    return fmt::format("{} lights instead of {}", found.size(), recorded.size());
  }
  for (std::size_t l = 0; l < recorded.size(); ++l) {
    const RecordedLight &a = recorded[l], &b = found[l];
    if (a.id != b.id || a.area != b.area) {
      return fmt::format("light '{}' instead of '{}'", b.id, a.id);
    }
    for (std::size_t i = 0; i < a.sides.size(); ++i) {
      const RecordedSide& own = a.sides[i];
      if (i >= b.sides.size() || own.polygon != b.sides[i].polygon || own.side != b.sides[i].side) {
        return place_of(a, own) + " is not listed in its place";
      }
      for (std::size_t k = 0; k < own.shares.size(); ++k) {
        if (same(own.shares[k], b.sides[i].shares[k])) continue;
        return fmt::format("{}: {} {} instead of {}", place_of(a, own), share_names(a.area)[k],
                           text_of(b.sides[i].shares[k]), text_of(own.shares[k]));
      }
      if (own.parts != b.sides[i].parts) {
        return place_of(a, own) + ": its parts have other fractions";
      }
    }
    if (a.sides.size() != b.sides.size()) {
      return place_of(b, b.sides[a.sides.size()]) + " is listed without need";
    }
  }
  return {};
}

std::string difference_from_oracle(const oracle::ExactAnswer& answer,
                                   const std::vector<RecordedLight>& recorded) {
  const PreparedScene& prepared = answer.prepared();
  const Scene& scene = answer.scene();
  if (recorded.size() != prepared.lights.size()) return "not all lights are recorded";
  for (std::uint32_t l = 0; l < recorded.size(); ++l) {
    const RecordedLight& light = recorded[l];
    const std::vector<oracle::AnswerEntry>& entries = answer.entries(l);
    if (entries.size() != light.sides.size()) {
      return fmt::format("light '{}': {} sides are recorded, the oracle lists {}", light.id,
                         light.sides.size(), entries.size());
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const oracle::AnswerEntry& entry = entries[i];
      const RecordedSide& side = light.sides[i];
      if (scene.polygons[entry.polygon].id != side.polygon || entry.side != side.side) {
        return place_of(light, side) + " stands where the oracle lists another side";
      }
      const std::uint32_t first = prepared.first_part[entry.polygon];
      if (!side.parts.empty() &&
          side.parts.size() != prepared.first_part[entry.polygon + 1] - first) {
        return place_of(light, side) + ": another number of parts";
      }
      for (const oracle::ReceiverGroup& group : entry.groups) {
        const std::vector<mpq_class> found = recorded_group(prepared, first, group, side);
        std::vector<mpq_class> truth;
        if (group.optional) {  // all of it is dark on this side
          truth.assign(found.size(), mpq_class(0));
          truth.back() = 1;
        } else {
          truth = exact_shares(answer.group_fractions(l, group), light.area);
        }
        for (std::size_t k = 0; k < truth.size(); ++k) {
          if (found[k] == truth[k]) continue;
          return fmt::format("{}: {} {}, but the oracle says {}", place_of(light, side),
                             share_names(light.area)[k], text_for_people(found[k]),
                             text_for_people(truth[k]));
        }
      }
    }
  }
  return {};
}

Expected<std::vector<RecordedLight>> exact_answer_of(const JudgedScene& scene) {
  const Expected<Classified> classified = scene.classify(shadow_options(Subject{}), "plane");
  if (!classified) return tl::unexpected(classified.error());
  auto recorded =
      recorded_of(scene.scene(), scene.prepared(), classified->result, classified->sides);
  if (!recorded) return recorded;
  std::string differs = difference_from_oracle(scene.answer(), *recorded);
  if (differs.empty()) {
    oracle::CertifyOptions options;
    options.strict = true;
    const auto report = scene.judge(classified->claims, options);
    if (!report) return tl::unexpected(report.error());
    if (!report->confirms_exact()) differs = report->reason;
  }
  if (differs.empty()) return recorded;
  return fail(ErrorCode::kGeometry, "the kernel plane and the oracle do not agree: " + differs);
}

}  // namespace gnomon::fuzz
