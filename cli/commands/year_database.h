// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a year in an SQLite file, as far as they are done: what goes on after an
// interruption, and what shards put together.
#ifndef GNOMON_CLI_COMMANDS_YEAR_DATABASE_H
#define GNOMON_CLI_COMMANDS_YEAR_DATABASE_H

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/common/stopwatch.h"
#include "gnomon/kernel/error.h"

namespace SQLite {
class Database;
class Statement;
class Transaction;
}  // namespace SQLite

namespace gnomon::cli {

class YearDatabase {
 public:
  /// `identity`: what two databases of one year have in common, "name: value" a line. Errors:
  /// kFile; kUsage, if the file holds another year, with the first line that differs.
  static Expected<YearDatabase> open(const std::string& file, const std::string& identity);
  YearDatabase(YearDatabase&&) noexcept;
  YearDatabase& operator=(YearDatabase&&) noexcept;
  /// Keeps what was put.
  ~YearDatabase();

  /// Ascending. Errors: kFile.
  Expected<std::vector<std::size_t>> rows() const;
  /// Written for good within a second, and by flush(). Errors: kFile.
  Expected<void> put(std::size_t row, std::span<const double> lit);
  Expected<void> flush();
  /// The row's shares. Errors: kFile, also if it is not there or no row.
  Expected<std::vector<double>> get(std::size_t row) const;
  /// Takes in the rows of another one. Errors: as of open().
  Expected<void> merge(const std::string& file, const std::string& identity);

 private:
  YearDatabase();

  std::string file_;
  std::unique_ptr<SQLite::Database> database_;
  std::unique_ptr<SQLite::Transaction> transaction_;
  Stopwatch since_flush_;
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_YEAR_DATABASE_H
