// SPDX-License-Identifier: LGPL-3.0-or-later
// The image space of all kernels whose planes are numbers (all but `plane`): planes by number, the
// tie rule, and the predicate at a sample, once. Rounded kernels compute the point x = E + t d in
// their numbers and compare; exact ones take the sign of the bracket, which is the same without a
// division (image_space.h).
//
// The arithmetic A has: Number, Vector (three of them), Plane (with members n and d, the value at x
// being n . x - d), kExact, and
//  - vertex(id), point(light): positions, or the direction of a directional light;
//  - position(x): a point of the grid by rational coordinates, of rounded kernels by doubles, too;
//    number(integer);
//  - plane_through(a, b, c), normal (b - a) x (c - a), and plane_along(a, direction, c), normal
//    direction x (c - a);
//  - side(plane, x), with the plane's thickness if it has one; along(plane, d), the sign of n . d;
//  - side_of_direction(plane, to_light), the same for the direction to a light.
#ifndef GNOMON_KERNEL_CONCEPT_CONSTRUCTED_IMAGE_SPACE_H
#define GNOMON_KERNEL_CONCEPT_CONSTRUCTED_IMAGE_SPACE_H

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/concept/grid_plane_points.h"
#include "kernel/concept/image_guess.h"
#include "kernel/concept/image_space.h"

namespace gnomon {

template <class A>
class ConstructedImageSpace {
  using Number = typename A::Number;
  using Vector = typename A::Vector;

 public:
  static constexpr bool kExact = A::kExact;

  ConstructedImageSpace(const Geometry& geometry, const ImageFrame& frame,
                        const KernelOptions& options)
      : arithmetic_(geometry, options),
        frame_(frame),
        grid_bits_(geometry.grid.bits()),
        grid_is_near_(doubles_hold(geometry)),
        eye_(arithmetic_.point(frame.eye)) {
    right_ = vector(frame.right);
    up_ = vector(frame.up);
    direction_ = vector(frame.direction(sample_));
    planes_.reserve(geometry.planes.size());
    for (const SupportTriple& triple : geometry.planes) {
      add(planes_,
          arithmetic_.plane_through(arithmetic_.vertex(triple.a), arithmetic_.vertex(triple.b),
                                    arithmetic_.vertex(triple.c)));
    }
  }

  const ImageFrame& frame() const { return frame_; }
  ImageLight add_light(const LightPoint& light) {
    lights_.push_back({arithmetic_.point(light), light.directional});
    return {static_cast<std::uint32_t>(lights_.size() - 1)};
  }
  PlaneRef add_shadow_plane(ImageLight light, VertexId a, VertexId b) {
    const LightOf& from = lights_[light.index];
    const Vector first = arithmetic_.vertex(a), second = arithmetic_.vertex(b);
    return PlaneRef(add(planes_, from.directional
                                     ? arithmetic_.plane_along(first, from.point, second)
                                     : arithmetic_.plane_through(from.point, second, first)));
  }
  PlaneRef add_grid_plane(const GridPlane& plane) {
    const auto through = [&](const auto& points) {
      return PlaneRef(add(planes_, arithmetic_.plane_through(arithmetic_.position(points[0]),
                                                             arithmetic_.position(points[1]),
                                                             arithmetic_.position(points[2]))));
    };
    if constexpr (!kExact) {
      if (grid_is_near_) return through(near_points_of(plane, grid_bits_));
    }
    return through(points_of(plane, grid_bits_));
  }
  /// Requires: one of the two is no directional light.
  RayPlaneRef add_ray_plane(ImagePoint from, ImagePoint to) {
    if (is_direction(to)) {
      return {add(ray_planes_, arithmetic_.plane_along(eye_, point(to), point(from))), false};
    }
    if (is_direction(from)) {
      return {add(ray_planes_, arithmetic_.plane_along(eye_, point(from), point(to))), true};
    }
    return {add(ray_planes_, arithmetic_.plane_through(eye_, point(to), point(from))), false};
  }

