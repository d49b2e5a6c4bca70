// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/area_clearance.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "oracle/geometry/space_loop.h"
#include "oracle/judge/standing.h"

namespace gnomon::oracle {
namespace {

using space::cross;
using space::dot;
using space::Loop;
using space::minus;
using space::negated;
using standing::kInfinity;
using standing::loop_normal;

constexpr std::size_t kExamined = 6;  // casters that are moved, nearest first

/// a + t d.
RationalPoint moved_by(const RationalPoint& a, const mpq_class& t, const RationalPoint& d) {
  RationalPoint result;
  for (int k = 0; k < 3; ++k) result[k] = a[k] + t * d[k];
  return result;
}

/// Whether a loop in a plane with this normal turns left at every corner.
bool is_convex(const Loop& loop, const RationalPoint& normal) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const RationalPoint to = minus(loop[(i + 1) % n], loop[i]);
    const RationalPoint on = minus(loop[(i + 2) % n], loop[(i + 1) % n]);
    if (dot(cross(to, on), normal) <= 0) return false;
  }
  return true;
}

double length_of(const RationalPoint& vector) {
  return round_up(standing::upper_root(dot(vector, vector)));
}

class AreaMoves {
 public:
  AreaMoves(const PreparedScene& scene, const PreparedLight& light,
            const AreaVisibility& visibility, std::span<const std::uint32_t> receivers, Side side,
            const RationalPoint& point, const AreaClaim& claim)
      : scene_(scene),
        visibility_(visibility),
        receivers_(receivers),
        side_(side),
        point_(point),
        claim_(claim) {
    for (const auto& corner : light.area_loop) light_.push_back(in_scene(corner));
    own_ = loop_of(receivers.front());
    for (const std::uint32_t part : receivers) {
      Loop loop = loop_of(part);
      if (has_point(loop)) own_ = std::move(loop);
    }
    normal_ = loop_normal(own_);
    if (side == Side::kBack) normal_ = negated(normal_);
    seen_ = space::cut(light_, {normal_, own_[0]});
  }

  std::optional<double> nearest() {
    const AreaPointVisibility truth = visibility_.at(receivers_.front(), side_, point_);
    if (truth.behind_light || claim_.is_right(truth)) return std::nullopt;
    for (const auto& [part, share] : truth.by_caster) hiding_.push_back(part);
    for (const std::uint32_t part : casters_to_move()) {
      const Loop loop = loop_of(part);
      carry_edges_across(part, loop);
      pull_corners_back(part, loop);
      move_receiver(loop);
    }
    if (best_ == kInfinity) return std::nullopt;
    return best_;
  }

 private:
  RationalPoint in_scene(const std::array<mpz_class, 3>& grid) const {
    const Geometry& geometry = scene_.geometry;
    RationalPoint result;
    for (int k = 0; k < 3; ++k) result[k] = geometry.origin[k] + geometry.step * grid[k];
    return result;
  }
  Loop loop_of(std::uint32_t part) const {
    const GridPositions& grid = scene_.geometry.grid;
    Loop loop;
    for (const VertexId vertex : scene_.loop(scene_.parts[part])) {
      loop.push_back(in_scene({grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)}));
    }
    return loop;
  }
  bool has_point(const Loop& loop) const {
    const RationalPoint normal = loop_normal(loop);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const RationalPoint edge = minus(loop[(i + 1) % loop.size()], loop[i]);
      if (dot(cross(normal, edge), minus(point_, loop[i])) < 0) return false;
    }
    return true;
  }
  bool is_receiver(std::uint32_t part) const {
    return std::ranges::find(receivers_, part) != receivers_.end();
  }

  std::vector<std::uint32_t> casters_to_move() const;
  void carry_edges_across(std::uint32_t part, const Loop& loop);
  void pull_corners_back(std::uint32_t part, const Loop& loop);
  void move_receiver(const Loop& loop);
  /// Takes a move if it is the shortest so far and makes the claim right.
  void try_corner(std::uint32_t part, const Loop& loop, std::size_t corner,
                  const RationalPoint& to);
  /// How far a corner of R has to move for p to move by s normal_; infinite where the light does
  /// not stay in front.
  double receiver_move(const mpq_class& s) const;

  const PreparedScene& scene_;
  const AreaVisibility& visibility_;
  std::span<const std::uint32_t> receivers_;
  Side side_;
  const RationalPoint& point_;
  AreaClaim claim_;
  Loop light_, own_, seen_;
  RationalPoint normal_;  // of the side
  std::vector<std::uint32_t> hiding_;
  double best_ = kInfinity;
};

