// SPDX-License-Identifier: GPL-3.0-or-later
// Samples of any program: points, and how much of a light was seen there, each against the truth at
// that very point.
//
// A point that is not on its polygon is taken to the nearest one that is. Without a polygon it
// belongs to the nearest; of those that are nearest within the width, to those with a side that
// faces the light. Seen through a side of a polygon, a point or directional light is there or not,
// as the point is lit or in shadow; of an area light the share of its area counts that neither the
// polygon's own plane nor a caster hides. Where both sides of a polygon are meant, their shares are
// added up.
//
// Exactness: every sample is decided exactly. What light and shadow meet in is neither right nor
// wrong, and so is where the share of an area light jumps (a point on a caster).
#ifndef GNOMON_ORACLE_SAMPLE_JUDGE_H
#define GNOMON_ORACLE_SAMPLE_JUDGE_H

#include <gmpxx.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "gnomon/kernel/sign.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

struct Sample {
  std::uint32_t light = 0;  // index into PreparedScene::lights
  RationalPoint point;      // scene units
  std::optional<std::uint32_t> polygon;
  std::optional<Side> side;          // of the polygon; none: all that receive
  std::optional<mpq_class> visible;  // share of the light that was seen; none: no number
  double allowed = 0;                // how far off a share of an area light may be
};

enum class SampleOutcome : std::uint8_t {
  kRight,
  kOnBorder,        // where light and shadow meet: neither right nor wrong
  kAmbiguous,       // right for one of the nearest polygons, wrong for another
  kNearBorder,      // wrong, within the width of a place where it would be right
  kIllConditioned,  // wrong, and right if one vertex moved by no more than the clearance
  kWrong,
};
inline constexpr std::size_t kSampleOutcomes = 6;
/// "right", "on-border", "ambiguous", "near-border", "ill-conditioned", "wrong".
const char* name_of(SampleOutcome outcome);

struct JudgedSample {
  SampleOutcome outcome = SampleOutcome::kRight;
  bool out_of_range = false;     // no share of this light: beyond 0 and 1, or between of a point
  std::uint32_t polygon = 0;     // index into Scene::polygons
  std::uint32_t part = 0;        // of the polygon, that holds the place
  RationalPoint place;           // on the polygon, where it was decided
  double moved = 0;              // from the point of the sample, scene units
  std::uint32_t candidates = 1;  // polygons that it may belong to
  mpq_class truth;               // share of the light that is seen
  double off = 0;                // what was seen less the truth
  /// The part that hides the light, or most of what is hidden. Of a point that is lit: one that the
  /// way to the light touches, else, if it is wrong, the one whose shadow is nearest.
  std::optional<std::uint32_t> caster;
  bool touches = false;
  /// Of what is wrong under a point or directional light: at least so far from where light and
  /// shadow meet, scene units.
  std::optional<double> from_border;

  bool is_miss() const { return outcome >= SampleOutcome::kNearBorder; }
};

struct SampleOptions {
  double width = 0;      // scene units
  double clearance = 0;  // scene units
};

/// What decides about a wrong sample.
struct SampleCause {
  std::optional<std::uint32_t> caster;  // part
  std::optional<double> clearance;      // how far one vertex must move to make it right
};

class SampleJudge {
 public:
  /// Keeps a reference to the scene.
  SampleJudge(const PreparedScene& scene, const SampleOptions& options);
  ~SampleJudge();

  /// Requires: a polygon that was not dropped, a scene with parts. Thread-safe.
  JudgedSample judge(const Sample& sample) const;
  /// Of a sample that is wrong. Costs more than to judge it. Thread-safe.
  SampleCause cause(const Sample& sample, const JudgedSample& judged) const;
  /// Lets go of what was made for lights, where there are many. Not while others judge.
  void forget_lights();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_SAMPLE_JUDGE_H
