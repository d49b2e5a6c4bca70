// SPDX-License-Identifier: GPL-3.0-or-later
// How a caster stands to one point and one point of a light, in doubles or in rational numbers:
// what the searches for the nearest change of a class begin with (clearance.h, area_clearance.h).
#ifndef GNOMON_ORACLE_JUDGE_STANDING_H
#define GNOMON_ORACLE_JUDGE_STANDING_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "gnomon/oracle/enclosure.h"

namespace gnomon::oracle::standing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Vector<Number> minus(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]),
          Number(a[0] * b[1] - a[1] * b[0])};
}

inline double upper_root(double squared) { return std::sqrt(squared); }
inline double upper_root(const mpq_class& squared) { return enclose_square_root(squared).upper; }

/// How a caster stands to one point: whether it covers it, and how far x is from its border.
struct Standing {
  bool between = false;  // the line meets the caster's plane between point and light
  bool inside = false;   // and inside the caster
  double border = kInfinity;
};

template <class Number>
Vector<Number> loop_normal(const std::vector<Vector<Number>>& loop) {
  return cross(minus(loop[1], loop[0]), minus(loop[2], loop[0]));
}

template <class Number>
Standing stand(const std::vector<Vector<Number>>& loop, bool directional,
               const Vector<Number>& light, const Vector<Number>& point) {
  Standing result;
  const Vector<Number> normal = loop_normal(loop);
  const Vector<Number> ray = directional ? light : minus(light, point);
  const Number height = dot(normal, minus(point, loop[0]));
  const Number rise = dot(normal, ray);
  if (rise == 0) return result;
  const Number t = -height / rise;
  if (!(t > 0) || (!directional && !(t < 1))) return result;
  result.between = true;
  result.inside = true;
  Vector<Number> x;
  for (int k = 0; k < 3; ++k) x[k] = point[k] + t * ray[k];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector<Number>& a = loop[i];
    const Vector<Number> edge = minus(loop[(i + 1) % loop.size()], a);
    const Vector<Number> from = minus(x, a);
    if (!(dot(cross(normal, edge), from) > 0)) result.inside = false;
    Number along = dot(from, edge) / dot(edge, edge);
    if (along < 0) along = 0;
    if (along > 1) along = 1;
    Vector<Number> apart;
    for (int k = 0; k < 3; ++k) apart[k] = from[k] - along * edge[k];
    result.border = std::min(result.border, upper_root(Number(dot(apart, apart))));
  }
  return result;
}

}  // namespace gnomon::oracle::standing

#endif  // GNOMON_ORACLE_JUDGE_STANDING_H
