// SPDX-License-Identifier: GPL-3.0-or-later
// A sink is what reports are written to: a string, a stream, a file. It remembers its first failure
// and drops what comes after that, so that writers need not check every line.
#ifndef GNOMON_REPORT_TEXT_TEXT_SINK_H
#define GNOMON_REPORT_TEXT_TEXT_SINK_H

#include <string>
#include <string_view>

namespace gnomon::report {

class TextSink {
 public:
  virtual ~TextSink() = default;
  virtual void write(std::string_view text) = 0;
};

class StringSink final : public TextSink {
 public:
  void write(std::string_view text) override { text_ += text; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_TEXT_SINK_H
