// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/image/seen_parts.h"

#include <algorithm>
#include <utility>

namespace gnomon::oracle {
namespace {

Integer3 negated(Integer3 v) {
  for (mpz_class& x : v) x = -x;
  return v;
}

}  // namespace

SampledView::SampledView(const PreparedView& view, const ExactCamera& camera)
    : scene_(view.scene),
      camera_(camera),
      eye_(view.frame.eye.grid),
      bits_(view.scene.geometry.grid.bits()) {
  for (const mpz_class& x : eye_) {
    if (x != 0) bits_ = std::max(bits_, static_cast<unsigned>(mpz_sizeinbase(x.get_mpz_t(), 2)));
  }
}

SampleRay SampledView::ray(std::uint32_t i, std::uint32_t j) const {
  const std::int64_t w = camera_.width, h = camera_.height;
  const std::int64_t across = h * (2 * std::int64_t{i} + 1 - w);
  const std::int64_t upwards = w * (h - 1 - 2 * std::int64_t{j});
  SampleRay ray;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int64_t x =
        w * h * camera_.forward[k] + across * camera_.right[k] + upwards * camera_.up[k];
    ray.exact[k] = static_cast<long>(x);
    ray.d[k] = static_cast<double>(x);
    ray.largest = std::max(ray.largest, std::fabs(ray.d[k]));
  }
  return ray;
}

SampleRay SampledView::moved_ray(std::uint32_t i, std::uint32_t j) const {
  SampleRay ray = this->ray(i, j);
  ray.largest = 0;
  // What is asked of a ray is linear in it, an integer of five coordinates of the grid, or of six
  // where one is a light's, and of the ray: a move by less than one over that cannot turn it.
  const unsigned move = 8 * bits_ + 64;
  for (std::size_t k = 0; k < 3; ++k) {
    ray.exact[k] = (ray.exact[k] << (2 * move)) + (mpz_class(camera_.right[k]) << move) +
                   mpz_class(camera_.up[k]);
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, ray.exact[k].get_mpz_t());
    ray.d[k] = std::ldexp(mantissa, static_cast<int>(exponent - 2 * static_cast<long>(move)));
    ray.largest = std::max(ray.largest, std::fabs(ray.d[k]));
  }
  return ray;
}

Integer3 SampledView::position(VertexId vertex) const {
  const GridPositions& grid = scene_.geometry.grid;
  return {grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)};
}

SeenParts::SeenParts(const SampledView& view)
    : view_(view),
      place_(view.scene().parts.size(), Seen::kNothing),
      blocks_((view.width() + kBlock - 1) / kBlock),
      cells_(std::size_t{blocks_} * view.height()) {
  for (std::uint32_t part = 0; part < view.scene().parts.size(); ++part) add(part);
}

void SeenParts::add(std::uint32_t index) {
  const Part& part = view_.scene().parts[index];
  std::vector<Integer3> loop;  // from the eye
  for (const VertexId v : view_.scene().loop(part)) {
    loop.push_back(difference_of(view_.position(v), view_.eye()));
  }
  const Integer3 n = cross_of(difference_of(loop[1], loop[0]), difference_of(loop[2], loop[0]));
  const mpz_class at_eye = -dot_of(n, loop[0]);
  const int side = sgn(at_eye);
  if (side == 0 || (side < 0 && !part.two_sided)) return;
  Facing facing;
  facing.part = index;
  facing.back = side < 0;
  facing.plane = facing.back ? CertifiedPlane(negated(n), -at_eye, view_.bits())
                             : CertifiedPlane(n, at_eye, view_.bits());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Integer3 &a = loop[k], &b = loop[(k + 1) % loop.size()];
    facing.edges.emplace_back(facing.back ? cross_of(a, b) : cross_of(b, a), 0, view_.bits());
  }
  const Rectangle box = rectangle_of(part);
  const auto place = static_cast<std::uint32_t>(facing_.size());
  for (std::uint32_t j = box.top; j < box.bottom; ++j) {
    if (box.left >= box.right) break;
    for (std::uint32_t b = box.left / kBlock; b <= (box.right - 1) / kBlock; ++b) {
      cells_[std::size_t{j} * blocks_ + b].push_back(place);
    }
  }
  place_[index] = place;
  facing_.push_back(std::move(facing));
}