/// Those that hide some of the light, and those whose border is nearest to the lines from p to the
/// light's corners, or whose plane is nearest to p.
std::vector<std::uint32_t> AreaMoves::casters_to_move() const {
  using Near = standing::Vector<double>;
  const auto rounded = [](const RationalPoint& point) {
    return Near{point[0].get_d(), point[1].get_d(), point[2].get_d()};
  };
  const Near from = rounded(point_);
  std::vector<Near> corners;
  for (const RationalPoint& corner : seen_) corners.push_back(rounded(corner));
  std::vector<std::pair<double, std::uint32_t>> others;
  std::vector<Near> loop;
  for (std::uint32_t part = 0; part < scene_.parts.size(); ++part) {
    if (!scene_.parts[part].casts || is_receiver(part)) continue;
    loop.clear();
    for (const VertexId vertex : scene_.loop(scene_.parts[part])) {
      loop.push_back(scene_.geometry.positions[vertex]);
    }
    const Near normal = loop_normal(loop);
    const double length = std::sqrt(standing::dot(normal, normal));
    double distance = std::fabs(standing::dot(normal, standing::minus(from, loop[0]))) /
                      (length > 0 ? length : 1);
    for (const Near& corner : corners) {
      distance = std::min(distance, standing::stand(loop, false, corner, from).border);
    }
    if (std::ranges::find(hiding_, part) != hiding_.end()) distance = -1;
    if (distance < kInfinity) others.emplace_back(distance, part);
  }
  const std::size_t count = std::min(others.size(), kExamined);
  std::ranges::partial_sort(others, others.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(others[i].second);
  return result;
}

void AreaMoves::try_corner(std::uint32_t part, const Loop& loop, std::size_t corner,
                           const RationalPoint& to) {
  const double length = length_of(minus(to, loop[corner]));
  if (!(length < best_)) return;
  Loop other = loop;
  other[corner] = to;
  if (!is_convex(other, loop_normal(loop))) return;
  std::vector<std::uint32_t> casters = hiding_;
  if (std::ranges::find(casters, part) == casters.end()) casters.push_back(part);
  std::ranges::sort(casters);
  const AreaPointVisibility seen =
      visibility_.at_if_moved(receivers_.front(), side_, point_, casters, part, other);
  if (claim_.is_right(seen)) best_ = length;
}

void AreaMoves::carry_edges_across(std::uint32_t part, const Loop& loop) {
  const RationalPoint normal = loop_normal(loop);
  const mpq_class height = dot(normal, minus(point_, loop[0]));
  for (const RationalPoint& corner : seen_) {
    const mpq_class beyond = dot(normal, minus(corner, loop[0]));
    if (sgn(height) * sgn(beyond) >= 0) continue;  // not between
    const RationalPoint x = moved_by(point_, height / (height - beyond), minus(corner, point_));
    std::optional<mpq_class> least;
    RationalPoint apart;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t j = (i + 1) % loop.size();
      const RationalPoint edge = minus(loop[j], loop[i]);
      mpq_class along = dot(minus(x, loop[i]), edge) / dot(edge, edge);
      if (along < 0) along = 0;
      if (along > 1) along = 1;
      const RationalPoint to_x = minus(x, moved_by(loop[i], along, edge));
      const mpq_class squared = dot(to_x, to_x);
      if (least && *least <= squared) continue;
      least = squared;
      apart = to_x;
      nearest = 2 * along <= 1 ? i : j;
    }
    // Twice the distance, and a little more.
    try_corner(part, loop, nearest, moved_by(loop[nearest], mpq_class(1048577, 524288), apart));
  }
}

void AreaMoves::pull_corners_back(std::uint32_t part, const Loop& loop) {
  if (std::ranges::find(hiding_, part) == hiding_.end()) return;
  const std::size_t n = loop.size();
  for (std::size_t e = 0; e < seen_.size(); ++e) {
    // The plane through p and an edge of what R sees of the light, the light in front.
    RationalPoint normal =
        cross(minus(seen_[e], point_), minus(seen_[(e + 1) % seen_.size()], point_));
    if (dot(normal, minus(seen_[(e + 2) % seen_.size()], point_)) < 0) normal = negated(normal);
    std::vector<mpq_class> heights;
    std::size_t in_front = 0, corner = 0;
    for (std::size_t i = 0; i < n; ++i) {
      heights.push_back(dot(normal, minus(loop[i], point_)));
      if (heights.back() <= 0) continue;
      ++in_front;
      corner = i;
    }
    if (in_front != 1) continue;
    // From where one edge of the corner meets the plane to where the other does: the nearest point.
    const auto meeting = [&](std::size_t other) {
      return moved_by(loop[corner], heights[corner] / (heights[corner] - heights[other]),
                      minus(loop[other], loop[corner]));
    };
    const RationalPoint first = meeting((corner + n - 1) % n);
    const RationalPoint across = minus(meeting((corner + 1) % n), first);
    mpq_class along = dot(minus(loop[corner], first), across) / dot(across, across);
    if (along < 0) along = 0;
    if (along > 1) along = 1;
    try_corner(part, loop, corner, moved_by(first, along, across));
  }
}

