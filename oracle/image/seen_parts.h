// SPDX-License-Identifier: GPL-3.0-or-later
// What the eye sees at a sample: its ray against all parts that face the eye, one by one.
//
// Exactness: exact. Boxes set most parts aside: certified rectangles of the picture, widened by a
// sample, and all of the picture for a part that is not well in front of the eye.
#ifndef GNOMON_ORACLE_IMAGE_SEEN_PARTS_H
#define GNOMON_ORACLE_IMAGE_SEEN_PARTS_H

#include <cstdint>
#include <vector>

#include "gnomon/scene/camera.h"
#include "oracle/image/certified_plane.h"

namespace gnomon::oracle {

/// The camera as the oracle computes with it.
class SampledView {
 public:
  SampledView(const PreparedView& view, const ExactCamera& camera);

  const Integer3& eye() const { return eye_; }
  unsigned bits() const { return bits_; }
  std::uint32_t width() const { return camera_.width; }
  std::uint32_t height() const { return camera_.height; }
  SampleRay ray(std::uint32_t i, std::uint32_t j) const;
  /// The same ray moved along R by so little that no sign changes but those that are zero, and
  /// along U by as little again.
  SampleRay moved_ray(std::uint32_t i, std::uint32_t j) const;
  Integer3 position(VertexId vertex) const;
  const PreparedScene& scene() const { return scene_; }
  const ExactCamera& camera() const { return camera_; }

 private:
  const PreparedScene& scene_;
  ExactCamera camera_;
  Integer3 eye_;
  unsigned bits_ = 0;  // of the grid
};

/// What a ray meets first.
struct Seen {
  static constexpr std::uint32_t kNothing = 0xffffffffu;
  std::uint32_t part = kNothing;
  std::vector<std::uint32_t> coplanar;  // other parts of its plane that are met as well
  bool boundary = false;
};

class SeenParts {
 public:
  explicit SeenParts(const SampledView& view);

  /// Cost: the parts whose rectangles hold the sample.
  Seen at(std::uint32_t i, std::uint32_t j, const SampleRay& ray) const;
  /// The plane of a part that is seen, positive where the eye is, seen from the eye.
  const CertifiedPlane& plane(std::uint32_t part) const { return facing_[place_[part]].plane; }
  bool faces_eye(std::uint32_t part) const { return place_[part] != Seen::kNothing; }
  /// Whether the eye is behind the part's front.
  bool sees_back(std::uint32_t part) const { return facing_[place_[part]].back; }

 private:
  struct Facing {
    std::uint32_t part = 0;
    bool back = false;
    CertifiedPlane plane;               // positive at the eye
    std::vector<CertifiedPlane> edges;  // through the eye, positive inside
  };
  struct Rectangle {
    std::uint32_t left = 0, right = 0, top = 0, bottom = 0;  // [left, right) x [top, bottom)
  };
  /// A part that a ray meets.
  struct Hit {
    const Facing* of = nullptr;
    double low = 0, high = 0;  // of the depth t, up to a factor that all share
    bool on_edge = false;
  };

  void add(std::uint32_t part);
  Rectangle rectangle_of(const Part& part) const;
  static int compare_depth(const Hit& a, const Hit& b, const SampleRay& ray);

  const SampledView& view_;
  std::vector<Facing> facing_;
  std::vector<std::uint32_t> place_;  // of a part in facing_
  /// Places in facing_ by row and block of columns.
  static constexpr std::uint32_t kBlock = 32;
  std::uint32_t blocks_ = 0;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_IMAGE_SEEN_PARTS_H
