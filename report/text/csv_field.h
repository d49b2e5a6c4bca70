// SPDX-License-Identifier: GPL-3.0-or-later
// Fields and lines of CSV files as RFC 4180 has them, with line feeds alone.
#ifndef GNOMON_REPORT_TEXT_CSV_FIELD_H
#define GNOMON_REPORT_TEXT_CSV_FIELD_H

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::report {

/// In quotes where it holds a comma, a quote or a line break.
inline void append_csv_field(std::string& text, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    text += field;
    return;
  }
  text += '"';
  for (const char c : field) {
    if (c == '"') text += '"';
    text += c;
  }
  text += '"';
}

inline void append_csv_line(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) text += ',';
    append_csv_field(text, cells[i]);
  }
  text += '\n';
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_CSV_FIELD_H
