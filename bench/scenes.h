// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes that are measured: those of `gnomon generate`'s families, and some of our own.
#ifndef GNOMON_BENCH_SCENES_H
#define GNOMON_BENCH_SCENES_H

#include <cstdint>
#include <map>
#include <string>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::bench {

using Parameters = std::map<std::string, std::int64_t>;

/// What a generator's whole numbers become.
enum class Coordinates {
  kGrid,      // doubles, as they are
  kDecimals,  // times 0.3, as decimals: a building drawn in metres
  kDoubles,   // the same decimals, each read as the nearest double
};

struct SceneRecipe {
  std::string generator;
  Parameters parameters;
  Coordinates coordinates = Coordinates::kGrid;
};

/// These end the program with a message if the scene cannot be made.
Scene generated(const SceneRecipe& recipe, std::uint64_t seed = 1);
PreparedScene prepared_or_stop(const Scene& scene);
PreparedScene make_scene(const SceneRecipe& recipe, std::uint64_t seed = 1);
inline PreparedScene make_scene(const std::string& generator, const Parameters& parameters,
                                std::uint64_t seed = 1) {
  return make_scene({generator, parameters, Coordinates::kGrid}, seed);
}

/// n thin parallelograms at random in a cube, each eight times as long as the mean distance of
/// neighbours and 1/64 as wide as long: nearly all of them cross planes of many others. Two-sided,
/// a lamp above.
PreparedScene long_sticks(std::int64_t n, std::uint64_t seed = 1);

/// n needles, triangles whose tips all lie on one ray of the light at different depths, spread
/// round it like the spokes of a wheel, over a floor: in light space all meet in one point.
PreparedScene wheel_of_needles(std::int64_t n);

/// n sheets over each other and a floor, as large as each other seen from the light up to some grid
/// units of 2^20, by which their corners are off: the borders of all nearly coincide, and cross.
PreparedScene stack_of_sheets(std::int64_t n, std::uint64_t seed = 1);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_SCENES_H
