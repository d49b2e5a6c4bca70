// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/scene_builder.h"

#include <utility>

#include "scene/base/text_file.h"
#include "scene/files/left_out.h"
#include "scene/files/readers.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon {

namespace {

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

void SceneBuilder::write_extra(const std::string& format, std::vector<ExtraFact> facts) {
  facts.emplace_back("kinds", json_array(kind_names(owners_.list(), kinds_.list())));
  scene_.extra = extra_with_groups(scene_, owners_.list(), kinds_.list(), format, facts);
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
