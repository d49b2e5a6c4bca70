// SPDX-License-Identifier: GPL-3.0-or-later
// The words of the code of scene_code.h, for what reads it and what writes it.
#ifndef GNOMON_FUZZ_GENERATE_SCENE_CODE_WORDS_H
#define GNOMON_FUZZ_GENERATE_SCENE_CODE_WORDS_H

#include <cstdint>

namespace gnomon::fuzz::scene_code {

/// What a step does; the numbers are the code's and must stay.
enum class Step : std::uint8_t {
  kLattice,        // vertex: x, y, z of a byte each, times the scale
  kFine,           // vertex: x, y, z of two bytes each, in 256ths, times the scale
  kNudged,         // vertex: one of the vertices, a coordinate moved by some ulps
  kBetween,        // vertex: a + (b - a) * k / 8
  kScaled,         // vertex: one of the vertices, times 2^k
  kExact,          // vertex: x, y, z as Number's parts
  kPolygon,        // flags, count, vertices
  kParallelogram,  // flags, vertices a, b, c; the fourth is a + c - b
  kRectangle,      // flags, axis, level, from, to: two lattice coordinates each
  kHole,           // of the last polygon: count, vertices
  kCopy,           // of a polygon, perhaps reversed: flags, polygon, rotation
  kPointLight,     // x, y, z of a byte each, times the scale
  kLightBetween,   // point: a + (b - a) * k / 8
  kSun,            // x, y, z of a byte each
  kSunAlong,       // from vertex a to vertex b
  kPanel,          // area: a corner of three bytes and two sides of three bytes each
  kPanelOf,        // area: the loop of a polygon, perhaps reversed
  kPanelAt,        // area: count, vertices
  kExactLight,     // point or directional: flags, Number's parts
  kExactPanel,     // area: count, Number's parts
  kCount,
};

inline constexpr unsigned kTwoSidedScene = 1, kDecimals = 2;
// Of polygons.
inline constexpr unsigned kOneSided = 1, kTwoSided = 2, kCastsNot = 4, kReversed = 8;
// Of kExactLight.
inline constexpr unsigned kDirectional = 1;
// Of a Number in kExact...: small integers, and mantissa and exponent.
inline constexpr std::uint8_t kMantissa = 128;  // else the byte is an integer, -64..63
inline constexpr std::int32_t kMostExponent = 1200;

}  // namespace gnomon::fuzz::scene_code

#endif  // GNOMON_FUZZ_GENERATE_SCENE_CODE_WORDS_H
