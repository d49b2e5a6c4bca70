// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/campaign_findings.h"

#include <fmt/format.h>

#include <utility>

#include "cli/commands/isolated_check.h"
#include "cli/common/interrupt.h"
#include "fuzz/findings/finding.h"
#include "fuzz/generate/generator.h"
#include "fuzz/shrink/shrink.h"
#include "fuzz/shrink/still_fails.h"

namespace gnomon::cli {

namespace {

Expected<std::string> write_one(const fuzz::CampaignPlan& plan, const fuzz::CampaignFinding& found,
                                const FindingsOptions& options) {
  const auto generator = fuzz::Generator::parse(found.generator);
  if (!generator) return tl::unexpected(generator.error());
  fuzz::Finding finding;
  finding.original = generator->make(found.seed).scene;
  finding.failure = found.failure;
  finding.check = plan.worker.check;
  finding.check.seed = found.seed;
  finding.seconds = plan.worker.limits.seconds;
  finding.megabytes = plan.worker.limits.megabytes;
  finding.generator = found.generator;
  finding.recipe = found.recipe;
  finding.campaign_seed = plan.seed;
  finding.case_index = found.case_index;
  finding.case_seed = found.seed;
  options.say(fmt::format("case {} ({}) fails: {}\n  {}\n  {}", found.case_index, found.recipe,
                          found.signature, found.failure.text,
                          fuzz::size_in_words(fuzz::size_of(finding.original))));

  const IsolatedCheck check(options.program, fuzz::narrowed(finding.check, finding.failure),
                            plan.worker.limits);
  const fuzz::StillFails alike = fuzz::fails_like(finding.failure, check);
  // A check that was cut short says nothing.
  const auto fails = [&](const Scene& scene) { return alike(scene) && !interrupted(); };
  if (fails(finding.original)) {
    fuzz::ShrinkOptions shrinking;
    shrinking.simpler = generator->with_fewer_moves(found.seed);
    shrinking.interrupted = &interrupted();
    shrinking.seconds = options.seconds;
    shrinking.progress = [&](const fuzz::ShrinkProgress& progress) {
      if (options.progress) {
        options.progress(fmt::format("shrink case {}: {}; {} tries", found.case_index,
                                     fuzz::size_in_words(progress.size), progress.tries));
      }
    };
    fuzz::ShrinkResult result = fuzz::shrink(finding.original, fails, shrinking);
    finding.scene = std::move(result.scene);
    finding.locally_minimal = result.locally_minimal;
  } else {
    finding.scene = finding.original;
  }
  // Not the half of it: the next run does it again.
  if (interrupted()) return fail(ErrorCode::kInterrupted, "interrupted");
  if (check.error()) return tl::unexpected(*check.error());
  const auto place = fuzz::write_finding(options.folder, finding);
  if (!place) return tl::unexpected(place.error());
  options.say(fmt::format("  {}: {}{}", place->string(),
                          fuzz::size_in_words(fuzz::size_of(finding.scene)),
                          finding.locally_minimal ? ", locally minimal" : ""));
  return place->string();
}

}  // namespace

Expected<void> write_campaign_findings(const fuzz::CampaignPlan& plan,
                                       fuzz::CampaignOutcome& outcome,
                                       const FindingsOptions& options) {
  for (fuzz::CampaignFinding& found : outcome.findings) {
    // What took down a process that made it cannot be made here.
    if (!found.folder.empty() || found.failure.subject == "generator") continue;
    auto place = write_one(plan, found, options);
    if (!place) return tl::unexpected(place.error());
    found.folder = std::move(*place);
    if (options.database.empty()) continue;
    if (auto done = fuzz::set_finding_folder(options.database, found); !done) return done;
  }
  return {};
}

}  // namespace gnomon::cli
