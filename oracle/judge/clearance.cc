// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/clearance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/judge/standing.h"

namespace gnomon::oracle {

namespace {

using standing::cross;
using standing::dot;
using standing::kInfinity;
using standing::loop_normal;
using standing::minus;
using standing::stand;
using standing::Standing;
using standing::upper_root;
using standing::Vector;

constexpr std::size_t kExamined = 6;  // casters looked at exactly, nearest first

class Decider {
 public:
  Decider(const PreparedScene& scene, const PreparedLight& light, std::uint32_t receiver,
          const RationalPoint& point)
      : scene_(scene),
        receiver_(receiver),
        point_(point),
        directional_(light.point.directional),
        is_eye_(light.is_eye) {
    for (int k = 0; k < 3; ++k) {
      light_[k] =
          directional_
              ? mpq_class(light.point.grid[k])
              : mpq_class(scene.geometry.origin[k] + scene.geometry.step * light.point.grid[k]);
    }
    own_loop_ = exact_loop(receiver);
    for (int k = 0; k < 3; ++k) {
      near_point_[k] = point_[k].get_d();
      near_light_[k] = light_[k].get_d();
    }
    if (directional_) {
      // A primitive integer vector may be beyond doubles.
      const double longest = std::max(
          {std::fabs(near_light_[0]), std::fabs(near_light_[1]), std::fabs(near_light_[2])});
      if (!std::isfinite(longest)) near_light_ = light.point.nearest;
    }
  }

  Decision decide();

 private:
  std::vector<RationalPoint> exact_loop(std::uint32_t part) const {
    const Geometry& geometry = scene_.geometry;
    std::vector<RationalPoint> loop;
    for (VertexId vertex : scene_.loop(scene_.parts[part])) {
      RationalPoint position;
      for (int k = 0; k < 3; ++k) {
        position[k] = geometry.origin[k] + geometry.step * geometry.grid.at(vertex, k);
      }
      loop.push_back(position);
    }
    return loop;
  }
  bool casts(std::uint32_t part, const std::vector<RationalPoint>& loop) const {
    if (part == receiver_ || !(scene_.parts[part].casts || is_eye_)) return false;
    const RationalPoint normal = loop_normal(loop);
    const mpq_class height =
        directional_ ? dot(normal, light_) : dot(normal, minus(light_, loop[0]));
    if (!(height > 0 || (height < 0 && scene_.parts[part].two_sided))) return false;
    return std::any_of(own_loop_.begin(), own_loop_.end(), [&](const RationalPoint& vertex) {
      return dot(normal, minus(vertex, loop[0])) != 0;
    });
  }
  bool covers(std::uint32_t part, const RationalPoint& point) const {
    const std::vector<RationalPoint> loop = exact_loop(part);
    return casts(part, loop) && stand(loop, directional_, light_, point).inside;
  }
  /// (b) for one caster: 3 s, if moving R's point across the caster's plane changes whether it
  /// covers.
  double move_receiver(std::uint32_t part, const std::vector<RationalPoint>& loop,
                       bool covered) const;

  const PreparedScene& scene_;
  std::uint32_t receiver_;
  RationalPoint point_, light_;
  std::vector<RationalPoint> own_loop_;
  Vector<double> near_point_{}, near_light_{};
  bool directional_, is_eye_;
  std::vector<std::uint32_t> near_casters_;
};

double Decider::move_receiver(std::uint32_t part, const std::vector<RationalPoint>& loop,
                              bool covered) const {
  const RationalPoint normal = loop_normal(loop), own = loop_normal(own_loop_);
  const mpq_class along = dot(normal, own);
  if (along == 0) return kInfinity;
  mpq_class s = -dot(normal, minus(point_, loop[0])) / along;
  s *= mpq_class(1048577, 1048576);  // a little beyond the plane
  if (s == 0) s = mpq_class(1, 1) / (mpz_class(1) << 200);
  RationalPoint moved;
  for (int k = 0; k < 3; ++k) moved[k] = point_[k] + s * own[k];
  if (covers(part, moved) == covered) return kInfinity;
  if (covered) {
    for (std::uint32_t other : near_casters_) {
      if (covers(other, moved)) return kInfinity;
    }
  }
  return round_up(3 * upper_root(mpq_class(s * s * dot(own, own))));
}

Decision Decider::decide() {
  struct Estimate {
    std::uint32_t part;
    double distance;
    bool maybe_covers;
  };
  std::vector<Estimate> estimates;
  std::vector<Vector<double>> loop;
  for (std::uint32_t part = 0; part < scene_.parts.size(); ++part) {
    if (part == receiver_ || !scene_.parts[part].casts) continue;
    loop.clear();
    double size = 0;
    for (VertexId vertex : scene_.loop(scene_.parts[part])) {
      loop.push_back(scene_.geometry.positions[vertex]);
      for (double coordinate : loop.back()) size = std::max(size, std::fabs(coordinate));
    }
    const Standing standing = stand(loop, directional_, near_light_, near_point_);
    const Vector<double> normal = loop_normal(loop);
    const double length = std::sqrt(dot(normal, normal));
    const double height =
        std::fabs(dot(normal, minus(near_point_, loop[0]))) / (length > 0 ? length : 1);
    const double slack = 1e-9 * size;
    const bool near_plane = !(height > slack);
    if (!standing.between && !near_plane) continue;
    const double distance = near_plane ? std::min(standing.border, height) : standing.border;
    estimates.push_back(
        {part, distance, standing.inside || near_plane || !(standing.border > slack)});
  }
  std::sort(estimates.begin(), estimates.end(),
            [](const Estimate& a, const Estimate& b) { return a.distance < b.distance; });
  for (const Estimate& estimate : estimates) {
    if (estimate.maybe_covers) near_casters_.push_back(estimate.part);
  }
  std::vector<std::uint32_t> covering;
  for (std::uint32_t part : near_casters_) {
    if (covers(part, point_)) covering.push_back(part);
  }
  std::vector<std::uint32_t> looked_at = covering;
  if (covering.empty()) {
    for (std::size_t i = 0; i < std::min(kExamined, estimates.size()); ++i) {
      looked_at.push_back(estimates[i].part);
    }
  }
  Decision decision;
  double best = kInfinity;
  for (std::uint32_t part : looked_at) {
    const std::vector<RationalPoint> loop = exact_loop(part);
    if (!casts(part, loop)) continue;
    double own = move_receiver(part, loop, !covering.empty());
    if (covering.size() <= 1) {
      const Standing standing = stand(loop, directional_, light_, point_);
      if (standing.between) own = std::min(own, round_up(2 * standing.border));
    }
    if (own < best || !decision.caster) decision.caster = part;
    best = std::min(best, own);
  }
  if (best < kInfinity) decision.clearance = best;
  return decision;
}

}  // namespace

Decision decide(const PreparedScene& scene, const PreparedLight& light, std::uint32_t receiver,
                const RationalPoint& point) {
  return Decider(scene, light, receiver, point).decide();
}

}  // namespace gnomon::oracle
