// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/engine_tables/table_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon::comparison {

const char* name_of(WrongKind kind) {
  switch (kind) {
    case WrongKind::kValue:
      return "value";
    case WrongKind::kNight:
      return "night";
    case WrongKind::kRange:
      break;
  }
  return "range";
}

double SunSum::difference() const {
  const double greater = std::max(std::fabs(found), std::fabs(truth));
  return greater > 0 ? std::fabs(found - truth) / greater : 0;
}

TableJudge::TableJudge(const EngineTable& table, std::vector<std::size_t> share_of_column,
                       std::optional<double> tolerance)
    : table_(&table),
      share_of_column_(std::move(share_of_column)),
      tolerance_(tolerance),
      wrong_of_columns_(share_of_column_.size()),
      sums_(share_of_column_.size()) {}

bool TableJudge::are_doubles() const { return table_->values.digits().are_doubles(); }

double TableJudge::allowed(const WrittenNumber& number) const {
  if (tolerance_) return *tolerance_ + kTruth;
  return table_->values.digits().rounding_of(number) + (are_doubles() ? kRoundingOfDoubles : 0) +
         kTruth;
}

void TableJudge::add(std::size_t row, std::span<const double> truth, bool is_day) {
  const double hours = std::chrono::duration<double, std::ratio<3600>>(table_->step).count();
  for (std::size_t column = 0; column < share_of_column_.size(); ++column) {
    if (share_of_column_[column] == kNoShare) continue;
    WrongValue value;
    value.row = row;
    value.column = column;
    value.found = table_->value(row, column);
    value.truth = truth[share_of_column_[column]];
    value.allowed = allowed(value.found);
    const double found = value.found.value;
    ++values_;
    sums_[column].truth += hours * value.truth;
    if (std::isfinite(found)) sums_[column].found += hours * found;
    value.off = std::fabs(found - value.truth);
    if (value.off <= value.allowed) continue;
    const bool is_share = found >= -value.allowed && found <= 1 + value.allowed;
    value.kind = !is_share ? WrongKind::kRange : !is_day ? WrongKind::kNight : WrongKind::kValue;
    if (!std::isfinite(value.off)) value.off = std::numeric_limits<double>::infinity();
    wrong_.add(value.kind);
    wrong_of_columns_[column].add(value.kind);
    keep(value);
  }
  ++rows_;
}

void TableJudge::keep(const WrongValue& wrong) {
  // Rows come in order, so that of values that are off alike the first stay.
  const auto place =
      std::ranges::upper_bound(worst_, wrong.off, std::greater<>(), &WrongValue::off);
  if (place == worst_.end() && worst_.size() == kWorst) return;
  worst_.insert(place, wrong);
  if (worst_.size() > kWorst) worst_.pop_back();
}

}  // namespace gnomon::comparison
