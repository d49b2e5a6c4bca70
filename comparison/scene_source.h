// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of a comparison by name: a family of `gnomon generate`, a generator of campaigns, or a
// file. A size is asked for in polygons, whatever a family's own parameter counts.
#ifndef GNOMON_COMPARISON_SCENE_SOURCE_H
#define GNOMON_COMPARISON_SCENE_SOURCE_H

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "fuzz/generate/generator.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/scene.h"

namespace gnomon::comparison {

class SceneSource {
 public:
  /// NAME[:parameter=value,...] of `gnomon generate`, a file, a generator of campaigns, or a step
  /// of an extreme (extreme_scenes.h). Errors: kUsage, for what is none of these.
  static Expected<SceneSource> parse(std::string_view text);

  /// The text that it was parsed from.
  const std::string& name() const { return name_; }
  /// Whether scenes of several sizes can be made: a family whose first parameter changes the number
  /// of polygons, and is not given in the text.
  bool takes_size() const { return !size_parameter_.empty(); }

  /// The largest scene of at most `polygons` polygons, the smallest there is if all have more.
  /// Without a size, or from a source that takes none: the family's defaults, the seed's scene, the
  /// file. Errors: those of the generator or the file.
  Expected<Scene> make(std::optional<std::uint64_t> polygons, std::uint64_t seed) const;

 private:
  Expected<Scene> of_parameter(std::int64_t value, std::uint64_t seed) const;
  void find_size_parameter();

  std::string name_;
  const GeneratorInfo* family_ = nullptr;
  std::map<std::string, std::int64_t> parameters_;
  std::string size_parameter_;
  std::int64_t smallest_ = 0, largest_ = 0;  // of that parameter
  std::shared_ptr<const fuzz::Generator> generator_;
  std::shared_ptr<const Scene> scene_;  // of an extreme
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_SCENE_SOURCE_H
