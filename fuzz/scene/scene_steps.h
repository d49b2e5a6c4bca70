// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes made simpler without touching a coordinate: the steps of shrinking that are the same for
// every scene.
#ifndef GNOMON_FUZZ_SCENE_SCENE_STEPS_H
#define GNOMON_FUZZ_SCENE_SCENE_STEPS_H

#include <cstddef>
#include <cstdint>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

Scene without_unused_vertices(Scene scene);
/// Also equal positions as one vertex, and a corner that repeats the one before it dropped where
/// three are left.
Scene tidied(const Scene& scene);
/// Every loop that names `from` names `to` instead; repeated corners as in tidied().
Scene with_joined_vertices(Scene scene, VertexId from, VertexId to);

/// How many flags are not at their default: two_sided of the scene and of polygons, casts, numbers,
/// intensity, "extra".
std::uint64_t flags_of(const Scene& scene);
Scene with_default_flags(Scene scene);
/// The steps that with_default_flags() takes, one by one; those that change nothing too.
std::size_t flag_steps(const Scene& scene);
Scene with_flag_step(Scene scene, std::size_t step);

/// Polygons a, b, ..., z, aa, ...; lights lamp, sun, panel, with a number if there are several.
Scene with_short_names(Scene scene);
/// How many ids are not those.
std::uint64_t long_names_of(const Scene& scene);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SCENE_SCENE_STEPS_H
