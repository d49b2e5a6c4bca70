// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/image/lit_samples.h"

#include <algorithm>
#include <utility>

namespace gnomon::oracle {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

Integer3 normal_of(const SampledView& view, const Part& part) {
  const auto loop = view.scene().loop(part);
  const Integer3 a = view.position(loop[0]);
  return cross_of(difference_of(view.position(loop[1]), a),
                  difference_of(view.position(loop[2]), a));
}

/// The sign of the plane of the part's front at the light.
int front_at_light(const SampledView& view, const PreparedLight& light, const Part& part) {
  const Integer3 n = normal_of(view, part);
  const Integer3 at{light.point.grid[0], light.point.grid[1], light.point.grid[2]};
  if (light.point.directional) return sgn(dot_of(n, at));
  return sgn(dot_of(n, difference_of(at, view.position(view.scene().loop(part)[0]))));
}

CertifiedPlane plane_through(const SampledView& view, Integer3 n, const Integer3& base) {
  mpz_class at_eye = dot_of(n, difference_of(view.eye(), base));
  return {std::move(n), std::move(at_eye), view.bits()};
}

Integer3 times(int sign, Integer3 v) {
  if (sign < 0) {
    for (mpz_class& x : v) x = -x;
  }
  return v;
}

}  // namespace

RationalPoint seen_point(const SampledView& view, const CertifiedPlane& plane,
                         const SampleRay& ray) {
  const Geometry& geometry = view.scene().geometry;
  mpq_class t(-plane.at_eye(), dot_of(plane.n(), ray.exact));
  t.canonicalize();
  RationalPoint point;
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = geometry.origin[k] + geometry.step * mpq_class(view.eye()[k] + t * ray.exact[k]);
  }
  return point;
}

std::vector<std::int8_t> LitSamples::fronts(const SampledView& view, const PreparedLight& light) {
  std::vector<std::int8_t> result;
  for (const Part& part : view.scene().parts) {
    result.push_back(static_cast<std::int8_t>(front_at_light(view, light, part)));
  }
  return result;
}

std::vector<std::uint32_t> LitSamples::facing_parts() const {
  std::vector<std::uint32_t> parts;
  for (std::uint32_t p = 0; p < front_.size(); ++p) {
    const Part& part = view_.scene().parts[p];
    if (part.casts && (front_[p] > 0 || (front_[p] < 0 && part.two_sided))) parts.push_back(p);
  }
  return parts;
}

LitSamples::LitSamples(const SampledView& view, const SeenParts& seen, const PreparedLight& light)
    : view_(view),
      seen_(seen),
      light_(light),
      exact_(view.scene(), light),
      front_(fronts(view, light)),
      place_(view.scene().parts.size(), kNone),
      index_(view.scene(), light, facing_parts()),
      receivers_(view.scene().parts.size()) {
  for (const std::uint32_t part : facing_parts()) {
    place_[part] = static_cast<std::uint32_t>(casters_.size());
    casters_.push_back(caster_of(part));
  }
  for (auto& receiver : receivers_) receiver = std::make_unique<MadeOnce<Receiver>>();
}

LitSamples::Caster LitSamples::caster_of(std::uint32_t index) const {
  const Part& part = view_.scene().parts[index];
  const auto loop = view_.scene().loop(part);
  const int side = front_[index];
  Caster caster;
  caster.part = index;
  caster.plane = plane_through(view_, times(side, normal_of(view_, part)), view_.position(loop[0]));
  const Integer3 light{light_.point.grid[0], light_.point.grid[1], light_.point.grid[2]};
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Integer3 a = view_.position(loop[k]), b = view_.position(loop[(k + 1) % loop.size()]);
    const Integer3 to_light = light_.point.directional ? light : difference_of(light, a);
    // Of a loop that turns left seen from the light, the inside is where this is positive.
    caster.edges.push_back(
        plane_through(view_, times(side, cross_of(to_light, difference_of(b, a))), a));
  }
  return caster;
}

LitSamples::Receiver LitSamples::receiver_of(std::uint32_t part) const {
  Receiver receiver;
  const std::vector<Part>& parts = view_.scene().parts;
  for (const std::uint32_t caster : index_.overlapping(part)) {
    // Coplanar parts do not shadow each other.
    if (caster == part || parts[caster].plane == parts[part].plane) continue;
    receiver.casters.push_back(place_[caster]);
  }
  return receiver;
}

PointVisibility LitSamples::at(std::uint32_t part, const SampleRay& ray) {
  if (!faces(part)) return {Visibility::kShadow, std::nullopt};
  if (!light_.region.empty()) {
    const PointVisibility seen = exact_.at(part, seen_point(view_, seen_.plane(part), ray), {});
    if (seen.visibility != Visibility::kLit) return seen;
  }
  const Receiver& receiver = receivers_[part]->get([&] { return receiver_of(part); });
  // From the eye the point is q = t d, t = P(E) / -(n . d): off by the bound of n . d, relative,
  // and 8u from the value at the eye, the direction, the quotient and the product.
  const CertifiedPlane& plane = seen_.plane(part);
  const double along = -plane.along(ray), bound = plane.along_bound(ray);
  const bool known = along > 2 * bound;
  const double t = known ? plane.eye() / along : 0;
  const Double3 q{t * ray.d[0], t * ray.d[1], t * ray.d[2]};
  const double largest = std::fabs(t) * ray.largest;
  const double error = known ? largest * (2 * bound / along + 12 * kRoundoff)
                             : std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> open;
  for (const std::uint32_t place : receiver.casters) {
    const Caster& caster = casters_[place];
    int behind = -caster.plane.certain_side_at(q, largest, error);
    if (behind == -1) continue;
    bool certain = behind == 1, outside = false;
    for (const CertifiedPlane& edge : caster.edges) {
      const int side = edge.certain_side_at(q, largest, error);
      outside = side == -1;
      if (outside) break;
      certain = certain && side == 1;
    }
    if (outside) continue;
    if (certain) return {Visibility::kShadow, caster.part};
    open.push_back(caster.part);
  }
  if (open.empty()) return {};
  return exact_.at(part, seen_point(view_, plane, ray), open);
}

}  // namespace gnomon::oracle
