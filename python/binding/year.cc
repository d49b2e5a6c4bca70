// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/binding/year.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/kernel_choice.h"
#include "gnomon/scene/digest.h"
#include "report/shares/gross_shares.h"
#include "report/shares/share_columns.h"
#include "report/year/row_sum.h"
#include "report/year/year_rows.h"

namespace gnomon::python {

namespace {

/// All rows, in order.
Expected<void> compute_rows(const LoadedScene& lit, const report::SunsOfRows& suns,
                            const report::ShareColumns& columns, ShadowOptions options,
                            const report::YearRows::Take& take) {
  report::YearRows rows(suns, columns, take);
  rows.advance();
  if (suns.lights.empty()) return {};
  options.control.light_done = [&](LightResult&& light) { return rows.add(light); };
  auto computed = compute_shadows(lit.prepared, options);
  if (!computed) return tl::unexpected(std::move(computed.error()));
  return {};
}

}  // namespace

Expected<Year> year(const LoadedScene& loaded, const suns::AskedSuns& asked, bool gross,
                    const RunNames& names, const std::atomic<bool>& stop) {
  auto options = shadow_options(names, stop);
  if (!options) return tl::unexpected(std::move(options.error()));
  if (auto checked = suns::check_asked_suns(asked); !checked) {
    return tl::unexpected(std::move(checked.error()));
  }
  auto suns_of_year = suns::suns_asked(asked, loaded.scene);
  if (!suns_of_year) return tl::unexpected(std::move(suns_of_year.error()));
  Year year;
  year.asked = *std::move(suns_of_year);
  auto times = suns::year_of_suns(year.asked);
  if (!times) return tl::unexpected(std::move(times.error()));
  year.times = *std::move(times);
  std::vector<std::size_t> all(year.times.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const report::SunsOfRows suns(year.times, std::move(all), year.asked.place.zone);
  auto lit = under_lights(loaded, suns.lights, names.jobs, stop);
  if (!lit) return tl::unexpected(std::move(lit.error()));
  const LoadedScene& scene = **lit;
  const report::ShareColumns columns(scene.scene, scene.prepared);
  const report::GrossShares walls =
      gross ? report::GrossShares(scene.scene, scene.prepared, columns) : report::GrossShares();
  year.sides = columns.names();
  std::ranges::move(walls.names(), std::back_inserter(year.sides));
  year.geometry = geometry_digest(scene.scene);
  year.kernel = parse_kernel_choice(names.kernel)->name();
  year.lit.resize(year.times.size() * year.sides.size());
  report::RowSum sum;
  const auto take = [&](std::size_t row, std::span<const double> shares) {
    const auto of_row = std::span(year.lit).subspan(row * year.sides.size(), year.sides.size());
    std::ranges::copy(shares, of_row.begin());
    walls.read(shares, of_row.subspan(shares.size()));
    sum.add(year.times[row], of_row);
    return true;
  };
  auto computed = compute_rows(scene, suns, columns, *std::move(options), take);
  if (!computed) return tl::unexpected(std::move(computed.error()));
  year.checksum = sum.text();
  return year;
}

}  // namespace gnomon::python
