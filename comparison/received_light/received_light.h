// SPDX-License-Identifier: GPL-3.0-or-later
// What points of a polygon see and receive of an area light, on any kernel by any method, against
// the exact share and the proven value. Of each point the light becomes a receiver and the point
// its lamp (gnomon/scene/visible_light_scene.h), which is how Chin & Feiner 1992 find the light's
// visible part; what is lit of it is then summed by the paper's contour integral.
//
// Exactness: truths are exact (share) or proven (illumination); what a kernel found is judged.
#ifndef GNOMON_COMPARISON_RECEIVED_LIGHT_RECEIVED_LIGHT_H
#define GNOMON_COMPARISON_RECEIVED_LIGHT_RECEIVED_LIGHT_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/algorithms/illumination.h"
#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/algorithms/visible_light.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::comparison {

/// A side of a polygon under an area light.
struct LitSide {
  std::uint32_t light = 0;  // index into Scene::lights
  std::uint32_t polygon = 0;
  Side side = Side::kFront;
};

/// How much of what is in front of the receiver a point sees.
enum class Sight : std::uint8_t { kNothing, kPart, kAll };
/// "nothing", "part", "all".
const char* name_of(Sight sight);

/// A point and what is true there.
struct PointSight {
  Position position;
  Sight sight = Sight::kNothing;
  /// Shares of the light's area: what is in front of the receiver's plane, what of it is seen.
  mpq_class in_front, visible;
  /// With the error asked for, and what it would be without casters. Units: as Illumination.
  Illumination received, unobstructed;
};

/// What a kernel found in one point.
struct FoundLight {
  Sight sight = Sight::kNothing;
  double visible = 0;                    // share of the light's area
  std::optional<mpq_class> exact_share;  // of exact kernels
  double received = 0;
  double cpu_seconds = 0;
};

class ReceivedLight {
 public:
  /// Keeps references to both. Errors: kGeometry (a receiver that is not planar or has no area).
  /// Requires: an area light.
  static Expected<ReceivedLight> make(const Scene& scene, const PreparedScene& prepared,
                                      const LitSide& receiver);

  /// Points spread over the polygon, inside its parts and exactly in its plane; the same for a
  /// seed.
  std::vector<Position> spread_points(std::size_t count, std::uint64_t seed) const;

  /// What is true in a point. Errors: kGeometry, for a point outside the receiver's plane.
  Expected<PointSight> at(const Position& point) const;

  /// The scene in which kernels find what the point sees. Errors: those of preparing.
  Expected<PreparedScene> scene_of(const PointSight& point) const;
  /// What the kernel and method of `options` find in that scene. Errors: those of
  /// compute_shadows(). Requires: a method that makes fragments, and tiles by them.
  Expected<FoundLight> found(const PointSight& point, const PreparedScene& scene,
                             ShadowOptions options) const;

  const LitSide& receiver() const { return receiver_; }

 private:
  ReceivedLight(const Scene& scene, const PreparedScene& prepared, const LitSide& receiver);
  mpq_class height_of(const std::array<mpq_class, 3>& point) const;

  const Scene* scene_;
  const PreparedScene* prepared_;
  LitSide receiver_;
  std::uint32_t part_ = 0;  // one of the polygon's, which has its plane
  // Of the receiving side's plane: a point, a normal, and the normal of length 1.
  std::array<mpq_class, 3> origin_, normal_;
  std::array<double, 3> unit_normal_{};
  LightVisibility visibility_;
  Illuminator illuminator_;
};

/// One kernel under one policy on all points.
struct KernelReceipt {
  std::string kernel, algorithm;
  bool exact = false;
  bool counts = true;      // for the exit status
  std::string error;       // why it has no more than `points`
  std::size_t points = 0;  // that it was run on
  // Sees nothing, part or all where another is true; by a hair is no failure.
  std::size_t wrong = 0;
  double share_off = 0;     // largest error of the share of the light's area
  double received_off = 0;  // largest error of what is received, as a share of the unobstructed
  double relative_off = 0;  // the same as a share of what is received
  std::size_t worst = 0;    // index of the point with that received_off
  bool differs = false;     // an exact kernel with another share than the true one
  double cpu_seconds = 0;   // of all points, one thread

  /// Beyond `tolerance`, or not finished.
  bool failed(double tolerance) const {
    return !error.empty() || share_off > tolerance || received_off > tolerance;
  }
};

/// Adds what a kernel found in a point.
void add_to(KernelReceipt& receipt, std::size_t index, const PointSight& point,
            const FoundLight& found);

struct ReceivedLightReport {
  const Scene* scene = nullptr;
  LitSide receiver;
  double tolerance = 0;
  std::vector<PointSight> points;
  std::vector<KernelReceipt> kernels;
  bool list_points = false;  // each in the text
  bool interrupted = false;
};

std::string received_light_text(const ReceivedLightReport& report);
std::string received_light_json(const ReceivedLightReport& report);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_RECEIVED_LIGHT_RECEIVED_LIGHT_H
