// SPDX-License-Identifier: GPL-3.0-or-later
// The values of an engine's table against the true shares, a row at a time.
//
// A value is wrong if it is further from the truth than its digits allow. What is no share at all
// (kRange) or is not dark at night (kNight) is told apart from what is merely off.
#ifndef GNOMON_COMPARISON_ENGINE_TABLES_TABLE_JUDGE_H
#define GNOMON_COMPARISON_ENGINE_TABLES_TABLE_JUDGE_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "comparison/engine_tables/engine_table.h"

namespace gnomon::comparison {

enum class WrongKind : std::uint8_t { kValue, kNight, kRange };
const char* name_of(WrongKind kind);

struct WrongCounts {
  std::uint64_t value = 0, night = 0, range = 0;
  std::uint64_t all() const { return value + night + range; }
  void add(WrongKind kind) {
    ++(kind == WrongKind::kValue ? value : kind == WrongKind::kNight ? night : range);
  }
};

struct WrongValue {
  std::size_t row = 0, column = 0;  // of the columns that are judged
  WrongKind kind = WrongKind::kValue;
  WrittenNumber found;
  double truth = 0, allowed = 0;  // how far off it may be
  double off = 0;                 // infinite of what is no number
};

/// Hours of sun: shares times the length of their step.
struct SunSum {
  double found = 0, truth = 0;
  /// By how much they differ, as a share of the greater one.
  double difference() const;
};

class TableJudge {
 public:
  static constexpr std::size_t kWorst = 10;
  /// What truth itself may be off by, as the double nearest to an enclosure.
  static constexpr double kTruth = 1e-14;
  /// Of a column whose polygon has no area, and so no share.
  static constexpr std::size_t kNoShare = static_cast<std::size_t>(-1);

  /// `tolerance`: instead of the digits. `share_of_column`: of a row of truth, the share that each
  /// kept column of the table means, or kNoShare. Keeps a reference to the table.
  TableJudge(const EngineTable& table, std::vector<std::size_t> share_of_column,
             std::optional<double> tolerance);

  /// `truth`: the lit shares under the row's sun, 0 at night.
  void add(std::size_t row, std::span<const double> truth, bool is_day);

  std::uint64_t values() const { return values_; }
  std::size_t rows() const { return rows_; }
  const WrongCounts& wrong() const { return wrong_; }
  const std::vector<WrongCounts>& wrong_of_columns() const { return wrong_of_columns_; }
  const std::vector<SunSum>& sums() const { return sums_; }
  /// Furthest off first.
  const std::vector<WrongValue>& worst() const { return worst_; }
  bool are_doubles() const;

 private:
  double allowed(const WrittenNumber& number) const;
  void keep(const WrongValue& wrong);

  const EngineTable* table_;
  std::vector<std::size_t> share_of_column_;
  std::optional<double> tolerance_;
  std::uint64_t values_ = 0;
  std::size_t rows_ = 0;
  WrongCounts wrong_;
  std::vector<WrongCounts> wrong_of_columns_;
  std::vector<SunSum> sums_;
  std::vector<WrongValue> worst_;
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ENGINE_TABLES_TABLE_JUDGE_H
