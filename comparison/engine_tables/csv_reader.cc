// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/engine_tables/csv_reader.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "scene/base/text_file.h"

namespace gnomon::comparison {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

const char* find(const char* begin, const char* end, char c) {
  const void* found = std::memchr(begin, c, static_cast<std::size_t>(end - begin));
  return found == nullptr ? end : static_cast<const char*>(found);
}

std::string undoubled(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] == '"') ++i;
  }
  return result;
}

}  // namespace

Expected<CsvReader> CsvReader::open(const std::filesystem::path& path) {
  std::unique_ptr<std::string> text;
  std::optional<TextWindow> window = path == "-" ? std::nullopt : TextWindow::of_file(path);
  if (!window) {
    auto bytes = read_file(path);
    if (!bytes) return tl::unexpected(std::move(bytes.error()));
    text = std::make_unique<std::string>(*std::move(bytes));
    window.emplace(*text);
  }
  const std::string_view start(window->begin(),
                               static_cast<std::size_t>(window->end() - window->begin()));
  const bool is_blank_text = start.find_first_not_of(" \t\r\n") == std::string_view::npos;
  if (auto checked = check_is_text(start, shown_name(path)); !checked && !is_blank_text) {
    return tl::unexpected(std::move(checked.error()));
  }
  return CsvReader(path, std::move(text), *std::move(window));
}

CsvReader::CsvReader(std::filesystem::path path, std::unique_ptr<std::string> text,
                     TextWindow window)
    : path_(std::move(path)), text_(std::move(text)), window_(std::move(window)) {
  start();
}

void CsvReader::start() {
  line_ = next_line_ = 1;
  size_ = window_.bytes_left();
  const std::string_view start(window_.begin(),
                               static_cast<std::size_t>(window_.end() - window_.begin()));
  next_ = record_ = record_end_ = window_.begin() + byte_order_mark(start);
}

Expected<void> CsvReader::rewind() {
  std::optional<TextWindow> window =
      text_ ? std::optional<TextWindow>(std::in_place, *text_) : TextWindow::of_file(path_);
  if (!window) return fail(ErrorCode::kFile, shown_name(path_) + ": cannot be read again");
  window_ = *std::move(window);
  start();
  return {};
}

bool CsvReader::is_comment() const {
  const char* const begin = std::find_if_not(record_, window_.end(), is_blank);
  return skips_comments_ && begin != window_.end() && *begin == '#';
}

double CsvReader::done() const {
  const auto left =
      window_.bytes_left() -
      std::min(window_.bytes_left(), static_cast<std::size_t>(next_ - window_.begin()));
  return 1 - static_cast<double>(left) / static_cast<double>(std::max<std::size_t>(1, size_));
}

/// Finds the end of the record at next_: a line break outside of quotes. False at the end of all.
bool CsvReader::find_record() {
  record_ = next_;
  line_ = next_line_;
  const char* at = record_;
  bool quoted = false;
  for (;;) {
    const char* line_break = find(at, window_.end(), '\n');
    // A comment ends with its line, whatever quotes it has.
    for (const char* quote = is_comment() ? line_break : find(at, line_break, '"');
         quote != line_break; quote = find(quote + 1, line_break, '"')) {
      quoted = !quoted;
    }
    at = line_break;
    if (at == window_.end()) {
      const auto looked_at = static_cast<std::size_t>(at - record_);
      const bool more = window_.move_on(record_);
      if (text_ == nullptr) record_ = window_.begin();
      at = record_ + looked_at;
      if (more) continue;
      break;
    }
    ++next_line_;
    if (!quoted) break;
    ++at;
  }
  record_end_ = at;
  next_ = at == window_.end() ? at : at + 1;
  if (record_end_ > record_ && record_end_[-1] == '\r') --record_end_;
  return record_ != window_.end();
}

Expected<bool> CsvReader::next() {
  do {
    if (!find_record()) {
      if (window_.is_whole()) return false;
      ErrorPlace where;
      where.file = shown_name(path_);
      return fail(ErrorCode::kFile, "cannot be read to its end", {}, where);
    }
  } while (std::all_of(record_, record_end_, is_blank) || is_comment());
  if (auto done = split(); !done) return tl::unexpected(std::move(done.error()));
  return true;
}

Expected<void> CsvReader::split() {
  fields_.clear();
  unescaped_.clear();
  const auto text_of = [](const char* begin, const char* end) {
    return std::string_view(begin, static_cast<std::size_t>(end - begin));
  };
  const auto wrong = [&](const char* at, std::string what, std::string expected) {
    return fail(ErrorCode::kSyntax, std::move(what), std::move(expected),
                place_at(static_cast<std::size_t>(at - record_)));
  };
  for (const char* at = record_;; ++at) {
    while (at != record_end_ && is_blank(*at)) ++at;
    CsvField field;
    field.offset = static_cast<std::size_t>(at - record_);
    if (at != record_end_ && *at == '"') {
      const char* const begin = at + 1;
      bool doubled = false;
      const char* end = find(begin, record_end_, '"');
      while (end != record_end_ && end + 1 != record_end_ && end[1] == '"') {
        doubled = true;
        end = find(end + 2, record_end_, '"');
      }
      if (end == record_end_) return wrong(at, "a quote that is not closed", "a closing quote");
      field.text = text_of(begin, end);
      if (doubled) field.text = unescaped_.emplace_back(undoubled(field.text));
      at = end + 1;
      while (at != record_end_ && is_blank(*at)) ++at;
      if (at != record_end_ && *at != ',') {
        return wrong(at, "text after a closing quote", "a comma or the end of the line");
      }
    } else {
      const char* const begin = at;
      at = find(begin, record_end_, ',');
      if (const char* quote = find(begin, at, '"'); quote != at) {
        return wrong(quote, "a quote within a field",
                     "the whole field in quotes, and quotes in it doubled");
      }
      const char* end = at;
      while (end != begin && is_blank(end[-1])) --end;
      field.text = text_of(begin, end);
    }
    fields_.push_back(field);
    if (at == record_end_) return {};
  }
}

ErrorPlace CsvReader::place_at(std::size_t offset) const {
  const std::string_view record(record_, static_cast<std::size_t>(record_end_ - record_));
  ErrorPlace place = place_in_text(shown_name(path_), record, offset);
  place.line += line_ - 1;
  return place;
}

ErrorPlace CsvReader::place_of(std::size_t field) const {
  return place_at(field < fields_.size() ? fields_[field].offset
                                         : static_cast<std::size_t>(record_end_ - record_));
}

}  // namespace gnomon::comparison