double AreaMoves::receiver_move(const mpq_class& s) const {
  const auto in_front = [&](const RationalPoint& normal, const RationalPoint& base) {
    return std::ranges::all_of(
        light_, [&](const RationalPoint& corner) { return dot(normal, minus(corner, base)) > 0; });
  };
  if (!in_front(normal_, own_[0])) return kInfinity;
  // In a fan of triangles, the one with the point: its corner of the largest weight.
  const std::size_t n = own_.size();
  std::size_t corner = n;
  mpq_class weight;
  for (std::size_t i = 2; i < n && corner == n; ++i) {
    const std::array<std::size_t, 3> triangle{0, i - 1, i};
    std::array<mpq_class, 3> parts;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const RationalPoint& a = own_[triangle[(k + 1) % 3]];
      parts[k] = dot(cross(minus(own_[triangle[(k + 2) % 3]], a), minus(point_, a)), normal_);
      if (side_ == Side::kBack) parts[k] = -parts[k];
      inside = inside && parts[k] >= 0;
    }
    if (!inside) continue;
    const mpq_class whole = parts[0] + parts[1] + parts[2];
    for (std::size_t k = 0; k < 3; ++k) {
      if (parts[k] <= weight * whole) continue;
      weight = parts[k] / whole;
      corner = triangle[k];
    }
  }
  if (corner == n) return kInfinity;
  const RationalPoint step = moved_by({}, s / weight, normal_);
  Loop bent = own_;
  bent[corner] = moved_by(bent[corner], 1, step);
  for (std::size_t i = 2; i < n; ++i) {
    RationalPoint normal = cross(minus(bent[i - 1], bent[0]), minus(bent[i], bent[0]));
    if (side_ == Side::kBack) normal = negated(normal);
    if (!in_front(normal, bent[0])) return kInfinity;
  }
  return length_of(step);
}

void AreaMoves::move_receiver(const Loop& loop) {
  const RationalPoint normal = loop_normal(loop);
  const mpq_class along = dot(normal, normal_);
  if (along == 0) return;
  const mpq_class s = -dot(normal, minus(point_, loop[0])) / along;
  // A little beyond the plane; from the plane itself to both sides.
  std::vector<mpq_class> steps{s * mpq_class(1048577, 1048576)};
  if (s == 0) {
    const mpq_class least = mpq_class(1, 1) / (mpz_class(1) << 200);
    steps = {least, -least};
  }
  for (const mpq_class& step : steps) {
    const double length = receiver_move(step);
    if (!(length < best_)) continue;
    std::vector<std::uint32_t> casters;
    for (std::uint32_t part = 0; part < scene_.parts.size(); ++part) {
      if (scene_.parts[part].casts && !is_receiver(part)) casters.push_back(part);
    }
    const RationalPoint moved = moved_by(point_, step, normal_);
    if (claim_.is_right(visibility_.at(receivers_.front(), side_, moved, true, casters))) {
      best_ = length;
    }
  }
}

}  // namespace

bool AreaClaim::is_right(const AreaPointVisibility& seen) const {
  switch (state) {
    case LightState::kPenumbra:
      return per_caster ? seen.state == LightState::kPenumbra : seen.state != LightState::kLit;
    case LightState::kUmbra:
      return seen.state == LightState::kUmbra || (!per_caster && seen.deep());
    default:
      return seen.state == state;
  }
}

std::optional<double> area_clearance(const PreparedScene& scene, const PreparedLight& light,
                                     const AreaVisibility& visibility,
                                     std::span<const std::uint32_t> receivers, Side side,
                                     const RationalPoint& point, const AreaClaim& claim) {
  return AreaMoves(scene, light, visibility, receivers, side, point, claim).nearest();
}

}  // namespace gnomon::oracle
