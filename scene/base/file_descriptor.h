// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef GNOMON_SCENE_BASE_FILE_DESCRIPTOR_H
#define GNOMON_SCENE_BASE_FILE_DESCRIPTOR_H

#include <unistd.h>

#include <utility>

namespace gnomon {

/// An open file, closed at the end; negative if it could not be opened. Standard input, output and
/// error stay open.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~FileDescriptor() {
    if (number_ > STDERR_FILENO) ::close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_FILE_DESCRIPTOR_H
