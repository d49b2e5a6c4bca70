// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign: numbered scenes made by seeds, checked by several processes, and remembered in a
// database, so that it can be stopped at any time, by whatever means, and goes on where it was.
//
// Guarantees: case i of a campaign is the same scene and the same check wherever and whenever it
// runs; different cases have different seeds (a bijection of 64-bit words); no case counts twice,
// and none is lost that the database has taken in; what a campaign found does not depend on the
// number of processes, on interruptions or on shards.
#ifndef GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_H
#define GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_H

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/workers/worker.h"
#include "gnomon/kernel/error.h"

namespace gnomon::fuzz {

/// The seed of a case: for one campaign seed a bijection, so that no two cases share one.
std::uint64_t case_seed(std::uint64_t campaign_seed, std::uint64_t index);
/// Which of `generators` generators makes it.
std::size_t case_generator(std::uint64_t seed, std::size_t generators);

/// What a campaign is: changing any of it makes another campaign.
struct CampaignPlan {
  std::uint64_t seed = 1;
  WorkerOptions worker;
  std::string text() const;  // all of it, one line, stable
};

/// Shard `index` of `count`: blocks of so many cases in turn.
struct Shard {
  static constexpr std::uint64_t kBlock = 1000;
  std::uint64_t index = 0, count = 1;
  bool has(std::uint64_t case_index) const { return case_index / kBlock % count == index; }
};

struct CampaignFinding {
  std::string signature;  // Failure::signature()
  Failure failure;
  std::uint64_t case_index = 0, seed = 0;
  std::string generator, recipe;
  std::string folder;  // where it was written; empty: not yet
};

/// Sums over all cases done.
struct CampaignTotals {
  std::uint64_t cases = 0, failing_cases = 0;
  // By name: "kind:lattice", "subject:plane", "failure:SIGNATURE", "generator:mix", "polygons", ...
  std::map<std::string, std::uint64_t> counts;
  std::uint64_t digest = 0;  // of all answers, whatever their order
  double seconds = 0;        // of the clock, over all runs
  std::uint64_t count(const std::string& name) const;
};

struct CampaignProgress {
  std::uint64_t done = 0, wanted = 0;  // wanted 0: no end but the time
  std::uint64_t failing = 0, signatures = 0;
  double seconds = 0;           // of this run
  double cases_per_second = 0;  // of the last seconds
};

struct CampaignRun {
  std::string program;                 // the gnomon command
  std::string database;                // empty: in memory
  std::optional<std::uint64_t> count;  // cases of the whole campaign; none: until the time is over
  std::optional<double> seconds;       // of this run
  unsigned jobs = 1;
  Shard shard;
  std::uint64_t keep = 3;  // findings kept of each signature; the others are counted
  std::function<void(const CampaignProgress&)> progress;
  /// Told once for each finding that is kept, when it is found.
  std::function<void(const CampaignFinding&)> found;
  const std::atomic<bool>* interrupted = nullptr;
};

struct CampaignOutcome {
  CampaignTotals totals;
  std::vector<CampaignFinding> findings;  // by signature, then by case
  bool interrupted = false;
  std::vector<std::string> missing_kinds;  // expected of these generators, and never made
};

/// A campaign of so many scenes must have made every kind that its generator promises.
inline constexpr std::uint64_t kCasesForAllKinds = 1000;

/// Runs what is left of a campaign. Errors: kUsage (the database is another campaign's, or in use),
/// kFile.
Expected<CampaignOutcome> run_campaign(const CampaignPlan& plan, const CampaignRun& run);

/// The file begins as a database does.
bool is_campaign(const std::string& path);

/// What a database holds. Errors: kFile (no campaign database).
Expected<CampaignOutcome> read_campaign(const std::string& database);
/// The plan's text in a database.
Expected<std::string> campaign_text(const std::string& database);
/// Notes where a finding was written.
Expected<void> set_finding_folder(const std::string& database, const CampaignFinding& finding);

/// Adds shards to `target`, which may be new. Errors: kUsage (other campaigns; the same cases in
/// two), kFile. Nothing is changed if there is an error.
Expected<CampaignOutcome> merge_campaigns(const std::string& target,
                                          const std::vector<std::string>& sources);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_H
