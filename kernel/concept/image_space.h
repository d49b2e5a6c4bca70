// SPDX-License-Identifier: LGPL-3.0-or-later
// What an algorithm of image space may ask of a kernel: the sides that the samples of a picture
// have of planes. A sample is a ray from the eye E along an integer direction d (image_frame.h); on
// a support plane P it is the point x = E + t d, t = -P(E) / (n . d), which exact kernels never
// compute.
//
// One predicate does all: for a plane P = (n, .) that the ray meets and any plane Q = (m, .),
//
//   side of Q at the sample on P = sign((n . d) Q(E) - (m . d) P(E)) * sign(n . d).
//
// The bracket is linear in d. Where it is zero, its value with R in place of d decides, then with
// U: the sample is moved infinitesimally. The factor sign(n . d) stays that of d, since moving the
// sample a little cannot turn P around. Planes through E are the same without P: sign(n . d), then
// with R, then U. So of two polygons that share an edge exactly one covers a sample.
//
// Reference: docs/image-space.md.
#ifndef GNOMON_KERNEL_CONCEPT_IMAGE_SPACE_H
#define GNOMON_KERNEL_CONCEPT_IMAGE_SPACE_H

#include <gmpxx.h>

#include <array>
#include <concepts>
#include <cstdint>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/image_frame.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/orientation.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"

namespace gnomon {

/// A light by number, as add_light() gave it.
struct ImageLight {
  std::uint32_t index = 0;
};

/// A plane through the eye, with its orientation, as add_ray_plane() gave it.
struct RayPlaneRef {
  std::uint32_t index = 0;
  bool flipped = false;
  RayPlaneRef operator-() const { return {index, !flipped}; }
};

/// A vertex of the scene, or a light: a point of it, or its direction.
struct ImagePoint {
  static ImagePoint at(VertexId vertex) { return {vertex, {}, false}; }
  static ImagePoint of(ImageLight light) { return {0, light, true}; }
  VertexId vertex = 0;
  ImageLight light;
  bool is_light = false;
};

/// The plane n . x = d of positions x on the grid, in front where n . x is more. Requires: n is not
/// zero.
struct GridPlane {
  std::array<mpz_class, 3> n;
  mpz_class d;
};

/// Planes are named as everywhere: below geometry.planes.size() the support planes, from there on
/// those added here. A space is one thread's; copies are independent.
///
/// Exactness: exact kernels answer every question exactly. Rounded ones compute x in their numbers,
/// and its side of Q, with their plane thickness; the tie rule is theirs, too.
template <class S>
concept ImageSpaceModel = std::copy_constructible<S> &&
    std::constructible_from<S, const Geometry&, const ImageFrame&, const KernelOptions&> &&
    requires(S& space, const S& constant, const LightPoint& point, ImageLight light, PlaneRef plane,
             RayPlaneRef ray_plane, ImagePoint from, VertexId vertex, ImageSample sample,
             const GridPlane& grid_plane, std::uint32_t row) {
  { S::kExact } -> std::convertible_to<bool>;
  { constant.frame() } -> std::same_as<const ImageFrame&>;
  { space.add_light(point) } -> std::same_as<ImageLight>;
  /// The plane through a light and the edge from one vertex to another. Its front is inside a loop
  /// that has this edge and is counter-clockwise seen from the light.
  { space.add_shadow_plane(light, vertex, vertex) } -> std::same_as<PlaneRef>;
  /// Any plane of the grid, for methods that make planes of their own. It is exactly that on exact
  /// kernels; rounded ones take three points of it.
  { space.add_grid_plane(grid_plane) } -> std::same_as<PlaneRef>;
  /// The plane through the eye and two points; its front is inside a loop with an edge from the
  /// first to the second that is counter-clockwise seen from the eye.
  { space.add_ray_plane(from, from) } -> std::same_as<RayPlaneRef>;

  /// The plane's value at the eye. Degree 3 (shadow planes of directional lights 2 and the
  /// direction).
  { space.side_of_eye(plane) } -> std::same_as<Sign>;
  /// A support plane's value at a light: n . L - d, or n . to_light.
  { space.side_of_light(plane, light) } -> std::same_as<Sign>;
  { space.side_of_vertex(plane, vertex) } -> std::same_as<Side>;
  /// m . d, with R and then U where it is zero: the side to which the sample's ray leaves a plane
  /// that holds the eye. Zero only if m is.
  { space.heading(plane, sample) } -> std::same_as<Sign>;
  /// The one predicate: side of `plane` (first) at the sample on a support plane (second), or on a
  /// shadow plane.
  /// Requires: the ray meets the support plane, P(E) and n . d of opposite signs; so it does where
  /// the sample is covered by a polygon of the plane that faces the eye. Zero iff the two are one
  /// plane. Degree 5, image_side_bits().
  { space.side_at_sample(plane, plane, sample) } -> std::same_as<Sign>;
  /// The side of a plane through the eye on which the sample lies: for edges of a polygon that
  /// faces the eye, positive inside. Zero only if the eye is on a line with the two points. Degree
  /// 2, image_coverage_bits().
  { space.covers(ray_plane, sample) } -> std::same_as<Sign>;

  /// Along a row each of the two changes its sign at most once, about at this column (it may be
  /// anything, even no number): for a search that confirms it by two signs.
  { constant.guess_side(plane, plane, row) } -> std::same_as<double>;
  { constant.guess_covers(ray_plane, row) } -> std::same_as<double>;
  { constant.stage_counts() } -> std::same_as<StageCounts>;
};

/// A kernel that has one, and optionally (`CountedImageSpace`) one that counts its decisions by the
/// stages that make them.
template <class Kernel>
concept ImageKernelModel = ImageSpaceModel<typename Kernel::ImageSpace>;

/// Calls `body.template operator()<Space>()` on the kernel's image space, on the one that counts if
/// `count_stages` is set and the kernel has one.
template <ImageKernelModel Kernel, class Body>
auto with_image_space(bool count_stages, const Body& body) {
  if constexpr (requires { typename Kernel::CountedImageSpace; }) {
    if (count_stages) return body.template operator()<typename Kernel::CountedImageSpace>();
  }
  return body.template operator()<typename Kernel::ImageSpace>();
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_IMAGE_SPACE_H
