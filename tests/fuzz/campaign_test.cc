// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign is the same however it is run: in one go, in pieces, in shards, killed and resumed.
#include "fuzz/campaign/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "fuzz/campaign/campaign_report.h"
#include "tests/support/test_directory.h"

namespace gnomon::fuzz {
namespace {

using testing::HasSubstr;

class CampaignTest : public testing::Test {
 protected:
  void SetUp() override {
    plan_.worker.generators = {"mix"};
    // A rounded kernel, so that there is something to find.
    plan_.worker.check.subjects = {*parse_subject("plane"), *parse_subject("float+thin")};
    plan_.worker.check.properties = {Property::kOracle};
  }

  std::string path(const std::string& name) const { return directory_.file(name); }

  CampaignRun run_of(std::string database, std::uint64_t count, unsigned jobs = 2) const {
    CampaignRun run;
    run.program = GNOMON_PROGRAM;
    run.database = std::move(database);
    run.count = count;
    run.jobs = jobs;
    return run;
  }
  /// All that must not depend on how it was run.
  static std::string figures(const CampaignOutcome& outcome) {
    report::StringSink sink;
    write_campaign_json(sink, "", outcome, false);
    return sink.text();
  }
  std::string ran(const CampaignRun& run) const {
    const auto outcome = run_campaign(plan_, run);
    return outcome ? figures(*outcome) : to_string(outcome.error());
  }

  const test::TestDirectory directory_;
  CampaignPlan plan_;
};

TEST(CaseSeed, IsDifferentForEachCase) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t index = 0; index < 100000; ++index) seeds.insert(case_seed(7, index));
  EXPECT_EQ(seeds.size(), 100000u);
  EXPECT_NE(case_seed(1, 0), case_seed(2, 0));
}

TEST_F(CampaignTest, DependsNeitherOnProcessesNorOnPieces) {
  const std::string whole = ran(run_of("", 40, 1));
  EXPECT_THAT(whole, HasSubstr("oracle:"));
  EXPECT_EQ(ran(run_of("", 40, 3)), whole);
  for (const std::uint64_t count : {7, 31, 40}) ran(run_of(path("pieces.db"), count));
  EXPECT_EQ(ran(run_of(path("pieces.db"), 40)), whole);
  const auto read = read_campaign(path("pieces.db"));
  ASSERT_TRUE(read);
  EXPECT_EQ(figures(*read), whole);
}

TEST_F(CampaignTest, ShardsMerge) {
  plan_.worker.check.subjects.pop_back();
  plan_.worker.check.properties = {Property::kRoundTrip};
  const std::uint64_t count = 2 * Shard::kBlock + 40;
  const std::string whole = ran(run_of("", count));
  CampaignRun run = run_of(path("0.db"), count);
  run.shard = {0, 2};
  ran(run);
  run.database = path("1.db");
  run.shard = {1, 2};
  ran(run);
  const auto merged = merge_campaigns(path("all.db"), {path("0.db"), path("1.db")});
  ASSERT_TRUE(merged) << to_string(merged.error());
  EXPECT_EQ(figures(*merged), whole);
  const auto again = merge_campaigns(path("all.db"), {path("1.db")});
  ASSERT_FALSE(again);
  EXPECT_THAT(to_string(again.error()), HasSubstr("1000 to 1999 are already there"));
}

TEST_F(CampaignTest, AnInterruptLosesNothing) {
  const std::string whole = ran(run_of("", 40));
  std::atomic<bool> stop = false;
  CampaignRun run = run_of(path("stopped.db"), 40);
  run.interrupted = &stop;
  run.found = [&](const CampaignFinding&) { stop = true; };
  const auto first = run_campaign(plan_, run);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->interrupted);
  EXPECT_LT(first->totals.cases, 40u);
  EXPECT_EQ(ran(run_of(path("stopped.db"), 40)), whole);
}

TEST_F(CampaignTest, AKillLosesNothing) {
  plan_.worker.check.subjects = {*parse_subject("plane")};
  const std::uint64_t count = 3000;
  const std::string database = path("killed.db");
  std::uint64_t done = 0;
  for (int kill = 0; kill < 3; ++kill) {
    const pid_t child = ::fork();
    if (child == 0) {
      (void)run_campaign(plan_, run_of(database, count));
      ::_exit(0);
    }
    // When something new is in the database, and more is under way.
    while (true) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      const auto growing = read_campaign(database);
      if (growing && growing->totals.cases > done) break;
      ASSERT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << "the campaign ended by itself";
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const auto read = read_campaign(database);
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_GT(read->totals.cases, done);
    EXPECT_EQ(read->totals.count("subject:plane"), read->totals.cases);
    EXPECT_EQ(read->totals.count("generator:mix"), read->totals.cases);
    done = read->totals.cases;
  }
  const std::string resumed = ran(run_of(database, done + 50));
  EXPECT_EQ(resumed, ran(run_of("", done + 50)));
}

TEST_F(CampaignTest, OneDatabaseOneCampaign) {
  ran(run_of(path("one.db"), 5));
  CampaignPlan other = plan_;
  other.seed = 2;
  const auto outcome = run_campaign(other, run_of(path("one.db"), 5));
  ASSERT_FALSE(outcome);
  EXPECT_THAT(to_string(outcome.error()), HasSubstr("another campaign"));
}

TEST_F(CampaignTest, WhatIsNoCampaignIsRefused) {
  const std::string text = path("text.db");
  std::ofstream(text) << "this is no database, and long enough to be seen as none\n";
  EXPECT_FALSE(read_campaign(text));
  EXPECT_FALSE(run_campaign(plan_, run_of(text, 5)));
  EXPECT_FALSE(read_campaign(path("missing.db")));
  EXPECT_FALSE(std::filesystem::exists(path("missing.db")));
}

}  // namespace
}  // namespace gnomon::fuzz
