// SPDX-License-Identifier: LGPL-3.0-or-later
// Points and planes in rational numbers, and points that a file can hold: a scene's numbers are
// decimal fractions, so that of the points of a plane only those with such coordinates will do.
#ifndef GNOMON_SCENE_REPAIR_RATIONAL_SPACE_H
#define GNOMON_SCENE_REPAIR_RATIONAL_SPACE_H

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon::scene_detail {

using RationalPoint = std::array<mpq_class, 3>;

RationalPoint operator-(const RationalPoint& a, const RationalPoint& b);
/// a + s b.
RationalPoint moved(const RationalPoint& a, const mpq_class& s, const RationalPoint& b);
RationalPoint cross_product(const RationalPoint& a, const RationalPoint& b);
mpq_class dot_product(const RationalPoint& a, const RationalPoint& b);
inline mpq_class square_of(const RationalPoint& a) { return dot_product(a, a); }
bool is_zero(const RationalPoint& a);

/// normal . p = offset, and three points of it that are not in one line.
struct RationalPlane {
  RationalPoint normal;
  mpq_class offset;
  std::array<RationalPoint, 3> points;

  bool holds(const RationalPoint& p) const { return dot_product(normal, p) == offset; }
  /// Squared distance.
  mpq_class square_from(const RationalPoint& p) const;
  bool is_same_as(const RationalPlane& other) const;
};

/// The plane through three points; nothing if they are in one line.
std::optional<RationalPlane> plane_through(const RationalPoint& a, const RationalPoint& b,
                                           const RationalPoint& c);

/// Is it a decimal fraction of not too many digits?
bool is_decimal(const mpq_class& value);
bool is_decimal(const RationalPoint& point);
/// The number as a scene holds it: a double where it is one and the scene is of doubles. Requires:
/// is_decimal().
Number to_number(const mpq_class& value, NumberMeaning meaning);

/// A double that is no smaller, and hardly greater, for looking up what exact numbers then decide.
double not_less_than(const mpq_class& distance);

/// A point near p that lies in all these planes and has decimal coordinates; `on_all` are such
/// points that are known. Its distance from the nearest point of the planes is far below `fineness`
/// where there is a choice. Nothing if there is no such point, or none was found.
std::optional<RationalPoint> decimal_point_on(const std::vector<RationalPlane>& planes,
                                              const RationalPoint& p, const mpq_class& fineness,
                                              const std::vector<RationalPoint>& on_all);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_REPAIR_RATIONAL_SPACE_H
