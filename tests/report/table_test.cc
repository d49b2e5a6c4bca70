// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/text/table.h"

#include <gtest/gtest.h>

#include <sstream>

#include "report/text/number_text.h"

namespace gnomon::report {
namespace {

void expect_width(const std::string& text, std::size_t width) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) EXPECT_LE(text_width(line), width) << line;
}

TEST(TextTable, AlignsColumns) {
  TextTable table({{"name"}, {"count", Align::kRight}});
  table.add_row({"a", "1"});
  table.add_row({"longer", "1,000"});
  EXPECT_EQ(table.to_string(), "name    count\n-------------\na           1\nlonger  1,000\n");
}

TEST(TextTable, CountsCharactersNotBytes) {
  EXPECT_EQ(text_width("Dämmerung"), 9u);
  TextTable table({{"licht"}, {"n", Align::kRight}});
  table.add_row({"Dämmerung", "1"});
  table.add_row({"Daemmerng", "1"});
  std::istringstream stream(table.to_string());
  std::string line;
  std::getline(stream, line);
  for (std::size_t width = text_width(line); std::getline(stream, line);) {
    EXPECT_EQ(text_width(line), width);
  }
}

TEST(TextTable, NeverExceedsTheWidth) {
  TextTable table({{"kernel"}, {"verdict"}, {"area", Align::kRight}});
  table.add_row({std::string(90, 'k'), std::string(80, 'v'), "1234567890"});
  table.add_note(std::string(50, 'x') + " " + std::string(250, 'y') + " and some words after it");
  const std::string text = table.to_string(100);
  expect_width(text, 100);
  EXPECT_NE(text.find("..."), std::string::npos);
  EXPECT_NE(text.find("1234567890"), std::string::npos) << "numbers give way last";
  expect_width(table.to_string(40), 40);
}

TEST(Wrapped, BreaksAtSpacesAndIndents) {
  EXPECT_EQ(wrapped("one two three", 9, 0, 2), "one two\n  three\n");
  EXPECT_EQ(wrapped("", 10, 0, 0), "");
  EXPECT_EQ(wrapped("abcdefgh", 4, 0, 1), "abcd\n efg\n h\n");
}

TEST(NumberText, ReadsBackAndGroups) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(std::stod(shortest(1.0 / 3)), 1.0 / 3);
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(rounded(1.23456789e-17, 3), "1.23e-17");
}

}  // namespace
}  // namespace gnomon::report
