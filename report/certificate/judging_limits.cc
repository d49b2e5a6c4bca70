// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/certificate/judging_limits.h"

#include <utility>

namespace gnomon::report {

oracle::CertifyOptions certify_options(const JudgingLimits& limits, const PreparedScene& prepared,
                                       std::vector<std::uint32_t> lights) {
  oracle::CertifyOptions options;
  options.tolerance = limits.tolerance.value_or(options.tolerance);
  options.share_tolerance = limits.tolerance;
  options.width = limits.width;
  options.strict = limits.strict;
  options.clearance = limits.strict ? 0 : limits.clearance;
  options.subset = limits.subset;
  options.leaks = limits.leaks;
  options.borders = !limits.measure && prepared.parts.size() > kSmallScene;
  options.lights = std::move(lights);
  return options;
}

}  // namespace gnomon::report
