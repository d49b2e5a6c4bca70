// SPDX-License-Identifier: LGPL-3.0-or-later
// What a point sees of an area light, as a scene of its own: the light's polygon receives, the
// point is the lamp, and everything that casts is between them. What is lit of the light's polygon
// is the part of the light that the point sees, so that every method and kernel computes it, and
// whatever judges shadows judges it.
//
// Chin & Feiner 1992, "Analytic visibility for penumbra vertices": the light is classified by the
// shadow volumes that the polygons between have from the point.
#ifndef GNOMON_SCENE_VISIBLE_LIGHT_SCENE_H
#define GNOMON_SCENE_VISIBLE_LIGHT_SCENE_H

#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// The scene of the point's sight. Its first polygon is the light's: one-sided, it casts nothing,
/// and it has the light's id (with "-light" behind it as often as a polygon has that already). The
/// others are the polygons that cast, turned round: a side hides a point of the light from what is
/// behind it, so that it is the side behind that faces the lamp. The one light is the point, "eye".
///
/// `light`: the id of an area light; empty: the only one. `point`: in scene units, as the scene's
/// numbers are meant.
///
/// Exactness: no arithmetic. On an exact kernel the lit share of the light's polygon is what
/// LightVisibility calls `visible` (gnomon/algorithms/visible_light.h) where all of the light is in
/// front of the receiver: a polygon does not hide from points of its own plane, and none that lies
/// in the light's plane hides anything, in both scenes.
/// Errors: kId: no such light, or none, or several and no id; kUsage: it is no area light.
Expected<Scene> visible_light_scene(const Scene& scene, std::string_view light,
                                    const Position& point);

}  // namespace gnomon

#endif  // GNOMON_SCENE_VISIBLE_LIGHT_SCENE_H
