// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/nodes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace gnomon {

void NodeTable::find_contacts(const FaceLoops& loops, std::vector<std::uint32_t> others) {
  insides_.assign(loops.faces.size(), MeshNode::kShared);
  for (const MeshFace& face : loops.faces) {
    if (face.penumbra_of == 0) continue;
    const auto loop = loops.loop(face);
    others.insert(others.end(), loop.begin(), loop.end());
  }
  contacts_.find(points_, others);
}

std::uint32_t NodeTable::node(std::uint32_t vertex, const FaceLoops& loops, std::uint32_t f) {
  const MeshFace& face = loops.faces[f];
  if (face.penumbra_of == 0 || !contacts_.touches(vertex, face)) {
    return add(vertex, face, MeshNode::kShared);
  }
  if (insides_[f] == MeshNode::kShared) {
    insides_[f] = points_.insert(new_point(inner_point(loops.loop(face), points_)));
  }
  const bool own = contacts_.is_behind(vertex, face, points_.exact(insides_[f]));
  return add(vertex, face, own ? insides_[f] : MeshNode::kShared);
}

std::uint32_t NodeTable::add(std::uint32_t vertex, const MeshFace& face, std::uint32_t inside) {
  const Part& part = scene_.parts[face.part];
  const bool back = part.flipped != (face.side == Side::kBack);
  const auto [at, is_new] = numbers_.emplace(Key{vertex, 2 * part.plane + (back ? 1 : 0), inside},
                                             static_cast<std::uint32_t>(nodes_.size()));
  if (is_new) {
    nodes_.push_back({vertex, inside, face.part, face.side, 0, 0, 0, 0});
    values_.resize(values_.size() + lights_, 0);
    errors_.resize(errors_.size() + lights_, 0);
  }
  MeshNode& node = nodes_[at->second];
  node.lit_by |= face.lit_by;
  node.penumbra_of |= face.penumbra_of;
  return at->second;
}

double NodeTable::shade(std::uint32_t node, const MeshFace& face) const {
  double sum = 0;
  const std::uint64_t shone_on = face.lit_by | face.penumbra_of;
  for (std::size_t light = 0; light < lights_; ++light) {
    if ((shone_on >> light & 1) != 0) sum += value(node, light);
  }
  return sum;
}

void NodeTable::illuminate(std::size_t light, const ShadeFunction& shade,
                           const std::function<bool(double)>& go_on) {
  const std::uint64_t bit = std::uint64_t{1} << light;
  std::vector<std::uint32_t> missing;
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const MeshNode& node = nodes_[n];
    const bool lit = (node.lit_by & bit) != 0;
    const std::uint64_t known = lit ? node.known_lit : node.known_lit | node.known_penumbra;
    if ((known & bit) == 0 && ((node.lit_by | node.penumbra_of) & bit) != 0) missing.push_back(n);
  }
  // Nodes between two looks at the clock of progress and at interruption.
  constexpr std::size_t kBatch = 1024;
  for (std::size_t begin = 0; begin < missing.size(); begin += kBatch) {
    if (!go_on(static_cast<double>(begin) / static_cast<double>(missing.size()))) return;
    const std::size_t end = std::min(missing.size(), begin + kBatch);
    tbb::parallel_for(begin, end,
                      [&](std::size_t i) { illuminate_node(missing[i], light, shade); });
  }
}

void NodeTable::illuminate_node(std::uint32_t n, std::size_t light, const ShadeFunction& shade) {
  const std::uint64_t bit = std::uint64_t{1} << light;
  MeshNode& node = nodes_[n];
  const bool lit = (node.lit_by & bit) != 0;
  const bool shared = node.inside == MeshNode::kShared;
  std::array<mpq_class, 3> inside;
  if (!shared) inside = points_.exact(node.inside).rational();
  const PointShade result =
      shade({static_cast<std::uint32_t>(light), node.part, node.side,
             points_.exact(node.vertex).rational(), lit, shared ? nullptr : &inside});
  values_[n * lights_ + light] = result.value;
  errors_[n * lights_ + light] = result.error_bound;
  (lit ? node.known_lit : node.known_penumbra) |= bit;
}

double NodeTable::largest_shade() const {
  double largest = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    double sum = 0;
    for (std::size_t light = 0; light < lights_; ++light) sum += values_[n * lights_ + light];
    largest = std::max(largest, sum);
  }
  return largest;
}

double NodeTable::largest_error(std::size_t light) const {
  double largest = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    largest = std::max(largest, errors_[n * lights_ + light]);
  }
  return largest;
}

}  // namespace gnomon
