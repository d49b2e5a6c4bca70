// SPDX-License-Identifier: GPL-3.0-or-later
// Where a command's result goes: standard output, or a file that appears whole or not at all
// (scene/base/output_file.h), buffered. A pipe whose reader has gone is no error: nobody is left to
// tell.
#ifndef GNOMON_CLI_COMMON_OUTPUT_H
#define GNOMON_CLI_COMMON_OUTPUT_H

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "gnomon/kernel/error.h"
#include "report/text/text_sink.h"
#include "scene/base/output_file.h"

namespace gnomon::cli {

class Output final : public report::TextSink {
 public:
  /// `-` or an empty path: standard output. Errors: kFile.
  static Expected<Output> open(const std::filesystem::path& path);

  /// Nothing more is written once `stop` is true, and finish() says kInterrupted.
  void give_up_if(const std::atomic<bool>& stop) { stop_ = &stop; }
  void write(std::string_view text) override;
  /// Puts the file in its place. Errors: kFile, also for whatever failed before; kInterrupted.
  Expected<void> finish();

 private:
  explicit Output(OutputFile file) : file_(std::move(file)) {}
  void flush();
  bool stopped() const { return stop_ != nullptr && *stop_; }

  OutputFile file_;
  std::string buffer_;
  std::optional<Error> failure_;  // the first
  const std::atomic<bool>* stop_ = nullptr;
};

/// Writes a whole text to a file or, for an empty path, to standard output. Errors: kFile.
Expected<void> write_output(const std::filesystem::path& path, std::string_view text);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_OUTPUT_H
