// SPDX-License-Identifier: LGPL-3.0-or-later
// A camera with an exact meaning. The eye is a point of the scene's numbers; right, up and forward
// are integer vectors of at most 16 bits, made once from what a user says and exact from then on.
// The eye goes through prepare() like a light, so that it lies on the scene's grid.
//
// Right and up reach from the middle of the picture to its sides, at the distance of forward; they
// need not be orthogonal. gnomon/kernel/image_frame.h has the direction of each sample.
#ifndef GNOMON_SCENE_CAMERA_H
#define GNOMON_SCENE_CAMERA_H

#include <array>
#include <cstdint>

#include "gnomon/kernel/error.h"
#include "gnomon/kernel/image_frame.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

struct ExactCamera {
  Position eye;
  std::array<std::int32_t, 3> right{}, up{}, forward{};
  std::uint32_t width = 0, height = 0;
};

/// What a user says of a camera, in scene units and doubles.
struct CameraView {
  std::array<double, 3> eye{}, look_at{}, up{0, 0, 1};
  double field_of_view = 0;  // degrees, along the longer side of the picture; in (0, 180)
  std::uint32_t width = 0, height = 0;
};

/// Rounds the frame to integers, the largest component to ImageFrame::kLargestComponent. `eye` is
/// the exact one. If `up` is along the view, another direction takes its place. Errors: kUsage (no
/// samples, a field of view outside (0, 180), the eye at look_at, a frame that rounding makes flat:
/// fields of view below about 0.01 degrees), kLimit (more than ImageFrame::kMostSamples).
Expected<ExactCamera> make_camera(const Position& eye, const CameraView& view);

/// The field of view, in degrees, that holds all vertices of the scene with a margin; 75 where some
/// are beside or behind the eye.
double fitting_field_of_view(const PreparedScene& scene, const CameraView& view);

/// A scene whose grid holds the eye.
struct PreparedView {
  PreparedScene scene;
  ImageFrame frame;
};

/// Errors: those of prepare(); kUsage and kLimit as make_camera(), for a camera from elsewhere.
Expected<PreparedView> prepare_view(Scene scene, const ExactCamera& camera);

}  // namespace gnomon

#endif  // GNOMON_SCENE_CAMERA_H
