// SPDX-License-Identifier: LGPL-3.0-or-later
// Image space of the kernel `plane`: sides of planes at the samples of a picture, filtered, then by
// planned integers. No point of a sample is ever computed.
//
// Guarantee: every answer is exact, on every input. Filter: with |n_k| <= 1 off by 2u each, values
// at the eye off by 2u of themselves, and M the largest component of the direction, which is
// exactly a double,
//  - n . d errs by 6u M (from n), 3u M (products), 2u M + 3u M (sums): 14u M, at most 3 M itself;
//  - (n . d) Q(E) - (m . d) P(E) by that times |Q(E)| + |P(E)|, and by 6u (from the values), 3u
//    (products) and 3u (difference) of M (|Q(E)| + |P(E)|): 26u M (|Q(E)| + |P(E)|).
// The source has 16u and 32u; the rest is for second order. Bits: image_precision.h.
// Reference: docs/image-space.md.
#ifndef GNOMON_KERNEL_IMPLICIT_IMPLICIT_IMAGE_SPACE_H
#define GNOMON_KERNEL_IMPLICIT_IMPLICIT_IMAGE_SPACE_H

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/concept/image_guess.h"
#include "kernel/concept/image_space.h"
#include "kernel/implicit/exact_geometry.h"
#include "kernel/implicit/scaled_doubles.h"
#include "kernel/implicit/staged_sign.h"

namespace gnomon {

template <class Stats = NoStats>
class ImplicitImageSpace {
 public:
  static constexpr bool kExact = true;

  ImplicitImageSpace(const Geometry& geometry, const ImageFrame& frame, const KernelOptions&);

  const ImageFrame& frame() const { return frame_; }
  ImageLight add_light(const LightPoint& light);
  PlaneRef add_shadow_plane(ImageLight light, VertexId a, VertexId b);
  PlaneRef add_grid_plane(const GridPlane& plane);
  /// Requires: one of the two is no directional light.
  RayPlaneRef add_ray_plane(ImagePoint from, ImagePoint to);

  Sign side_of_eye(PlaneRef plane) const {
    return turned(planes_[plane.index()].eye_sign, plane.flipped());
  }
  /// Degree 3, side_of_support_bits(); of a direction 2 and 1, 2b + e + 3 bits.
  Sign side_of_light(PlaneRef plane, ImageLight light);
  /// The same degrees and bits.
  Side side_of_vertex(PlaneRef plane, VertexId vertex);
  /// Degree 2 (of a shadow plane of a directional light 1 and 1), image_coverage_bits().
  Sign heading(PlaneRef plane, ImageSample sample);
  /// Degree 5, image_side_bits(). Identity: the side of a plane on itself is zero.
  Sign side_at_sample(PlaneRef of, PlaneRef on, ImageSample sample);
  /// Degree 2, image_coverage_bits().
  Sign covers(RayPlaneRef plane, ImageSample sample);

  double guess_side(PlaneRef of, PlaneRef on, std::uint32_t row) const {
    return gnomon::guess_side(frame_, planes_[of.index()].guess, planes_[on.index()].guess, row);
  }
  double guess_covers(RayPlaneRef plane, std::uint32_t row) const {
    return gnomon::guess_covers(frame_, ray_planes_[plane.index].guess, row);
  }
  StageCounts stage_counts() const { return stages_.counts(); }

 private:
  /// What a plane goes through: three positions, or two and a direction; or its coefficients.
  struct Source {
    enum class Kind : std::uint8_t { kSupport, kShadow, kRay, kGrid };
    Kind kind = Kind::kSupport;
    PlaneId support = 0;  // kGrid: into grid_planes_
    ImagePoint from, to;  // kShadow: the edge's vertices; kRay: with the eye
    ImageLight light;     // kShadow
  };
  struct Plane {
    Source source;
    GuessedPlane guess;  // what the filter computes with, too
    double d = 0;        // n . x - d for positions times 2^-b
    Sign eye_sign = Sign::kZero;
    bool usable = false;         // by the filter
    bool has_direction = false;  // goes along the direction to a light
  };
  struct Direction {
    ImageFrame::Direction exact{};
    Double3 nearest{};  // the same numbers
    double largest = 0;
  };
  template <class Int>
  struct ExactSource {
    Vector3<Int> n, base;
    Int d{};  // of the value at the base: -d
    Int value(const Vector3<Int>& x) const { return Int(dot(n, difference(x, base)) - d); }
  };

  static Sign turned(Sign sign, bool flipped) { return flipped ? -sign : sign; }
  bool is_direction(const ImagePoint& point) const {
    return point.is_light && lights_[point.light.index].directional;
  }
  template <class Int>
  Vector3<Int> integers(const std::array<mpz_class, 3>& v) const {
    return {integer_from<Int>(v[0]), integer_from<Int>(v[1]), integer_from<Int>(v[2])};
  }
  template <class Int>
  Vector3<Int> point(const ImagePoint& of) const {
    return of.is_light ? integers<Int>(lights_[of.light.index].grid)
                       : ExactGeometry<Int>(*geometry_).position(of.vertex);
  }
  template <class Int>
  ExactSource<Int> exact(const Source& source) const;
  template <class Int>
  static Vector3<Int> along_of(const std::array<std::int64_t, 3>& d) {
    return {integer_from<Int>(d[0]), integer_from<Int>(d[1]), integer_from<Int>(d[2])};
  }

  unsigned grid_plane_bits(const Source& source) const;
  unsigned value_bits(const Plane& plane) const;
  unsigned coverage_bits(const Plane& plane) const;
  unsigned bracket_bits(const Plane& q, const Plane& p) const;
  std::uint32_t add(std::vector<Plane>& planes, const Source& source);
  const Direction& look_along(ImageSample sample);
  Sign along(const Plane& plane, ImageSample sample);
  Sign exact_along(const Plane& plane, const std::array<std::int64_t, 3>& d);
  Sign exact_bracket(const Plane& q, const Plane& p, const std::array<std::int64_t, 3>& d);
  Sign moved(const Plane& q, const Plane& p);

  const Geometry* geometry_;
  ImageFrame frame_;
  // Of vertices, to which doubles are scaled; of these, the eye and lights; of samples' directions
  // and of those to lights.
  unsigned scale_bits_, grid_bits_, sample_bits_, direction_bits_ = 0;
  std::array<std::array<std::int64_t, 3>, 2> moves_;  // R, U
  std::vector<Plane> planes_, ray_planes_;
  std::vector<GridPlane> grid_planes_;
  std::vector<LightPoint> lights_;
  ImageSample sample_;  // the last one asked for
  Direction direction_;
  [[no_unique_address]] StagedSign<Stats> stages_;
};

extern template class ImplicitImageSpace<NoStats>;
extern template class ImplicitImageSpace<CountStats>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_IMPLICIT_IMAGE_SPACE_H
