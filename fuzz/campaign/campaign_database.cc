// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/campaign/campaign_database.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace gnomon::fuzz {

namespace {

constexpr int kApplicationId = 0x474e4d4e;  // "GNMN"
constexpr int kVersion = 1;
constexpr const char* kSchema = R"(
CREATE TABLE campaign(plan TEXT NOT NULL);
CREATE TABLE done(first INTEGER PRIMARY KEY, last INTEGER NOT NULL CHECK(last >= first));
CREATE TABLE counts(name TEXT PRIMARY KEY, n INTEGER NOT NULL) WITHOUT ROWID;
CREATE TABLE findings(signature TEXT NOT NULL, case_index INTEGER NOT NULL, seed INTEGER NOT NULL,
                      generator TEXT NOT NULL, recipe TEXT NOT NULL, failure TEXT NOT NULL,
                      folder TEXT NOT NULL, PRIMARY KEY(signature, case_index)) WITHOUT ROWID;
)";

// SQLite's integers have a sign; the bits stay.
std::int64_t stored(std::uint64_t value) { return static_cast<std::int64_t>(value); }
std::uint64_t loaded(const SQLite::Column& column) {
  return static_cast<std::uint64_t>(column.getInt64());
}

}  // namespace

void RangeSet::add(std::uint64_t first, std::uint64_t last) {
  auto at = ranges_.upper_bound(first);
  if (at != ranges_.begin()) {
    const auto before = std::prev(at);
    if (before->second + 1 >= first) {
      first = before->first;
      last = std::max(last, before->second);
      at = ranges_.erase(before);
    }
  }
  while (at != ranges_.end() && at->first <= last + 1) {
    last = std::max(last, at->second);
    at = ranges_.erase(at);
  }
  ranges_.emplace(first, last);
}

bool RangeSet::has(std::uint64_t value) const { return next_outside(value) != value; }

std::uint64_t RangeSet::next_outside(std::uint64_t value) const {
  const auto at = ranges_.upper_bound(value);
  if (at == ranges_.begin()) return value;
  const std::uint64_t last = std::prev(at)->second;
  return last >= value ? last + 1 : value;
}

std::uint64_t RangeSet::size() const {
  std::uint64_t all = 0;
  for (const auto& [first, last] : ranges_) all += last - first + 1;
  return all;
}

const std::pair<const std::uint64_t, std::uint64_t>* RangeSet::common(const RangeSet& other) const {
  for (const auto& range : ranges_) {
    const auto after = other.ranges_.upper_bound(range.second);
    if (after != other.ranges_.begin() && std::prev(after)->second >= range.first) return &range;
  }
  return nullptr;
}

bool CampaignState::add(CampaignFinding finding, std::uint64_t keep) {
  auto& own = findings[finding.signature];
  const std::uint64_t index = finding.case_index;
  own.emplace(index, std::move(finding));
  while (own.size() > keep) own.erase(std::prev(own.end()));
  return own.contains(index);
}

