// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/certificate/certificate.h"
#include "report/text/csv_field.h"
#include "report/text/number_text.h"

namespace gnomon::report {

std::string certificate_csv(const Certificate& certificate) {
  std::string text;
  append_csv_line(text, {"run", "kernel", "algorithm", "thickness", "counts", "verdict",
                         "worst_share", "wrong_sides", "width", "fragments", "reason"});
  for (const JudgedRun& run : certificate.runs) {
    const auto& report = run.report;
    append_csv_line(text, {run.name, run.kernel, run.algorithm,
                           run.foreign || run.exact ? "" : shortest(run.thickness),
                           run.counts ? "1" : "0", report ? name_of(report->verdict) : "",
                           report ? shortest(report->totals.worst_share()) : "",
                           report ? std::to_string(report->totals.wrong_polygons) : "",
                           report ? shortest(report->totals.width.upper) : "",
                           std::to_string(run.fragments), report ? report->reason : run.error});
  }
  return text;
}

}  // namespace gnomon::report
