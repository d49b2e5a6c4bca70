// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "scene/repair/snap.h"

namespace gnomon::scene_detail {

namespace {

/// Offsets of lists, from their lengths at [i + 1].
void add_up(std::vector<std::uint32_t>& first) {
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
}

}  // namespace

SnapRound::SnapRound(const Scene& scene, PreparedScene prepared)
    : scene_(scene),
      prepared_(std::move(prepared)),
      points_(prepared_),
      position_(prepared_.geometry.positions.size()) {
  const std::size_t vertices = position_.size();
  first_input_.assign(vertices + 1, 0);
  for (const std::uint32_t vertex : prepared_.vertex_of_input) {
    if (vertex != PreparedScene::kUnused) ++first_input_[vertex + 1];
  }
  add_up(first_input_);
  inputs_.resize(first_input_.back());
  std::vector<std::uint32_t> next(first_input_.begin(), first_input_.end() - 1);
  for (std::uint32_t i = 0; i < prepared_.vertex_of_input.size(); ++i) {
    const std::uint32_t vertex = prepared_.vertex_of_input[i];
    if (vertex != PreparedScene::kUnused) inputs_[next[vertex]++] = i;
  }
  std::vector<std::vector<VertexId>> outlines;
  first_polygon_.assign(vertices + 1, 0);
  for (std::uint32_t p = 0; p < scene_.polygons.size(); ++p) {
    for (const VertexId vertex : outlines.emplace_back(outline(p))) ++first_polygon_[vertex + 1];
  }
  add_up(first_polygon_);
  polygons_.resize(first_polygon_.back());
  next.assign(first_polygon_.begin(), first_polygon_.end() - 1);
  for (std::uint32_t p = 0; p < outlines.size(); ++p) {
    for (const VertexId vertex : outlines[p]) polygons_[next[vertex]++] = p;
  }
}

const RationalPoint& SnapRound::at(VertexId vertex) {
  std::optional<RationalPoint>& position = position_[vertex];
  if (!position) {
    const Position& input = scene_.vertices[inputs(vertex)[0]];
    position = RationalPoint{input[0].exact(), input[1].exact(), input[2].exact()};
  }
  return *position;
}

std::vector<VertexId> SnapRound::outline(std::uint32_t polygon) const {
  std::vector<VertexId> vertices;
  const auto add = [&](const std::vector<VertexId>& ring) {
    for (const VertexId vertex : ring) vertices.push_back(prepared_.vertex_of_input[vertex]);
  };
  add(scene_.polygons[polygon].loop);
  for (const auto& hole : scene_.polygons[polygon].holes) add(hole);
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::optional<RationalPlane> SnapRound::plane_of(std::uint32_t polygon) {
  if (prepared_.first_part[polygon] == prepared_.first_part[polygon + 1]) return std::nullopt;
  const std::vector<VertexId> vertices = outline(polygon);
  // Of any three that are not in one line; far apart, for the sake of shares of its edges.
  const RationalPoint& a = at(vertices[0]);
  const auto farthest = std::ranges::max_element(
      vertices, {}, [&](VertexId vertex) { return mpq_class(square_of(at(vertex) - a)); });
  const RationalPoint& b = at(*farthest);
  const auto widest = std::ranges::max_element(vertices, {}, [&](VertexId vertex) {
    return mpq_class(square_of(cross_product(b - a, at(vertex) - a)));
  });
  auto plane = plane_through(a, b, at(*widest));
  if (!plane) return std::nullopt;
  for (const VertexId vertex : vertices) {
    if (!plane->holds(at(vertex))) return std::nullopt;
  }
  return plane;
}

}  // namespace gnomon::scene_detail
