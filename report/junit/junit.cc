// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/junit/junit.h"

#include <algorithm>
#include <string_view>

#include "report/text/xml_text.h"

namespace gnomon::report {

namespace {

void append_attribute(std::string& to, std::string_view name, std::string_view value) {
  to += ' ';
  to += name;
  to += "=\"";
  append_xml(to, value);
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
  append_xml(text, one.text);
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
