// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/junit/junit.h"

#include <algorithm>
#include <string_view>

#include "scene/base/text_file.h"

namespace gnomon::report {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// XML 1.0 has no control characters but these, and neither U+FFFE nor U+FFFF.
bool is_xml(std::string_view character) {
  const char first = character.front();
  if (character.size() == 1) {
    return static_cast<unsigned char>(first) >= 0x20 || first == '\t' || first == '\n' ||
           first == '\r';
  }
  return character != "\xEF\xBF\xBE" && character != "\xEF\xBF\xBF";
}

void append_escaped(std::string& to, std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(1, utf8_length(text, at));
    const std::string_view character = text.substr(at, length);
    at += length;
    switch (character.front()) {
      case '&':
        to += "&amp;";
        break;
      case '<':
        to += "&lt;";
        break;
      case '>':
        to += "&gt;";
        break;
      case '"':
        to += "&quot;";
        break;
      case '\n':
        to += "&#10;";
        break;
      default: {
        const bool broken = length == 1 && (character.front() & '\x80') != 0;
        to += broken || !is_xml(character) ? kReplacement : character;
      }
    }
  }
}

void append_attribute(std::string& to, std::string_view name, std::string_view value) {
  to += ' ';
  to += name;
  to += "=\"";
  append_escaped(to, value);
  to += '"';
}

std::string_view element_of(JUnitOutcome outcome) {
  switch (outcome) {
    case JUnitOutcome::kFailed:
      return "failure";
    case JUnitOutcome::kError:
      return "error";
    case JUnitOutcome::kSkipped:
      return "skipped";
    case JUnitOutcome::kPassed:
      break;
  }
  return {};
}

void write_case(TextSink& sink, const JUnitCase& one) {
  std::string text = "    <testcase";
  append_attribute(text, "classname", one.group);
  append_attribute(text, "name", one.name);
  const std::string_view element = element_of(one.outcome);
  if (element.empty()) {
    sink.write(text + "/>\n");
    return;
  }
  text += ">\n      <";
  text += element;
  append_attribute(text, "message", one.message);
  text += '>';
  append_escaped(text, one.text);
  text += "</";
  text += element;
  sink.write(text + ">\n    </testcase>\n");
}

}  // namespace

void write_junit(TextSink& sink, const std::string& name, std::span<const JUnitCase> cases) {
  const auto count = [&](JUnitOutcome outcome) {
    return std::to_string(std::ranges::count(cases, outcome, &JUnitCase::outcome));
  };
  std::string counts;
  append_attribute(counts, "tests", std::to_string(cases.size()));
  append_attribute(counts, "failures", count(JUnitOutcome::kFailed));
  append_attribute(counts, "errors", count(JUnitOutcome::kError));
  append_attribute(counts, "skipped", count(JUnitOutcome::kSkipped));
  std::string suite = "  <testsuite";
  append_attribute(suite, "name", name);
  sink.write("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + counts + ">\n" + suite +
             counts + ">\n");
  for (const JUnitCase& one : cases) write_case(sink, one);
  sink.write("  </testsuite>\n</testsuites>\n");
}

}  // namespace gnomon::report
