// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/messages.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <utility>

namespace gnomon::cli {

namespace {

void print_line(std::string line) {
  // One message is one line, whatever a file's name or content holds.
  std::ranges::replace_if(
      line, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace

ExitStatus report_error(const Error& error) {
  print_line("gnomon: " + to_string(error));
  return status_of(error.code);
}

ExitStatus report_usage(std::string what, std::string expected, std::string file) {
  Error error;
  error.where.file = std::move(file);
  error.what = std::move(what);
  error.expected = std::move(expected);
  return report_error(error);
}

void say(std::string_view text) { print_line("gnomon: " + std::string(text)); }

void warn(std::string_view text) {
  static std::set<std::string, std::less<>> said;
  if (said.emplace(text).second) print_line("gnomon: warning: " + std::string(text));
}

}  // namespace gnomon::cli
