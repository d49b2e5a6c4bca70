// SPDX-License-Identifier: GPL-3.0-or-later
// How strictly results are judged, as `gnomon certify` and the Python module ask for it.
#ifndef GNOMON_REPORT_CERTIFICATE_JUDGING_LIMITS_H
#define GNOMON_REPORT_CERTIFICATE_JUDGING_LIMITS_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "gnomon/oracle/verdict.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::report {

/// Scenes of up to so many parts are judged by measuring all error, larger ones by borders where
/// these suffice; and slow exact kernels run on them without being asked for.
inline constexpr std::size_t kSmallScene = 200;

struct JudgingLimits {
  std::optional<double> tolerance;  // wrong share of a polygon; none: 1e-9, of shares their digits
  std::optional<double> width;      // of a region of error, scene units; none: 1e-9 of the diagonal
  double clearance = 0;             // scene units; nothing under `strict`
  std::optional<std::uint64_t> leaks;
  bool strict = false, subset = false;
  bool measure = false;  // all error, on large scenes too
};

/// `lights`: indices into PreparedScene::lights.
oracle::CertifyOptions certify_options(const JudgingLimits& limits, const PreparedScene& prepared,
                                       std::vector<std::uint32_t> lights);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_CERTIFICATE_JUDGING_LIMITS_H
