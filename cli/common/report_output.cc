// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/report_output.h"

#include <algorithm>
#include <system_error>

#include "cli/common/command_line.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "report/page/page_text.h"

namespace gnomon::cli {

namespace {

constexpr const char* kPageName = "index.html";
constexpr const char* kJUnitName = "junit.xml";

Expected<void> make_directory(const std::filesystem::path& directory) {
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  if (!failed) return {};
  ErrorPlace where;
  where.file = directory.string();
  return fail(ErrorCode::kFile, "cannot make the directory: " + failed.message(), {}, where);
}

Expected<void> write_file(const std::filesystem::path& path,
                          const std::function<void(report::TextSink&)>& write) {
  auto output = Output::open(path);
  if (!output) return tl::unexpected(output.error());
  write(*output);
  return output->finish();
}

Expected<void> write_page_file(const std::filesystem::path& directory, const Report& report) {
  if (report::page_text().empty()) {
    say(std::string(kPageName) + " is left out of " + directory.string() +
        ": this program was built without npm, which bundles the page; the tables and pictures are "
        "there");
    return {};
  }
  report::PageHead head;
  head.command = report.command;
  head.command_line = command_line();
  head.program = program_version();
  head.scene = report.scene;
  for (const ReportFile& file : report.files) head.files.push_back(file.name);
  head.files.emplace_back(kJUnitName);
  head.notes = report.notes;
  return write_file(directory / kPageName, [&](report::TextSink& sink) {
    report::write_page(sink, head, report.documents);
  });
}

}  // namespace

void add_report_options(CLI::App& command, ReportOptions& options) {
  command
      .add_option("--report", options.directory,
                  "Write index.html, a page to look at, with tables and pictures beside it")
      ->type_name("DIR");
  command.add_option("--junit", options.junit, "Write the verdicts as JUnit XML, for CI")
      ->type_name("FILE");
}

Expected<void> write_report(const ReportOptions& options, const Report& report) {
  const auto write_junit = [&](report::TextSink& sink) {
    report::write_junit(sink, "gnomon " + report.command, report.cases);
  };
  if (!options.junit.empty()) {
    if (auto done = write_file(options.junit, write_junit); !done) return done;
  }
  if (options.directory.empty()) return {};
  const std::filesystem::path directory = options.directory;
  if (auto done = make_directory(directory); !done) return done;
  for (const ReportFile& file : report.files) {
    if (auto done = write_file(directory / file.name, file.write); !done) return done;
  }
  if (auto done = write_file(directory / kJUnitName, write_junit); !done) return done;
  return write_page_file(directory, report);
}

std::string file_name_part(std::string name) {
  std::ranges::replace_if(
      name,
      [](char c) {
        return (c < '0' || c > '9') && (c < 'a' || c > 'z') && (c < 'A' || c > 'Z') && c != '+' &&
               c != '-' && c != '.' && c != '_';
      },
      '_');
  return name;
}

}  // namespace gnomon::cli
