// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/output.h"

#include <cerrno>
#include <system_error>

namespace gnomon::cli {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18;

bool is_closed_pipe(const Error& error) {
  return error.what.ends_with(std::generic_category().message(EPIPE));
}

}  // namespace

Expected<Output> Output::open(const std::filesystem::path& path) {
  auto file = OutputFile::open(path.empty() ? std::filesystem::path("-") : path);
  if (!file) return tl::unexpected(std::move(file.error()));
  return Output(std::move(*file));
}

void Output::write(std::string_view text) {
  if (failure_ || stopped()) return;
  buffer_ += text;
  if (buffer_.size() >= kBufferSize) flush();
}

void Output::flush() {
  if (!failure_) {
    if (auto written = file_.write(buffer_); !written) failure_ = std::move(written.error());
  }
  buffer_.clear();
}

Expected<void> Output::finish() {
  if (stopped()) return fail(ErrorCode::kInterrupted, "interrupted");
  flush();
  if (failure_) {
    if (is_closed_pipe(*failure_)) return {};
    return tl::unexpected(*failure_);
  }
  return file_.commit();
}

Expected<void> write_output(const std::filesystem::path& path, std::string_view text) {
  auto output = Output::open(path);
  if (!output) return tl::unexpected(output.error());
  output->write(text);
  return output->finish();
}

}  // namespace gnomon::cli