  Sign side_of_eye(PlaneRef ref) const {
    return turned(arithmetic_.side(planes_[ref.index()].plane, eye_), ref.flipped());
  }
  Sign side_of_light(PlaneRef ref, ImageLight light) const {
    const LightOf& of = lights_[light.index];
    const typename A::Plane& plane = planes_[ref.index()].plane;
    return turned(of.directional ? arithmetic_.side_of_direction(plane, of.point)
                                 : arithmetic_.side(plane, of.point),
                  ref.flipped());
  }
  Side side_of_vertex(PlaneRef ref, VertexId vertex) const {
    return side_of(turned(arithmetic_.side(planes_[ref.index()].plane, arithmetic_.vertex(vertex)),
                          ref.flipped()));
  }
  Sign heading(PlaneRef ref, ImageSample sample) {
    return turned(along(planes_[ref.index()].plane, sample), ref.flipped());
  }
  Sign covers(RayPlaneRef ref, ImageSample sample) {
    return turned(along(ray_planes_[ref.index].plane, sample), ref.flipped);
  }
  Sign side_at_sample(PlaneRef of, PlaneRef on, ImageSample sample) {
    if (of.same_plane(on)) return Sign::kZero;
    const PlaneOf &q = planes_[of.index()], &p = planes_[on.index()];
    look_along(sample);
    const Number p_along = dot(p.plane.n, direction_);
    Sign side;
    if constexpr (kExact) {
      side = sign_of(bracket(q, p, p_along, dot(q.plane.n, direction_))) * sign_of(p_along);
    } else {
      const Number t = -p.at_eye / p_along;
      Vector x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = eye_[k] + t * direction_[k];
      side = arithmetic_.side(q.plane, x);
    }
    if (side == Sign::kZero) side = moved(q, p, sign_of(p_along));
    return turned(side, of.flipped());
  }

  double guess_side(PlaneRef of, PlaneRef on, std::uint32_t row) const {
    return gnomon::guess_side(frame_, planes_[of.index()].guess, planes_[on.index()].guess, row);
  }
  double guess_covers(RayPlaneRef ref, std::uint32_t row) const {
    return gnomon::guess_covers(frame_, ray_planes_[ref.index].guess, row);
  }
  StageCounts stage_counts() const { return {}; }

 private:
  struct PlaneOf {
    typename A::Plane plane;
    Number at_eye;
    GuessedPlane guess;
  };
  struct LightOf {
    Vector point;
    bool directional = false;
  };

  static Sign turned(Sign sign, bool flipped) { return flipped ? -sign : sign; }
  static Number dot(const Vector& a, const Vector& b) {
    return Number(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
  }
  template <class Integers>
  Vector vector(const Integers& v) const {
    return {arithmetic_.number(v[0]), arithmetic_.number(v[1]), arithmetic_.number(v[2])};
  }
  std::uint32_t add(std::vector<PlaneOf>& planes, typename A::Plane plane) {
    PlaneOf made{std::move(plane), {}, {}};
    made.at_eye = Number(dot(made.plane.n, eye_) - made.plane.d);
    for (std::size_t k = 0; k < 3; ++k) made.guess.n[k] = A::to_double(made.plane.n[k]);
    made.guess.at_eye = A::to_double(made.at_eye);
    planes.push_back(std::move(made));
    return static_cast<std::uint32_t>(planes.size() - 1);
  }
  bool is_direction(const ImagePoint& of) const {
    return of.is_light && lights_[of.light.index].directional;
  }
  Vector point(const ImagePoint& of) const {
    return of.is_light ? lights_[of.light.index].point : arithmetic_.vertex(of.vertex);
  }
  void look_along(ImageSample sample) {
    if (sample == sample_) return;
    sample_ = sample;
    direction_ = vector(frame_.direction(sample));
  }
  Sign along(const typename A::Plane& plane, ImageSample sample) {
    look_along(sample);
    for (const Vector* d : {&direction_, &right_, &up_}) {
      const Sign sign = arithmetic_.along(plane, *d);
      if (sign != Sign::kZero) return sign;
    }
    return Sign::kZero;
  }
  static Number bracket(const PlaneOf& q, const PlaneOf& p, const Number& p_along,
                        const Number& q_along) {
    return Number(Number(p_along * q.at_eye) - Number(q_along * p.at_eye));
  }
  /// The side of Q to which the sample on P goes when it is moved along R, else along U.
  Sign moved(const PlaneOf& q, const PlaneOf& p, Sign p_sign) const {
    for (const Vector* d : {&right_, &up_}) {
      const Number p_along = dot(p.plane.n, *d);
      const Sign sign = sign_of(bracket(q, p, p_along, dot(q.plane.n, *d)));
      if (sign == Sign::kZero) continue;
      return sign * (frame_.ties == TieRule::kPlaneStays ? p_sign : sign_of(p_along));
    }
    return Sign::kZero;
  }

  A arithmetic_;
  ImageFrame frame_;
  unsigned grid_bits_;
  bool grid_is_near_;  // doubles hold what is as large as the grid, in its units and the scene's
  Vector eye_, right_, up_;
  std::vector<PlaneOf> planes_, ray_planes_;
  std::vector<LightOf> lights_;
  ImageSample sample_;  // the last one asked for, and its direction
  Vector direction_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_CONSTRUCTED_IMAGE_SPACE_H
