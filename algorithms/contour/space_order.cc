// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/space_order.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <utility>

#include "algorithms/partition/in_parallel.h"

namespace gnomon {

namespace {

constexpr int kBitsOfAxis = 11;
constexpr std::uint32_t kUnnamed = 0xffffffffu;
constexpr std::uint32_t kGrain = 4096;  // of one thread

/// Puts two zeros before each bit of a number below 2^kBitsOfAxis.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 16) & 0x00000000ff0000ffu;
  x = (x | x << 8) & 0x000000f00f00f00fu;
  x = (x | x << 4) & 0x000000c30c30c30c3u;
  return (x | x << 2) & 0x0000000249249249u;
}

/// Of each part, the place of the mean of its corners on the curve (Morton 1966).
std::vector<std::uint64_t> places_on_curve(const PreparedScene& scene, unsigned jobs) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::uint32_t>(scene.parts.size());
  std::vector<std::array<double, 3>> means(count);
  in_parallel(jobs, count, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const auto loop = scene.loop(scene.parts[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0;
        for (const VertexId v : loop) sum += scene.geometry.positions[v][k];
        means[i][k] = sum / static_cast<double>(loop.size());
      }
    }
  });
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high{-kInfinity, -kInfinity, -kInfinity};
  for (const std::array<double, 3>& mean : means) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], mean[k]);
      high[k] = std::max(high[k], mean[k]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  constexpr double kMost = (1 << kBitsOfAxis) - 1;
  const double scale = extent > 0 ? kMost / extent : 0;
  std::vector<std::uint64_t> places(count);
  in_parallel(jobs, count, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double cell = std::clamp((means[i][k] - low[k]) * scale, 0.0, kMost);
        // A sum that overflows has no place.
        places[i] |= cell == cell ? spread(static_cast<std::uint64_t>(cell)) << k : 0;
      }
    }
  });
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

/// Lowers `least` to `value`, whatever other threads do.
void lower_to(std::uint32_t& least, std::uint32_t value) {
  const std::atomic_ref<std::uint32_t> shared(least);
  std::uint32_t known = shared.load(std::memory_order_relaxed);
  while (value < known && !shared.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
  }
}

/// New numbers, in the order in which things are first named; what nobody names comes last, in its
/// order. The same for every number of threads.
class Numbering {
 public:
  /// `names`: old numbers below `count`, at most 2^32 - 1 of them.
  Numbering(std::size_t count, const std::vector<std::uint32_t>& names, unsigned jobs)
      : new_(count, kUnnamed) {
    old_.reserve(count);
    if (jobs == 1) {
      for (const std::uint32_t old : names) name(old);
    } else {
      const auto size = static_cast<std::uint32_t>(names.size());
      std::vector<std::uint32_t>& first = new_;  // where each is named first
      in_parallel(jobs, size, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t i = begin; i < end; ++i) lower_to(first[names[i]], i);
      });
      number_by_blocks(names, jobs);
    }
    for (std::uint32_t old = 0; old < count; ++old) name(old);
  }

  std::uint32_t of(std::uint32_t old) const { return new_[old]; }
  const std::vector<std::uint32_t>& old() const { return old_; }

 private:
  void name(std::uint32_t old) {
    if (new_[old] != kUnnamed) return;
    new_[old] = static_cast<std::uint32_t>(old_.size());
    old_.push_back(old);
  }

  // From where each is named first, in new_, to numbers.
  void number_by_blocks(const std::vector<std::uint32_t>& names, unsigned jobs) {
    const auto size = static_cast<std::uint32_t>(names.size());
    const std::uint32_t blocks = (size + kGrain - 1) / kGrain;
    std::vector<std::uint32_t> numbers(blocks + 1);  // first those of each block, then before it
    const auto for_each_first = [&](const auto& body) {
      in_parallel(jobs, blocks, 1, [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t block = begin; block < end; ++block) {
          const std::uint32_t last = std::min(size, (block + 1) * kGrain);
          for (std::uint32_t i = block * kGrain; i < last; ++i) {
            if (firsts_[i]) body(block, i);
          }
        }
      });
    };
    // Which names are the first of theirs, since new_ is written over.
    firsts_.resize(size);
    in_parallel(jobs, size, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) firsts_[i] = new_[names[i]] == i;
    });
    for_each_first([&](std::uint32_t block, std::uint32_t) { ++numbers[block + 1]; });
    for (std::uint32_t block = 0; block < blocks; ++block) numbers[block + 1] += numbers[block];
    old_.resize(numbers[blocks]);
    for_each_first([&](std::uint32_t block, std::uint32_t i) {
      new_[names[i]] = numbers[block];
      old_[numbers[block]++] = names[i];
    });
    firsts_ = {};
  }

  std::vector<std::uint32_t> new_, old_;
  std::vector<std::uint8_t> firsts_;
};

