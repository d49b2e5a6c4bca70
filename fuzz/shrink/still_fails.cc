// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/shrink/still_fails.h"

#include <algorithm>
#include <utility>

namespace gnomon::fuzz {

namespace {

std::string counted(std::uint64_t count, std::string_view one, std::string_view several) {
  return std::to_string(count) + ' ' + std::string(count == 1 ? one : several);
}

}  // namespace

CheckOptions narrowed(const CheckOptions& options, const Failure& failure) {
  CheckOptions own = options;
  own.properties = {failure.property};
  own.subjects.clear();
  if (failure.property == Property::kAgreement) {
    const auto first = std::ranges::find_if(options.subjects, &Subject::exact);
    if (first != options.subjects.end()) own.subjects.push_back(*first);
  }
  // Failures of preparation have a subject that is none of ours.
  for (const Subject& subject : options.subjects) {
    if (name_of(subject) == failure.subject &&
        std::ranges::find(own.subjects, subject) == own.subjects.end()) {
      own.subjects.push_back(subject);
    }
  }
  return own;
}

bool fails_alike(const CaseReport& report, const Failure& failure) {
  const bool blunder = failure.share >= kBlunderShare;
  return std::ranges::any_of(report.failures, [&](const Failure& own) {
    return own.alike(failure) && (own.share >= kBlunderShare) == blunder;
  });
}

StillFails fails_like(Failure failure, SceneChecker check) {
  return [failure = std::move(failure), check = std::move(check)](const Scene& scene) {
    return fails_alike(check(scene), failure);
  };
}

StillFails fails_like(const Failure& failure, const CheckOptions& options) {
  return fails_like(failure, [own = narrowed(options, failure)](const Scene& scene) {
    return check_scene(scene, own);
  });
}

std::string size_in_words(const SceneSize& size) {
  return counted(size.polygons, "polygon", "polygons") + ", " +
         counted(size.lights, "light", "lights") + ", " +
         counted(size.vertices, "vertex", "vertices") + ", " + counted(size.bits, "bit", "bits");
}

}  // namespace gnomon::fuzz
