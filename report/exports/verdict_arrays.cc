// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exports/verdict_arrays.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "report/sides/polygon_sides.h"

namespace gnomon::report {

namespace {

constexpr double kNotCompared = -1;

/// By the names of light and polygon.
using SideKey = std::tuple<std::string, std::string, Side>;
using Comparisons = std::map<SideKey, const oracle::PolygonComparison*>;

/// What was found of each light by itself.
Comparisons comparisons_of(const oracle::Report& report) {
  Comparisons by_side;
  for (const oracle::LightComparison& light : report.lights) {
    if (light.block != Block::kLights) continue;
    for (const oracle::PolygonComparison& polygon : light.polygons) {
      by_side.emplace(SideKey(light.id, polygon.polygon, polygon.side), &polygon);
    }
  }
  return by_side;
}

double wrong_share(const oracle::PolygonComparison& side) {
  double share = 0;
  for (const oracle::AreaShare* wrong :
       {&side.misclassified, &side.uncovered, &side.overlapping, &side.outside}) {
    if (!wrong->zero) share = std::max(share, wrong->fraction.upper);
  }
  return share;
}

}  // namespace

std::vector<CellArray> verdict_arrays(const Certificate& certificate, const ShadowResult& result,
                                      std::span<const ResultPiece> pieces) {
  const Scene& scene = *certificate.scene;
  std::vector<std::string> lights;
  for (const LightResult& light : result.lights) {
    lights.push_back(light_name(scene, *certificate.prepared, light));
  }
  std::vector<CellArray> arrays;
  for (const JudgedRun& run : certificate.runs) {
    if (!run.report) continue;
    const Comparisons by_side = comparisons_of(*run.report);
    CellArray shares{"wrong_share " + run.name, {}}, widths{"wrong_width " + run.name, {}};
    for (const ResultPiece& piece : pieces) {
      const auto found =
          by_side.find(SideKey(lights[piece.light], scene.polygons[piece.polygon].id, piece.side));
      const bool is_compared = found != by_side.end();
      shares.values.push_back(is_compared ? wrong_share(*found->second) : kNotCompared);
      widths.values.push_back(is_compared ? found->second->width.upper : kNotCompared);
    }
    arrays.push_back(std::move(shares));
    arrays.push_back(std::move(widths));
  }
  return arrays;
}

Expected<void> write_verdict_vtp(TextSink& sink, const Certificate& certificate,
                                 const ShadowResult& exact) {
  const auto pieces = result_pieces(*certificate.prepared, exact);
  if (!pieces) return tl::unexpected(pieces.error());
  VtpExtras extras;
  extras.cells = verdict_arrays(certificate, exact, *pieces);
  NamedTexts ids{"run_ids", {}}, verdicts{"run_verdicts", {}};
  for (const JudgedRun& run : certificate.runs) {
    ids.texts.push_back(run.name);
    verdicts.texts.emplace_back(run.report ? name_of(run.report->verdict) : "gave up");
  }
  extras.fields = {std::move(ids), std::move(verdicts)};
  write_vtp(sink, *certificate.scene, *certificate.prepared, exact, *pieces, extras);
  return {};
}

}  // namespace gnomon::report
