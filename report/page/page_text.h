// SPDX-License-Identifier: GPL-3.0-or-later
// The page without its data: what the bundler made of the folder web/, in pieces that a compiler
// takes.
#ifndef GNOMON_REPORT_PAGE_PAGE_TEXT_H
#define GNOMON_REPORT_PAGE_PAGE_TEXT_H

#include <span>
#include <string_view>

namespace gnomon::report {

struct PageText {
  std::span<const std::string_view> before, after;  // the data

  /// The program was built without npm.
  bool empty() const { return before.empty(); }
};

PageText page_text();

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PAGE_PAGE_TEXT_H
