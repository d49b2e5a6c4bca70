// SPDX-License-Identifier: GPL-3.0-or-later
// How much of a scene is wrong, as one number that is right at every scale of the scene: areas in
// scene units overflow above 2^508 and underflow below 2^-508.
#ifndef GNOMON_REPORT_CERTIFICATE_WRONG_SHARE_H
#define GNOMON_REPORT_CERTIFICATE_WRONG_SHARE_H

#include <gmpxx.h>

#include <map>
#include <string>

#include "report/certificate/certificate.h"

namespace gnomon::report {

class WrongShare {
 public:
  explicit WrongShare(const Certificate& certificate);

  /// Misclassified area (what is not covered counts) as a share of all area that faces a light; of
  /// all that was compared if none faces one. An upper bound but for the rounding of the sums.
  double of(const oracle::Report& report) const;

  /// All area that faces a light, and that of a polygon: shares of the square over the scene's box.
  /// Off by less than 2^-45 of themselves.
  double facing() const { return facing_; }
  double area_of(const std::string& polygon) const {
    const auto area = areas_.find(polygon);
    return area == areas_.end() ? 0 : area->second;
  }
  /// The square over the scene's box, scene units squared.
  const mpq_class& unit() const { return unit_; }

 private:
  double facing_ = 0;
  std::map<std::string, double> areas_;  // by polygon
  mpq_class unit_ = 0;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_CERTIFICATE_WRONG_SHARE_H
