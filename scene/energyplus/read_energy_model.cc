// SPDX-License-Identifier: LGPL-3.0-or-later
// The readers of IDF and epJSON, two syntaxes of one model.
#include <algorithm>

#include "scene/base/text_file.h"
#include "scene/energyplus/energy_scene.h"
#include "scene/files/json_dialect.h"
#include "scene/files/readers.h"

namespace gnomon {

namespace {

Expected<ReadResult> scene_of_model(const Expected<EnergyModel>& model,
                                    const ReadOptions& options) {
  if (!model) return tl::unexpected(model.error());
  return energy::EnergyScene(*model, options).build();
}

}  // namespace

Likeness looks_like_epjson(std::string_view text) {
  return json_dialect(text) == SceneFormat::kEpJson ? Likeness::kCertain : Likeness::kNone;
}

/// Does a line of the first ones begin with a class that energy models have, and a comma?
Likeness looks_like_idf(std::string_view text) {
  constexpr std::size_t kFarEnough = std::size_t{1} << 16;
  text = first_word_on(text).substr(0, kFarEnough);
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    if (line.substr(first).starts_with("!-Generator")) return Likeness::kCertain;
    const std::size_t comma = line.find(',', first);
    if (comma == std::string_view::npos) continue;
    std::string_view word = line.substr(first, comma - first);
    while (!word.empty() && (word.back() == ' ' || word.back() == '\t')) word.remove_suffix(1);
    if (energy_class(word) != nullptr) return Likeness::kPossible;
  }
  return Likeness::kNone;
}

Expected<ReadResult> read_idf(const std::string& text, const std::string& file,
                              const ReadOptions& options) {
  return scene_of_model(parse_idf(text, file), options);
}

Expected<ReadResult> read_epjson(const std::string& text, const std::string& file,
                                 const ReadOptions& options) {
  return scene_of_model(parse_epjson(text, file), options);
}

}  // namespace gnomon
