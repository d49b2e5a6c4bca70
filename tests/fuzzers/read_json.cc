// SPDX-License-Identifier: GPL-3.0-or-later
// A scene file in JSON; what is read without the parser is what the parser says.
#include "harness.h"
#include "scene/base/text_window.h"
#include "scene/files/plain_json_scene.h"
#include "scene/files/readers.h"

namespace {

using namespace gnomon;

void check_plain(const std::string& text, const ReadOptions& options) {
  TextWindow window(text);
  const auto plain = read_plain_json(window, "input.json", options);
  if (!plain) return;
  const auto parsed = parse_json(text, "input.json", options);
  if (!parsed) fuzzers::broken("read without its error: " + to_string(parsed.error()));
  if (const auto what = fuzzers::difference(plain->scene, parsed->scene); !what.empty()) {
    fuzzers::broken("by the parser, not the same " + what);
  }
  fuzzers::require(plain->scene.extra == parsed->scene.extra, "by the parser, another extra");
  fuzzers::require(plain->warnings == parsed->warnings, "by the parser, other warnings");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzzers::text_of(data, size));
  fuzzers::check_scene_file(text, "input.json", SceneFormat::kJson);
  ReadOptions options;
  check_plain(text, options);
  options.numbers = NumberMeaning::kDecimal;
  check_plain(text, options);
  return 0;
}
