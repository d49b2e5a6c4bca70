// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/judged_scene.h"

#include <utility>

#include "fuzz/mistakes/compute.h"
#include "report/sides/claims_of.h"

namespace gnomon::fuzz {

JudgedScene::JudgedScene(const Scene& scene, const PreparedScene& prepared)
    : scene_(scene),
      prepared_(prepared),
      answer_(scene, prepared),
      diagonal_(oracle::scene_diagonal(prepared)) {}

Classified JudgedScene::claim(ShadowResult result, const ShadowOptions& options,
                              std::string name) const {
  Classified classified;
  classified.result = std::move(result);
  classified.sides =
      report::classified_sides(prepared_, classified.result, options.output.exact_fractions);
  classified.claims =
      report::claims_of(scene_, prepared_, classified.result, classified.sides, std::move(name));
  return classified;
}

Expected<Classified> JudgedScene::classify(const ShadowOptions& options, std::string name,
                                           Mistake mistake) const {
  Expected<ShadowResult> result = compute_shadows(prepared_, options, mistake);
  if (!result) return tl::unexpected(result.error());
  return claim(std::move(*result), options, std::move(name));
}

Expected<oracle::Report> JudgedScene::judge(const Claims& claims,
                                            oracle::CertifyOptions options) const {
  options.threads = 1;
  return oracle::certify(answer_, claims, options);
}

Judged JudgedScene::classify_and_judge(const ShadowOptions& options, std::string name,
                                       const oracle::CertifyOptions& certify_options,
                                       Mistake mistake) const {
  Judged judged;
  Expected<Classified> classified = classify(options, std::move(name), mistake);
  if (!classified) {
    judged.refused = classified.error();
    return judged;
  }
  judged.classified = std::move(*classified);
  Expected<oracle::Report> report = judge(judged.classified->claims, certify_options);
  if (report) {
    judged.report = std::move(*report);
  } else {
    judged.unjudged = report.error();
  }
  return judged;
}

}  // namespace gnomon::fuzz
