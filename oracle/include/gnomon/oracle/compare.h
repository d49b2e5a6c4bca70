// SPDX-License-Identifier: GPL-3.0-or-later
// What a comparison is, by the definitions (docs: semantics): a candidate's fragments of one
// polygon side against the exact regions, in one exact overlay. Every cell of it has a true class
// and the classes the candidate claims, so every number below is a sum over cells, and "identical"
// means that no cell errs.
//
// Exactness: all decisions are exact; areas are certified enclosures, and exact fractions where the
// boundary of the error is short. Widths are bounds from both sides.
#ifndef GNOMON_ORACLE_COMPARE_H
#define GNOMON_ORACLE_COMPARE_H

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/oracle/exact_answer.h"
#include "gnomon/result/claims.h"

namespace gnomon::oracle {

/// What is wrong at a place; ordered from the mildest.
enum class ErrorKind : std::uint8_t { kNone, kOverlapping, kOutside, kUncovered, kMisclassified };

/// A place that shows an error: enough to look at it and to check it by hand.
struct Witness {
  std::string light, polygon;
  Side side = Side::kFront;
  ErrorKind kind = ErrorKind::kNone;
  RationalPoint point;  // strictly inside the region of error, on the support plane
  std::array<double, 3> nearest{};
  std::optional<LightState> found;  // none: uncovered
  std::optional<LightState> truth;  // none: outside the polygon, or it is about the whole side
  std::string caster;               // polygon that decides, empty if none does
  Enclosure width;                  // of the region around it, scene units
  std::optional<double> clearance;  // scene units; none: no single vertex is known to change it
  std::string text;                 // one sentence
  Block block = Block::kLights;     // of the candidate
  /// Shares told alone say nothing of a place: `text` has it all.
  bool is_of_side() const { return kind == ErrorKind::kMisclassified && !truth; }
};

/// A maximal connected region in which the candidate is wrong in any way.
struct ErrorRegion {
  AreaShare area;
  Witness witness;
  bool ill_conditioned = false;  // clearance below the one asked for
  bool rounding = false;         // all of it is what rounding to doubles excuses

  bool excused() const { return ill_conditioned || rounding; }
};

struct ComparisonOptions {
  double clearance = 0;           // scene units; 0: nothing is ill-conditioned
  double width_resolution = 0;    // scene units; widths need not be told more closely
  std::size_t exact_limit = 200;  // boundary edges up to which an area is also given exactly
  std::size_t most_regions = 16;  // kept with their witness, widest first
  /// False: regions that are rounding alone are counted as that and told no more of: `width` and
  /// `worst` leave them out. What is judged stays the same.
  bool measure_rounding = true;
  /// Of shares told alone: of the polygon; none: as their digits say (ToldShare::rounding), and
  /// `double_tolerance` of those that are doubles (ToldShare::is_double).
  std::optional<double> share_tolerance;
  double double_tolerance = 1e-9;
};

/// One polygon side under one light.
struct PolygonComparison {
  std::string polygon;
  Side side = Side::kFront;
  AreaShare lit, shadow;      // the truth
  AreaShare penumbra, umbra;  // the truth under an area light
  AreaShare misclassified, uncovered, overlapping, outside;
  AreaShare ill_conditioned, rounding;  // shares of the error that are, counted apart
  /// Area lights: true umbra claimed as penumbra. A cost; where umbra is claimed per caster it is
  /// misclassified instead, and none.
  AreaShare missing_umbra;
  Enclosure width;      // of the widest region of error, scene units
  Enclosure off_plane;  // scene units
  /// How near to a border error is rounding, and a vertex to its plane, scene units; 0 if every
  /// loop is exact.
  double rounding_radius = 0;
  std::uint64_t fragments = 0, regions = 0, ill_conditioned_regions = 0, rounding_regions = 0;
  std::uint64_t invented = 0, lost = 0, t_vertices = 0, self_crossing = 0;
  std::vector<ErrorRegion> worst;  // widest first
  bool inconsistent = false;       // the oracle contradicts itself: a finding about us
  /// Right but for what its borders leave room for: areas and widths of error are bounds from
  /// above, zero where there is none; regions, leaks and T-vertices are not counted.
  bool by_borders = false;
  /// The candidate tells shares alone. `misclassified` is then by how much the worst of them is
  /// off, which is at most the area that is: a share that is right may lie in the wrong place. What
  /// is within what the share's digits say, or within the tolerance asked for, is not judged.
  std::size_t told_shares = 0;
  /// The same without what is ill-conditioned or rounding: what the verdict looks at.
  AreaShare judged_misclassified, judged_uncovered, judged_overlapping, judged_outside;
  Enclosure judged_width, judged_off_plane;
};

/// `candidate` may be null: nothing was found. Requires: `entry` is one of answer.entries(light).
/// Under an area light `lit` must be claimed where lit is true and nowhere else. Per caster, the
/// other two classes too; else penumbra is accepted wherever lit is not true, and umbra where it is
/// true and where no light is certified to arrive.
PolygonComparison compare_entry(const ExactAnswer& answer, std::uint32_t light,
                                const AnswerEntry& entry, const ClaimedPolygon* candidate,
                                const ClaimedTerms& terms, const ComparisonOptions& options);

const char* name_of(ErrorKind kind);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_COMPARE_H
