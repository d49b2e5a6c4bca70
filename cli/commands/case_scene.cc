// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/case_scene.h"

#include <algorithm>
#include <set>

#include "fuzz/check/judged_scene.h"
#include "fuzz/check/subject.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/digest.h"
#include "report/json/result_json.h"
#include "report/page/scene_view.h"
#include "report/sides/claims_of.h"

namespace gnomon::cli {

namespace {

/// The subject may not come back, or not alone.
bool is_dangerous(const fuzz::Failure& failure) {
  return failure.property == fuzz::Property::kCrash || failure.property == fuzz::Property::kBudget;
}

}  // namespace

CaseScene::CaseScene(const Scene& scene, std::span<const fuzz::Failure> failures) : scene_(scene) {
  auto prepared = prepare(scene_);
  if (!prepared || prepared->parts.size() > kMostParts) return;
  prepared_ = *std::move(prepared);
  shown_ = true;
  std::set<std::string> dangerous, failing;
  for (const fuzz::Failure& failure : failures) {
    (is_dangerous(failure) ? dangerous : failing).insert(failure.subject);
  }
  if (dangerous.empty()) add_exact();
  for (const std::string& subject : failing) {
    if (!dangerous.contains(subject)) add_subject(subject);
  }
}

void CaseScene::add_exact() {
  if (prepared_.lights.empty()) return;
  ShadowOptions options;
  options.output.points = true;
  fuzz::thrown_by([&] {
    auto result = compute_shadows(prepared_, options);
    if (!result) return;
    answers_.push_back(report::claims_of(scene_, prepared_, *result, "exact", false));
    result_ = *std::move(result);
  });
}

void CaseScene::add_subject(const std::string& name) {
  const auto subject = fuzz::parse_subject(name);
  if (!subject || subject->foreign()) return;
  fuzz::thrown_by([&] {
    const fuzz::JudgedScene judged(scene_, prepared_);
    auto classified = judged.classify(fuzz::shadow_options(*subject), name, subject->mistake);
    if (classified) answers_.push_back(std::move(classified->claims));
  });
}

void CaseScene::write_view(report::TextSink& sink) const {
  std::vector<report::ViewLayer> layers;
  for (const Claims& answer : answers_) {
    for (const ClaimedLight& light : answer.lights) layers.push_back({answer.name, &light});
  }
  report::write_scene_view(sink, scene_, prepared_, layers);
}

void CaseScene::write_result(report::TextSink& sink) const {
  report::ResultJsonOptions shares;
  shares.geometry_digest = geometry_digest(scene_);
  report::write_result_json(sink, scene_, prepared_, *result_, shares);
}

}  // namespace gnomon::cli
