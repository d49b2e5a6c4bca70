// SPDX-License-Identifier: GPL-3.0-or-later
// The counts of a method's work as text.
#ifndef GNOMON_REPORT_TEXT_COUNT_TEXT_H
#define GNOMON_REPORT_TEXT_COUNT_TEXT_H

#include <cstdint>
#include <span>
#include <string>

#include "gnomon/algorithms/work_counts.h"

namespace gnomon::report {

/// A count as "1,234"; a share as a decimal, such as 0.0625.
std::string count_text(const CounterInfo& counter, std::uint64_t count);
/// "volumes 61, tests 1,830, mean p 0.0625"; empty if all of the work is zero, which is what runs
/// that do not count leave.
std::string work_text(std::span<const Counter> counters, const WorkCounts& work);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_COUNT_TEXT_H
