// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of lit shares under the suns of a year (docs/formats.md, "Years of suns"), a row a time,
// so that no more than one row is ever in memory.
//
// Guarantees: a file is there whole, or with the rows that were added if finish() is called before
// all are, or not at all; the same rows give the same bytes.
#ifndef GNOMON_REPORT_YEAR_YEAR_WRITER_H
#define GNOMON_REPORT_YEAR_YEAR_WRITER_H

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "suns/year/year_of_suns.h"

namespace gnomon::report {

/// What a table says besides its numbers.
struct YearHead {
  std::string scene, geometry;  // name, digest
  std::string kernel;
  suns::YearOptions suns;
  std::vector<std::string> sides;       // columns
  std::size_t rows = 0;                 // that are to come
  static constexpr int kAllDigits = 7;  // of single precision
  int digits = kAllDigits;              // of shares in netCDF files
};

class YearWriter {
 public:
  virtual ~YearWriter() = default;
  /// `lit`: of each column. Errors: kFile.
  virtual Expected<void> add(const suns::SunTime& sun, std::span<const double> lit) = 0;
  /// Puts the file in its place; `checksum`: of all rows (row_sum.h). Errors: kFile.
  virtual Expected<void> finish(const std::string& checksum) = 0;
};

/// By the ending of the name: .csv (also for standard output, "-"), .npy with FILE.npy.json beside
/// it, .nc. Keeps a reference to the head. Errors: kUsage for another ending; kFile.
Expected<std::unique_ptr<YearWriter>> open_year_table(const std::filesystem::path& file,
                                                      const YearHead& head);
/// The table of sunlit fractions that EnergyPlus imports (Schedule:File:Shading): of fronts alone,
/// without those of whole walls, with the end of each step as the time. Errors: kFile.
Expected<std::unique_ptr<YearWriter>> open_shading_table(const std::filesystem::path& file,
                                                         const YearHead& head);

/// The formats, for open_year_table().
Expected<std::unique_ptr<YearWriter>> open_year_csv(const std::filesystem::path& file,
                                                    const YearHead& head);
Expected<std::unique_ptr<YearWriter>> open_year_npy(const std::filesystem::path& file,
                                                    const YearHead& head);
Expected<std::unique_ptr<YearWriter>> open_year_netcdf(const std::filesystem::path& file,
                                                       const YearHead& head);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_YEAR_YEAR_WRITER_H
