// SPDX-License-Identifier: LGPL-3.0-or-later
// Vectors of doubles, for form factors alone: their bounds have margins, and nothing is decided by
// a sign that is not certain.
#ifndef GNOMON_ALGORITHMS_FORM_FACTORS_VECTORS_H
#define GNOMON_ALGORITHMS_FORM_FACTORS_VECTORS_H

#include <array>
#include <cmath>

namespace gnomon {

using Vector = std::array<double, 3>;

inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector& a) { return std::sqrt(dot(a, a)); }
/// Length 1; 0 stays 0.
inline Vector unit(const Vector& a) {
  const double size = length(a);
  return size > 0 ? 1 / size * a : a;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_FORM_FACTORS_VECTORS_H
