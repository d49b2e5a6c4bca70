// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/space_order.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace gnomon {

namespace {

constexpr int kBitsOfAxis = 11;
constexpr std::uint32_t kUnnamed = 0xffffffffu;

/// Puts two zeros before each bit of a number below 2^kBitsOfAxis.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x00000000ff0000ffu;
  x = (x | x << 8) & 0x000000f00f00f00fu;
  x = (x | x << 4) & 0x000000c30c30c30c3u;
  return (x | x << 2) & 0x0000000249249249u;
}

/// Of each part, the place of the mean of its corners on the curve (Morton 1966).
std::vector<std::uint64_t> places_on_curve(const PreparedScene& scene) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high{-kInfinity, -kInfinity, -kInfinity};
  std::vector<std::array<double, 3>> means(scene.parts.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const auto loop = scene.loop(scene.parts[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0;
      for (const VertexId v : loop) sum += scene.geometry.positions[v][k];
      means[i][k] = sum / static_cast<double>(loop.size());
      low[k] = std::min(low[k], means[i][k]);
      high[k] = std::max(high[k], means[i][k]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  constexpr double kMost = (1 << kBitsOfAxis) - 1;
  const double scale = extent > 0 ? kMost / extent : 0;
  std::vector<std::uint64_t> places(means.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double cell = std::clamp((means[i][k] - low[k]) * scale, 0.0, kMost);
      // A sum that overflows has no place.
      places[i] |= cell == cell ? spread(static_cast<std::uint64_t>(cell)) << k : 0;
    }
  }
  return places;
}

/// The order of numbers of 3 kBitsOfAxis bits; equal ones stay in theirs.
std::vector<std::uint32_t> sorted_by(const std::vector<std::uint64_t>& places) {
  std::vector<std::uint32_t> order(places.size()), next(places.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  constexpr std::size_t kDigits = std::size_t{1} << kBitsOfAxis;
  for (int shift = 0; shift < 3 * kBitsOfAxis; shift += kBitsOfAxis) {
    std::array<std::uint32_t, kDigits + 1> first{};
    const auto digit = [&](std::uint32_t i) { return places[i] >> shift & (kDigits - 1); };
    for (const std::uint32_t i : order) ++first[digit(i) + 1];
    for (std::size_t d = 0; d < kDigits; ++d) first[d + 1] += first[d];
    for (const std::uint32_t i : order) next[first[digit(i)]++] = i;
    order.swap(next);
  }
  return order;
}

/// New numbers, in the order in which things are first named.
class Numbering {
 public:
  explicit Numbering(std::size_t count) : new_(count, kUnnamed) { old_.reserve(count); }

  std::uint32_t of(std::uint32_t old) {
    if (new_[old] == kUnnamed) {
      new_[old] = static_cast<std::uint32_t>(old_.size());
      old_.push_back(old);
    }
    return new_[old];
  }
  /// What nobody has named comes last, in its order.
  void name_rest() {
    for (std::uint32_t old = 0; old < new_.size(); ++old) of(old);
  }
  const std::vector<std::uint32_t>& old() const { return old_; }

 private:
  std::vector<std::uint32_t> new_, old_;
};

GridPositions reordered(const GridPositions& grid, const std::vector<std::uint32_t>& order) {
  if (grid.is_narrow()) {
    std::vector<std::int64_t> coordinates(3 * order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      std::copy_n(grid.narrow_point(order[i]), 3, coordinates.begin() + 3 * i);
    }
    return GridPositions::from_narrow(std::move(coordinates));
  }
  std::vector<mpz_class> coordinates;
  coordinates.reserve(3 * order.size());
  for (const std::uint32_t v : order) {
    for (int k = 0; k < 3; ++k) coordinates.push_back(grid.at(v, k));
  }
  return GridPositions::from(std::move(coordinates));
}

}  // namespace

bool SpaceOrder::pays(const PreparedScene& scene) {
  constexpr std::size_t kFewestParts = 20000;
  return scene.parts.size() >= kFewestParts;
}

SpaceOrder::SpaceOrder(const PreparedScene& scene) : parts_(sorted_by(places_on_curve(scene))) {
  const Geometry& from = scene.geometry;
  Geometry& to = scene_.geometry;
  Numbering vertices(from.positions.size()), edges(from.edges.size()), planes(from.planes.size());
  for (const std::uint32_t index : parts_) {
    for (const VertexId v : scene.loop(scene.parts[index])) vertices.of(v);
  }
  vertices.name_rest();
  scene_.parts.reserve(parts_.size());
  scene_.loop_vertices.reserve(scene.loop_vertices.size());
  scene_.loop_edges.reserve(scene.loop_edges.size());
  to.edges.reserve(from.edges.size());
  for (const std::uint32_t index : parts_) {
    const Part& part = scene.parts[index];
    Part& copy = scene_.parts.emplace_back(part);
    copy.first = static_cast<std::uint32_t>(scene_.loop_vertices.size());
    copy.plane = planes.of(part.plane);
    for (const VertexId v : scene.loop(part)) scene_.loop_vertices.push_back(vertices.of(v));
    for (const PlaneRef edge : scene.edges(part)) {
      const EdgeEnds& ends = from.edges[edge.index()];
      const bool turned = vertices.of(ends.a) > vertices.of(ends.b);
      scene_.loop_edges.emplace_back(edges.of(edge.index()), edge.flipped() != turned);
    }
  }
  edges.name_rest();
  planes.name_rest();
  to.positions.reserve(from.positions.size());
  for (const std::uint32_t v : vertices.old()) to.positions.push_back(from.positions[v]);
  to.light_vertices = from.light_vertices;
  to.grid = reordered(from.grid, vertices.old());
  to.step = from.step;
  to.origin = from.origin;
  for (const std::uint32_t e : edges.old()) {
    const auto [low, high] =
        std::minmax({vertices.of(from.edges[e].a), vertices.of(from.edges[e].b)});
    to.edges.push_back({low, high});
  }
  to.planes.reserve(from.planes.size());
  for (const std::uint32_t p : planes.old()) {
    const SupportTriple& plane = from.planes[p];
    to.planes.push_back({vertices.of(plane.a), vertices.of(plane.b), vertices.of(plane.c)});
  }
  scene_.lights = scene.lights;
  scene_.position_bits = scene.position_bits;
  scene_.direction_bits = scene.direction_bits;
}

void SpaceOrder::restore(LightResult& result) const {
  std::vector<PartResult> parts(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    parts[parts_[i]] = result.parts[i];
    parts[parts_[i]].part = parts_[i];
  }
  result.parts = std::move(parts);
  if (result.exact_fractions.empty()) return;
  std::vector<ExactFractions> fractions(parts_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    fractions[parts_[i]] = std::move(result.exact_fractions[i]);
  }
  result.exact_fractions = std::move(fractions);
}

}  // namespace gnomon
