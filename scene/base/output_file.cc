// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/base/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace gnomon {

namespace {

constexpr ::mode_t kDefaultMode = 0666;  // less the user's mask
constexpr ::mode_t kPermissionBits = 07777;
constexpr int kMostTries = 100;

std::string shown_target(const std::filesystem::path& path) {
  return path == "-" ? "<stdout>" : path.string();
}

}  // namespace

tl::unexpected<Error> OutputFile::error(const std::string& what, int number) const {
  return fail(ErrorCode::kFile, what + ": " + std::generic_category().message(number), {},
              ErrorPlace{shown_target(target_), 0, 0, {}});
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  if (this == &other) return *this;
  discard();
  target_ = std::move(other.target_);
  temporary_ = std::move(other.temporary_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() noexcept {
  if (descriptor_ < 0) return;
  if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  descriptor_ = -1;
}

Expected<OutputFile> OutputFile::open(const std::filesystem::path& path) {
  OutputFile file;
  file.target_ = path;
  if (path == "-") {
    file.descriptor_ = STDOUT_FILENO;
    return file;
  }
  if (path.empty()) {
    return fail(ErrorCode::kFile, "no file name", "a file, or - for standard output");
  }
  std::error_code ignored;
  const std::filesystem::path followed = std::filesystem::canonical(path, ignored);
  if (!ignored) file.target_ = followed;
  struct stat status {};
  const bool exists = ::stat(file.target_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) return file.error("cannot write", EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    file.descriptor_ = ::open(file.target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.descriptor_ < 0) return file.error("cannot write", errno);
    return file;
  }
  // Moving a file over another asks only the directory; the file has a say, too.
  if (exists && ::access(file.target_.c_str(), W_OK) != 0) return file.error("cannot write", errno);
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    file.temporary_ = file.target_;
    file.temporary_ += "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".part";
    file.descriptor_ =
        ::open(file.temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kDefaultMode);
    if (file.descriptor_ >= 0 || errno != EEXIST) break;
  }
  if (file.descriptor_ < 0) return file.error("cannot write", errno);
  if (exists && ::fchmod(file.descriptor_, status.st_mode & kPermissionBits) != 0) {
    return file.error("cannot write", errno);
  }
  return file;
}

Expected<void> OutputFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor_, text.data(), text.size());
    if (count < 0) {
      if (errno == EINTR) continue;
      return error("cannot write", errno);
    }
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

Expected<void> OutputFile::write_over_start(std::string_view text) {
  for (::off_t at = 0; !text.empty();) {
    const ssize_t count = ::pwrite(descriptor_, text.data(), text.size(), at);
    if (count < 0) {
      if (errno == EINTR) continue;
      return error("cannot write", errno);
    }
    at += count;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

Expected<void> OutputFile::commit() {
  const int descriptor = std::exchange(descriptor_, -1);
  const bool closed = descriptor <= STDERR_FILENO || ::close(descriptor) == 0;
  const int close_error = closed ? 0 : errno;
  if (temporary_.empty()) {
    if (closed) return {};
    return error("cannot write", close_error);
  }
  if (!closed || ::rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int number = closed ? errno : close_error;
    ::unlink(temporary_.c_str());
    return error("cannot write", number);
  }
  return {};
}

Expected<void> write_file(const std::filesystem::path& path, std::string_view text) {
  auto file = OutputFile::open(path);
  if (!file) return tl::unexpected(std::move(file.error()));
  if (auto written = file->write(text); !written) return written;
  return file->commit();
}

}  // namespace gnomon
