// SPDX-License-Identifier: LGPL-3.0-or-later
// Which stage answered each decision of the kernel `plane`: identity, floating-point filter, or
// exact integers. Off by default (NoStats is empty and its calls vanish); a template parameter of
// the kernel.
#ifndef GNOMON_KERNEL_STAGE_COUNTS_H
#define GNOMON_KERNEL_STAGE_COUNTS_H

#include <array>
#include <cstdint>

#include "gnomon/kernel/precision_plan.h"

namespace gnomon {

enum class Stage : std::uint8_t {
  kIdentity,
  kFilter,
  kExact64,
  kExact128,
  kExact256,
  kExact512,
  kExact1024,
  kExactUnbounded
};

constexpr Stage exact_stage(IntegerWidth width) {
  return static_cast<Stage>(static_cast<unsigned>(Stage::kExact64) + static_cast<unsigned>(width));
}
static_assert(exact_stage(IntegerWidth::k64) == Stage::kExact64 &&
              exact_stage(IntegerWidth::kUnbounded) == Stage::kExactUnbounded);

/// Decisions by the stage that answered.
struct StageCounts {
  std::uint64_t identity = 0, filter = 0;
  std::uint64_t exact64 = 0, exact128 = 0, exact256 = 0, exact512 = 0, exact1024 = 0;
  std::uint64_t unbounded = 0;     // GMP
  std::uint64_t exactly_zero = 0;  // of the exact ones

  /// By width, from the narrowest.
  std::array<std::uint64_t, 6> by_width() const {
    return {exact64, exact128, exact256, exact512, exact1024, unbounded};
  }
  std::uint64_t exact() const {
    return exact64 + exact128 + exact256 + exact512 + exact1024 + unbounded;
  }
  std::uint64_t total() const { return identity + filter + exact(); }
  StageCounts& operator+=(const StageCounts& other) {
    identity += other.identity;
    filter += other.filter;
    exact64 += other.exact64;
    exact128 += other.exact128;
    exact256 += other.exact256;
    exact512 += other.exact512;
    exact1024 += other.exact1024;
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
      case Stage::kExact64:
        ++counts_.exact64;
        break;
      case Stage::kExact128:
        ++counts_.exact128;
        break;
      case Stage::kExact256:
        ++counts_.exact256;
        break;
      case Stage::kExact512:
        ++counts_.exact512;
        break;
      case Stage::kExact1024:
        ++counts_.exact1024;
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

#endif  // GNOMON_KERNEL_STAGE_COUNTS_H
