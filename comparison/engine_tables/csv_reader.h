// SPDX-License-Identifier: GPL-3.0-or-later
// CSV files record by record, as RFC 4180 has them, through a window, so that a table of any length
// takes no memory of its own. Beyond the standard: a byte order mark, blanks around fields, blank
// lines.
#ifndef GNOMON_COMPARISON_ENGINE_TABLES_CSV_READER_H
#define GNOMON_COMPARISON_ENGINE_TABLES_CSV_READER_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "scene/base/text_window.h"

namespace gnomon::comparison {

struct CsvField {
  std::string_view text;   // without its quotes, or without the blanks around it
  std::size_t offset = 0;  // in the record
};

class CsvReader {
 public:
  /// Errors: kFile; kSyntax (no text).
  static Expected<CsvReader> open(const std::filesystem::path& file);
  /// From here on lines that begin with '#' are passed over like blank ones.
  void skip_comments() { skips_comments_ = true; }
  /// Back to the first record. What is no regular file was kept. Errors: kFile.
  Expected<void> rewind();

  /// Goes on to the next record that is not blank; false at the end. Fields before end. Errors:
  /// kSyntax (wrong quotes), kFile.
  Expected<bool> next();
  const std::vector<CsvField>& fields() const { return fields_; }
  /// Of the first byte of a field, or of where the record ends for one that is not there.
  ErrorPlace place_of(std::size_t field) const;
  /// An error at that place.
  tl::unexpected<Error> wrong(ErrorCode code, std::size_t field, std::string what,
                              std::string expected) const {
    return fail(code, std::move(what), std::move(expected), place_of(field));
  }
  /// The line that the record begins in, from 1.
  std::uint64_t line() const { return line_; }
  /// The share of the file that was read, for progress.
  double done() const;

 private:
  CsvReader(std::filesystem::path path, std::unique_ptr<std::string> text, TextWindow window);
  void start();
  bool find_record();
  bool is_comment() const;
  Expected<void> split();
  ErrorPlace place_at(std::size_t offset) const;

  std::filesystem::path path_;
  bool skips_comments_ = false;
  std::unique_ptr<std::string> text_;  // of what is no regular file
  TextWindow window_;
  std::size_t size_ = 0;
  const char *record_ = nullptr, *record_end_ = nullptr;  // without its line break
  const char* next_ = nullptr;                            // where the next record begins
  std::uint64_t line_ = 1, next_line_ = 1;
  std::vector<CsvField> fields_;
  std::deque<std::string> unescaped_;  // texts of fields with doubled quotes
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ENGINE_TABLES_CSV_READER_H
