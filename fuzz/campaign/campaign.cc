// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <fstream>
#include <set>
#include <utility>

#include "fuzz/campaign/campaign_database.h"
#include "fuzz/generate/generator.h"
#include "fuzz/workers/worker_pool.h"
#include "report/text/number_text.h"
#include "scene/base/text_hash.h"

namespace gnomon::fuzz {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kSaveInterval{1000};
constexpr std::chrono::seconds kRateWindow{3};

/// The mixer of splitmix64: a bijection of 64-bit words.
std::uint64_t mixed(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
  return word ^ (word >> 31);
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

tl::unexpected<Error> database_error(const std::exception& error) {
  return fail(ErrorCode::kFile, error.what());
}

CampaignOutcome outcome_of(const CampaignState& state) {
  CampaignOutcome outcome;
  outcome.totals = state.totals;
  for (const auto& [signature, cases] : state.findings) {
    for (const auto& [index, finding] : cases) outcome.findings.push_back(finding);
  }
  return outcome;
}

class Campaign {
 public:
  Campaign(const CampaignPlan& plan, const CampaignRun& run, std::vector<Generator> generators)
      : plan_(plan),
        run_(run),
        generators_(std::move(generators)),
        database_(run.database, CampaignDatabase::Access::kWrite),
        start_(Clock::now()),
        last_save_(start_) {}

  Expected<CampaignOutcome> run() {
    state_.plan = plan_.text();
    if (!database_.is_new()) {
      CampaignState found = database_.load();
      if (!found.plan.empty() && found.plan != state_.plan) {
        return fail(ErrorCode::kUsage,
                    run_.database + " is the database of another campaign: " + found.plan,
                    "the same options, or another --db");
      }
      found.plan = state_.plan;
      state_ = std::move(found);
    }
    earlier_seconds_ = state_.totals.seconds;
    database_.save(state_);
    next_ = 0;
    WorkerPool pool(worker_command(run_.program, plan_.worker), plan_.worker.limits.seconds,
                    std::max(1u, run_.jobs));
    WorkerPool::Callbacks callbacks;
    callbacks.next = [&] { return next_request(); };
    callbacks.answered = [&](const Request& request, const WorkerAnswer& answer) {
      // Whatever ends this program may have ended what was under way before; who goes on with the
      // campaign does the case again.
      if (is_interrupted() && !answer.report.failures.empty()) return;
      take(request.index, answer);
    };
    callbacks.tick = [&] {
      if (Clock::now() - last_save_ >= kSaveInterval) save();
      tell();
      return !is_interrupted();
    };
    const auto done = pool.run(callbacks);
    save();
    if (!done) return tl::unexpected(done.error());
    CampaignOutcome outcome = outcome_of(state_);
    outcome.interrupted = is_interrupted();
    outcome.missing_kinds = missing_kinds();
    return outcome;
  }

 private:
  bool is_interrupted() const { return run_.interrupted != nullptr && run_.interrupted->load(); }
  bool out_of_time() const { return run_.seconds && seconds_since(start_) >= *run_.seconds; }

  std::optional<Request> next_request() {
    if (out_of_time() || is_interrupted()) return std::nullopt;
    for (;;) {
      next_ = state_.done.next_outside(next_);
      if (run_.shard.has(next_)) break;
      next_ = (next_ / Shard::kBlock + 1) * Shard::kBlock;
    }
    if (run_.count && next_ >= *run_.count) return std::nullopt;
    const std::uint64_t index = next_++;
    const std::uint64_t seed = case_seed(plan_.seed, index);
    return case_request(index, seed, case_generator(seed, generators_.size()));
  }

  void take(std::uint64_t index, const WorkerAnswer& answer) {
    const std::uint64_t seed = case_seed(plan_.seed, index);
    const std::string& generator = generators_[case_generator(seed, generators_.size())].name();
    const CaseReport& report = answer.report;
    CampaignTotals& totals = state_.totals;
    state_.done.add(index, index);
    ++totals.cases;
    totals.digest += mixed(index ^ text_hash(report.digest));
    ++totals.counts["generator:" + generator];
    for (const std::uint16_t kind : answer.kinds) {
      ++totals.counts["kind:" + std::string(kinds()[kind].name)];
    }
    for (const std::string& subject : report.subjects) ++totals.counts["subject:" + subject];
    totals.counts["polygons"] += report.polygons;
    totals.counts["lights"] += report.lights;
    totals.counts["fragments"] += report.fragments;
    totals.counts["claims checked"] += report.claims_checked;
    if (report.area_lights > 0) ++totals.counts["cases with area lights"];
    if (report.area_lights < report.lights) ++totals.counts["cases with point lights"];
    if (!report.failures.empty()) ++totals.failing_cases;
    std::set<std::string> seen;
    for (const Failure& failure : report.failures) {
      const std::string signature = failure.signature();
      if (!seen.insert(signature).second) continue;
      ++totals.counts["failure:" + signature];
      CampaignFinding finding{signature, failure, index, seed, generator, answer.recipe, {}};
      if (state_.add(finding, run_.keep) && run_.found) run_.found(finding);
    }
    ++done_here_;
  }

  void save() {
    state_.totals.seconds = earlier_seconds_ + seconds_since(start_);
    database_.save(state_);
    last_save_ = Clock::now();
  }

  void tell() {
    if (!run_.progress) return;
    const Clock::time_point now = Clock::now();
    recent_.emplace_back(now, done_here_);
    while (now - recent_.front().first > kRateWindow) recent_.pop_front();
    CampaignProgress progress;
    progress.done = state_.totals.cases;
    progress.wanted = run_.count.value_or(0);
    progress.failing = state_.totals.failing_cases;
    progress.signatures = state_.findings.size();
    progress.seconds = seconds_since(start_);
    const double window = std::chrono::duration<double>(now - recent_.front().first).count();
    if (window > 0) {
      progress.cases_per_second = static_cast<double>(done_here_ - recent_.front().second) / window;
    }
    run_.progress(progress);
  }

  std::vector<std::string> missing_kinds() const {
    std::set<std::string> missing;
    for (const Generator& generator : generators_) {
      if (state_.totals.count("generator:" + generator.name()) < kCasesForAllKinds) continue;
      for (const std::uint16_t kind : generator.expected_kinds()) {
        const std::string name(kinds()[kind].name);
        if (state_.totals.count("kind:" + name) == 0) missing.insert(name);
      }
    }
    return {missing.begin(), missing.end()};
  }

  const CampaignPlan& plan_;
  const CampaignRun& run_;
  std::vector<Generator> generators_;
  CampaignDatabase database_;
  CampaignState state_;
  Clock::time_point start_, last_save_;
  double earlier_seconds_ = 0;
  std::uint64_t next_ = 0, done_here_ = 0;
  std::deque<std::pair<Clock::time_point, std::uint64_t>> recent_;
};

}  // namespace

std::uint64_t case_seed(std::uint64_t campaign_seed, std::uint64_t index) {
  return mixed(mixed(campaign_seed + 0x9e3779b97f4a7c15u) + index);
}

std::size_t case_generator(std::uint64_t seed, std::size_t generators) {
  return generators == 0 ? 0 : static_cast<std::size_t>(mixed(~seed) % generators);
}

std::uint64_t CampaignTotals::count(const std::string& name) const {
  const auto at = counts.find(name);
  return at == counts.end() ? 0 : at->second;
}

std::string CampaignPlan::text() const {
  std::string text = fmt::format("seed {}", seed);
  // The command line of its processes says all that matters; time and memory are the machine's.
  WorkerOptions options = worker;
  options.limits = {};
  for (const std::string& argument : worker_command("", options).arguments) text += ' ' + argument;
  return text;
}

Expected<CampaignOutcome> run_campaign(const CampaignPlan& plan, const CampaignRun& run) {
  std::vector<Generator> generators;
  for (const std::string& name : plan.worker.generators) {
    Expected<Generator> generator = Generator::parse(name);
    if (!generator) return tl::unexpected(generator.error());
    generators.push_back(std::move(*generator));
  }
  if (generators.empty()) return fail(ErrorCode::kUsage, "no generator", "at least one");
  try {
    return Campaign(plan, run, std::move(generators)).run();
  } catch (const std::exception& error) {
    return database_error(error);
  }
}

bool is_campaign(const std::string& path) {
  constexpr std::string_view kMagic = "SQLite format 3";
  std::ifstream file(path, std::ios::binary);
  std::string start(kMagic.size(), '\0');
  return file.read(start.data(), static_cast<std::streamsize>(start.size())) && start == kMagic;
}

Expected<CampaignOutcome> read_campaign(const std::string& database) {
  try {
    return outcome_of(CampaignDatabase(database, CampaignDatabase::Access::kRead).load());
  } catch (const std::exception& error) {
    return database_error(error);
  }
}

Expected<std::string> campaign_text(const std::string& database) {
  try {
    return CampaignDatabase(database, CampaignDatabase::Access::kRead).load().plan;
  } catch (const std::exception& error) {
    return database_error(error);
  }
}

Expected<void> set_finding_folder(const std::string& database, const CampaignFinding& finding) {
  try {
    CampaignDatabase file(database, CampaignDatabase::Access::kWrite);
    CampaignState state = file.load();
    const auto cases = state.findings.find(finding.signature);
    if (cases != state.findings.end()) {
      const auto at = cases->second.find(finding.case_index);
      if (at != cases->second.end()) at->second.folder = finding.folder;
    }
    file.save(state);
    return {};
  } catch (const std::exception& error) {
    return database_error(error);
  }
}

Expected<CampaignOutcome> merge_campaigns(const std::string& target,
                                          const std::vector<std::string>& sources) {
  try {
    // Enough for what shards keep together; each has thrown away what it did not.
    constexpr std::uint64_t kKeepAll = ~std::uint64_t{0};
    std::error_code ignored;
    CampaignDatabase file(target, CampaignDatabase::Access::kWrite);
    CampaignState state;
    if (!file.is_new()) state = file.load();
    for (const std::string& source : sources) {
      CampaignState shard = CampaignDatabase(source, CampaignDatabase::Access::kRead).load();
      if (state.plan.empty()) state.plan = shard.plan;
      if (shard.plan != state.plan) {
        return fail(ErrorCode::kUsage,
                    source + " is of another campaign: " + shard.plan + "; not of: " + state.plan,
                    "shards of one campaign");
      }
      if (const auto* common = shard.done.common(state.done)) {
        return fail(ErrorCode::kUsage,
                    fmt::format("{}: cases of {} to {} are already there", source, common->first,
                                common->second),
                    "shards that have no case in common");
      }
      for (const auto& [first, last] : shard.done.ranges()) state.done.add(first, last);
      for (const auto& [name, n] : shard.totals.counts) state.totals.counts[name] += n;
      state.totals.failing_cases += shard.totals.failing_cases;
      state.totals.digest += shard.totals.digest;
      state.totals.seconds += shard.totals.seconds;
      for (auto& [signature, cases] : shard.findings) {
        for (auto& [index, finding] : cases) state.add(std::move(finding), kKeepAll);
      }
    }
    state.totals.cases = state.done.size();
    file.save(state);
    return outcome_of(state);
  } catch (const std::exception& error) {
    return database_error(error);
  }
}

}  // namespace gnomon::fuzz
