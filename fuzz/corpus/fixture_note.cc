// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/fixture_note.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "fuzz/text/rational_text.h"
#include "gnomon/result/classes.h"
#include "report/json/json_writer.h"

namespace gnomon::fuzz {

namespace {

bool is_exact(const RecordedSide& side) {
  return std::ranges::all_of(side.shares,
                             [](const RecordedShare& share) { return share.exact.has_value(); });
}

std::optional<mpq_class> rational(const JsonValue* json) {
  const auto text = text_of(json);
  return text ? parse_fraction(*text) : std::nullopt;
}

void write_shares(report::JsonWriter& json, const RecordedLight& light, const RecordedSide& side) {
  const auto names = share_names(light.area);
  json.begin_object(report::JsonLayout::kInline);
  json.member("id", side.polygon);
  json.member("side", name_of(side.side));
  for (std::size_t k = 0; k < names.size(); ++k) {
    json.key(names[k]);
    if (side.shares[k].exact) {
      json.value(side.shares[k].exact->get_str());
    } else {
      json.value(side.shares[k].nearest);
    }
  }
  if (!side.parts.empty()) {
    json.key("parts");
    json.begin_array();
    for (const std::vector<mpq_class>& part : side.parts) {
      json.begin_object();
      for (std::size_t k = 0; k < names.size(); ++k) json.member(names[k], part[k].get_str());
      json.end_object();
    }
    json.end_array();
  }
  json.end_object();
}

}  // namespace

tl::unexpected<Error> NoteReader::wrong(const std::string& pointer, std::string what,
                                        std::string expected) const {
  return fail(ErrorCode::kFormat, std::move(what), std::move(expected),
              ErrorPlace{file_, 0, 0, prefix_ + pointer});
}

Expected<void> NoteReader::parse(const std::string& text) {
  if (text.empty()) return wrong("", "\"extra\" is missing", "what the scene shows");
  auto document = parse_json_object(text, file_);
  if (!document) return wrong("", document.error().what, document.error().expected);
  document_ = *std::move(document);
  return {};
}

Expected<std::string> NoteReader::text(const char* key, bool required) const {
  const JsonValue* value = find_member(document_, key);
  if (value == nullptr) {
    if (!required) return std::string();
    return wrong("", fmt::format("key \"{}\" is missing", key));
  }
  const auto text = text_of(value);
  if (text && !text->empty()) return *text;
  return wrong(fmt::format("/{}", key), "not a text", "a string that is not empty");
}

Expected<std::uint64_t> NoteReader::count(const char* key) const {
  const JsonValue* value = find_member(document_, key);
  if (value == nullptr) return std::uint64_t{0};
  if (!value->IsUint64()) return wrong(fmt::format("/{}", key), "not a count");
  return value->GetUint64();
}

Expected<std::vector<std::string>> NoteReader::texts(const char* key) const {
  std::vector<std::string> list;
  const JsonValue* value = find_member(document_, key);
  if (value == nullptr) {
    return wrong("", fmt::format("key \"{}\" is missing", key), "a list, perhaps empty");
  }
  const auto not_a_list = [&] {
    return wrong(fmt::format("/{}", key), "not a list of texts", "names of subjects");
  };
  if (!value->IsArray()) return not_a_list();
  for (const JsonValue& element : value->GetArray()) {
    auto text = text_of(&element);
    if (!text) return not_a_list();
    list.push_back(*std::move(text));
  }
  return list;
}

Expected<std::vector<RecordedLight>> NoteReader::fractions(const Scene& scene) const {
  const JsonValue* all = find_member(document_, "fractions");
  if (all == nullptr || !all->IsObject()) {
    return wrong("", "key \"fractions\" is missing or no object", "an object with every light");
  }
  std::vector<RecordedLight> lights;
  for (const Light& light : scene.lights) {
    const std::string pointer = "/fractions/" + light.id;
    const JsonValue* own = find_member(*all, light.id);
    if (own == nullptr || !own->IsArray()) {
      return wrong(pointer, fmt::format("light '{}' is missing or no list", light.id),
                   "a list of polygon sides");
    }
    RecordedLight& recorded = lights.emplace_back();
    recorded.id = light.id;
    recorded.area = light.has_area();
    for (rapidjson::SizeType i = 0; i < own->Size(); ++i) {
      auto one = side((*own)[i], recorded.area, fmt::format("{}/{}", pointer, i));
      if (!one) return tl::unexpected(one.error());
      const bool known = std::ranges::any_of(
          scene.polygons, [&](const Polygon& polygon) { return polygon.id == one->polygon; });
      if (!known) {
        return wrong(fmt::format("{}/{}/id", pointer, i),
                     fmt::format("no polygon '{}' in the scene", one->polygon));
      }
      recorded.sides.push_back(std::move(*one));
    }
  }
  if (all->MemberCount() != scene.lights.size()) {
    return wrong("/fractions", "a light that is not in the scene");
  }
  return lights;
}

Expected<RecordedSide> NoteReader::side(const JsonValue& json, bool area,
                                        const std::string& pointer) const {
  if (!json.IsObject()) return wrong(pointer, "not an object", "one polygon side");
  RecordedSide result;
  auto id = text_of(find_member(json, "id"));
  if (!id) return wrong(pointer, "key \"id\" is missing or no text");
  result.polygon = *std::move(id);
  const auto name = text_of(find_member(json, "side"));
  const auto known = name ? side_by_name(*name) : std::nullopt;
  if (!known) {
    return wrong(pointer + "/side", "no side", "\"front\" or \"back\"");
  }
  result.side = *known;
  if (auto done = shares(json, area, pointer, result); !done) return tl::unexpected(done.error());
  if (auto done = parts(json, area, pointer, result); !done) return tl::unexpected(done.error());
  return result;
}

Expected<void> NoteReader::shares(const JsonValue& json, bool area, const std::string& pointer,
                                  RecordedSide& result) const {
  mpq_class sum = 0;
  for (const std::string_view shade : share_names(area)) {
    const std::string place = fmt::format("{}/{}", pointer, shade);
    const JsonValue* value = find_member(json, shade);
    if (value == nullptr) return wrong(place, "a class is missing");
    RecordedShare& share = result.shares.emplace_back();
    if (value->IsNumber()) {
      share.nearest = value->GetDouble();
      continue;
    }
    share.exact = rational(value);
    if (!share.exact) return wrong(place, "no fraction", "a rational as text, or a number");
    share.nearest = share.exact->get_d();
    sum += *share.exact;
  }
  if (!is_exact(result) || sum == 1) return {};
  return wrong(pointer, "the fractions add up to " + sum.get_str(), "1");
}

/// A side whose fractions are not all exact has exact fractions for each of its parts.
Expected<void> NoteReader::parts(const JsonValue& json, bool area, const std::string& pointer,
                                 RecordedSide& result) const {
  const JsonValue* parts = find_member(json, "parts");
  if (is_exact(result) != (parts == nullptr)) {
    return wrong(pointer, "parts are given where they are not needed, or the other way round");
  }
  if (parts == nullptr) return {};
  if (!parts->IsArray()) return wrong(pointer + "/parts", "not a list");
  for (const JsonValue& part : parts->GetArray()) {
    std::vector<mpq_class>& shares = result.parts.emplace_back();
    mpq_class sum = 0;
    for (const std::string_view shade : share_names(area)) {
      auto share = part.IsObject() ? rational(find_member(part, shade)) : std::nullopt;
      if (!share) return wrong(pointer + "/parts", "a part without exact fractions");
      sum += *share;
      shares.push_back(*std::move(share));
    }
    if (sum != 1) return wrong(pointer + "/parts", "fractions that do not add up to 1");
  }
  return {};
}

std::string note_text(const FixtureNote& note, const std::vector<RecordedLight>& lights) {
  report::StringSink sink;
  {
    report::JsonWriter json(sink);
    json.begin_object();
    json.member("shows", note.shows);
    json.member("kind", note.kind);
    if (!note.found.empty()) json.member("found", note.found);
    if (note.inform || !note.wrong.empty()) {
      std::vector<std::string> wrong = note.wrong;
      std::ranges::sort(wrong);
      json.key("wrong");
      json.begin_array(report::JsonLayout::kInline);
      for (const std::string& name : wrong) json.value(name);
      json.end_array();
    }
    json.key("fractions");
    json.begin_object();
    for (const RecordedLight& light : lights) {
      json.key(light.id);
      json.begin_array();
      for (const RecordedSide& side : light.sides) write_shares(json, light, side);
      json.end_array();
    }
    json.end_object();
    json.end_object();
  }
  // Within the scene it stands one level deeper.
  std::string text;
  for (const char c : sink.text()) {
    text += c;
    if (c == '\n') text += ' ';
  }
  return text;
}

}  // namespace gnomon::fuzz
