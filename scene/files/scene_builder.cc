// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/scene_builder.h"

#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <unordered_set>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/files/left_out.h"
#include "scene/files/readers.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon {

namespace {

using JsonWriter = rapidjson::Writer<rapidjson::StringBuffer>;

void write_text(JsonWriter& writer, std::string_view text) {
  writer.String(text.data(), static_cast<rapidjson::SizeType>(text.size()));
}

/// Equal texts for equal numbers of one base.
void append_key(std::string& key, const Number& number) {
  if (number.has_small_mantissa()) {
    key += std::to_string(number.small_mantissa());
  } else {
    key += number.mantissa().get_str();
  }
  key += number.is_decimal() ? 'e' : 'p';
  key += std::to_string(number.is_zero() ? 0 : number.exponent());
  key += ' ';
}

}  // namespace

void GroupList::add(const std::string& name, std::uint32_t polygon) {
  const auto [place, is_new] = index_.try_emplace(name, list_.size());
  if (is_new) list_.push_back({name, {}});
  list_[place->second].polygons.push_back(polygon);
}

std::string counted_as(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

SceneBuilder::SceneBuilder(const std::string& file, const ReadOptions& options,
                           NumberMeaning numbers)
    : options_(options) {
  scene_.file = file;
  scene_.name = name_from_file(file);
  scene_.numbers = options.numbers.value_or(numbers);
}

Expected<Position> SceneBuilder::as_meant(const Position& exact) {
  Position result;
  for (std::size_t axis = 0; axis < result.size(); ++axis) {
    const Number& number = exact[axis];
    if (number.is_zero()) continue;
    if (!number.is_decimal() && scene_.numbers == NumberMeaning::kDouble && number.is_double()) {
      result[axis] = number;
      continue;
    }
    bool underflow = false;
    auto meant = gnomon::as_meant(number.is_decimal() ? number : decimal_of(number.exact()),
                                  scene_.numbers, underflow);
    if (!meant) return tl::unexpected(std::move(meant.error()));
    if (underflow) ++underflows_;
    result[axis] = *std::move(meant);
  }
  return result;
}

Expected<VertexId> SceneBuilder::vertex(const Position& exact) {
  auto position = as_meant(exact);
  if (!position) return tl::unexpected(std::move(position.error()));
  std::string key;
  for (const Number& coordinate : *position) append_key(key, coordinate);
  const auto [place, is_new] =
      vertex_index_.try_emplace(std::move(key), static_cast<VertexId>(scene_.vertices.size()));
  if (is_new) scene_.vertices.push_back(*std::move(position));
  return place->second;
}

Expected<std::vector<VertexId>> SceneBuilder::vertices(const std::vector<Position>& exact) {
  std::vector<VertexId> ids;
  for (const Position& position : exact) {
    auto id = vertex(position);
    if (!id) return tl::unexpected(std::move(id.error()));
    ids.push_back(*id);
  }
  return ids;
}

Expected<Polygon*> SceneBuilder::add(const std::string& id, std::uint64_t offset) {
  if (id.empty()) return fail(ErrorCode::kId, "a surface without a name", "a name");
  if (!names_.try_emplace(id, 0).second) {
    return fail(ErrorCode::kId, "a second surface " + quoted_text(id), "names that differ");
  }
  Polygon& polygon = scene_.polygons.emplace_back();
  polygon.id = id;
  offsets_.push_back(offset);
  return &polygon;
}

std::string SceneBuilder::free_id(const std::string& id) {
  if (names_.try_emplace(id, 0).second) return id;
  for (;;) {
    std::string next = id + "/" + std::to_string(++names_[id]);
    if (names_.try_emplace(next, 0).second) return next;
  }
}

Polygon& SceneBuilder::add_renamed(const std::string& id, std::uint64_t offset) {
  Polygon& polygon = scene_.polygons.emplace_back();
  polygon.id = free_id(id);
  offsets_.push_back(offset);
  return polygon;
}

void SceneBuilder::take_back(std::size_t count) {
  while (scene_.polygons.size() > count) {
    names_.erase(scene_.polygons.back().id);
    scene_.polygons.pop_back();
    offsets_.pop_back();
  }
}

void SceneBuilder::add_bad(const std::string& id, std::uint64_t offset, Error why) {
  problems_.push_back({static_cast<std::uint32_t>(scene_.polygons.size()), std::move(why)});
  scene_.polygons.emplace_back().id = id;
  offsets_.push_back(offset);
}

void SceneBuilder::put_into_groups(const std::string& owner, const std::string& kind) {
  const auto polygon = static_cast<std::uint32_t>(scene_.polygons.size() - 1);
  if (!owner.empty()) owners_.add(owner, polygon);
  if (!kind.empty()) kinds_.add(kind, polygon);
}

void SceneBuilder::write_extra(const std::string& name,
                               const std::vector<std::pair<std::string, std::string>>& facts) {
  rapidjson::StringBuffer buffer;
  JsonWriter writer(buffer);
  std::unordered_set<std::string> owners;
  for (const PolygonGroup& owner : owners_.list()) owners.insert(owner.name);
  const auto kind_name = [&](const PolygonGroup& kind) {
    std::string shown = kind.name;
    while (owners.contains(shown)) shown += " surfaces";
    return shown;
  };
  const auto write_group = [&](const std::string& shown, const PolygonGroup& group) {
    write_text(writer, shown);
    writer.StartArray();
    for (const std::uint32_t polygon : group.polygons) {
      write_text(writer, scene_.polygons[polygon].id);
    }
    writer.EndArray();
  };
  writer.StartObject();
  write_text(writer, "groups");
  writer.StartObject();
  for (const PolygonGroup& owner : owners_.list()) write_group(owner.name, owner);
  for (const PolygonGroup& kind : kinds_.list()) write_group(kind_name(kind), kind);
  writer.EndObject();
  write_text(writer, name);
  writer.StartObject();
  for (const auto& [key, value] : facts) {
    write_text(writer, key);
    writer.RawValue(value.data(), value.size(), rapidjson::kStringType);
  }
  write_text(writer, "kinds");
  writer.StartArray();
  for (const PolygonGroup& kind : kinds_.list()) write_text(writer, kind_name(kind));
  writer.EndArray();
  writer.EndObject();
  writer.EndObject();
  scene_.extra.assign(buffer.GetString(), buffer.GetSize());
}

void SceneBuilder::warn_of(std::size_t count, const std::string& one, const std::string& many,
                           const std::string& rest) {
  if (count != 0) warn(counted_as(count, one, many) + rest);
}

ReadResult SceneBuilder::finish() {
  warn_of(underflows_, "coordinate is", "coordinates are", " too small for full double precision");
  if (!options_.skip_bad && !options_.polygon_offsets) offsets_.clear();
  ReadResult result{std::move(scene_), std::move(warnings_), {}, std::move(offsets_)};
  leave_out(result, std::move(problems_));
  if (result.scene.polygons.empty()) result.warnings.emplace_back("the scene has no polygons");
  return result;
}

}  // namespace gnomon
