// SPDX-License-Identifier: GPL-3.0-or-later
// Text tables of a fixed width: columns as wide as their content, shortened where the whole would
// exceed the width, and notes below a row that are wrapped at words.
#ifndef GNOMON_REPORT_TEXT_TABLE_H
#define GNOMON_REPORT_TEXT_TABLE_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::report {

enum class Align : std::uint8_t { kLeft, kRight };

struct Column {
  std::string title;
  Align align = Align::kLeft;
};

/// Columns that a text takes on a terminal, a UTF-8 character counting as one.
std::size_t text_width(std::string_view text);

/// Lines of at most `width` columns, broken at spaces (within a word only if it is longer than a
/// line); the first begins with `indent` spaces, the others with `hanging`.
std::string wrapped(std::string_view text, std::size_t width, std::size_t indent,
                    std::size_t hanging);

class TextTable {
 public:
  static constexpr std::size_t kWidth = 100;

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Requires: as many cells as columns.
  void add_row(std::vector<std::string> cells);
  /// A note below the row that was added last, wrapped and indented.
  void add_note(std::string text);

  /// No line is longer than `width`; the widest columns of text are shortened ("...") until they
  /// fit.
  std::string to_string(std::size_t width = kWidth) const;

 private:
  struct Row {
    std::vector<std::string> cells;
    std::vector<std::string> notes;
  };
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_TABLE_H
