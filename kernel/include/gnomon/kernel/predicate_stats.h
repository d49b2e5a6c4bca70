// SPDX-License-Identifier: LGPL-3.0-or-later
// Which stage answered each decision of the kernel `plane`: identity, floating-point filter, or
// exact integers. Off by default (NoStats is empty and its calls vanish); a template parameter of
// the kernel.
#ifndef GNOMON_KERNEL_PREDICATE_STATS_H
#define GNOMON_KERNEL_PREDICATE_STATS_H

#include <cstdint>

namespace gnomon {

enum class Stage : std::uint8_t { kIdentity, kFilter, kExact128, kExact512, kExactUnbounded };

struct StageCounts {
  std::uint64_t identity = 0, filter = 0, exact128 = 0, exact512 = 0, unbounded = 0;
  std::uint64_t exactly_zero = 0;  // of the exact ones
  std::uint64_t exact() const { return exact128 + exact512 + unbounded; }
  std::uint64_t total() const { return identity + filter + exact(); }
  StageCounts& operator+=(const StageCounts& other) {
    identity += other.identity;
    filter += other.filter;
    exact128 += other.exact128;
    exact512 += other.exact512;
    unbounded += other.unbounded;
    exactly_zero += other.exactly_zero;
    return *this;
  }
};

struct NoStats {
  void count(Stage) {}
  void count_zero() {}
  StageCounts counts() const { return {}; }
};

class CountStats {
 public:
  void count(Stage stage) {
    switch (stage) {
      case Stage::kIdentity:
        ++counts_.identity;
        break;
      case Stage::kFilter:
        ++counts_.filter;
        break;
      case Stage::kExact128:
        ++counts_.exact128;
        break;
      case Stage::kExact512:
        ++counts_.exact512;
        break;
      case Stage::kExactUnbounded:
        ++counts_.unbounded;
        break;
    }
  }
  void count_zero() { ++counts_.exactly_zero; }
  StageCounts counts() const { return counts_; }

 private:
  StageCounts counts_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_PREDICATE_STATS_H
