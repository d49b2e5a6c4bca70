// SPDX-License-Identifier: GPL-3.0-or-later
#include "verdicts.h"

#include <fmt/format.h>

#include <cmath>

#include "table.h"

namespace gnomon::bench {
namespace {

std::string with_unit(double value, Unit unit) {
  if (std::isnan(value)) return "-";
  switch (unit) {
    case Unit::kRatio:
      return short_number(value) + "x";
    case Unit::kSeconds:
      return short_number(value) + " s";
    case Unit::kExponent:
      return fmt::format("n^{:.2f}", value);
    case Unit::kGigabytes:
      return short_number(value) + " GB";
  }
  return {};
}

/// Differences count for exponents, factors for everything else.
std::string verdict(double value, const Target& target) {
  if (std::isnan(value)) return "not measured";
  if (target.at_least ? value >= target.limit : value <= target.limit) return "met";
  if (target.unit == Unit::kExponent) return fmt::format("missed by {:.2f}", value - target.limit);
  return fmt::format("missed by {:.2f}x",
                     target.at_least ? target.limit / value : value / target.limit);
}

}  // namespace

void Verdicts::add(const std::string& work, const std::string& scene, const Target& target,
                   const std::vector<double>& measured) {
  std::vector<std::string> row = {work, scene, target.text};
  for (const double value : measured) row.push_back(with_unit(value, target.unit));
  row.push_back(verdict(measured[judged_], target));
  rows_.push_back(std::move(row));
}

void Verdicts::print() const {
  std::vector<std::string> header = {"work", "scene", "target"};
  header.insert(header.end(), algorithms_.begin(), algorithms_.end());
  header.push_back("verdict");
  Table table(std::move(header));
  for (const std::vector<std::string>& row : rows_) table.add(row);
  fmt::print("\nTargets (verdict: algorithm {})\n", algorithms_[judged_]);
  table.print();
}

}  // namespace gnomon::bench
