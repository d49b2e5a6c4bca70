// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes put right where they do not say what was meant (intent.h): exactly, so that what was all
// but equal is equal afterwards, and with an account of all that was changed.
#ifndef GNOMON_SCENE_REPAIR_H
#define GNOMON_SCENE_REPAIR_H

#include <gmpxx.h>

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

struct SnapReport {
  std::size_t rounds = 0;            // until nothing moved
  bool settled = false;              // nothing moves any more; false after very many rounds
  std::size_t merged_vertices = 0;   // positions that are no more
  std::size_t moved_vertices = 0;    // positions that were used and are elsewhere
  std::size_t planes = 0;            // made one out of several
  double largest_movement = 0;       // scene units
  std::vector<std::string> folding;  // ids of polygons that would fold: their vertices stayed
  std::size_t pairs_left = 0;   // still all but in one plane, since no decimal numbers would do
  std::size_t bent_left = 0;    // the same of polygons that are bent
  bool became_decimal = false;  // the scene was of doubles, which could not hold the result
};

/// Vertices within `distance` of each other become one, the first of them; polygons that overlap
/// within `distance` of one plane come to lie in it, and polygons bent by no more than that become
/// planar: exactly, again and again until nothing moves. No vertex moves farther at a time than
/// three times the distance. Requires: distance > 0. Errors: those of prepare().
Expected<SnapReport> snap_scene(Scene& scene, const mpq_class& distance);

struct ParentReport {
  std::vector<std::string> windows,
      walls;                      // ids: the loop of each window is now a hole of its wall
  std::vector<std::string> left;  // lie in a polygon, and overlap what is there
};

/// Polygons that lie exactly in another one of their plane, and look where it looks, become holes
/// of the smallest such. Errors: those of prepare().
Expected<ParentReport> make_holes_of_windows(Scene& scene);

struct OrientReport {
  std::vector<std::string> reversed;  // ids of polygons
  std::size_t components = 0;         // closed
  std::size_t inwards = 0;            // that look inwards now: a light is inside
  std::size_t left = 0;  // closed components that no choice of sides makes look one way
};

/// Closed components look outwards, those with a point or area light inside inwards, and cavities
/// of solids into the cavity. Loops are reversed; nothing moves. Errors: those of prepare().
Expected<OrientReport> orient_closed(Scene& scene);

/// Adds to the scene's "extra" what was done, under "changes": JSON text of one object.
void note_change(Scene& scene, const std::string& change);

}  // namespace gnomon

#endif  // GNOMON_SCENE_REPAIR_H
