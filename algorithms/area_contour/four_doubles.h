// SPDX-License-Identifier: LGPL-3.0-or-later
// Four doubles or eight floats at a time, in functions that are compiled for AVX2, too.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_FOUR_DOUBLES_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_FOUR_DOUBLES_H

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
