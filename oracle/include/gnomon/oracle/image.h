// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle of pictures: what the eye sees at each sample, and which lights reach it, by the
// definition itself: intersect the ray with every part, take the nearest, and from there the
// segment to each light with every caster. In rational numbers where doubles with bounds do not
// decide. No spans, no ties, no order; nothing is shared with the kernels.
//
// A sample is on a **boundary**, and counted apart, if its ray meets an edge at or before what is
// seen, or two parts of different planes at one depth, or if the point that is seen lies on a
// border of light and shadow. There is nothing to be wrong about there. Reference:
// docs/image-space.md, "The oracle".
#ifndef GNOMON_ORACLE_IMAGE_H
#define GNOMON_ORACLE_IMAGE_H

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/oracle/verdict.h"
#include "gnomon/result/claims.h"
#include "gnomon/result/pixel_claims.h"
#include "gnomon/scene/camera.h"

namespace gnomon::oracle {

/// Whether a point that a sample sees is so near to a border of shadow, under a light (index into
/// Scene::lights), that a candidate of some resolution cannot tell the two sides apart.
using NearBorder = std::function<bool(std::uint32_t light, const RationalPoint& point)>;

struct ImageOptions {
  double clearance = 0;  // scene units; wrong samples below it are ill-conditioned
  bool strict = false;   // any wrong sample fails, by rows too
  /// Samples times parts; above it every n-th sample is judged.
  std::uint64_t most_pairs = 1'000'000'000;
  /// Samples on boundaries are judged, too, after they were really moved: by 2^-60 of R and 2^-120
  /// of U, in integers. For our own exact kernels, whose ties are defined; nobody else has to know
  /// them.
  bool moves_ties = false;
  double most_boundary = 0.02;  // of the samples judged, for a verdict
  /// Of a candidate of rows: a wrong sample that this holds for is told apart
  /// (ImageReport::by_rows). Called by several threads.
  NearBorder near_border;
  std::function<void(double)> progress;            // 0..1; called from one thread at a time
  const std::atomic<bool>* interrupted = nullptr;  // checked between rows
};

/// A sample at which a candidate is wrong.
struct WrongSample {
  std::uint32_t i = 0, j = 0;
  std::array<double, 3> point{};                  // that is seen, scene units; nothing seen: zeros
  std::uint32_t claimed = PixelClaims::kNothing;  // polygons, as in the claims
  std::uint32_t seen = PixelClaims::kNothing;
  std::optional<std::uint32_t> light;   // index into Scene::lights; none: the polygon is wrong
  bool claimed_lit = false;             // of that light
  std::optional<std::uint32_t> caster;  // polygon that decides, if one does
  std::optional<double> clearance;      // scene units: how far one vertex must move to change it
  bool by_rows = false;                 // ImageOptions::near_border
};

struct ImageReport {
  std::string candidate;
  Verdict verdict = Verdict::kIdentical;  // kWithinTolerance: all wrong samples are ill-conditioned
                                          // or by rows
  std::string reason;                     // of a failure, one sentence
  std::uint64_t samples = 0;              // of the picture
  std::uint64_t step = 1;                 // every so many were looked at
  std::uint64_t judged = 0, boundary = 0;
  std::uint64_t moved = 0;  // of those on boundaries: judged after they were moved
  std::uint64_t wrong = 0, wrong_polygon = 0;  // samples
  std::vector<std::uint64_t> wrong_of_light;   // samples, by the claims' lights
  std::uint64_t ill_conditioned = 0;           // of the wrong ones
  std::uint64_t by_rows = 0;                   // of the wrong ones: ImageOptions::near_border
  std::optional<WrongSample> worst;            // of the largest clearance
  bool interrupted = false;

  std::uint64_t looked_at() const { return judged + boundary; }
  double boundary_share() const {
    return looked_at() == 0 ? 0 : static_cast<double>(boundary) / static_cast<double>(looked_at());
  }
};

/// `view`: the scene prepared with the claims' camera. Errors: kUsage (a clearance that is negative
/// or NaN). An interrupted run is a report.
Expected<ImageReport> judge_pixels(const PreparedView& view, const PixelClaims& claims,
                                   const ImageOptions& options);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_IMAGE_H
