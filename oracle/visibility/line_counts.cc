// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/line_counts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "oracle/geometry/chart.h"
#include "oracle/geometry/space_loop.h"

namespace gnomon::oracle {

namespace {

RationalPoint rational(const Integers3& point) {
  return {mpq_class(point[0]), mpq_class(point[1]), mpq_class(point[2])};
}

/// Doubles that hold the coordinates for certain, and go on for ever towards a direction.
struct NearBox {
  std::array<double, 3> low{}, high{};

  void set(std::size_t axis, double from, double to) {
    constexpr double kWiden = 0x1p-50;  // of themselves; GMP truncates by less than 2^-52
    low[axis] = from - kWiden * std::fabs(from);
    high[axis] = to + kWiden * std::fabs(to);
  }
  bool is_clear_of(const NearBox& other) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (low[k] > other.high[k] || other.low[k] > high[k]) return true;
    }
    return false;
  }
};

}  // namespace

struct LineCounts::Data {
  struct Hiding {
    std::vector<Integers3> loop;    // counter-clockwise as seen from the eye
    ExactPlane plane;               // positive at the eye
    std::vector<ExactPlane> walls;  // through the eye and each edge, positive inside
    // For single points.
    std::vector<RationalPoint> corners, inward, wall_normals;
    RationalPoint normal;
    NearBox box;
  };

  const PreparedScene& scene;
  bool directional = false;
  Integers3 eye;
  std::vector<Hiding> hiding;

  Data(const PreparedScene& prepared, const PreparedLight& light)
      : scene(prepared), directional(light.point.directional), eye(light.point.grid) {
    for (const Part& part : scene.parts) {
      if (part.casts || light.is_eye) add(part);
    }
  }

  Integers3 position(VertexId vertex) const {
    const GridPositions& grid = scene.geometry.grid;
    return {grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)};
  }
  /// From a point towards the eye.
  Integers3 to_eye(const Integers3& from) const { return directional ? eye : minus(eye, from); }

  static ExactPlane plane_at(Integers3 normal, const Integers3& point) {
    ExactPlane plane{std::move(normal), 0};
    plane.offset = dot(plane.normal, point);
    return plane;
  }

  void add(const Part& part) {
    Hiding one;
    for (const VertexId vertex : scene.loop(part)) one.loop.push_back(position(vertex));
    Integers3 normal = cross(minus(one.loop[1], one.loop[0]), minus(one.loop[2], one.loop[0]));
    const int side = sgn(dot(normal, to_eye(one.loop[0])));
    if (side == 0 || (side < 0 && !part.two_sided)) return;
    if (side < 0) {
      std::ranges::reverse(one.loop);
      for (mpz_class& component : normal) component = -component;
    }
    one.plane = plane_at(std::move(normal), one.loop[0]);
    const std::size_t size = one.loop.size();
    for (std::size_t i = 0; i < size; ++i) {
      const Integers3& from = one.loop[i];
      const Integers3& to = one.loop[(i + 1) % size];
      ExactPlane wall = plane_at(cross(to_eye(from), minus(to, from)), from);
      // The corner after next is inside.
      if (value_at(wall, one.loop[(i + 2) % size]) < 0) wall = opposite(std::move(wall));
      one.walls.push_back(std::move(wall));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::ranges::minmax_element(
          one.loop, {}, [&](const Integers3& point) -> const mpz_class& { return point[k]; });
      one.box.set(k, (*low)[k].get_d(), (*high)[k].get_d());
    }
    one.normal = rational(one.plane.normal);
    for (std::size_t i = 0; i < size; ++i) {
      one.corners.push_back(rational(one.loop[i]));
      one.inward.push_back(
          rational(cross(one.plane.normal, minus(one.loop[(i + 1) % size], one.loop[i]))));
      one.wall_normals.push_back(rational(one.walls[i].normal));
    }
    hiding.push_back(std::move(one));
  }

  /// Of the triangle between points and the eye, or of the strip from them towards the light.
  NearBox box_of(const Integers3& a, const Integers3& b) const {
    NearBox box;
    for (std::size_t k = 0; k < 3; ++k)
      box.set(k, std::min(a[k], b[k]).get_d(), std::max(a[k], b[k]).get_d());
    add_eye(box);
    return box;
  }
  NearBox box_of(const RationalPoint& point) const {
    NearBox box;
    for (std::size_t k = 0; k < 3; ++k) box.set(k, point[k].get_d(), point[k].get_d());
    add_eye(box);
    return box;
  }
  void add_eye(NearBox& box) const {
    NearBox own;
    for (std::size_t k = 0; k < 3; ++k) {
      own.set(k, eye[k].get_d(), eye[k].get_d());
      if (!directional) {
        box.low[k] = std::min(box.low[k], own.low[k]);
        box.high[k] = std::max(box.high[k], own.high[k]);
      } else if (eye[k] < 0) {
        box.low[k] = -HUGE_VAL;
      } else if (eye[k] > 0) {
        box.high[k] = HUGE_VAL;
      }
    }
  }
};

