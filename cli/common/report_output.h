// SPDX-License-Identifier: GPL-3.0-or-later
// --report DIR and --junit FILE, wherever a verdict is given: the page, the files beside it, and
// what CI systems read.
#ifndef GNOMON_CLI_COMMON_REPORT_OUTPUT_H
#define GNOMON_CLI_COMMON_REPORT_OUTPUT_H

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "report/junit/junit.h"
#include "report/page/page_writer.h"
#include "report/text/text_sink.h"

namespace gnomon::cli {

struct ReportOptions {
  std::string directory, junit;  // empty: not asked for

  bool asked() const { return !directory.empty() || !junit.empty(); }
};

void add_report_options(CLI::App& command, ReportOptions& options);

/// A file of the directory.
struct ReportFile {
  std::string name;
  std::function<void(report::TextSink&)> write;
};

/// What a command has to show.
struct Report {
  std::string command;  // "certify"
  std::string scene;    // its name, or what stands for it
  std::vector<ReportFile> files;
  std::vector<report::PageDocument> documents;  // of the page, which is none without them
  std::vector<report::JUnitCase> cases;
  std::vector<std::string> notes;  // what was left out of the page
};

/// The report directory with its files, junit.xml and index.html, and the file of --junit: what was
/// asked for. A program without a page says so on standard error. Errors: kFile, kInterrupted.
Expected<void> write_report(const ReportOptions& options, const Report& report);

/// A characteristic file name of what has any name.
std::string file_name_part(std::string name);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_REPORT_OUTPUT_H
