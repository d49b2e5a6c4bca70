// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/small_lattice.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "fuzz/generate/random_shapes.h"
#include "fuzz/generate/scene_pen.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {
namespace {

using Loop = std::vector<Triple>;

constexpr std::int64_t kLast = 2;  // the lattice is [0, kLast]^3

bool is_triangle(const Triple& a, const Triple& b, const Triple& c) {
  return !is_zero(cross(b - a, c - a));
}
bool on_lattice(const Triple& p) {
  return std::ranges::all_of(p, [](std::int64_t x) { return 0 <= x && x <= kLast; });
}

/// Coordinates of the lattice in, a scene out. A lattice step is two units of the pen, so that
/// lamps may stand half-way.
class LatticePen {
 public:
  explicit LatticePen(Random& random)
      : random_(random), sides_(static_cast<Sides>(random.below(4))) {}

  void add_something() {
    switch (random_.below(10)) {
      case 0:
        return add_duplicate();
      case 1:
        return add_reversed();
      case 2:
      case 3:
        return add_fan();
      case 4:
        return add_box();
      case 5:
        return add_t_junction();
      default:
        return add_patch();
    }
  }

  /// A triangle or a parallelogram, often a rectangle.
  void add_patch() {
    for (;;) {
      const Triple p = point(), q = point(), r = point();
      if (!is_triangle(p, q, r)) continue;
      const Triple fourth = q + r - p;
      Loop loop = {p, q, r};
      if (on_lattice(fourth) && random_.chance(2, 3)) loop = {p, q, fourth, r};
      return add(loop);
    }
  }

  std::size_t size() const { return loops_.size(); }

  void add_lights() {
    const std::uint64_t draw = random_.below(8);
    if (draw < 5) add_lamp();
    if (draw >= 4) pen_.sun(direction(random_, 2));
  }
  Scene take() { return pen_.take(); }

 private:
  enum class Sides : std::uint8_t { kOne, kTwo, kEither, kEitherAgain };

  Triple point() { return point_in(random_, 0, kLast); }
  void choose_flags() {
    pen_.two_sided(sides_ == Sides::kTwo || (sides_ >= Sides::kEither && random_.chance(1, 2)));
    pen_.casts(!random_.chance(1, 7));
  }
  /// With flags of its own.
  void add(const Loop& loop) {
    choose_flags();
    add_as_before(loop);
  }
  void add_as_before(const Loop& loop) {
    Loop doubled;
    for (const Triple& p : loop) doubled.push_back(2 * p);
    pen_.polygon(doubled);
    loops_.push_back(loop);
  }

  void add_duplicate() {
    if (loops_.empty()) return add_patch();
    Loop loop = loops_[random_.below(loops_.size())];
    const auto turn = static_cast<std::ptrdiff_t>(random_.below(loop.size()));
    std::rotate(loop.begin(), loop.begin() + turn, loop.end());
    add(loop);
  }
  void add_reversed() {
    if (loops_.empty()) return add_patch();
    Loop loop = loops_[random_.below(loops_.size())];
    std::ranges::reverse(loop);
    add(loop);
  }

  /// Triangles around a common vertex, each with an edge of the one before: in one plane around a
  /// square's middle, or anywhere in space.
  void add_fan() {
    Triple apex = point();
    std::vector<Triple> ring;
    if (random_.chance(1, 2)) {
      const std::size_t w = random_.below(3), u = (w + 1) % 3, v = (w + 2) % 3;
      static constexpr std::array<std::array<std::int64_t, 2>, 9> kAround = {
          {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {0, 0}}};
      apex[u] = apex[v] = 1;
      const std::size_t step = 1 + random_.below(2);  // triangles of one area or of two
      const std::size_t begin = random_.below(3), count = 2 + random_.below(8 / step - 1);
      for (std::size_t i = 0; i <= count; ++i) {
        Triple p = apex;
        const auto& at = kAround[(step * (begin + i)) % 8];
        p[u] = at[0], p[v] = at[1];
        ring.push_back(p);
      }
    } else {
      for (std::size_t i = 0; i < 4; ++i) ring.push_back(point());
    }
    const bool reversed = random_.chance(1, 2);
    if (reversed) std::ranges::reverse(ring);
    choose_flags();
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
      if (is_triangle(apex, ring[i], ring[i + 1])) add_as_before({apex, ring[i], ring[i + 1]});
    }
  }

  void add_box() {
    const Triple low = point_in(random_, 0, kLast - 1);
    Triple high;
    for (std::size_t k = 0; k < 3; ++k) high[k] = random_.between(low[k] + 1, kLast);
    middle_ = low + high;
    choose_flags();
    pen_.box(2 * low, 2 * high, random_.chance(1, 3));
    // Its bottom and top, for copies.
    loops_.push_back(
        {low, {high[0], low[1], low[2]}, {high[0], high[1], low[2]}, {low[0], high[1], low[2]}});
    loops_.push_back(
        {{low[0], low[1], high[2]}, {high[0], low[1], high[2]}, high, {low[0], high[1], high[2]}});
  }

  /// An edge with a lattice point in its middle: one triangle on it, and two that meet there.
  void add_t_junction() {
    Triple a{}, b{};
    while (a == b) {
      a = point(), b = a;
      for (std::size_t k = 0; k < 3; ++k) {
        if (a[k] != 1 && random_.chance(1, 2)) b[k] = kLast - a[k];
      }
    }
    Triple middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (a[k] + b[k]) / 2;
    const Triple c = point(), d = point(), e = random_.chance(1, 2) ? d : point();
    if (is_triangle(a, b, c)) add({a, b, c});
    choose_flags();
    if (is_triangle(middle, a, d)) add_as_before({middle, a, d});
    if (is_triangle(b, middle, e)) add_as_before({b, middle, e});
  }

  void add_lamp() {
    switch (random_.below(5)) {
      case 0:  // on a lattice point
        pen_.lamp(2 * point());
        break;
      case 1: {  // in a polygon's plane
        const Loop& loop = loops_[random_.below(loops_.size())];
        const Triple u = loop[1] - loop[0], v = loop[2] - loop[0];
        const std::int64_t i = random_.between(-2, 4), j = random_.between(-2, 4);
        pen_.lamp(2 * loop[0] + i * u + j * v);
        break;
      }
      case 2:  // in the middle of a box, or of a cell
        pen_.lamp(is_zero(middle_) ? 2 * point_in(random_, 0, kLast - 1) + Triple{1, 1, 1}
                                   : middle_);
        break;
      default:
        pen_.lamp(point_in(random_, -4, 2 * kLast + 4));
    }
  }

  Random& random_;
  Sides sides_;
  ScenePen pen_{-1};
  std::vector<Loop> loops_;  // in steps of the lattice
  Triple middle_{};          // of the last box, in units of the pen; 0 if there is none
};

}  // namespace

Scene small_lattice(std::uint64_t seed) {
  Random random(seed);
  LatticePen pen(random);
  constexpr std::size_t kEnough = 7;
  const std::int64_t count = random.between(2, 5);
  for (std::int64_t i = 0; (i < count || pen.size() < 2) && pen.size() < kEnough; ++i) {
    pen.add_something();
  }
  pen.add_lights();
  return pen.take();
}

}  // namespace gnomon::fuzz
