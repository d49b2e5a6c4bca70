// SPDX-License-Identifier: LGPL-3.0-or-later
// The reader of HBJSON.
#include "scene/base/text_file.h"
#include "scene/building/honeybee_reader.h"
#include "scene/files/json_dialect.h"
#include "scene/files/readers.h"

namespace gnomon {

Likeness looks_like_hbjson(std::string_view text) {
  return json_dialect(text) == SceneFormat::kHbJson ? Likeness::kCertain : Likeness::kNone;
}

Expected<ReadResult> read_hbjson(const std::string& text, const std::string& file,
                                 const ReadOptions& options) {
  if (auto readable = check_is_utf8(text, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  const auto tape = JsonTape::parse(text, file);
  if (!tape) return tl::unexpected(tape.error());
  return HoneybeeReader(*tape, file, options).read();
}

}  // namespace gnomon
