// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a kernel on a scene and hands its result to the oracle, by the translation that the command
// uses too; claims_test.cc holds that translation against a second one.
#ifndef GNOMON_TESTS_SUPPORT_SOLVE_H
#define GNOMON_TESTS_SUPPORT_SOLVE_H

#include <array>
#include <memory>
#include <string>

#include "fuzz/check/judged_scene.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::test {

/// A scene with its preparation and its exact answer; they refer to each other and stay where they
/// are.
class Case {
 public:
  /// Null, with the message in `why`, if the scene cannot be prepared.
  static std::unique_ptr<Case> make(Scene scene, std::string* why = nullptr);

  const Scene& scene() const { return scene_; }
  const PreparedScene& prepared() const { return prepared_; }
  const fuzz::JudgedScene& judged() const { return judged_; }
  const oracle::ExactAnswer& answer() const { return judged_.answer(); }
  bool is_area(std::uint32_t light) const { return prepared_.lights[light].has_area(); }

 private:
  Case(Scene scene, PreparedScene prepared)
      : scene_(std::move(scene)), prepared_(std::move(prepared)), judged_(scene_, prepared_) {}

  Scene scene_;
  PreparedScene prepared_;
  fuzz::JudgedScene judged_;
};

/// Options for a comparison: exact points, and exact fractions if the kernel has them.
ShadowOptions options_for(KernelId kernel);

/// What the result claims, without fractions. Requires: the result was computed with
/// keep_exact_points.
Claims claims_of(const Case& scene, const ShadowResult& result);

/// The lights of the result certified, with one thread, without tolerance (strict) or with the
/// default one.
oracle::Report judge(const Case& scene, const ShadowResult& result, bool strict = true);

/// A kernel with its policies, by name: "double@1e-12" (thickness), "double+identity@0", "epick",
/// "plane". Throws std::runtime_error for a name that is none.
ShadowOptions options_by_name(const std::string& name, MethodId algorithm);

inline constexpr std::array kAlgorithms = {MethodId::kSectors, MethodId::kSvbsp};
/// As in the table of methods.
std::string name_of(MethodId algorithm);
/// Sectors with cells so small that few polygons make a tree and many tasks.
ShadowOptions with_small_cells(ShadowOptions options);

/// The scene as JSON, for messages.
std::string text_of(const Scene& scene);

/// <name>.json of any folder of tests/regressions. Throws std::runtime_error if it cannot be read.
Scene regression_scene(const std::string& name);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_SOLVE_H
