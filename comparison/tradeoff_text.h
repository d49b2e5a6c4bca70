// SPDX-License-Identifier: GPL-3.0-or-later
// Speed against accuracy as a table, JSON, CSV and a plot.
#ifndef GNOMON_COMPARISON_TRADEOFF_TEXT_H
#define GNOMON_COMPARISON_TRADEOFF_TEXT_H

#include <string>

#include "comparison/tradeoff.h"
#include "report/text/text_sink.h"

namespace gnomon::comparison {

/// All rows; those on the front are marked.
std::string tradeoff_text(const Tradeoff& tradeoff, bool commands);
/// Which thicknesses are right, and the best single one.
std::string thickness_text(const Tradeoff& tradeoff);
/// What changes of the scenes did to the answers.
std::string invariance_text(const Tradeoff& tradeoff);

/// "format": "gnomon-tradeoff"; rows, front, thicknesses.
void write_tradeoff_json(report::TextSink& sink, const Tradeoff& tradeoff);
std::string tradeoff_csv(const Tradeoff& tradeoff);
/// Time to the right and error upwards, both logarithmic, a group of rows of one scene a panel.
void write_tradeoff_plot(report::TextSink& sink, const Tradeoff& tradeoff);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_TRADEOFF_TEXT_H
