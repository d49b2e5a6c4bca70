// SPDX-License-Identifier: GPL-3.0-or-later
// Samples as a program writes them (docs/samples.md): CSV with the columns light, x, y, z, visible
// and perhaps polygon, in any order, a row a sample. Read one by one, so that a file of any length
// takes no memory.
#ifndef GNOMON_COMPARISON_SAMPLES_SAMPLE_FILE_H
#define GNOMON_COMPARISON_SAMPLES_SAMPLE_FILE_H

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "comparison/engine_tables/csv_reader.h"
#include "comparison/engine_tables/written_number.h"
#include "gnomon/kernel/error.h"
#include "gnomon/oracle/sample_judge.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::comparison {

struct SampleRow {
  std::uint64_t line = 0;
  oracle::Sample sample;  // `allowed` is not set
  WrittenNumber visible;  // as written
};

/// Whether a file begins as one of samples does: with the names of their columns.
bool is_sample_file(const std::filesystem::path& file);

class SampleFile {
 public:
  /// Reads the first line. Coordinates are read as the scene means its numbers. Keeps references to
  /// both scenes. Errors: kFile; kSyntax, kFormat with the place (no text, a column that is missing
  /// or stands twice).
  static Expected<SampleFile> open(const std::filesystem::path& file, const Scene& scene,
                                   const PreparedScene& prepared);

  /// False at the end. Errors: kSyntax, kFormat, kNumber, kId with the place: quotes, rows of
  /// another length than the first, what is no number, lights and polygons that the scene does not
  /// have, polygons without area or without the side that is named.
  Expected<bool> next(SampleRow& row);
  /// Back to the first sample. Errors: kFile.
  Expected<void> rewind();

  /// An error at the end of the file as far as it was read.
  tl::unexpected<Error> wrong_at_end(std::string what, std::string expected) const;
  /// Columns that mean nothing here.
  const std::vector<std::string>& passed_over() const { return passed_over_; }
  double done() const { return csv_.done(); }

 private:
  enum Column : std::uint8_t { kLight, kX, kY, kZ, kVisible, kPolygon, kColumns };
  static const std::array<std::string_view, kColumns>& names();

  SampleFile(CsvReader csv, const Scene& scene, const PreparedScene& prepared);
  Expected<void> read_head();
  Expected<void> check_length() const;
  Expected<void> read_light(SampleRow& row) const;
  Expected<void> read_point(SampleRow& row) const;
  Expected<void> read_visible(SampleRow& row) const;
  Expected<void> read_polygon(SampleRow& row) const;
  std::string_view text_of(Column column) const { return csv_.fields()[*column_[column]].text; }
  tl::unexpected<Error> wrong(ErrorCode code, Column column, std::string what,
                              std::string expected) const;

  CsvReader csv_;
  const Scene* scene_;
  const PreparedScene* prepared_;
  std::array<std::optional<std::size_t>, kColumns> column_;
  std::size_t columns_ = 0;
  std::vector<std::string> passed_over_;
  std::unordered_map<std::string_view, std::uint32_t> lights_, polygons_;  // by id
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_SAMPLES_SAMPLE_FILE_H
