// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/text/count_text.h"

#include "report/text/number_text.h"

namespace gnomon::report {

std::string count_text(const CounterInfo& counter, std::uint64_t count) {
  if (counter.denominator == 1) return grouped(count);
  return shortest(static_cast<double>(count) / static_cast<double>(counter.denominator));
}

std::string work_text(std::span<const Counter> counters, const WorkCounts& work) {
  std::string text;
  if (work == WorkCounts{}) return text;
  for (const Counter counter : counters) {
    const CounterInfo& info = counter_info(counter);
    text +=
        (text.empty() ? "" : ", ") + std::string(info.name) + ' ' + count_text(info, work[counter]);
  }
  return text;
}

}  // namespace gnomon::report
