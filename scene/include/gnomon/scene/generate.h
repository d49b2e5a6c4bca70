// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes made by rule: of the same kind and polygon counts as the papers', large ones, and families
// in which exact degeneracy is the rule. Each is a documented function of its parameters and seed.
//
// Guarantees: the same name, parameters and seed give the same scene, bit for bit, on every
// machine. All coordinates are integers or multiples of a power of two, so that scenes are exact as
// doubles and polygons with more than three vertices exactly planar, unless a family says
// otherwise.
#ifndef GNOMON_SCENE_GENERATE_H
#define GNOMON_SCENE_GENERATE_H

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// All parameters are whole numbers; switches are 0 or 1.
struct GeneratorParameter {
  std::string name;
  std::int64_t default_value = 0;
  std::int64_t minimum = 0, maximum = 0;
  std::string meaning;
  std::vector<std::string> words{};  // for the values from the minimum to the maximum, or none
};

struct GeneratorInfo {
  std::string name;
  std::string summary;  // what the scene is, and how many polygons it has
  std::vector<GeneratorParameter> parameters;
  std::string source;  // the paper whose scene it stands for, or what it is hard for
  bool small = false;  // with few polygons by default and made for campaigns of many seeds
};

/// Sorted by name.
const std::vector<GeneratorInfo>& generators();
const GeneratorInfo* generator_by_name(std::string_view name);

/// What `text` means as a value of the parameter: a whole number or one of the parameter's words.
/// That it is in range, and that there is such a parameter, generate() checks.
std::optional<std::int64_t> parameter_value(const GeneratorInfo& info, std::string_view parameter,
                                            std::string_view text);
/// The words, as "a|b|c", or the range, as "1..9".
std::string values_of(const GeneratorParameter& parameter);

/// Parameters that are not given have their defaults. Errors: kUsage (unknown name or parameter, a
/// value out of its range).
Expected<Scene> generate(std::string_view name,
                         const std::map<std::string, std::int64_t>& parameters = {},
                         std::uint64_t seed = 1);

}  // namespace gnomon

#endif  // GNOMON_SCENE_GENERATE_H
