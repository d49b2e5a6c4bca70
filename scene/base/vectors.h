// SPDX-License-Identifier: LGPL-3.0-or-later
// Differences and products of vectors of three numbers, for numbers of any type. They are exact for
// exact numbers, and rounded at every step for floating-point numbers.
#ifndef GNOMON_SCENE_BASE_VECTORS_H
#define GNOMON_SCENE_BASE_VECTORS_H

#include <array>

namespace gnomon {

template <class T>
std::array<T, 3> minus(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}

template <class T>
T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
std::array<T, 3> cross(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[1] * b[2] - a[2] * b[1]), T(a[2] * b[0] - a[0] * b[2]), T(a[0] * b[1] - a[1] * b[0])};
}

template <class T>
bool is_zero(const std::array<T, 3>& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_VECTORS_H
