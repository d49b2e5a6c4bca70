// SPDX-License-Identifier: GPL-3.0-or-later
// The map of where kernels fail, as a table, JSON, CSV and a plot.
#ifndef GNOMON_COMPARISON_EXTREMES_TEXT_H
#define GNOMON_COMPARISON_EXTREMES_TEXT_H

#include <string>

#include "comparison/extremes.h"
#include "report/text/text_sink.h"

namespace gnomon::comparison {

/// A table an axis; `curves`: with the worst share of every step.
std::string extremes_text(const Extremes& extremes, bool curves);
/// The axes and their steps.
std::string extreme_axes_text();
/// "format": "gnomon-extremes".
void write_extremes_json(report::TextSink& sink, const Extremes& extremes);
std::string extremes_csv(const Extremes& extremes);
/// Steps to the right and wrong shares upwards, a line a kernel; a row of panels an axis, a panel a
/// method. Thick dots are failures.
void write_extremes_plot(report::TextSink& sink, const Extremes& extremes);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_EXTREMES_TEXT_H