/// Beside the database, since SQLite's own locks are given up whenever any descriptor of the file
/// is closed.
class CampaignDatabase::Lock {
 public:
  explicit Lock(const std::string& path) : path_(path + "-lock") {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw std::runtime_error(path_ + ": " + std::strerror(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw std::runtime_error(path + " is in use by another campaign");
    }
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
  ~Lock() {
    ::unlink(path_.c_str());
    ::close(descriptor_);
  }

 private:
  std::string path_;
  int descriptor_ = -1;
};

CampaignDatabase::CampaignDatabase(const std::string& path, Access access) {
  try {
    open(path, access);
  } catch (const SQLite::Exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

void CampaignDatabase::open(const std::string& path, Access access) {
  const bool in_memory = path.empty();
  const bool writes = access == Access::kWrite;
  if (!in_memory && writes) lock_ = std::make_unique<Lock>(path);
  std::error_code ignored;
  const auto size = in_memory ? 0 : std::filesystem::file_size(path, ignored);
  is_new_ = in_memory || ignored || size == 0;
  if (!writes && is_new_) throw std::runtime_error(path + ": there is no campaign in it");
  // A campaign that was killed leaves a log behind that only a writer may take in.
  database_ = std::make_unique<SQLite::Database>(
      in_memory ? ":memory:" : path, SQLite::OPEN_READWRITE | (writes ? SQLite::OPEN_CREATE : 0),
      2000);
  if (is_new_) {
    database_->exec("PRAGMA journal_mode = WAL");
    SQLite::Transaction transaction(*database_);
    database_->exec("PRAGMA application_id = " + std::to_string(kApplicationId));
    database_->exec("PRAGMA user_version = " + std::to_string(kVersion));
    database_->exec(kSchema);
    transaction.commit();
  } else {
    const auto pragma = [&](const char* name) {
      return database_->execAndGet(std::string("PRAGMA ") + name).getInt();
    };
    if (pragma("application_id") != kApplicationId) {
      throw std::runtime_error(path + ": a database, but not of a campaign");
    }
    if (pragma("user_version") != kVersion) {
      throw std::runtime_error(path + ": of version " + std::to_string(pragma("user_version")) +
                               ", and this program knows " + std::to_string(kVersion));
    }
  }
  // With a write-ahead log this is safe against a killed process; a power cut may cost the last
  // second.
  database_->exec("PRAGMA synchronous = NORMAL");
}

CampaignDatabase::~CampaignDatabase() {
  // The log is taken in and goes away before the lock does.
  database_.reset();
}

CampaignState CampaignDatabase::load() {
  CampaignState state;
  SQLite::Transaction transaction(*database_);  // one moment of a campaign that may be running
  SQLite::Statement plan(*database_, "SELECT plan FROM campaign");
  if (plan.executeStep()) state.plan = plan.getColumn(0).getString();
  SQLite::Statement done(*database_, "SELECT first, last FROM done");
  while (done.executeStep()) state.done.add(loaded(done.getColumn(0)), loaded(done.getColumn(1)));
  SQLite::Statement counts(*database_, "SELECT name, n FROM counts");
  while (counts.executeStep()) {
    state.totals.counts[counts.getColumn(0).getString()] = loaded(counts.getColumn(1));
  }
  const auto take = [&](const char* name) {
    const std::uint64_t n = state.totals.count(name);
    state.totals.counts.erase(name);
    return n;
  };
  state.totals.failing_cases = take("failing cases");
  state.totals.digest = take("digest");
  state.totals.seconds = static_cast<double>(take("milliseconds")) / 1000;
  state.totals.cases = state.done.size();
  SQLite::Statement findings(*database_,
                             "SELECT signature, case_index, seed, generator, recipe, failure, "
                             "folder FROM findings");
  while (findings.executeStep()) {
    CampaignFinding finding;
    finding.signature = findings.getColumn(0).getString();
    finding.case_index = loaded(findings.getColumn(1));
    finding.seed = loaded(findings.getColumn(2));
    finding.generator = findings.getColumn(3).getString();
    finding.recipe = findings.getColumn(4).getString();
    const Expected<Failure> failure = parse_failure(findings.getColumn(5).getString());
    if (!failure) throw std::runtime_error("a finding that cannot be read");
    finding.failure = *failure;
    finding.folder = findings.getColumn(6).getString();
    state.findings[finding.signature].emplace(finding.case_index, finding);
  }
  return state;
}

void CampaignDatabase::save(const CampaignState& state) {
  SQLite::Transaction transaction(*database_, SQLite::TransactionBehavior::IMMEDIATE);
  database_->exec("DELETE FROM campaign; DELETE FROM done; DELETE FROM findings");
  SQLite::Statement plan(*database_, "INSERT INTO campaign VALUES(?)");
  plan.bind(1, state.plan);
  plan.exec();
  SQLite::Statement done(*database_, "INSERT INTO done VALUES(?, ?)");
  for (const auto& [first, last] : state.done.ranges()) {
    done.bind(1, stored(first));
    done.bind(2, stored(last));
    done.exec();
    done.reset();
  }
  SQLite::Statement count(*database_, "INSERT OR REPLACE INTO counts VALUES(?, ?)");
  const auto write = [&](const std::string& name, std::uint64_t n) {
    count.bind(1, name);
    count.bind(2, stored(n));
    count.exec();
    count.reset();
  };
  for (const auto& [name, n] : state.totals.counts) write(name, n);
  write("failing cases", state.totals.failing_cases);
  write("digest", state.totals.digest);
  write("milliseconds", static_cast<std::uint64_t>(state.totals.seconds * 1000));
  SQLite::Statement row(*database_, "INSERT INTO findings VALUES(?, ?, ?, ?, ?, ?, ?)");
  for (const auto& [signature, cases] : state.findings) {
    for (const auto& [index, finding] : cases) {
      row.bind(1, signature);
      row.bind(2, stored(index));
      row.bind(3, stored(finding.seed));
      row.bind(4, finding.generator);
      row.bind(5, finding.recipe);
      row.bind(6, failure_text(finding.failure));
      row.bind(7, finding.folder);
      row.exec();
      row.reset();
    }
  }
  transaction.commit();
}

}  // namespace gnomon::fuzz
