// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/base/text_window.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace gnomon {

namespace {

/// Stays in a processor's second cache.
constexpr std::size_t kWindow = std::size_t{1} << 18;

/// The number of bytes read, 0 at the end of the file; negative if it cannot be read.
ssize_t read_some(int file, char* to, std::size_t count) {
  for (;;) {
    const ssize_t got = ::read(file, to, count);
    if (got >= 0 || errno != EINTR) return got;
  }
}

}  // namespace

TextWindow::TextWindow(FileDescriptor file, std::size_t size)
    : file_(std::move(file)),
      unread_(size),
      capacity_(std::min(kWindow, size + 1)),
      buffer_(std::make_unique_for_overwrite<char[]>(capacity_ + 1)) {
  buffer_[0] = '\0';
  begin_ = end_ = buffer_.get();
}

std::optional<TextWindow> TextWindow::of_file(const std::filesystem::path& path) {
  // A pipe must not even be opened: its writer would find it closed again.
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0) return std::nullopt;
  TextWindow window(std::move(file), static_cast<std::size_t>(status.st_size));
  window.move_on(window.begin());
  return window;
}

bool TextWindow::move_on(const char* keep) {
  if (file_.number() < 0) return false;
  const auto kept = static_cast<std::size_t>(end_ - keep);
  if (kept == capacity_) {
    const std::size_t larger = 2 * capacity_;
    auto buffer = std::make_unique_for_overwrite<char[]>(larger + 1);
    std::memcpy(buffer.get(), keep, kept);
    buffer_ = std::move(buffer);
    capacity_ = larger;
  } else {
    std::memmove(buffer_.get(), keep, kept);
  }
  const ssize_t count = read_some(file_.number(), buffer_.get() + kept, capacity_ - kept);
  failed_ = failed_ || count < 0;
  const auto got = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  begin_ = buffer_.get();
  end_ = begin_ + kept + got;
  buffer_[kept + got] = '\0';
  unread_ -= std::min(unread_, got);
  return got != 0;
}

}  // namespace gnomon
