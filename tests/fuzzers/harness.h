// SPDX-License-Identifier: GPL-3.0-or-later
// What the fuzz targets share. A target is one source with the function that libFuzzer calls for
// each input, below; it is linked with libFuzzer (preset fuzzers) or with replay_main.cc, which
// runs the corpus through it in every build of the tests. A property that does not hold ends the
// program with a sentence.
#ifndef GNOMON_TESTS_FUZZERS_HARNESS_H
#define GNOMON_TESTS_FUZZERS_HARNESS_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/number.h"
#include "gnomon/scene/scene.h"
#include "gnomon/scene/scene_format.h"

/// libFuzzer's entry point. 0: the input may be kept.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace gnomon::fuzzers {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Says `what` and aborts.
[[noreturn]] void broken(const std::string& what);
inline void require(bool holds, const std::string& what) {
  if (!holds) broken(what);
}

/// An error in words on one line, with the file's name and, if `in_text`, a line of the text.
void check_error(const Error& error, std::string_view file, std::string_view text, bool in_text);

/// Reads the text as a file of that name by either meaning of numbers. What can be read is valid,
/// is the same again after it was written as JSON and, if it can be, as a file of its own format,
/// and is written the same again.
void check_scene_file(std::string_view text, const std::string& file, SceneFormat format,
                      bool lights_only = false);

/// The first difference in words; empty if the two cannot be told apart. File names and `extra` do
/// not count.
std::string difference(const Scene& a, const Scene& b);

}  // namespace gnomon::fuzzers

#endif  // GNOMON_TESTS_FUZZERS_HARNESS_H
