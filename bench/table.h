// SPDX-License-Identifier: GPL-3.0-or-later
// Tables in plain text: columns as wide as their widest cell, the first to the left, the others to
// the right.
#ifndef GNOMON_BENCH_TABLE_H
#define GNOMON_BENCH_TABLE_H

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::bench {

class Table {
 public:
  explicit Table(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void print() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t value);
/// Three significant digits, no exponent: "0.0123", "4.56", "789", "12,345".
std::string short_number(double value);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_TABLE_H
