// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict: a candidate against the exact answer of a scene, polygon side by polygon side, and
// one word for all of it, with the worst place as a witness.
//
//   identical         misclassified, uncovered, overlapping and outside are exactly 0 everywhere;
//   within tolerance  each is at most `tolerance` of every polygon, and every region of error and
//                     every vertex off its plane is at most `width`; what the rounding of loops
//                     that are not exact explains is told apart and counts only if `strict`;
//   shares agree      nothing is known but shares (ToldShare), and each is the true one as far as
//                     its digits tell: no proof, since a shadow in the wrong place keeps its share;
//   failed            otherwise, or if something is missing, unknown or listed twice.
//
// What a candidate tells of several lights at once (Claims::combined, Claims::overlay) is judged
// light by light besides; whether shared fragments tile a side is judged once.
//
// Umbra of an area light that a candidate calls penumbra is a cost, told and not judged.
//
// Above `most_pairs` pairs of parts (a stated limit: the exact regions grow with the square of the
// scene) exact points are checked instead, and the verdict says how many.
#ifndef GNOMON_ORACLE_VERDICT_H
#define GNOMON_ORACLE_VERDICT_H

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/oracle/compare.h"
#include "gnomon/oracle/exact_answer.h"
#include "gnomon/result/claims.h"

namespace gnomon::oracle {

enum class Verdict : std::uint8_t { kIdentical, kWithinTolerance, kSharesAgree, kFailed };

struct CertifyOptions {
  double tolerance = 1e-9;      // fraction of each polygon
  std::optional<double> width;  // scene units; default 1e-9 of the scene's diagonal
  /// Of shares told alone, a fraction of each polygon; none: as their digits say.
  std::optional<double> share_tolerance;
  bool strict = false;                 // tolerance and width 0, and rounding counts
  double clearance = 0;                // scene units; error below it is ill-conditioned
  bool subset = false;                 // lights and polygons may be missing
  std::optional<std::uint64_t> leaks;  // fail with more invented and lost regions than this
  /// Success is proven by borders where they suffice, and polygon sides overlaid where they do not
  /// (ComparisonTotals::by_borders): the same verdict, sooner, but errors that are small enough are
  /// bounded and not measured. Without effect if strict or with a clearance or `leaks`.
  bool borders = false;
  std::vector<std::uint32_t> lights;         // indices into PreparedScene::lights; empty: all
  std::uint64_t most_pairs = 1'000'000'000;  // a minute for a city of that size; area: minutes
  std::uint32_t points_a_polygon = 8;  // above the limit: of its fragments, and as many at random
  // Points times parts; where all polygons would take more, every n-th polygon side is checked.
  std::uint64_t most_point_pairs = 50'000'000;
  std::uint64_t seed = 1;                // of the random points
  std::size_t exact_limit = 200;         // boundary edges up to which areas are also exact
  std::size_t most_regions = 1;          // kept a polygon side
  bool measure_rounding = true;          // false: regions of rounding alone have no width or place
  unsigned threads = 0;                  // 0: as many as there are
  std::function<void(double)> progress;  // 0..1; called from one thread at a time
  const std::atomic<bool>* interrupted = nullptr;  // checked between polygons
};

struct LightComparison {
  std::string id;
  Block block = Block::kLights;  // of the candidate, which may tell of a light in several
  std::vector<PolygonComparison> polygons;  // in order of the scene, front before back
};

/// Sums and maxima over all polygon sides; areas in scene units squared.
struct ComparisonTotals {
  Enclosure area, lit, shadow, penumbra, umbra;
  Enclosure misclassified, uncovered, overlapping, outside, ill_conditioned, rounding;
  Enclosure missing_umbra;
  double worst_misclassified = 0;  // greatest upper bound of a polygon's fraction
  double worst_uncovered = 0, worst_overlapping = 0, worst_outside = 0;
  Enclosure width, off_plane;  // greatest
  std::uint64_t polygons = 0, fragments = 0, wrong_polygons = 0, regions = 0;
  std::uint64_t ill_conditioned_regions = 0, rounding_regions = 0;
  double rounding_radius = 0;  // greatest, scene units
  std::uint64_t invented = 0, lost = 0, t_vertices = 0, self_crossing = 0;
  std::uint64_t by_borders = 0;  // polygon sides whose error is bounded by borders alone

  /// The greatest of the worst shares.
  double worst_share() const {
    return std::max({worst_misclassified, worst_uncovered, worst_overlapping, worst_outside});
  }
};

struct Report {
  std::string candidate;
  Verdict verdict = Verdict::kIdentical;
  std::string reason;                 // of a failure, one sentence; empty otherwise
  std::string excess;                 // of a failure: the number that is above its limit
  std::vector<std::string> problems;  // missing, unknown, listed twice: each fails the candidate
  std::vector<std::string> notes;     // what was not compared, and why
  std::vector<LightComparison> lights;
  ComparisonTotals totals;
  std::optional<Witness> worst;                    // the place that decided, or the worst there is
  double tolerance = 0, width = 0, clearance = 0;  // as applied; scene units
  double diagonal = 0;                             // of the scene
  bool by_points = false;                          // above the limit: only points were compared
  std::uint64_t points_checked = 0, points_wrong = 0, points_on_boundary = 0;
  std::uint64_t pairs = 0, most_pairs = 0;
  std::uint64_t told_shares = 0;          // compared
  std::optional<double> share_tolerance;  // as applied to them; none: as their digits say
  bool interrupted = false;               // not everything was compared
  bool oracle_fault = false;              // the oracle contradicted itself: a bug of ours

  /// What an exact kernel must reach: identical; where only points were checked, nothing wrong
  /// found.
  bool confirms_exact() const {
    return !oracle_fault &&
           verdict == (by_points ? Verdict::kWithinTolerance : Verdict::kIdentical);
  }
};

/// Pieces of a light are judged as lights, and must tile it. Errors: kUsage (tolerance, width or
/// clearance negative or NaN); kGeometry (a piece of a light that is none). An interrupted run is a
/// report.
Expected<Report> certify(const ExactAnswer& answer, const Claims& candidate,
                         const CertifyOptions& options);
Expected<Report> certify(const Scene& scene, const PreparedScene& prepared, const Claims& candidate,
                         const CertifyOptions& options);

const char* name_of(Verdict verdict);
/// The diagonal of the box of all vertices of parts, scene units.
double scene_diagonal(const PreparedScene& prepared);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_VERDICT_H
