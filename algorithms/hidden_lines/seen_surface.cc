// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/hidden_lines/seen_surface.h"

#include <array>
#include <numeric>

#include "algorithms/facing_chain/contour.h"

namespace gnomon {

namespace {

BoxTree tree_of(std::vector<Box> boxes) {
  std::vector<std::uint32_t> members(boxes.size());
  std::iota(members.begin(), members.end(), 0u);
  return {std::move(boxes), std::move(members)};
}

/// The side of each support plane that the viewer is on.
std::vector<int> viewer_sides(const Geometry& geometry, const ViewSigns& signs) {
  std::vector<int> sides(geometry.planes.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const SupportTriple plane = geometry.planes[i];
    sides[i] = -signs.bracket(plane.a, plane.b, plane.c);
  }
  return sides;
}

Side facing_side(const Part& part, int viewer_side) {
  const int side = part.flipped ? -viewer_side : viewer_side;
  return side > 0 ? Side::kFront : side < 0 && part.two_sided ? Side::kBack : Side::kOn;
}

}  // namespace

SeenSurface::SeenSurface(const PreparedScene& scene, const PreparedLight& light)
    : scene_(scene), signs_(scene.geometry, light.point), near_(scene.geometry, light.point) {
  const std::vector<int> sides = viewer_sides(scene.geometry, signs_);
  std::vector<Side> hiding(scene.parts.size(), Side::kOn);
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
    const Part& part = scene.parts[i];
    if (casts_under(light, part)) hiding[i] = facing_side(part, sides[part.plane]);
    if (hiding[i] == Side::kOn) continue;
    parts_.push_back({i, hiding[i] == Side::kBack, sides[part.plane]});
    boxes.push_back(near_.box_of(scene.loop(part)));
  }
  part_tree_ = tree_of(std::move(boxes));
  contour_ = contour_of(scene, hiding);
  boxes.clear();
  for (const ContourEdge& edge : contour_) {
    const EdgeEnds own = ends(edge.edge.index());
    boxes.push_back(near_.box_of(std::array{own.a, own.b}));
  }
  contour_tree_ = tree_of(std::move(boxes));
}

DirectedEdge SeenSurface::edge(const SeenPart& seen, std::uint32_t k) const {
  const auto loop = scene_.loop(scene_.parts[seen.part]);
  const VertexId from = loop[k], to = loop[k + 1 == loop.size() ? 0 : k + 1];
  return seen.sees_back ? DirectedEdge{to, from} : DirectedEdge{from, to};
}

int SeenSurface::side(const SeenPart& seen, VertexId vertex) const {
  const SupportTriple plane = scene_.geometry.planes[scene_.parts[seen.part].plane];
  return seen.viewer_side * signs_.volume(plane.a, plane.b, plane.c, vertex);
}

mpz_class SeenSurface::exact_side(const SeenPart& seen, VertexId vertex) const {
  const SupportTriple plane = scene_.geometry.planes[scene_.parts[seen.part].plane];
  return seen.viewer_side * signs_.exact_volume(plane.a, plane.b, plane.c, vertex);
}

void SeenSurface::find_contour(const SightShaft& shaft, std::vector<std::uint32_t>& found) const {
  contour_tree_.find(
      [&](const BoxTree::Node& node, std::uint32_t) { return !shaft.misses(node.box); },
      [&](std::uint32_t i) { return !shaft.misses(contour_tree_.box(i)); }, found);
}

void SeenSurface::find_parts(const SightShaft& shaft, std::vector<std::uint32_t>& found) const {
  part_tree_.find([&](const BoxTree::Node& node, std::uint32_t) { return !shaft.misses(node.box); },
                  [&](std::uint32_t i) { return !shaft.misses(part_tree_.box(i)); }, found);
}

void SeenSurface::find_parts_on(VertexId a, VertexId b, std::vector<std::uint32_t>& found) const {
  const Box own = near_.box_of(std::array{a, b});
  const auto meets = [&](const Box& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (other.low[k] > own.high[k] || other.high[k] < own.low[k]) return false;
    }
    return true;
  };
  part_tree_.find([&](const BoxTree::Node& node, std::uint32_t) { return meets(node.box); },
                  [&](std::uint32_t i) { return meets(part_tree_.box(i)); }, found);
}

}  // namespace gnomon
