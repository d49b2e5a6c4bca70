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

#include <string>

#include "gnomon/kernel/error.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// Who looks, and at what.
struct LightSight {
  std::string light;  // the id of an area light; empty: the only one
  Position point;     // in scene units, as the scene's numbers are meant
  /// The id of the polygon that the point lies on, which sees what is in front of its plane (behind
  /// it, as its back side). Empty: the point sees all around.
  std::string receiver;
  Side side = Side::kFront;
};

/// The scene of the point's sight. Its first polygon is the light's: one-sided, it casts nothing,
/// and it has the light's id (with "-light" behind it as often as a polygon has that already). The
/// others are the polygons that cast, turned round: a side hides a point of the light from what is
/// behind it, so that it is the side behind that faces the lamp. The one light is the point, "eye";
/// its region is what the receiver sees.
///
/// Exactness: exact. On an exact kernel the lit share of the light's polygon is what
/// LightVisibility::at calls `visible` (gnomon/algorithms/visible_light.h): a polygon does not hide
/// from points of its own plane, and none that lies in the light's plane hides anything, in both
/// scenes.
/// Errors: kId: no such light, or none, or several and no id; no such receiver; kUsage: it is no
/// area light; kGeometry: the receiver is not planar, or has no area.
Expected<Scene> visible_light_scene(const Scene& scene, const LightSight& sight);

}  // namespace gnomon

#endif  // GNOMON_SCENE_VISIBLE_LIGHT_SCENE_H
