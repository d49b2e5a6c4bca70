// SPDX-License-Identifier: LGPL-3.0-or-later
// A file that is there as a whole or not at all: written beside its place under another name, and
// moved there by commit(). What interrupts a program before leaves the old file, or none.
#ifndef GNOMON_SCENE_BASE_OUTPUT_FILE_H
#define GNOMON_SCENE_BASE_OUTPUT_FILE_H

#include <filesystem>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"

namespace gnomon {

class OutputFile {
 public:
  /// `-` is standard output; that, pipes and devices are written to directly. A link is followed.
  /// Errors: kFile.
  static Expected<OutputFile> open(const std::filesystem::path& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  /// Throws away what was not committed.
  ~OutputFile();

  /// Errors: kFile (a full disk, a closed pipe).
  Expected<void> write(std::string_view text);
  /// Writes over the first bytes of what has been written. Errors: kFile, also for standard output,
  /// pipes and devices.
  Expected<void> write_over_start(std::string_view text);
  /// The file is now in its place. Nothing may be written afterwards. Errors: kFile.
  Expected<void> commit();

 private:
  OutputFile() = default;
  void discard() noexcept;
  tl::unexpected<Error> error(const std::string& what, int number) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;  // empty if written directly
  int descriptor_ = -1;
};

/// open, write, commit.
Expected<void> write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_OUTPUT_FILE_H
