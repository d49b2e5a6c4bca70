// SPDX-License-Identifier: GPL-3.0-or-later
// A checksum of rows that does not depend on their order, so that what shards and other machines
// computed can be compared and added up: the sum, modulo 2^64, of a hash of each row's time, sun
// and shares.
#ifndef GNOMON_REPORT_YEAR_ROW_SUM_H
#define GNOMON_REPORT_YEAR_ROW_SUM_H

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "suns/year/year_of_suns.h"

namespace gnomon::report {

class RowSum {
 public:
  void add(const suns::SunTime& sun, std::span<const double> lit) {
    std::uint64_t hash = kStart;
    take(hash, static_cast<std::uint64_t>(sun.at.time_since_epoch().count()));
    for (const std::int32_t component : sun.direction) {
      take(hash, static_cast<std::uint64_t>(std::int64_t{component}));
    }
    for (const double share : lit) take(hash, std::bit_cast<std::uint64_t>(share));
    sum_ += hash;
  }
  std::string text() const { return fmt::format("{:016x}", sum_); }

 private:
  // FNV-1a with words instead of bytes, and a shift that brings high bits down.
  static constexpr std::uint64_t kStart = 0xcbf29ce484222325, kPrime = 0x100000001b3;
  static void take(std::uint64_t& hash, std::uint64_t word) {
    hash = (hash ^ word) * kPrime;
    hash ^= hash >> 32;
  }
  std::uint64_t sum_ = 0;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_YEAR_ROW_SUM_H