namespace {

/// The t of [0, 1] at which all functions added so far are not negative.
class Interval {
 public:
  void keep_where_positive(const mpz_class& at_start, const mpz_class& at_end) {
    const int first = sgn(at_start), last = sgn(at_end);
    if (first >= 0 && last >= 0) return;
    if (first <= 0 && last <= 0) {
      to_ = -1;
      return;
    }
    mpq_class zero(at_start, at_start - at_end);
    zero.canonicalize();
    if (first < 0) {
      if (zero > from_) from_ = std::move(zero);
    } else if (zero < to_) {
      to_ = std::move(zero);
    }
  }
  bool is_empty() const { return from_ >= to_; }
  const mpq_class& from() const { return from_; }
  const mpq_class& to() const { return to_; }

 private:
  mpq_class from_ = 0, to_ = 1;
};

struct Change {
  mpq_class at;
  std::array<int, 2> by{};  // moved to one side, to the other
};

}  // namespace

LineCounts::LineCounts(const PreparedScene& scene, const PreparedLight& light)
    : data_(std::make_unique<Data>(scene, light)) {}
LineCounts::~LineCounts() = default;
LineCounts::LineCounts(LineCounts&&) noexcept = default;

std::vector<CountedPart> LineCounts::parts(EdgeId edge) const {
  const EdgeEnds ends = data_->scene.geometry.edges[edge];
  const Integers3 a = data_->position(ends.a), b = data_->position(ends.b);
  const Integers3 aside = cross(data_->to_eye(a), minus(b, a));
  const NearBox box = data_->box_of(a, b);
  std::vector<Change> changes;
  for (const Data::Hiding& one : data_->hiding) {
    if (one.box.is_clear_of(box)) continue;
    const mpz_class at_a = value_at(one.plane, a), at_b = value_at(one.plane, b);
    if (at_a == 0 && at_b == 0) continue;
    Interval interval;
    interval.keep_where_positive(-at_a, -at_b);
    std::array<int, 2> counts{1, 1};
    for (const ExactPlane& wall : one.walls) {
      const mpz_class wall_a = value_at(wall, a), wall_b = value_at(wall, b);
      if (wall_a == 0 && wall_b == 0) {
        const int side = sgn(dot(wall.normal, aside));
        if (side < 0) counts[0] = 0;
        if (side > 0) counts[1] = 0;
      } else {
        interval.keep_where_positive(wall_a, wall_b);
      }
    }
    if (interval.is_empty()) continue;
    changes.push_back({interval.from(), counts});
    changes.push_back({interval.to(), {-counts[0], -counts[1]}});
  }
  std::ranges::sort(changes, {}, &Change::at);
  std::vector<CountedPart> result;
  std::array<int, 2> counts{};
  std::size_t i = 0;
  for (mpq_class from = 0; from < 1;) {
    for (; i < changes.size() && changes[i].at <= from; ++i) {
      for (std::size_t k = 0; k < 2; ++k) counts[k] += changes[i].by[k];
    }
    mpq_class to = i < changes.size() ? changes[i].at : mpq_class(1);
    const auto count = static_cast<std::uint32_t>(std::max(counts[0], counts[1]));
    if (!result.empty() && result.back().hidden_by == count) {
      result.back().end = to;
    } else {
      result.push_back({to, count});
    }
    from = std::move(to);
  }
  return result;
}

std::optional<std::uint32_t> LineCounts::count_at(EdgeId edge, const mpq_class& t) const {
  const EdgeEnds ends = data_->scene.geometry.edges[edge];
  const RationalPoint a = rational(data_->position(ends.a)), b = rational(data_->position(ends.b));
  const RationalPoint along = space::minus(b, a), eye = rational(data_->eye);
  RationalPoint x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = a[k] + t * along[k];
  const RationalPoint to_eye = data_->directional ? eye : space::minus(eye, x);
  const RationalPoint aside = space::cross(to_eye, along);
  const NearBox box = data_->box_of(x);
  std::array<std::uint32_t, 2> counts{};
  for (const Data::Hiding& one : data_->hiding) {
    if (one.box.is_clear_of(box)) continue;
    // x + s (eye - x) is on the plane; it is not x, nor beyond the eye.
    const mpq_class behind = space::dot(one.normal, space::minus(one.corners[0], x));
    if (behind < 0) continue;
    const bool is_on_plane = behind == 0;
    if (is_on_plane && space::dot(one.normal, along) == 0) continue;
    const mpq_class s = behind / space::dot(one.normal, to_eye);
    RationalPoint met;
    for (std::size_t k = 0; k < 3; ++k) met[k] = x[k] + s * to_eye[k];
    std::vector<std::size_t> on;  // edges whose lines hold the point
    bool outside = false;
    for (std::size_t i = 0; i < one.corners.size() && !outside; ++i) {
      const int side = sgn(space::dot(one.inward[i], space::minus(met, one.corners[i])));
      outside = side < 0;
      if (side == 0) on.push_back(i);
    }
    if (outside) continue;
    if (is_on_plane) return std::nullopt;
    bool first = true, second = true;
    for (const std::size_t i : on) {
      if (space::dot(one.wall_normals[i], along) != 0) return std::nullopt;
      const int moved = sgn(space::dot(one.wall_normals[i], aside));
      first = first && moved >= 0;
      second = second && moved <= 0;
    }
    counts[0] += first ? 1 : 0;
    counts[1] += second ? 1 : 0;
  }
  return std::max(counts[0], counts[1]);
}

}  // namespace gnomon::oracle
