// SPDX-License-Identifier: LGPL-3.0-or-later
// The readers of CityJSON and CityJSONSeq (versions 1.0, 1.1 and 2.0). A sequence is read line by
// line, so that beside the scene only one line of its text need be in memory.
#include <algorithm>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/base/text_window.h"
#include "scene/cityjson/city_reader.h"
#include "scene/files/json_dialect.h"
#include "scene/files/readers.h"

namespace gnomon {

namespace {

/// The lines of a sequence, one after the other.
class SequenceReader {
 public:
  SequenceReader(const std::string& file, const ReadOptions& options)
      : file_(file), city_(file, options) {}

  /// A line without its line break, which begins at that byte of the file.
  Expected<void> add(const std::string& line, std::uint64_t offset) {
    ++number_;
    if (line.find_first_not_of(" \t\r", byte_order_mark(line)) == std::string::npos) return {};
    if (auto readable = check_is_utf8(line, file_); !readable) {
      readable.error().where.line += number_ - 1;
      return readable;
    }
    auto tape = JsonTape::parse(line, file_, number_);
    if (!tape) return tl::unexpected(std::move(tape.error()));
    const bool is_first = !std::exchange(has_header_, true);
    return is_first ? city_.read_city(*tape) : city_.read_feature(*tape, offset);
  }

  Expected<ReadResult> finish(std::string_view text) {
    if (!has_header_) {
      return fail(ErrorCode::kSyntax, "the file is empty", "a line with a CityJSON object",
                  ErrorPlace{file_, 1, 1, {}});
    }
    return city_.finish(text);
  }

 private:
  const std::string& file_;
  CityReader city_;
  std::uint64_t number_ = 0;
  bool has_header_ = false;
};

}  // namespace

Likeness looks_like_cityjson(std::string_view text) {
  return json_dialect(text) == SceneFormat::kCityJson ? Likeness::kCertain : Likeness::kNone;
}

Likeness looks_like_cityjson_sequence(std::string_view text) {
  return json_dialect(text) == SceneFormat::kCityJsonSeq ? Likeness::kCertain : Likeness::kNone;
}

Expected<ReadResult> read_cityjson(const std::string& text, const std::string& file,
                                   const ReadOptions& options) {
  if (auto readable = check_is_utf8(text, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  auto tape = JsonTape::parse(text, file);
  if (!tape) return tl::unexpected(std::move(tape.error()));
  CityReader city(file, options);
  if (auto done = city.read_city(*tape); !done) return tl::unexpected(std::move(done.error()));
  return city.finish(text);
}

Expected<ReadResult> read_cityjson_sequence(const std::string& text, const std::string& file,
                                            const ReadOptions& options) {
  SequenceReader reader(file, options);
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    line.assign(text, at, end - at);
    if (auto done = reader.add(line, at); !done) return tl::unexpected(std::move(done.error()));
    at = end + 1;
  }
  return reader.finish(text);
}

Expected<ReadResult> stream_cityjson_sequence(TextWindow& window, const std::string& file,
                                              const ReadOptions& options) {
  SequenceReader reader(file, options);
  const char* at = window.begin();
  const char* searched = at;
  std::string line;
  std::uint64_t offset = 0;
  for (;;) {
    const char* end = std::find(searched, window.end(), '\n');
    if (end == window.end()) {
      const auto known = end - at;
      const bool goes_on = window.move_on(at);
      at = window.begin();
      searched = at + known;
      if (goes_on) continue;
      if (!window.is_whole()) {
        return fail(ErrorCode::kFile, "cannot read the file to its end", {},
                    ErrorPlace{file, 0, 0, {}});
      }
      end = window.end();
    }
    if (end == window.end() && at == end) break;
    line.assign(at, end);
    if (auto done = reader.add(line, offset); !done) return tl::unexpected(std::move(done.error()));
    if (end == window.end()) break;
    offset += line.size() + 1;
    at = searched = end + 1;
  }
  return reader.finish({});
}

}  // namespace gnomon
