// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes as short strings of bytes, for coverage-guided fuzzing: any bytes are a small scene, small
// changes of the bytes are small changes of the scene, and its steps make degeneracy likely: points
// of a lattice, of earlier vertices, between and beyond them, one ulp away from them; exactly
// planar polygons; copies and reversed copies; lights in planes, on edges, at vertices and in the
// shape of polygons.
//
// The code: byte 0 has flags (1 two-sided, 2 numbers are decimals), byte 1 the scale of lattice
// points (a power of two; beyond +-100 in steps of 2^32), then steps of one byte, taken modulo
// their number, each with its operands. Bytes that are missing are 0. Indices are taken modulo what
// there is; a step beyond the limits or without what it needs does nothing. A scene whose numbers
// are decimals has no ulps: one unit in the last place there is 10^-9.
#ifndef GNOMON_FUZZ_GENERATE_SCENE_CODE_H
#define GNOMON_FUZZ_GENERATE_SCENE_CODE_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct SceneCodeLimits {
  std::size_t vertices = 64, polygons = 12, lights = 2;
  std::size_t loop = 32;  // vertices of a loop, a hole or an area light
};

/// The scene obeys validate.h, with numbers as ids of polygons; that its loops and area lights are
/// planar, or do not cross themselves, is not said.
Scene scene_from_code(std::span<const std::uint8_t> code, const SceneCodeLimits& limits = {});

/// A code that gives the same scene but for its name, its ids, intensities and "extra". Nothing if
/// it is beyond the limits, or if a decimal has more than 63 bits or an exponent beyond +-127.
std::optional<std::vector<std::uint8_t>> code_of_scene(const Scene& scene,
                                                       const SceneCodeLimits& limits = {});

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_SCENE_CODE_H
