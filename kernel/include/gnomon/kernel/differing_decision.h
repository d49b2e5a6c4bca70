// SPDX-License-Identifier: LGPL-3.0-or-later
// A decision on which a rounded kernel and the exact one differ: what was asked of which plane and
// point, by names that hold for every run on the same scene, and how far from zero the exact value
// is.
#ifndef GNOMON_KERNEL_DIFFERING_DECISION_H
#define GNOMON_KERNEL_DIFFERING_DECISION_H

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/sign.h"

namespace gnomon {

/// What methods ask of kernels.
enum class Predicate : std::uint8_t {
  kFacing,       // which side of a support plane faces the light
  kSceneBsp,     // a vertex against a support plane, in the scene BSP
  kShadowPlane,  // a vertex against the plane through the light and an edge
  kCut,          // a vertex against the plane through the light and where two polygons cut
  kDepth,        // a point of a polygon against the support plane of another: which is nearer
  kBorder,       // a vertex against a border of cells, which no scene asks for
  kVolume,       // a vertex against a plane of a shadow volume of an area light
  kSupport,      // a vertex against a support plane, under a light taken in three dimensions
  kThreePoints,  // whether three points are on a line, and so no plane of a volume
};
inline constexpr std::size_t kPredicateCount = 9;

/// "facing", "scene BSP", "shadow plane", ...
std::string_view name_of(Predicate predicate);

/// A plane by what it was made from.
struct PlaneName {
  enum class Kind : std::uint8_t {
    kNone,
    kSupport,  // of[0]: PlaneId
    kEdge,     // of[0]: EdgeId; through the light, or the name of the edge itself in space
    kCut,      // of[0], of[1]: PlaneId; through the light and where the first is cut by the second
    kBorder,   // of cells
    kThrough,  // of: vertices; kMadeVertex stands for a made point or a direction
  };
  Kind kind = Kind::kNone;
  std::array<std::uint32_t, 3> of{};
  std::uint64_t rest = 0;  // what else tells it from others, as a hash
};

/// A vertex by its number among the prepared scene's positions, or by the planes that it was made
/// from, in the loop of a support plane.
struct CornerName {
  static constexpr std::uint32_t kNoSupport = 0xffffffffu;
  VertexId source = 0;  // kMadeVertex: made
  PlaneName before, after;
  PlaneId support = kNoSupport;
};

/// All times that a question was asked in a run are one: a kernel answers them alike.
struct DifferingDecision {
  Predicate predicate = Predicate::kFacing;
  std::optional<std::uint32_t> light;  // index into PreparedScene::lights; none: the scene BSP
  PlaneName plane;
  CornerName corner;                        // of kFacing and kThreePoints nothing
  std::array<double, 3> position{};         // of the exact vertex, scene units
  std::array<double, 3> tested_position{};  // as the kernel under test has it
  Side tested = Side::kOn;
  Side exact = Side::kOn;
  std::uint64_t decisions = 0;  // asked before it was asked first
  std::uint64_t times = 0;      // that the answers differed
  /// |n . x - d| for the exact plane and vertex, in units of the last place of the largest of the
  /// four terms, in the number type of the kernel under test. 0 where exact is kOn.
  double ulps = 0;
  /// The question as a hash, and the answer of the kernel under test in the plane's own
  /// orientation: what a flip needs.
  std::uint64_t question = 0;
  Side flip = Side::kOn;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_DIFFERING_DECISION_H
