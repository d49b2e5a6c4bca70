// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/base/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <system_error>

#include "scene/base/file_descriptor.h"
#include "scene/base/utf16.h"

namespace gnomon {

namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16;
/// The limit for a pipe or device, whose length is not known beforehand.
constexpr std::size_t kMostStreamBytes = std::size_t{1} << 32;

tl::unexpected<Error> file_error(const std::string& name, const std::string& what,
                                 std::string expected = {}) {
  return fail(ErrorCode::kFile, what, std::move(expected), ErrorPlace{name, 0, 0, {}});
}

std::string system_message(int error) { return std::generic_category().message(error); }

Expected<void> not_utf8(std::string_view text, const std::string& file, std::size_t offset) {
  return fail(ErrorCode::kSyntax, "this byte is not valid UTF-8", "a file in UTF-8",
              place_in_text(file, text, offset));
}

/// Do the first bytes of a file of that size (0: not known) begin a format of binary data, or a
/// text whose characters have two bytes?
bool goes_on_behind_zeros(std::string_view begin, std::size_t size) {
  return begin.starts_with("ply") || begin.starts_with("glTF") ||
         is_size_of_binary_stl(begin, size) || is_utf16(begin);
}

Expected<std::string> read_bytes(const std::filesystem::path& path, bool stops_at_zeros);

}  // namespace

bool is_size_of_binary_stl(std::string_view begin, std::size_t size) {
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  if (begin.size() < kHeader) return false;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    count |= std::size_t{static_cast<unsigned char>(begin[kHeader - 4 + i])} << (8 * i);
  }
  return size == kHeader + kTriangle * count;
}

std::string shown_name(const std::filesystem::path& path) {
  return path == "-" ? "<stdin>" : path.string();
}

Expected<std::string> read_file(const std::filesystem::path& path) {
  auto bytes = read_bytes(path, true);
  if (!bytes || !is_utf16(*bytes) || is_size_of_binary_stl(*bytes, bytes->size())) return bytes;
  return utf8_of_utf16(*bytes, shown_name(path));
}

Expected<std::string> read_all_bytes(const std::filesystem::path& path) {
  return read_bytes(path, false);
}

namespace {

Expected<std::string> read_bytes(const std::filesystem::path& path, bool stops_at_zeros) {
  const std::string name = shown_name(path);
  if (path.empty()) return file_error("", "no file name", "a file, or - for standard input");
  const bool standard = path == "-";
  const FileDescriptor file(standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.number() < 0) return file_error(name, "cannot open: " + system_message(errno));
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) {
    return file_error(name, "cannot read: " + system_message(errno));
  }
  if (S_ISDIR(status.st_mode)) return file_error(name, "is a directory", "a file");
  const bool regular = S_ISREG(status.st_mode);

  std::string text;
  if (regular && status.st_size > 0) text.reserve(static_cast<std::size_t>(status.st_size) + 1);
  const auto chunk = std::make_unique<char[]>(kChunk);
  for (;;) {
    const ssize_t count = ::read(file.number(), chunk.get(), kChunk);
    if (count < 0) {
      if (errno == EINTR) continue;
      return file_error(name, "cannot read: " + system_message(errno));
    }
    if (count == 0) return text;
    text.append(chunk.get(), static_cast<std::size_t>(count));
    if (stops_at_zeros && text.size() <= kChunk && text.find('\0') != std::string::npos &&
        !goes_on_behind_zeros(text, regular ? static_cast<std::size_t>(status.st_size) : 0)) {
      return text;
    }
    if (!regular && text.size() > kMostStreamBytes) {
      return fail(ErrorCode::kLimit, "the stream does not end", "at most 4 GiB",
                  ErrorPlace{name, 0, 0, {}});
    }
  }
}

}  // namespace

ErrorPlace PlacesInText::at(std::string file, std::size_t offset, std::string pointer) {
  const std::size_t first = byte_order_mark(text_);
  offset = std::max(std::min(offset, text_.size()), first);
  if (line_ == 0 || offset < line_start_) {
    line_ = 1;
    line_start_ = first;
  }
  for (;;) {
    const std::size_t end = text_.find('\n', line_start_);
    if (end == std::string_view::npos || end >= offset) break;
    ++line_;
    line_start_ = end + 1;
  }
  ErrorPlace place{std::move(file), line_, 1, std::move(pointer)};
  for (std::size_t at = line_start_; at < offset; ++at) {
    if ((static_cast<unsigned char>(text_[at]) & 0xC0u) != 0x80u) ++place.column;
  }
  return place;
}

ErrorPlace place_in_text(std::string file, std::string_view text, std::size_t offset,
                         std::string pointer) {
  return PlacesInText(text).at(std::move(file), offset, std::move(pointer));
}

std::string quoted_text(std::string_view text) {
  constexpr std::size_t kMostShown = 40;
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string result = "'";
  std::size_t at = 0;
  while (at < text.size() && at < kMostShown) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::size_t length = utf8_length(text, at);
    const bool control =
        byte < 0x20 || byte == 0x7F ||
        (length == 2 && byte == 0xC2 && static_cast<unsigned char>(text[at + 1]) < 0xA0);
    if (length != 0 && !control) {
      result += text.substr(at, length);
      at += length;
    } else {
      ++at;
      result += "\\x";
      result += kHex[byte >> 4];
      result += kHex[byte & 15];
    }
  }
  if (at < text.size()) result += "...";
  result += '\'';
  return result;
}

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
  };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead < 0xC2) return 0;
  if (lead < 0xE0) return continues(1) ? 2 : 0;
  if (lead < 0xF0) {
    if (!continues(1) || !continues(2)) return 0;
    if (lead == 0xE0 && byte(1) < 0xA0) return 0;   // overlong
    if (lead == 0xED && byte(1) >= 0xA0) return 0;  // surrogate
    return 3;
  }
  if (lead > 0xF4 || !continues(1) || !continues(2) || !continues(3)) return 0;
  if (lead == 0xF0 && byte(1) < 0x90) return 0;
  if (lead == 0xF4 && byte(1) >= 0x90) return 0;
  return 4;
}

std::size_t byte_order_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}

Expected<void> check_is_text(std::string_view text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n", byte_order_mark(text)) == std::string_view::npos) {
    return fail(ErrorCode::kSyntax, "the file is empty", "a scene", ErrorPlace{file, 1, 1, {}});
  }
  const std::size_t nul = text.find('\0');
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") || nul == 0 ||
      (nul == 1 && text.size() > 3 && text[3] == '\0')) {
    return fail(ErrorCode::kSyntax, "the file is not UTF-8 (UTF-16 or UTF-32, it seems)",
                "a file in UTF-8, or in UTF-16 with a byte order mark", ErrorPlace{file, 1, 1, {}});
  }
  if (nul != std::string_view::npos) {
    return fail(ErrorCode::kSyntax, "a NUL byte", "text", place_in_text(file, text, nul));
  }
  return {};
}

Expected<void> check_is_utf8(std::string_view text, const std::string& file) {
  if (auto is_text = check_is_text(text, file); !is_text) return is_text;
  std::size_t at = 0;
  while (at < text.size()) {
    // Eight ASCII bytes at a time.
    std::uint64_t word = 0;
    if (at + sizeof word <= text.size()) {
      std::memcpy(&word, text.data() + at, sizeof word);
      if ((word & 0x8080808080808080u) == 0) {
        at += sizeof word;
        continue;
      }
    }
    const std::size_t length = utf8_length(text, at);
    if (length == 0) return not_utf8(text, file, at);
    at += length;
  }
  return {};
}

}  // namespace gnomon
