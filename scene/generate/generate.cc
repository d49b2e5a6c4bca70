// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "scene/generate/scene_maker.h"

namespace gnomon {
namespace {

using scene_detail::Generator;

/// Whoever lets a light be chosen lets it be an area light.
void add_area_parameters(std::vector<GeneratorParameter>& parameters) {
  const auto has = [&](const GeneratorParameter& parameter) {
    return std::ranges::find(parameters, parameter.name, &GeneratorParameter::name) !=
           parameters.end();
  };
  if (!has(scene_detail::kLightParameter) || has(scene_detail::kAreaParameter)) return;
  parameters.push_back(scene_detail::kAreaParameter);
  parameters.push_back(scene_detail::kAreaSizeParameter);
}

const std::vector<Generator>& registry() {
  static const std::vector<Generator> all = [] {
    std::vector<Generator> result;
    for (auto family : {scene_detail::paper_generators, scene_detail::room_generators,
                        scene_detail::figure_generators, scene_detail::solid_generators,
                        scene_detail::large_generators, scene_detail::object_generators,
                        scene_detail::hard_generators, scene_detail::repair_generators,
                        scene_detail::area_paper_generators, scene_detail::area_generators}) {
      for (Generator& generator : family()) result.push_back(std::move(generator));
    }
    for (Generator& generator : result) add_area_parameters(generator.info.parameters);
    std::sort(result.begin(), result.end(),
              [](const Generator& a, const Generator& b) { return a.info.name < b.info.name; });
    return result;
  }();
  return all;
}

const Generator* find(std::string_view name) {
  for (const Generator& generator : registry()) {
    if (generator.info.name == name) return &generator;
  }
  return nullptr;
}

}  // namespace

const std::vector<GeneratorInfo>& generators() {
  static const std::vector<GeneratorInfo> infos = [] {
    std::vector<GeneratorInfo> result;
    for (const Generator& generator : registry()) result.push_back(generator.info);
    return result;
  }();
  return infos;
}

const GeneratorInfo* generator_by_name(std::string_view name) {
  const Generator* generator = find(name);
  return generator == nullptr ? nullptr : &generator->info;
}

std::optional<std::int64_t> parameter_value(const GeneratorInfo& info, std::string_view parameter,
                                            std::string_view text) {
  const auto p = std::ranges::find(info.parameters, parameter, &GeneratorParameter::name);
  if (p != info.parameters.end()) {
    const auto word = std::ranges::find(p->words, text);
    if (word != p->words.end()) return p->minimum + (word - p->words.begin());
  }
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::string values_of(const GeneratorParameter& parameter) {
  if (parameter.words.empty()) {
    return fmt::format("{}..{}", parameter.minimum, parameter.maximum);
  }
  std::string text;
  for (const std::string& word : parameter.words) text += (text.empty() ? "" : "|") + word;
  return text;
}

Expected<Scene> generate(std::string_view name,
                         const std::map<std::string, std::int64_t>& parameters,
                         std::uint64_t seed) {
  const Generator* generator = find(name);
  if (generator == nullptr) {
    std::string names;
    for (const GeneratorInfo& info : generators()) names += (names.empty() ? "" : " ") + info.name;
    return fail(ErrorCode::kUsage, fmt::format("there is no generator '{}'", name),
                "one of " + names);
  }
  scene_detail::Values values;
  for (const GeneratorParameter& p : generator->info.parameters) values[p.name] = p.default_value;
  for (const auto& [key, value] : parameters) {
    const auto& known = generator->info.parameters;
    const auto p =
        std::find_if(known.begin(), known.end(),
                     [&key = key](const GeneratorParameter& q) { return q.name == key; });
    if (p == known.end()) {
      std::string names;
      for (const GeneratorParameter& q : known) names += (names.empty() ? "" : " ") + q.name;
      return fail(ErrorCode::kUsage, fmt::format("generator '{}' has no parameter '{}'", name, key),
                  names.empty() ? "no parameters" : "one of " + names);
    }
    if (value < p->minimum || value > p->maximum) {
      return fail(
          ErrorCode::kUsage,
          fmt::format("generator '{}': {} = {} is out of range", name, key, value),
          p->words.empty() ? fmt::format("{} to {}", p->minimum, p->maximum) : values_of(*p));
    }
    values[key] = value;
  }
  scene_detail::SceneMaker maker{std::string(name)};
  Random random(seed);
  generator->make(maker, values, random);
  return maker.take();
}

}  // namespace gnomon