// A point q from the eye is a R + b U + c F with a, b, c quotients of determinants: its column is
// that of a / c. Determinants of doubles are off by 32 u of the product of the largest components;
// where that is below 2^-20 of c's, a column or row inside the picture is off by less than one.
SeenParts::Rectangle SeenParts::rectangle_of(const Part& part) const {
  const ExactCamera& camera = view_.camera();
  const auto doubles = [](const std::array<std::int32_t, 3>& v) {
    return Double3{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  };
  const auto cross = [](const Double3& a, const Double3& b) {
    return Double3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  // Integers below 2^31, exactly.
  const Double3 r = doubles(camera.right), u = doubles(camera.up), f = doubles(camera.forward);
  Double3 along_f = cross(r, u), along_r = cross(u, f), along_u = cross(f, r);
  if (dot_of(along_f, f) < 0) {
    for (Double3* v : {&along_f, &along_r, &along_u}) {
      for (double& x : *v) x = -x;
    }
  }
  const Rectangle all{0, view_.width(), 0, view_.height()};
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (const VertexId v : view_.scene().loop(part)) {
    const Integer3 exact = difference_of(view_.position(v), view_.eye());
    Double3 q;
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = exact[k].get_d();
      largest = std::max(largest, std::fabs(q[k]));
    }
    const double c = dot_of(along_f, q);
    const double error = 32 * kRoundoff * largest * 0x1p31;
    if (!std::isfinite(largest) || !(c * 0x1p-20 > error)) return all;
    const double place[2] = {(dot_of(along_r, q) / c + 1) * view_.width() / 2,
                             (1 - dot_of(along_u, q) / c) * view_.height() / 2};
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], place[k]);
      high[k] = std::max(high[k], place[k]);
    }
  }
  const auto clamped = [](double x, std::uint32_t most) {
    return static_cast<std::uint32_t>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  return {clamped(std::floor(low[0]) - 1, all.right), clamped(std::ceil(high[0]) + 1, all.right),
          clamped(std::floor(low[1]) - 1, all.bottom), clamped(std::ceil(high[1]) + 1, all.bottom)};
}

/// Of the depths -P(E) / (n . d): a nearer -1, the same 0.
int SeenParts::compare_depth(const Hit& a, const Hit& b, const SampleRay& ray) {
  if (a.high < b.low) return -1;
  if (b.high < a.low) return 1;
  // Both n . d are negative, so that a / b of them turns the comparison around twice.
  const CertifiedPlane &p = a.of->plane, &q = b.of->plane;
  return sgn(
      mpz_class(q.at_eye() * dot_of(p.n(), ray.exact) - p.at_eye() * dot_of(q.n(), ray.exact)));
}

Seen SeenParts::at(std::uint32_t i, std::uint32_t j, const SampleRay& ray) const {
  Seen seen;
  Hit best;
  std::vector<Hit> touched;
  for (const std::uint32_t place : cells_[std::size_t{j} * blocks_ + i / kBlock]) {
    Hit hit;
    hit.of = &facing_[place];
    int least = 1;
    for (const CertifiedPlane& edge : hit.of->edges) {
      least = std::min(least, edge.side_of(ray));
      if (least < 0) break;
    }
    if (least < 0) continue;
    const CertifiedPlane& plane = hit.of->plane;
    const double along = -plane.along(ray), bound = plane.along_bound(ray);
    hit.low = plane.eye() * (1 - 8 * kRoundoff) / (along + bound);
    hit.high = along > bound ? plane.eye() * (1 + 8 * kRoundoff) / (along - bound)
                             : std::numeric_limits<double>::infinity();
    if (least == 0) {
      touched.push_back(hit);
      continue;
    }
    const int order = best.of == nullptr ? -1 : compare_depth(hit, best, ray);
    if (order < 0) {
      best = hit;
      seen.coplanar.clear();
      seen.boundary = false;
    } else if (order == 0) {
      const std::vector<Part>& parts = view_.scene().parts;
      if (parts[hit.of->part].plane == parts[best.of->part].plane) {
        seen.coplanar.push_back(hit.of->part);
      } else {
        seen.boundary = true;
      }
    }
  }
  if (best.of != nullptr) seen.part = best.of->part;
  for (const Hit& hit : touched) {
    if (best.of == nullptr || compare_depth(hit, best, ray) <= 0) seen.boundary = true;
  }
  return seen;
}

}  // namespace gnomon::oracle
