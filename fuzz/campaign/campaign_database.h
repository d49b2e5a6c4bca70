// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign's memory in SQLite. Everything that belongs to a set of cases is written in one
// transaction, so that a process that is killed leaves whole cases or nothing.
#ifndef GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_DATABASE_H
#define GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_DATABASE_H

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/campaign/campaign.h"

namespace gnomon::fuzz {

/// Whole numbers as disjoint ranges that do not touch.
class RangeSet {
 public:
  void add(std::uint64_t first, std::uint64_t last);
  bool has(std::uint64_t value) const;
  /// The smallest number that is at least `value` and not in the set.
  std::uint64_t next_outside(std::uint64_t value) const;
  std::uint64_t size() const;
  /// First to last.
  const std::map<std::uint64_t, std::uint64_t>& ranges() const { return ranges_; }
  /// A range that both have, if any: its first number and its last.
  const std::pair<const std::uint64_t, std::uint64_t>* common(const RangeSet& other) const;

 private:
  std::map<std::uint64_t, std::uint64_t> ranges_;
};

/// What a database holds, or is about to.
struct CampaignState {
  std::string plan;
  RangeSet done;
  CampaignTotals totals;
  std::map<std::string, std::map<std::uint64_t, CampaignFinding>> findings;  // signature, case

  /// Keeps the first `keep` cases of each signature. True if the finding is one of them.
  bool add(CampaignFinding finding, std::uint64_t keep);
};

/// A file that two processes cannot have at once. Throws SQLite::Exception, and std::runtime_error
/// with a sentence.
class CampaignDatabase {
 public:
  enum class Access : std::uint8_t { kRead, kWrite };
  /// Writing makes the file if there is none.
  CampaignDatabase(const std::string& path, Access access);
  ~CampaignDatabase();

  bool is_new() const { return is_new_; }
  CampaignState load();
  /// Writes all of it in one transaction.
  void save(const CampaignState& state);

 private:
  class Lock;
  void open(const std::string& path, Access access);

  std::unique_ptr<Lock> lock_;
  std::unique_ptr<SQLite::Database> database_;
  bool is_new_ = false;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_DATABASE_H
