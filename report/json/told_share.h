// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef GNOMON_REPORT_JSON_TOLD_SHARE_H
#define GNOMON_REPORT_JSON_TOLD_SHARE_H

#include <cmath>

#include "gnomon/algorithms/shadow_result.h"

namespace gnomon::report {

/// An enclosed share as one double: the middle, but 0 and 1 of nothing that may be more or less. So
/// who reads that a polygon is all lit, or not at all, can rely on it.
inline double told_share(const Interval& share) {
  const double middle = share.middle();
  if (middle == 1 && share.lower < 1) return std::nextafter(1.0, 0.0);
  if (middle == 0 && share.upper > 0) return share.upper;
  return middle;
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_JSON_TOLD_SHARE_H
