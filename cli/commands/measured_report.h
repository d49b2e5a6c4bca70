// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a command that measures: tradeoff, extremes, compare (report_output.h).
#ifndef GNOMON_CLI_COMMANDS_MEASURED_REPORT_H
#define GNOMON_CLI_COMMANDS_MEASURED_REPORT_H

#include <functional>
#include <string>
#include <vector>

#include "cli/common/report_output.h"
#include "comparison/comparison.h"
#include "gnomon/kernel/error.h"
#include "report/text/text_sink.h"

namespace gnomon::cli {

/// What was measured, and its writers.
struct MeasuredRows {
  std::string command;   // "tradeoff"
  std::string document;  // "tradeoff": the page knows it by that
  std::string title;     // empty: the scenes
  std::vector<const comparison::Row*> rows;
  std::vector<std::string> contradictions;
  bool interrupted = false;
  std::function<std::string()> text, csv;
  std::function<void(report::TextSink&)> json;
  std::function<void(report::TextSink&)> plot;  // may be empty
};

/// table.txt, rows.json, rows.csv, plot.svg and the page. A rounded kernel that fails is what is
/// measured: as a case of JUnit it is skipped. Errors: those of write_report().
Expected<void> write_measured_report(const ReportOptions& options, const MeasuredRows& measured);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_MEASURED_REPORT_H
