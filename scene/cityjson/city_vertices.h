// SPDX-License-Identifier: LGPL-3.0-or-later
// The vertices of a CityJSON file: integers times a scale plus a translation, all three exactly the
// decimals of their texts; and those of geometry templates, moved by a matrix.
#ifndef GNOMON_SCENE_CITYJSON_CITY_VERTICES_H
#define GNOMON_SCENE_CITYJSON_CITY_VERTICES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gnomon/scene/scene.h"
#include "scene/json/json_tape.h"

namespace gnomon {

/// v * scale + translate, axis by axis.
struct CityTransform {
  Position scale, translate;
};
/// Errors: kFormat, kLimit.
Expected<CityTransform> read_city_transform(const JsonNode& node);

/// The places of vertices in a tape. Numbers are read when they are asked for.
class CityVertices {
 public:
  CityVertices() = default;
  /// Errors: kFormat, if it is no array of arrays of three numbers.
  static Expected<CityVertices> read(const JsonNode& list);

  std::size_t size() const { return nodes_.size(); }
  JsonNode node(const JsonTape& tape, std::uint32_t vertex) const { return {tape, nodes_[vertex]}; }

 private:
  std::vector<std::uint32_t> nodes_;  // indices of the tape
};

/// Three decimals as they are written. Requires: an array of three numbers. Errors: kLimit.
Expected<Position> exact_position(const JsonNode& node);
/// Moved and scaled by the transform, if there is one; still decimal.
Position transformed(Position position, const std::optional<CityTransform>& transform);

/// The 4x4 matrix of a geometry instance, without its last row, which is 0 0 0 1.
class CityMatrix {
 public:
  /// Errors: kFormat, kLimit.
  static Expected<CityMatrix> read(const JsonNode& node);
  /// The matrix times the point, plus the anchor.
  Position apply(const Position& point, const Position& anchor) const;
  /// Does it turn what is counter-clockwise into what is clockwise?
  bool mirrors() const;

 private:
  std::array<Number, 12> entries_;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_CITYJSON_CITY_VERTICES_H
