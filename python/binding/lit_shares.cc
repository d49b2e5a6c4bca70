// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/binding/lit_shares.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "gnomon/algorithms/shadows.h"
#include "report/shares/share_columns.h"
#include "report/sides/polygon_sides.h"
#include "report/text/number_text.h"

namespace gnomon::python {

namespace {

constexpr std::size_t kNoColumn = static_cast<std::size_t>(-1);

/// Which column of report::ShareColumns each column of the answer is.
std::vector<std::size_t> columns_wanted(const report::ShareColumns& columns, std::size_t polygons,
                                        bool fronts) {
  std::vector<std::size_t> wanted(fronts ? polygons : columns.size(), kNoColumn);
  for (std::size_t column = 0; column < columns.size(); ++column) {
    if (!fronts) {
      wanted[column] = column;
    } else if (columns.side(column) == Side::kFront) {
      wanted[columns.polygon(column)] = column;
    }
  }
  return wanted;
}

/// Runs the lights of a scene one after the other.
Expected<void> run_lights(const LoadedScene& lit, ShadowOptions options,
                          const std::function<void(const LightResult&)>& take) {
  if (lit.scene.lights.empty()) return {};
  options.control.light_done = [&](LightResult&& light) {
    take(light);
    return true;
  };
  auto computed = compute_shadows(lit.prepared, options);
  if (!computed) return tl::unexpected(std::move(computed.error()));
  return {};
}

/// The text of one side's exact lit share.
std::string lit_text(const report::ClassifiedSide& side) {
  return side.exact_lit ? side.exact_lit->get_str() : report::shortest(side.lit.middle());
}

}  // namespace

Expected<LitShares> lit_shares(const LoadedScene& loaded, std::vector<Light> lights, bool fronts,
                               const RunNames& names, const std::atomic<bool>& stop) {
  auto options = shadow_options(names, stop);
  if (!options) return tl::unexpected(std::move(options.error()));
  auto lit = under_lights(loaded, std::move(lights), names.jobs, stop);
  if (!lit) return tl::unexpected(std::move(lit.error()));
  const LoadedScene& scene = **lit;
  const report::ShareColumns columns(scene.scene, scene.prepared);
  const std::vector<std::size_t> wanted =
      columns_wanted(columns, scene.scene.polygons.size(), fronts);
  LitShares shares{scene.scene.lights.size(), wanted.size(), {}};
  shares.values.reserve(shares.lights * shares.columns);
  std::vector<double> of_light(columns.size());
  auto run = run_lights(scene, *std::move(options), [&](const LightResult& light) {
    columns.read_lit(light, of_light);
    for (const std::size_t column : wanted) {
      shares.values.push_back(column == kNoColumn ? std::numeric_limits<double>::quiet_NaN()
                                                  : of_light[column]);
    }
  });
  if (!run) return tl::unexpected(std::move(run.error()));
  return shares;
}

Expected<ExactShares> exact_shares(const LoadedScene& loaded, std::vector<Light> lights,
                                   bool fronts, const RunNames& names,
                                   const std::atomic<bool>& stop) {
  auto options = shadow_options(names, stop);
  if (!options) return tl::unexpected(std::move(options.error()));
  if (!kernel_info(options->kernel.id).exact) {
    return fail(ErrorCode::kUsage, "--exact-fractions: kernel " + names.kernel + " rounds",
                "an exact kernel: plane, rational or epeck");
  }
  auto lit = under_lights(loaded, std::move(lights), names.jobs, stop);
  if (!lit) return tl::unexpected(std::move(lit.error()));
  const LoadedScene& scene = **lit;
  options->output.exact_fractions = true;
  const report::ShareColumns columns(scene.scene, scene.prepared);
  const report::PartWeights weights(scene.prepared);
  const std::vector<std::size_t> wanted =
      columns_wanted(columns, scene.scene.polygons.size(), fronts);
  ExactShares shares{scene.scene.lights.size(), wanted.size(), {}};
  auto run = run_lights(scene, *std::move(options), [&](const LightResult& light) {
    for (const std::size_t column : wanted) {
      std::string& text = shares.values.emplace_back();
      if (column == kNoColumn) continue;
      text = "0";  // of a side that polygon_sides() does not list
      for (const report::ClassifiedSide& side :
           report::polygon_sides(scene.prepared, light, columns.polygon(column), true, weights)) {
        if (side.side == columns.side(column)) text = lit_text(side);
      }
    }
  });
  if (!run) return tl::unexpected(std::move(run.error()));
  return shares;
}

}  // namespace gnomon::python
