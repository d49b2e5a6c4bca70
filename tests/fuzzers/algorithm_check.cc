// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithm_check.h"

#include "fuzz/check/check.h"
#include "fuzz/generate/scene_code.h"
#include "gnomon/scene/prepare.h"
#include "harness.h"

namespace gnomon::fuzzers {

namespace {

void check_subjects(const Scene& scene, std::vector<fuzz::Subject> subjects,
                    std::vector<fuzz::Property> properties, std::uint64_t seed) {
  fuzz::CheckOptions options;
  options.subjects = std::move(subjects);
  options.properties = std::move(properties);
  options.seed = seed;
  const fuzz::CaseReport report = fuzz::check_scene(scene, options);
  if (!report.failures.empty()) {
    broken(report.failures[0].signature() + ": " + report.failures[0].text);
  }
}

}  // namespace

void check_algorithms(const Scene& scene, std::initializer_list<std::string_view> subjects,
                      std::initializer_list<std::string_view> rounded, std::uint64_t seed) {
  if (scene.lights.empty() || scene.polygons.empty()) return;
  const auto prepared = prepare(scene);
  if (!prepared) return check_error(prepared.error(), scene.file, {}, false);
  if (prepared->parts.empty()) return;

  // The oracle judges the first alone; the others must have the same fractions.
  std::vector<fuzz::Subject> all;
  for (const std::string_view name : subjects) all.push_back(*fuzz::parse_subject(name));
  check_subjects(scene, {all[0]}, {}, seed);
  check_subjects(scene, all, {fuzz::Property::kAgreement}, seed);
  for (const std::string_view name : rounded) {
    ShadowOptions rounded_options = fuzz::shadow_options(*fuzz::parse_subject(name));
    rounded_options.limits.fragments = 5'000;
    const auto result = compute_shadows(*prepared, rounded_options);
    if (!result) {
      require(result.error().code == ErrorCode::kLimit,
              std::string(name) + " refuses: " + to_string(result.error()));
    }
  }
}

void check_code(const Scene& scene) {
  const auto code = fuzz::code_of_scene(scene);
  if (!code) return;
  const std::string what = difference(scene, fuzz::scene_from_code(*code));
  require(what.empty(), "the code of a scene is of another: " + what);
}

}  // namespace gnomon::fuzzers
