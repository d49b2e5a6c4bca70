// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/text/table.h"

#include <algorithm>
#include <cassert>

namespace gnomon::report {

namespace {

constexpr std::size_t kGap = 2;
constexpr std::size_t kShortest = 6;  // columns are not shortened below this
constexpr std::string_view kEllipsis = "...";

/// Bytes of the first `width` characters.
std::size_t bytes_of_width(std::string_view text, std::size_t width) {
  std::size_t at = 0;
  while (at < text.size() && width > 0) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80) ++at;
    --width;
  }
  return at;
}

std::string shortened(const std::string& text, std::size_t width) {
  if (text_width(text) <= width) return text;
  if (width <= kEllipsis.size()) return text.substr(0, bytes_of_width(text, width));
  return text.substr(0, bytes_of_width(text, width - kEllipsis.size())) + std::string(kEllipsis);
}

}  // namespace

std::size_t text_width(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent,
                    std::size_t hanging) {
  std::string result;
  std::string line(indent, ' ');
  bool line_is_empty = true;
  const auto end_line = [&] {
    result += line + '\n';
    line.assign(hanging, ' ');
    line_is_empty = true;
  };
  while (!text.empty()) {
    const std::size_t space = std::min(text.find(' '), text.size());
    std::string_view word = text.substr(0, space);
    text.remove_prefix(std::min(space + 1, text.size()));
    if (word.empty()) continue;
    if (!line_is_empty && text_width(line) + 1 + text_width(word) > width) end_line();
    if (!line_is_empty) line += ' ';
    while (text_width(line) + text_width(word) > width && text_width(line) < width) {
      const std::size_t head = bytes_of_width(word, width - text_width(line));
      line += word.substr(0, head);
      word.remove_prefix(head);
      end_line();
    }
    line += word;
    line_is_empty = false;
  }
  if (!line_is_empty) result += line + '\n';
  return result;
}

void TextTable::add_row(std::vector<std::string> cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back({std::move(cells), {}});
}

void TextTable::add_note(std::string text) { rows_.back().notes.push_back(std::move(text)); }

std::string TextTable::to_string(std::size_t width) const {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    std::size_t widest = text_width(columns_[i].title);
    for (const Row& row : rows_) widest = std::max(widest, text_width(row.cells[i]));
    widths.push_back(widest);
  }
  std::size_t total = kGap * (widths.size() - 1);
  for (std::size_t column : widths) total += column;
  while (total > width) {
    // Words give way before numbers do.
    std::size_t victim = widths.size();
    for (Align align : {Align::kLeft, Align::kRight}) {
      for (std::size_t i = 0; i < widths.size(); ++i) {
        if (columns_[i].align != align || widths[i] <= kShortest) continue;
        if (victim == widths.size() || widths[i] > widths[victim]) victim = i;
      }
      if (victim != widths.size()) break;
    }
    if (victim == widths.size()) break;
    --widths[victim];
    --total;
  }

  std::string result;
  const auto add_line = [&](const auto& cell_of) {
    std::string line;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (i > 0) line.append(kGap, ' ');
      const std::string cell = shortened(cell_of(i), widths[i]);
      const std::size_t blank = widths[i] - text_width(cell);
      if (columns_[i].align == Align::kRight) line.append(blank, ' ');
      line += cell;
      if (columns_[i].align == Align::kLeft) line.append(blank, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result += line.substr(0, bytes_of_width(line, width)) + '\n';
  };
  add_line([&](std::size_t i) { return columns_[i].title; });
  result += std::string(std::min(total, width), '-') + '\n';
  for (const Row& row : rows_) {
    add_line([&](std::size_t i) { return row.cells[i]; });
    for (const std::string& note : row.notes) result += wrapped(note, width, 4, 6);
  }
  return result;
}

}  // namespace gnomon::report
