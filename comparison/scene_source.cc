// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/scene_source.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "comparison/extreme_scenes.h"
#include "gnomon/scene/read.h"

namespace gnomon::comparison {

namespace {

/// "n=100,light=1". Errors: kUsage.
Expected<std::map<std::string, std::int64_t>> parse_parameters(const GeneratorInfo& info,
                                                               std::string_view text,
                                                               const std::string& whole) {
  std::map<std::string, std::int64_t> parameters;
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), item.size() + 1));
    const std::size_t equals = item.find('=');
    const std::string_view name = item.substr(0, equals);
    const auto value = equals == std::string_view::npos
                           ? std::nullopt
                           : parameter_value(info, name, item.substr(equals + 1));
    if (name.empty() || !value) {
      return fail(ErrorCode::kUsage, "'" + whole + "': '" + std::string(item) + "'",
                  "NAME:parameter=whole number,...");
    }
    if (!parameters.emplace(std::string(name), *value).second) {
      return fail(ErrorCode::kUsage, "'" + whole + "': " + std::string(item) + " is given twice",
                  "each parameter once");
    }
  }
  return parameters;
}

}  // namespace

Expected<SceneSource> SceneSource::parse(std::string_view text) {
  SceneSource source;
  source.name_ = text;
  if (text.starts_with(kExtremePrefix)) {
    auto scene = extreme_by_name(text);
    if (!scene) return tl::unexpected(std::move(scene.error()));
    source.scene_ = std::make_shared<const Scene>(std::move(*scene));
    return source;
  }
  const std::size_t colon = text.find(':');
  source.family_ = generator_by_name(text.substr(0, colon));
  if (source.family_ != nullptr) {
    const std::string_view rest = colon == std::string_view::npos ? "" : text.substr(colon + 1);
    auto parameters = parse_parameters(*source.family_, rest, source.name_);
    if (!parameters) return tl::unexpected(std::move(parameters.error()));
    source.parameters_ = std::move(*parameters);
    source.find_size_parameter();
    return source;
  }
  std::error_code failure;
  if (std::filesystem::exists(source.name_, failure)) return source;
  auto generator = fuzz::Generator::parse(text);
  if (!generator) {
    return fail(ErrorCode::kUsage, "'" + source.name_ + "': no such scene",
                "a file, or one of those that 'gnomon generate --list' names");
  }
  source.generator_ = std::make_shared<const fuzz::Generator>(std::move(*generator));
  return source;
}

void SceneSource::find_size_parameter() {
  if (family_->parameters.empty()) return;
  const GeneratorParameter& first = family_->parameters.front();
  if (parameters_.contains(first.name)) return;
  size_parameter_ = first.name;
  smallest_ = first.minimum;
  largest_ = first.maximum;
  constexpr std::int64_t kSome = 4;
  const auto few = of_parameter(smallest_, 1);
  const auto more = of_parameter(std::min(smallest_ + kSome, largest_), 1);
  if (!few || !more || few->polygons.size() >= more->polygons.size()) size_parameter_.clear();
}

Expected<Scene> SceneSource::of_parameter(std::int64_t value, std::uint64_t seed) const {
  std::map<std::string, std::int64_t> parameters = parameters_;
  parameters[size_parameter_] = value;
  return generate(family_->name, parameters, seed);
}

Expected<Scene> SceneSource::make(std::optional<std::uint64_t> polygons, std::uint64_t seed) const {
  if (scene_) return *scene_;
  if (generator_) return generator_->make(seed).scene;
  if (family_ == nullptr) {
    auto read = read_scene(name_, {});
    if (!read) return tl::unexpected(std::move(read.error()));
    return std::move(read->scene);
  }
  if (!polygons || !takes_size()) return generate(family_->name, parameters_, seed);
  Expected<Scene> best = of_parameter(smallest_, seed);
  if (!best || best->polygons.size() > *polygons) return best;
  // Twice as much until it is too much or grows no more, then halves of the gap.
  std::int64_t low = smallest_, high = largest_ + 1;
  for (std::int64_t step = 1; low + step < high; step *= 2) {
    Expected<Scene> next = of_parameter(low + step, seed);
    if (!next) return next;
    if (next->polygons.size() > *polygons) {
      high = low + step;
      break;
    }
    const bool grows = next->polygons.size() > best->polygons.size();
    low += step;
    best = std::move(next);
    if (!grows) break;
  }
  while (high <= largest_ && low + 1 < high) {
    const std::int64_t middle = low + (high - low) / 2;
    Expected<Scene> next = of_parameter(middle, seed);
    if (!next) return next;
    if (next->polygons.size() > *polygons) {
      high = middle;
    } else {
      low = middle;
      best = std::move(next);
    }
  }
  return best;
}

}  // namespace gnomon::comparison
