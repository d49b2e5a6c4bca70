// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/radiance/seams.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <utility>

namespace gnomon {

namespace {

using Vector = std::array<mpq_class, 3>;

/// Twice the area vector, as Newell has it.
Vector area_vector(const Scene& scene, const std::vector<VertexId>& loop) {
  const auto at = [&](VertexId vertex) -> Vector {
    const Position& position = scene.vertices[vertex];
    return {position[0].exact(), position[1].exact(), position[2].exact()};
  };
  Vector sum, before = at(loop.back());
  for (const VertexId vertex : loop) {
    Vector here = at(vertex);
    for (std::size_t x = 0; x < 3; ++x) {
      const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
      sum[x] += before[y] * here[z] - before[z] * here[y];
    }
    before = std::move(here);
  }
  return sum;
}

mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Two edges, by the places that they begin at, that are one edge in both directions.
std::optional<std::pair<std::size_t, std::size_t>> seam_of(const std::vector<VertexId>& loop) {
  std::unordered_map<std::uint64_t, std::size_t> edges;
  const auto key = [](VertexId a, VertexId b) { return std::uint64_t{a} << 32 | b; };
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const VertexId from = loop[i], to = loop[(i + 1) % loop.size()];
    const auto found = edges.find(key(to, from));
    if (found != edges.end()) return std::pair(found->second, i);
    edges.emplace(key(from, to), i);
  }
  return std::nullopt;
}

void drop_repeated(std::vector<VertexId>& loop) {
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
}

}  // namespace

LoopWithHoles without_seams(const Scene& scene, std::vector<VertexId> loop) {
  constexpr std::size_t kFewest = 3;
  std::vector<std::vector<VertexId>> waiting = {loop}, parts;
  bool has_seams = false;
  while (!waiting.empty()) {
    std::vector<VertexId> part = std::move(waiting.back());
    waiting.pop_back();
    drop_repeated(part);
    if (part.size() < kFewest) continue;
    const auto seam = seam_of(part);
    if (!seam) {
      parts.push_back(std::move(part));
      continue;
    }
    has_seams = true;
    // u v ... v u ...: the part between the seam's edges, and all the rest.
    const auto begin = part.begin();
    const auto first = static_cast<std::ptrdiff_t>(seam->first),
               second = static_cast<std::ptrdiff_t>(seam->second);
    waiting.emplace_back(begin + first + 1, begin + second);
    std::vector<VertexId> rest(begin, begin + first);
    rest.insert(rest.end(), begin + second + 1, part.end());
    waiting.push_back(std::move(rest));
  }
  if (!has_seams) return LoopWithHoles{std::move(loop), {}};
  std::vector<Vector> areas;
  std::size_t greatest = 0;
  for (const std::vector<VertexId>& part : parts) {
    areas.push_back(area_vector(scene, part));
    if (dot(areas.back(), areas.back()) > dot(areas[greatest], areas[greatest])) {
      greatest = areas.size() - 1;
    }
  }
  // All of it is seams: preparation drops it.
  if (parts.empty()) return LoopWithHoles{std::move(loop), {}};
  LoopWithHoles result;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i == greatest) continue;
    const int turns = sgn(dot(areas[i], areas[greatest]));
    if (turns > 0) return LoopWithHoles{std::move(loop), {}};
    if (turns < 0) result.holes.push_back(std::move(parts[i]));
  }
  result.loop = std::move(parts[greatest]);
  return result;
}

}  // namespace gnomon
