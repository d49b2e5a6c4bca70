// SPDX-License-Identifier: LGPL-3.0-or-later
// Four doubles or eight floats at a time, in functions that are compiled for AVX2, too.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_FOUR_DOUBLES_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_FOUR_DOUBLES_H

#include <algorithm>

namespace gnomon::area_contour {

// Never passed by value, since below AVX it is not settled how.
typedef double Doubles __attribute__((vector_size(32), may_alias));
typedef long Bits __attribute__((vector_size(32), may_alias));
typedef float Floats __attribute__((vector_size(32), may_alias));
typedef int FloatBits __attribute__((vector_size(32), may_alias));

inline bool any(const Bits& bits) { return (bits[0] | bits[1] | bits[2] | bits[3]) != 0; }
inline bool all(const Bits& bits) { return (bits[0] & bits[1] & bits[2] & bits[3]) != 0; }

/// A bit for each of four.
inline unsigned lanes_of(const Bits& bits) {
  return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
}

/// A bit for each of eight that are all bits.
inline unsigned lanes_of(const FloatBits& bits) {
  constexpr FloatBits kLanes = {0x1, 0x2, 0x4, 0x8, 0x10, 0x20, 0x40, 0x80};
  const FloatBits own = bits & kLanes;
  const Bits& pairs = reinterpret_cast<const Bits&>(own);
  const long both = pairs[0] | pairs[1] | pairs[2] | pairs[3];
  return static_cast<unsigned>(both | both >> 32) & 255;
}

inline double least_of(const Doubles& x) {
  return std::min(std::min(x[0], x[1]), std::min(x[2], x[3]));
}
inline double most_of(const Doubles& x) {
  return std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
}

inline const Doubles& row(const double* values) {
  return *reinterpret_cast<const Doubles*>(values);
}
inline Doubles& row(double* values) { return *reinterpret_cast<Doubles*>(values); }

inline const Floats& row(const float* values) { return *reinterpret_cast<const Floats*>(values); }

// Before functions that are compiled for AVX2, too; the loader chooses. Neither level fuses a
// product with a sum, so that both give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define GNOMON_FOR_AVX2 __attribute__((target_clones("avx2", "default")))
#else
#define GNOMON_FOR_AVX2
#endif

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_FOUR_DOUBLES_H