GridPositions reordered(const GridPositions& grid, const std::vector<std::uint32_t>& order,
                        unsigned jobs) {
  const auto count = static_cast<std::uint32_t>(order.size());
  if (grid.is_narrow()) {
    std::vector<std::int64_t> coordinates(3 * order.size());
    in_parallel(jobs, count, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        std::copy_n(grid.narrow_point(order[i]), 3, coordinates.data() + 3 * i);
      }
    });
    return GridPositions::from_narrow(std::move(coordinates));
  }
  std::vector<mpz_class> coordinates(3 * order.size());
  in_parallel(jobs, count, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (int k = 0; k < 3; ++k) {
        coordinates[3 * i + static_cast<std::size_t>(k)] = grid.at(order[i], k);
      }
    }
  });
  return GridPositions::from(std::move(coordinates));
}

Geometry reordered(const Geometry& from, const Numbering& vertices, const Numbering& edges,
                   const Numbering& planes, unsigned jobs) {
  Geometry to;
  to.grid = reordered(from.grid, vertices.old(), jobs);
  to.light_vertices = from.light_vertices;
  to.step = from.step;
  to.origin = from.origin;
  to.positions.resize(from.positions.size());
  to.edges.resize(from.edges.size());
  to.planes.resize(from.planes.size());
  const auto fill = [&](auto& items, const auto& make) {
    in_parallel(jobs, static_cast<std::uint32_t>(items.size()), kGrain,
                [&](std::uint32_t begin, std::uint32_t end) {
                  for (std::uint32_t i = begin; i < end; ++i) items[i] = make(i);
                });
  };
  fill(to.positions, [&](std::uint32_t v) { return from.positions[vertices.old()[v]]; });
  fill(to.edges, [&](std::uint32_t e) {
    const EdgeEnds& ends = from.edges[edges.old()[e]];
    const auto [low, high] = std::minmax({vertices.of(ends.a), vertices.of(ends.b)});
    return EdgeEnds{low, high};
  });
  fill(to.planes, [&](std::uint32_t p) {
    const SupportTriple& plane = from.planes[planes.old()[p]];
    return SupportTriple{vertices.of(plane.a), vertices.of(plane.b), vertices.of(plane.c)};
  });
  return to;
}

/// What the parts name, corner by corner, in their order.
struct Names {
  std::vector<std::uint32_t> vertices, edges, planes;
};

}  // namespace

bool SpaceOrder::pays(const PreparedScene& scene, bool directional) {
  constexpr std::size_t kFewestParts = 20000, kFewestUnderSun = 4000;
  return scene.parts.size() >= (directional ? kFewestUnderSun : kFewestParts);
}

SpaceOrder::SpaceOrder(const PreparedScene& scene, unsigned jobs)
    : parts_(sorted_by(places_on_curve(scene, jobs))) {
  const auto count = static_cast<std::uint32_t>(parts_.size());
  scene_.parts.resize(count);
  std::uint32_t corners = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    scene_.parts[i] = scene.parts[parts_[i]];
    scene_.parts[i].first = corners;
    corners += scene_.parts[i].count;
  }
  const auto for_each_part = [&](const auto& body) {
    in_parallel(jobs, count, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) body(scene_.parts[i], scene.parts[parts_[i]]);
    });
  };
  Names names{std::vector<std::uint32_t>(corners), std::vector<std::uint32_t>(corners),
              std::vector<std::uint32_t>(count)};
  for_each_part([&](const Part& copy, const Part& part) {
    const auto loop = scene.loop(part);
    const auto loop_edges = scene.edges(part);
    for (std::uint32_t k = 0; k < part.count; ++k) {
      names.vertices[copy.first + k] = loop[k];
      names.edges[copy.first + k] = loop_edges[k].index();
    }
    names.planes[static_cast<std::size_t>(&copy - scene_.parts.data())] = part.plane;
  });
  const Geometry& from = scene.geometry;
  const Numbering vertices(from.positions.size(), names.vertices, jobs);
  const Numbering edges(from.edges.size(), names.edges, jobs);
  const Numbering planes(from.planes.size(), names.planes, jobs);
  scene_.loop_vertices.resize(corners);
  scene_.loop_edges.resize(corners);
  for_each_part([&](Part& copy, const Part& part) {
    copy.plane = planes.of(part.plane);
    const auto loop_edges = scene.edges(part);
    for (std::uint32_t k = 0; k < part.count; ++k) {
      const PlaneRef edge = loop_edges[k];
      const EdgeEnds& ends = from.edges[edge.index()];
      const bool turned = vertices.of(ends.a) > vertices.of(ends.b);
      scene_.loop_vertices[copy.first + k] = vertices.of(names.vertices[copy.first + k]);
      scene_.loop_edges[copy.first + k] =
          PlaneRef(edges.of(edge.index()), edge.flipped() != turned);
    }
  });
  scene_.geometry = reordered(from, vertices, edges, planes, jobs);
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
