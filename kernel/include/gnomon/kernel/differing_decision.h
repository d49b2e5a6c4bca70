// SPDX-License-Identifier: LGPL-3.0-or-later
// What a run of two kernels in lock-step reports: the first decision on which they differ.
#ifndef GNOMON_KERNEL_DIFFERING_DECISION_H
#define GNOMON_KERNEL_DIFFERING_DECISION_H

#include <array>
#include <cstdint>
#include <string>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/sign.h"

namespace gnomon {

/// The first decision on which the two kernels differ.
struct DifferingDecision {
  std::string plane;                        // in words
  std::string vertex;                       // in words
  std::array<double, 3> position{};         // nearest doubles of the exact vertex, scene units
  std::array<double, 3> tested_position{};  // as the kernel under test has it
  PlaneId support = 0;                      // of the fragment
  Side tested = Side::kOn;
  Side exact = Side::kOn;
  std::uint64_t decisions = 0;  // asked before this one
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_DIFFERING_DECISION_H
