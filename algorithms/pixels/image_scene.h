// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene as an eye and its lights see it: which side of a part faces whom, and the planes of its
// edges through the eye and through a light, each made once for all parts that share the edge. So
// of two parts that share an edge exactly one covers a sample, on rounded kernels, too.
#ifndef GNOMON_ALGORITHMS_PIXELS_IMAGE_SCENE_H
#define GNOMON_ALGORITHMS_PIXELS_IMAGE_SCENE_H

#include <array>
#include <cstdint>
#include <vector>

#include "algorithms/pixels/pixel_task.h"
#include "kernel/concept/image_space.h"

namespace gnomon {

template <ImageSpaceModel Space>
class ImageScene {
 public:
  explicit ImageScene(const PixelTask& task)
      : scene_(task.scene),
        rules_(task.rules),
        space_(task.scene.geometry, frame_of(task), task.options.kernel.options()),
        ray_planes_(task.scene.geometry.edges.size(), kNone) {
    facing_eye_ = sides([&](PlaneRef front) { return space_.side_of_eye(front); });
    if (!rules_.backs_are_transparent) {
      for (std::size_t p = 0; p < scene_.parts.size(); ++p) {
        const PlaneRef front = front_of(scene_.parts[p]);
        if (space_.side_of_eye(front) == Sign::kNegative) facing_eye_[p] = -front;
      }
    }
    for (const std::uint32_t light : task.lights) {
      const ImageLight added = space_.add_light(scene_.lights[light].point);
      lights_.push_back({added, &scene_.lights[light].point,
                         sides([&](PlaneRef front) { return space_.side_of_light(front, added); }),
                         std::vector<std::uint32_t>(scene_.geometry.edges.size(), kNone)});
    }
  }

  Space& space() { return space_; }
  /// From, to.
  std::array<VertexId, 2> ends_of(PlaneRef edge) const {
    const auto [a, b] = scene_.geometry.edges[edge.index()];
    return edge.flipped() ? std::array{b, a} : std::array{a, b};
  }
  const PreparedScene& scene() const { return scene_; }
  std::size_t light_count() const { return lights_.size(); }
  ImageLight light(std::size_t l) const { return lights_[l].light; }
  const LightPoint& light_point(std::size_t l) const { return *lights_[l].point; }

  /// The part's plane, its front where the eye is; not valid() if the eye does not see the part.
  PlaneRef facing_eye(std::uint32_t part) const { return facing_eye_[part]; }
  /// The same for a light, by its place in the task.
  PlaneRef facing_light(std::uint32_t part, std::size_t l) const { return lights_[l].facing[part]; }
  /// Does the side that the eye sees face the light? Requires: the eye sees the part.
  bool seen_side_faces(std::uint32_t part, std::size_t l) const {
    return facing_light(part, l) == facing_eye(part);
  }

  /// Of the k-th edge: the plane through the eye, positive inside the part. Requires: the eye sees
  /// the part.
  RayPlaneRef ray_plane(std::uint32_t part, std::size_t k) {
    const Part& of = scene_.parts[part];
    const PlaneRef edge = scene_.edges(of)[k];
    return ray_plane_of(is_back(of, facing_eye_[part]) ? -edge : edge);
  }
  /// Of an edge by EdgeId, in its direction: positive on its left as seen from the eye.
  RayPlaneRef ray_plane_of(PlaneRef edge) {
    std::uint32_t& made = ray_planes_[edge.index()];
    if (made == kNone) {
      const auto [a, b] = scene_.geometry.edges[edge.index()];
      made = space_.add_ray_plane(ImagePoint::at(a), ImagePoint::at(b)).index;
    }
    return {made, edge.flipped()};
  }
  /// Of the k-th edge: the plane through a light, positive inside the part's shadow volume.
  /// Requires: the part faces the light.
  PlaneRef shadow_plane(std::uint32_t part, std::size_t k, std::size_t l) {
    const Part& of = scene_.parts[part];
    const PlaneRef edge = scene_.edges(of)[k];
    return shadow_plane_of(is_back(of, lights_[l].facing[part]) ? -edge : edge, l);
  }
  /// Of an edge by EdgeId, in its direction: positive on its left as seen from the light.
  PlaneRef shadow_plane_of(PlaneRef edge, std::size_t l) {
    std::uint32_t& made = lights_[l].shadow_planes[edge.index()];
    if (made == kNone) {
      const auto [a, b] = scene_.geometry.edges[edge.index()];
      made = space_.add_shadow_plane(lights_[l].light, a, b).index();
    }
    return PlaneRef(made, edge.flipped());
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  struct LightOf {
    ImageLight light;
    const LightPoint* point;
    std::vector<PlaneRef> facing;              // a part each
    std::vector<std::uint32_t> shadow_planes;  // an edge each, for the way from its a to its b
  };

  static ImageFrame frame_of(const PixelTask& task) {
    ImageFrame frame = task.frame;
    if (!task.rules.planes_stay_at_ties) frame.ties = TieRule::kPlaneTurns;
    return frame;
  }
  static PlaneRef front_of(const Part& part) { return PlaneRef(part.plane, part.flipped); }
  /// Whether the plane has its front at the back of the part.
  static bool is_back(const Part& part, PlaneRef plane) { return plane.flipped() != part.flipped; }
  /// The side of each part for which `sign` of its plane is positive, of a two-sided one either.
  template <class SignOf>
  std::vector<PlaneRef> sides(const SignOf& sign) {
    std::vector<PlaneRef> result;
    result.reserve(scene_.parts.size());
    for (const Part& part : scene_.parts) {
      const PlaneRef front = front_of(part);
      const Sign side = sign(front);
      result.push_back(side == Sign::kPositive                     ? front
                       : side == Sign::kNegative && part.two_sided ? -front
                                                                   : PlaneRef());
    }
    return result;
  }

  const PreparedScene& scene_;
  const Rules& rules_;
  Space space_;
  std::vector<PlaneRef> facing_eye_;
  std::vector<std::uint32_t> ray_planes_;  // an edge each, for the way from its a to its b
  std::vector<LightOf> lights_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_IMAGE_SCENE_H
