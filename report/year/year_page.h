// SPDX-License-Identifier: GPL-3.0-or-later
// A year as a page shows it: shares to four digits, hours by month, the suns. Exact shares are in
// the tables that `gnomon year -o` writes.
#ifndef GNOMON_REPORT_YEAR_YEAR_PAGE_H
#define GNOMON_REPORT_YEAR_YEAR_PAGE_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "report/text/text_sink.h"
#include "report/year/sun_hours.h"
#include "report/year/year_writer.h"

namespace gnomon::report {

class YearPage {
 public:
  /// Shares in a page: 45 MB of text. Of a larger year it has the hours alone.
  static constexpr std::size_t kMostShares = 16'000'000;

  /// Keeps a reference.
  explicit YearPage(const YearHead& head, std::size_t most_shares = kMostShares);

  void add(const suns::SunTime& sun, std::span<const double> lit);
  /// "format": "gnomon-year" (docs/report.md).
  void write(TextSink& sink) const;
  /// As sun_hours.h has them.
  std::string hours_csv() const { return hours_.text(); }
  std::size_t rows() const { return rows_; }

 private:
  const YearHead* head_;
  bool has_shares_;
  std::size_t rows_ = 0;
  std::vector<std::int32_t> suns_;
  std::vector<std::uint16_t> lit_;
  SunHours hours_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_YEAR_YEAR_PAGE_H
