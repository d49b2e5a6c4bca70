// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/year_database.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <utility>

namespace gnomon::cli {

namespace {

constexpr int kApplicationId = 0x476e7972, kVersion = 1;
constexpr double kSecondsBetweenFlushes = 1;

tl::unexpected<Error> failed(const std::string& file, const std::string& what) {
  return fail(ErrorCode::kFile, file + ": " + what);
}

/// The first line in which two texts differ, as "was A, is B".
std::string difference(const std::string& was, const std::string& is) {
  std::istringstream of_file(was), of_this(is);
  std::string a, b;
  while (std::getline(of_file, a), std::getline(of_this, b)) {
    if (a != b) return a + " there, " + b + " here";
  }
  return "another kind of year";
}

}  // namespace

YearDatabase::YearDatabase() = default;
YearDatabase::YearDatabase(YearDatabase&&) noexcept = default;
YearDatabase& YearDatabase::operator=(YearDatabase&&) noexcept = default;

YearDatabase::~YearDatabase() {
  if (database_ == nullptr) return;
  // What cannot be written any more was told by put() or is lost with the disk.
  static_cast<void>(flush());
}

Expected<YearDatabase> YearDatabase::open(const std::string& file, const std::string& identity) {
  YearDatabase result;
  result.file_ = file;
  try {
    result.database_ = std::make_unique<SQLite::Database>(
        file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, 2000);
    SQLite::Database& database = *result.database_;
    const auto pragma = [&](const char* name) {
      return database.execAndGet(std::string("PRAGMA ") + name).getInt();
    };
    const bool is_new = pragma("page_count") == 0;
    if (!is_new &&
        (pragma("application_id") != kApplicationId || pragma("user_version") != kVersion)) {
      return failed(file, "a database, but not of a year, or of another version");
    }
    if (is_new) {
      database.exec("PRAGMA journal_mode = WAL");
      SQLite::Transaction transaction(database);
      database.exec("PRAGMA application_id = " + std::to_string(kApplicationId));
      database.exec("PRAGMA user_version = " + std::to_string(kVersion));
      database.exec("CREATE TABLE year(identity TEXT NOT NULL)");
      database.exec("CREATE TABLE rows(row INTEGER PRIMARY KEY, lit BLOB NOT NULL)");
      SQLite::Statement insert(database, "INSERT INTO year VALUES(?)");
      insert.bind(1, identity);
      insert.exec();
      transaction.commit();
    }
    database.exec("PRAGMA synchronous = NORMAL");
    const std::string known = database.execAndGet("SELECT identity FROM year").getString();
    if (known != identity) {
      return fail(ErrorCode::kUsage, file + " holds another year: " + difference(known, identity),
                  "the same scene and options, or another file");
    }
  } catch (const SQLite::Exception& error) {
    return failed(file, error.what());
  }
  return result;
}

Expected<std::vector<std::size_t>> YearDatabase::rows() const {
  try {
    std::vector<std::size_t> rows;
    SQLite::Statement select(*database_, "SELECT row FROM rows ORDER BY row");
    while (select.executeStep()) {
      rows.push_back(static_cast<std::size_t>(select.getColumn(0).getInt64()));
    }
    return rows;
  } catch (const SQLite::Exception& error) {
    return failed(file_, error.what());
  }
}

Expected<void> YearDatabase::put(std::size_t row, std::span<const double> lit) {
  try {
    if (transaction_ == nullptr) {
      transaction_ = std::make_unique<SQLite::Transaction>(*database_);
      since_flush_.lap();
    }
    SQLite::Statement insert(*database_, "INSERT OR REPLACE INTO rows VALUES(?, ?)");
    insert.bind(1, static_cast<std::int64_t>(row));
    insert.bind(2, lit.data(), static_cast<int>(lit.size_bytes()));
    insert.exec();
  } catch (const SQLite::Exception& error) {
    return failed(file_, error.what());
  }
  Stopwatch since = since_flush_;
  return since.lap().elapsed < kSecondsBetweenFlushes ? Expected<void>() : flush();
}

Expected<void> YearDatabase::flush() {
  try {
    if (transaction_ != nullptr) transaction_->commit();
    transaction_.reset();
    return {};
  } catch (const SQLite::Exception& error) {
    return failed(file_, error.what());
  }
}

Expected<std::vector<double>> YearDatabase::get(std::size_t row) const {
  try {
    SQLite::Statement select(*database_, "SELECT lit FROM rows WHERE row = ?");
    select.bind(1, static_cast<std::int64_t>(row));
    if (!select.executeStep()) return failed(file_, "row " + std::to_string(row) + " is missing");
    const SQLite::Column column = select.getColumn(0);
    const auto bytes = static_cast<std::size_t>(column.getBytes());
    std::vector<double> lit(bytes / sizeof(double));
    if (!lit.empty()) std::memcpy(lit.data(), column.getBlob(), lit.size() * sizeof(double));
    return lit;
  } catch (const SQLite::Exception& error) {
    return failed(file_, error.what());
  }
}

Expected<void> YearDatabase::merge(const std::string& file, const std::string& identity) {
  try {
    // Opened for reading alone, so that a name that is wrong makes no file.
    SQLite::Database(file, SQLite::OPEN_READONLY).execAndGet("SELECT count(*) FROM year");
  } catch (const SQLite::Exception& error) {
    return failed(file, error.what());
  }
  auto other = open(file, identity);
  if (!other) return tl::unexpected(std::move(other.error()));
  auto rows = other->rows();
  if (!rows) return tl::unexpected(std::move(rows.error()));
  for (const std::size_t row : *rows) {
    auto lit = other->get(row);
    if (!lit) return tl::unexpected(std::move(lit.error()));
    if (auto done = put(row, *lit); !done) return done;
  }
  return flush();
}

}  // namespace gnomon::cli
