// SPDX-License-Identifier: GPL-3.0-or-later
// Text as the content and the attributes of XML.
#ifndef GNOMON_REPORT_TEXT_XML_TEXT_H
#define GNOMON_REPORT_TEXT_XML_TEXT_H

#include <string>
#include <string_view>

namespace gnomon::report {

/// Appends the text with &, <, >, " and line ends written as references. What is no character of
/// XML 1.0 (control characters, bytes that are no UTF-8) becomes U+FFFD.
void append_xml(std::string& to, std::string_view text);
/// The same as a text of its own.
std::string xml_text(std::string_view text);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_XML_TEXT_H
