// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/subject.h"

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::fuzz {

namespace {

constexpr std::string_view kCommandPrefix = "command:";
/// Adds the method of that name, with its options, to a subject. Errors: kUsage; `kind` says of
/// which lights it has to be a method.
Expected<void> add_method(Subject& subject, LightKinds lights, std::string_view text,
                          const std::string& whole, std::string_view kind) {
  const std::string_view name = text.substr(0, text.find(':'));
  const Domain domain = lights.point && method_by_name(name, Domain::kImageSpace)
                            ? Domain::kImageSpace
                            : Domain::kObjectSpace;
  const std::optional<MethodId> id = method_by_name(name, domain);
  const LightKinds takes = id ? method_info(*id).lights : LightKinds{};
  if (!(lights.point && takes.point) && !(lights.area && takes.area)) {
    return fail(ErrorCode::kUsage,
                "'" + whole + "': no such algorithm for " + std::string(kind) + " lights",
                "one of: " + method_names(lights) +
                    (lights.point ? ", " + method_names(lights, Domain::kImageSpace) : ""));
  }
  const auto selection = parse_method(text, domain);
  if (!selection) return tl::unexpected(selection.error());
  (lights.area ? subject.area_algorithm : subject.algorithm) = *id;
  if (name.size() != text.size()) subject.options = selection->values;
  return {};
}

/// A mistake that its kernel and its algorithms cannot make would be looked for in vain.
Expected<void> check_mistake(const Subject& subject, const std::string& whole) {
  const std::string mistake(name_of(subject.mistake));
  if (subject.mistake == Mistake::kTVerticesLeftIn) {
    return fail(ErrorCode::kUsage, "'" + whole + "': " + mistake + " is a mistake of meshes",
                "a mistake of shadows; --zoo looks for this one");
  }
  if (subject.mistake == Mistake::kThicknessTooSmall && subject.kernel.thin) {
    return fail(ErrorCode::kUsage, "'" + whole + "': its planes have no thickness anyway",
                "a kernel without +thin");
  }
  if (subject.mistake == Mistake::kCombinedBitLost && subject.options.merge != MergeOf::kConvex) {
    return fail(ErrorCode::kUsage, "'" + whole + "': " + mistake + " is a mistake of merging",
                "svbsp:merge=convex");
  }
  if (subject.mistake == Mistake::kHiddenDepthStrict &&
      subject.options.depth != TableDepth::kHidden) {
    return fail(ErrorCode::kUsage, "'" + whole + "': " + mistake + " is a mistake of hidden faces",
                "ridge-edges:depth=hidden");
  }
  const KernelId kernel = subject.kernel.kernel;
  // A picture has no area lights.
  const bool has_areas = method_info(subject.algorithm).domain != Domain::kImageSpace;
  if (!applies_to(subject.mistake, kernel, subject.algorithm) &&
      !(has_areas && applies_to_area(subject.mistake, kernel, subject.area_algorithm))) {
    return fail(ErrorCode::kUsage, "'" + whole + "': " + mistake + " changes nothing there",
                "a kernel and an algorithm that it applies to (docs/bug-zoo.md)");
  }
  return {};
}

}  // namespace

std::string name_of(const Subject& subject) {
  if (subject.foreign()) return std::string(kCommandPrefix) + subject.command;
  std::string name = subject.kernel.name();
  const bool usual_area = subject.area_algorithm == MethodId::kReceiver;
  if (subject.algorithm != MethodId::kSectors || !usual_area) {
    name += '/' + method_text(subject.algorithm, subject.options);
  }
  if (!usual_area) name += '/' + method_text(subject.area_algorithm, subject.options);
  if (subject.mistake != Mistake::kNone) name += '~' + std::string(name_of(subject.mistake));
  return name;
}

Expected<Subject> parse_subject(std::string_view text) {
  const std::string whole(text);
  Subject subject;
  if (text.starts_with(kCommandPrefix)) {
    subject.command = text.substr(kCommandPrefix.size());
    if (subject.command.empty()) return fail(ErrorCode::kUsage, "an empty command", "a program");
    return subject;
  }
  if (const std::size_t at = text.find('~'); at != std::string_view::npos) {
    const auto mistake = mistake_by_name(text.substr(at + 1));
    if (!mistake) {
      std::string names;
      for (const MistakeInfo& info : mistakes()) {
        names += (names.empty() ? "" : ", ") + std::string(info.name);
      }
      return fail(ErrorCode::kUsage, "'" + whole + "': no such mutation", "one of: " + names);
    }
    subject.mistake = *mistake;
    text = text.substr(0, at);
  }
  std::array<std::string_view, 2> algorithms;
  std::size_t slash = text.find('/');
  std::string_view rest = slash == std::string_view::npos ? "" : text.substr(slash + 1);
  if (slash != std::string_view::npos) {
    text = text.substr(0, slash);
    slash = rest.find('/');
    algorithms[0] = rest.substr(0, slash);
    if (slash != std::string_view::npos) algorithms[1] = rest.substr(slash + 1);
    if (algorithms[0].empty() || (slash != std::string_view::npos && algorithms[1].empty())) {
      return fail(ErrorCode::kUsage, "'" + whole + "': an algorithm is missing after '/'",
                  "KERNEL/ALGORITHM/AREA-ALGORITHM");
    }
  }
  const auto kernel = parse_kernel_choice(text);
  if (!kernel) return tl::unexpected(kernel.error());
  subject.kernel = *kernel;
  if (!algorithms[0].empty()) {
    const auto added = add_method(subject, {.point = true}, algorithms[0], whole, "point");
    if (!added) return tl::unexpected(added.error());
  }
  if (!algorithms[1].empty()) {
    const auto added = add_method(subject, {.area = true}, algorithms[1], whole, "area");
    if (!added) return tl::unexpected(added.error());
  }
  if (const auto checked = check_mistake(subject, whole); !checked) {
    return tl::unexpected(checked.error());
  }
  return subject;
}

bool combines(const Subject& subject, const Scene& scene) {
  constexpr std::size_t kMostLights = 64;
  const bool is_sound = subject.mistake == Mistake::kNone || is_of_lights_together(subject.mistake);
  if (subject.foreign() || !is_sound || scene.lights.size() > kMostLights) return false;
  // Lights of any kind beside an area light are combined by its method.
  const bool area = std::ranges::any_of(scene.lights, &Light::has_area);
  return method_info(area ? subject.area_algorithm : subject.algorithm).combines_lights &&
         subject.options.cover == Cover::kPartition;
}

ShadowOptions shadow_options(const Subject& subject) {
  ShadowOptions options;
  options.kernel.id = subject.kernel.kernel;
  options.kernel.identity = subject.kernel.identity;
  if (subject.kernel.thin) options.kernel.thickness = 0;
  options.method.point = subject.algorithm;
  options.method.area = subject.area_algorithm;
  options.method.options = subject.options;
  options.tuning.jobs = 1;
  options.output.exact_points = true;
  options.output.exact_fractions = subject.kernel.exact();
  return options;
}

}  // namespace gnomon::fuzz
