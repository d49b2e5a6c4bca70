// SPDX-License-Identifier: GPL-3.0-or-later
// A comparison as a table, as JSON and as CSV.
#ifndef GNOMON_COMPARISON_COMPARISON_TEXT_H
#define GNOMON_COMPARISON_COMPARISON_TEXT_H

#include <string>

#include "comparison/comparison.h"
#include "report/text/text_sink.h"

namespace gnomon::comparison {

struct TableOptions {
  bool commands = false;  // below each row the command that repeats it
  bool counters = false;  // below each row all that its system counts
};

/// For people: a table with a row a run. What a run is judged to break, or why it did not end,
/// stands below its row.
std::string comparison_text(const Comparison& comparison, const TableOptions& options = {});

/// For programs, in the order of the rows. Times, ratios, memory and growth only if asked for: the
/// rest is the same for the same plan, unless a limit cut a run short.
void write_comparison_json(report::TextSink& sink, const Comparison& comparison, bool times);
/// The same rows, a line each.
std::string comparison_csv(const Comparison& comparison, bool times);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_COMPARISON_TEXT_H
