// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/shrink/shrink.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "fuzz/scene/scene_steps.h"
#include "fuzz/shrink/coordinate_steps.h"
#include "fuzz/shrink/smallest_scene.h"
#include "fuzz/shrink/structure_steps.h"
#include "gnomon/scene/write.h"
#include "scene/base/text_hash.h"

namespace gnomon::fuzz {

namespace {

/// One round of all steps, the most rewarding first.
void run_round(SmallestScene& search) {
  search.in("tidying", tidy_up);
  search.in("polygons", drop_polygons);
  search.in("lights", drop_lights);
  search.in("holes", drop_holes);
  search.in("corners", drop_corners);
  search.in("flags", reset_flags);
  search.in("vertices", join_vertices);
  search.in("scene", change_scene);
  search.in("axes", change_axes);
  search.in("values", change_values);
  search.in("points", change_points);
  search.in("coordinates", change_coordinates);
  search.in("names", [](SmallestScene& own) { own.attempt(with_short_names(own.best())); });
}

}  // namespace

ShrinkResult shrink(Scene scene, const StillFails& fails, const ShrinkOptions& options) {
  SmallestScene search(std::move(scene), fails, options);
  search.in("moves", undo_moves);
  for (std::uint64_t rounds = 1;; ++rounds) {
    const std::uint64_t accepted = search.accepted();
    run_round(search);
    const bool locally_minimal = !search.stopped() && search.accepted() == accepted;
    if (search.stopped() || locally_minimal) return search.take_result(rounds, locally_minimal);
  }
}

std::string fingerprint_of(const Scene& scene) {
  Scene plain = scene;
  plain.name.clear();
  plain.extra.clear();
  const auto text = scene_to_text(plain, SceneFormat::kJson);
  return fmt::format("{:016x}", text ? text_hash(text->text) : 0);
}

}  // namespace gnomon::fuzz
