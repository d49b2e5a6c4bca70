// SPDX-License-Identifier: GPL-3.0-or-later
// The shares of all polygon sides under many lights as one table (docs/formats.md, "Tables of
// shares"), written a light at a time, so that no more than one light is ever in memory.
//
// Guarantees: the numbers are the fractions of the result file (result_json.h); a number of a CSV
// file reads back to the same double; the same results give the same bytes.
#ifndef GNOMON_REPORT_SHARES_SHARE_TABLE_H
#define GNOMON_REPORT_SHARES_SHARE_TABLE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/kernel_list.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/shares/share_columns.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

enum class ShareFormat : std::uint8_t { kCsv, kNpy };
/// By the ending of a file's name, ".csv" or ".npy".
std::optional<ShareFormat> share_format(const std::filesystem::path& file);

class ShareTable {
 public:
  /// `lights`: indices into PreparedScene::lights, of the rows to come. Keeps references to the
  /// scenes.
  ShareTable(const Scene& scene, const PreparedScene& prepared,
             std::span<const std::uint32_t> lights, ShareFormat format);

  /// What the file begins with if it has so many lights; of one length for all counts up to that of
  /// `lights`.
  std::string head(std::size_t lights) const;
  /// What follows for one light; valid until the next call. Requires: a whole light.
  std::string_view row(const LightResult& light);

  /// The names of the rows so far and of the columns as JSON, for formats that have no room for
  /// them. `file`: the table's name.
  void write_names(TextSink& sink, KernelId kernel, std::string_view geometry_digest,
                   std::string_view file) const;

 private:
  const std::string& light_id(std::uint32_t light) const;
  std::string csv_head() const;
  std::string npy_head(std::size_t lights) const;
  void read(const LightResult& light);
  void append_csv(std::uint32_t light);
  void append_npy();

  const Scene& scene_;
  const PreparedScene& prepared_;
  ShareFormat format_;
  ShareColumns columns_;
  std::vector<std::string_view> classes_;  // one or three: see the page of formats
  std::vector<double> values_;             // of one light: by class, then by column
  std::string row_;
  std::vector<std::string> lights_;        // of the rows so far
  std::vector<std::string_view> methods_;  // that found them
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SHARES_SHARE_TABLE_H
