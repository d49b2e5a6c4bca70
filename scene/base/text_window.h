// SPDX-License-Identifier: LGPL-3.0-or-later
// A text through a window that moves over it, so that who reads a large file from its beginning to
// its end needs neither memory for all of it nor a second way through memory.
#ifndef GNOMON_SCENE_BASE_TEXT_WINDOW_H
#define GNOMON_SCENE_BASE_TEXT_WINDOW_H

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "scene/base/file_descriptor.h"

namespace gnomon {

/// [begin(), end()) is what is in the window; *end() is a NUL.
class TextWindow {
 public:
  /// All of a text, which must outlive the window.
  explicit TextWindow(const std::string& text)
      : begin_(text.data()), end_(text.data() + text.size()), file_(-1) {}
  /// The first bytes of a regular file; nothing for any other path.
  static std::optional<TextWindow> of_file(const std::filesystem::path& path);

  const char* begin() const { return begin_; }
  const char* end() const { return end_; }
  /// The bytes of the text from begin() on, by what the file's size was when it was opened.
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - begin_) + unread_; }

  /// Takes more of the text in, and lets go of what lies before `keep`, a place in the window. All
  /// pointers into the window end. False at the end of the text, or if it cannot be read.
  bool move_on(const char* keep);
  /// Could all be read so far?
  bool is_whole() const { return !failed_; }

 private:
  TextWindow(FileDescriptor file, std::size_t size);

  const char* begin_;
  const char* end_;
  FileDescriptor file_;  // none for a text in memory
  std::size_t unread_ = 0;
  bool failed_ = false;
  std::size_t capacity_ = 0;  // of the buffer, without the NUL
  std::unique_ptr<char[]> buffer_;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_TEXT_WINDOW_H
