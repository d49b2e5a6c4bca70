// SPDX-License-Identifier: LGPL-3.0-or-later
// The sign convention, written here once; everything else refers to it.
//
//  * Axes are right-handed. A loop of vertices is *counter-clockwise* seen from the front of its
//    support plane: with n = (b - a) x (c - a) for three consecutive vertices of a convex loop, the
//    front is where n . (x - a) > 0.
//  * A plane is (n, d) with value n . x - d: positive in front, zero on, negative behind.
//  * A side of a polygon *faces* a light when the light's homogeneous point (L, 1) or (to_light, 0)
//    has a positive value: n . L - d > 0, or n . to_light > 0.
//  * An edge plane of a loop (a shadow plane, or the plane that cut the edge) has the interior of
//    the loop in *front*: inside is positive. A signed reference, PlaneRef, carries the
//    orientation.
//  * Light space: q(v) = L - v for a point light; for a directional light d whose largest component
//    is d_z, q(v) = (x d_z - z d_x, y d_z - z d_y, d_z), axes permuted cyclically otherwise. For a
//    loop that is counter-clockwise seen from the light, det(q_a, q_b, q_c) is positive for d_z > 0
//    and for d_z < 0 alike (it is d_z^2 (n . d)), the shadow plane of edge (a, b) is q_a x q_b, and
//    the vertex between the edges i-1 and i is the ray n_(i-1) x n_i *in that order*: swapping the
//    two gives the antipode, a real and different direction for a lamp inside the scene.
#ifndef GNOMON_KERNEL_ORIENTATION_H
#define GNOMON_KERNEL_ORIENTATION_H

#include <cstdint>

namespace gnomon {

/// A plane by number, with its orientation: reference +(i+1) is plane i as it is, -(i+1) its
/// opposite.
class PlaneRef {
 public:
  constexpr PlaneRef() = default;
  constexpr explicit PlaneRef(std::uint32_t index, bool flipped = false)
      : code_(flipped ? -static_cast<std::int32_t>(index) - 1
                      : static_cast<std::int32_t>(index) + 1) {}

  constexpr std::uint32_t index() const {
    return static_cast<std::uint32_t>(code_ < 0 ? -code_ : code_) - 1;
  }
  constexpr bool flipped() const { return code_ < 0; }
  constexpr bool valid() const { return code_ != 0; }
  constexpr PlaneRef operator-() const {
    PlaneRef result;
    result.code_ = -code_;
    return result;
  }
  /// The same plane, whatever the orientation.
  constexpr bool same_plane(PlaneRef other) const {
    return code_ == other.code_ || code_ == -other.code_;
  }
  friend constexpr bool operator==(PlaneRef, PlaneRef) = default;

 private:
  std::int32_t code_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_ORIENTATION_H
