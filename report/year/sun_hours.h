// SPDX-License-Identifier: GPL-3.0-or-later
// Hours of sun by side and month: lit shares, each for the length of its step.
#ifndef GNOMON_REPORT_YEAR_SUN_HOURS_H
#define GNOMON_REPORT_YEAR_SUN_HOURS_H

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "suns/year/year_of_suns.h"

namespace gnomon::report {

class SunHours {
 public:
  explicit SunHours(std::vector<std::string> sides, suns::Minutes step)
      : sides_(std::move(sides)), step_(step), hours_(sides_.size()) {}

  void add(const suns::SunTime& sun, std::span<const double> lit);
  /// CSV: a row a side, with the hours of all and of each month; the last row, "daylight", has the
  /// hours in which the sun is up.
  std::string text() const;
  /// Of each month, of one side.
  std::vector<double> hours_of(std::size_t side) const { return in_hours(hours_[side]); }
  /// The hours of each month in which the sun is up.
  std::vector<double> daylight() const { return in_hours(daylight_); }

 private:
  using Months = std::array<double, 12>;  // in steps
  double hours_of_step() const { return static_cast<double>(step_.count()) / 60; }
  std::vector<double> in_hours(const Months& months) const;

  std::vector<std::string> sides_;
  suns::Minutes step_;
  std::vector<Months> hours_;  // by side
  Months daylight_{};
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_YEAR_SUN_HOURS_H
