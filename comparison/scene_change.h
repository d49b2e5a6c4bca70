// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of a scene that change no exact answer: maps of space that carry light and shadow with
// them, and other ways to write the same scene down. What they do to a rounded answer is how much
// of it is chance.
//
// Exactness: every coordinate of the changed scene is exact.
#ifndef GNOMON_COMPARISON_SCENE_CHANGE_H
#define GNOMON_COMPARISON_SCENE_CHANGE_H

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "comparison/measurement.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::comparison {

struct SceneChange {
  std::string_view name;  // such as "axes yzx"
  std::string_view meaning;
  Scene (*make)(const Scene& scene);
};

/// All changes there are.
std::span<const SceneChange> scene_changes();
/// Null: there is no such change.
const SceneChange* change_by_name(std::string_view name);

/// Of every light, polygon and side: the share that is lit, as a double; of an exact result that
/// has exact fractions, that of the exact one.
using SideShares = std::map<std::tuple<std::string, std::string, Side>, double>;
SideShares shares_of(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result,
                     bool exact);
/// A side that one of them lacks counts as one that is all in shadow.
Difference difference_of(const SideShares& before, const SideShares& after);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_SCENE_CHANGE_H
