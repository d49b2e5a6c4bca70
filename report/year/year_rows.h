// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a year: which suns are to be computed, each direction once, and the rows in order as
// soon as their suns are done.
#ifndef GNOMON_REPORT_YEAR_YEAR_ROWS_H
#define GNOMON_REPORT_YEAR_YEAR_ROWS_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/scene.h"
#include "report/shares/share_columns.h"
#include "suns/year/year_of_suns.h"

namespace gnomon::report {

/// Which light of the scene each row has.
struct SunsOfRows {
  static constexpr std::uint32_t kNight = 0xffffffffu;

  /// `rows`: of `times`, ascending.
  SunsOfRows(std::span<const suns::SunTime> times, std::vector<std::size_t> rows,
             suns::Minutes zone);

  std::vector<std::size_t> rows;
  std::vector<std::uint32_t> light;   // of each of them, or kNight
  std::vector<std::size_t> last_use;  // by light: into `rows`
  std::vector<Light> lights;          // each direction once, in the order of first use
};

class YearRows {
 public:
  /// Takes a row and its lit shares; false stops.
  using Take = std::function<bool(std::size_t row, std::span<const double> lit)>;

  /// Keeps references.
  YearRows(const SunsOfRows& suns, const ShareColumns& columns, Take take)
      : suns_(&suns), columns_(&columns), take_(std::move(take)), night_(columns.size()) {}

  /// Hands on the rows that need no further light. False once a row was not taken.
  bool advance();
  /// The next light, in order.
  bool add(const LightResult& light);
  /// How many rows were handed on.
  std::size_t done() const { return next_; }

 private:
  const SunsOfRows* suns_;
  const ShareColumns* columns_;
  Take take_;
  std::vector<double> night_;
  /// By light, as long as a later row has it: most often one, of averaged suns those of a day.
  std::unordered_map<std::uint32_t, std::vector<double>> kept_;
  std::size_t next_ = 0;  // of suns_->rows
  bool stopped_ = false;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_YEAR_YEAR_ROWS_H
