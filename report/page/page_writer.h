// SPDX-License-Identifier: GPL-3.0-or-later
// One self-contained HTML file: the page (page_text.h) with JSON documents in it, each as the
// command writes it into a file, too. What a document holds is shown and never run: in the page a
// `<` of it is written as JSON's \u003c, which is the same text to whoever parses it.
#ifndef GNOMON_REPORT_PAGE_PAGE_WRITER_H
#define GNOMON_REPORT_PAGE_PAGE_WRITER_H

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/text/text_sink.h"

namespace gnomon::report {

struct PageDocument {
  std::string name;  // "certificate": the page finds it by that
  std::function<void(TextSink&)> write;
};

/// What a page says of itself: at its head and foot.
struct PageHead {
  std::string command;             // "certify"
  std::string command_line;        // that makes it again
  std::string program;             // "gnomon 0.1.0"
  std::string scene;               // name, or what stands for it; may be empty
  std::vector<std::string> files;  // beside it
  std::vector<std::string> notes;  // what was left out, a sentence each
};

/// "format": "gnomon-page".
void write_page_head(TextSink& sink, const PageHead& head);

/// Requires: !page_text().empty().
void write_page(TextSink& sink, const PageHead& head, std::span<const PageDocument> documents);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PAGE_PAGE_WRITER_H
