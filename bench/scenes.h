// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes that are measured. All come from `gnomon generate`'s families but the long sticks.
#ifndef GNOMON_BENCH_SCENES_H
#define GNOMON_BENCH_SCENES_H

#include <cstdint>
#include <map>
#include <string>

#include "gnomon/scene/prepare.h"

namespace gnomon::bench {

using Parameters = std::map<std::string, std::int64_t>;

/// A generated scene, prepared. Ends the program with a message if it cannot be.
PreparedScene make_scene(const std::string& generator, const Parameters& parameters,
                         std::uint64_t seed = 1);

/// n thin parallelograms at random in a cube, each eight times as long as the mean distance of
/// neighbours and 1/64 as wide as long: nearly all of them cross planes of many others.
PreparedScene long_sticks(std::int64_t n, std::uint64_t seed = 1);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_SCENES_H
