// SPDX-License-Identifier: GPL-3.0-or-later
// A table of lit shares, surface by time, as engines write them (docs/formats.md, "Tables of an
// engine"). It is read once, front to back; only the columns that are asked for are held.
#ifndef GNOMON_COMPARISON_ENGINE_TABLES_ENGINE_TABLE_H
#define GNOMON_COMPARISON_ENGINE_TABLES_ENGINE_TABLE_H

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "comparison/engine_tables/written_number.h"
#include "gnomon/kernel/error.h"
#include "suns/calendar/civil_time.h"
#include "suns/year/year_of_suns.h"

namespace gnomon::comparison {

enum class TableForm : std::uint8_t {
  kEnergyPlus,  // "Surface Name,NAME,...", rows with the end of a step
  kSuns,        // "time,sun_x,sun_y,sun_z,NAME,...", as gnomon year writes it
};

struct TableRow {
  suns::CivilTime time;         // kEnergyPlus: the end of a step; kSuns: of the sun
  suns::Direction direction{};  // kSuns
};

struct EngineTable {
  std::string file;  // as messages call it
  TableForm form = TableForm::kEnergyPlus;
  std::vector<std::string> names;   // of all columns of shares
  std::vector<std::uint32_t> kept;  // which of them, ascending
  std::vector<TableRow> rows;       // by time
  WrittenNumbers values;            // row by row, of the columns kept
  suns::Minutes zone{0};            // kSuns
  /// The least distance of two rows; of one row the longest step up to an hour that ends then.
  std::chrono::seconds step{3600};

  WrittenNumber value(std::size_t row, std::size_t kept_column) const {
    return values[row * kept.size() + kept_column];
  }
};

struct TableReading {
  std::chrono::year year{2025};  // of the days of kEnergyPlus, which have none
  /// Of all names, which columns to keep, ascending. Its errors end the reading.
  std::function<Expected<std::vector<std::uint32_t>>(const EngineTable&)> choose;
  /// Told the share that was read; false stops (kInterrupted).
  std::function<bool(double)> progress;
};

/// Whether a file begins as a table does. Of what is no regular file its ending, ".csv", tells.
bool is_engine_table(const std::filesystem::path& file);

/// Errors: kFile; kSyntax, kFormat, kNumber, kId with the place: quotes, a head of no known form,
/// names that are empty or stand twice, no rows, rows of another length than the head, times that
/// are none or not after the last, values that are no numbers; kInterrupted.
Expected<EngineTable> read_engine_table(const std::filesystem::path& file,
                                        const TableReading& reading);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ENGINE_TABLES_ENGINE_TABLE_H
