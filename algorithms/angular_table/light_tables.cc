// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/light_tables.h"

#include <utility>

#include "algorithms/angular_table/solid_checks.h"
#include "gnomon/algorithms/facing_sides.h"

namespace gnomon {

namespace {

/// Of one hemisphere: everything that casts, and everything that is looked up, is ahead.
Expected<void> check_ahead(const PixelTask& task, const TableChart& chart,
                           const std::vector<bool>& receives) {
  const PreparedScene& scene = task.scene;
  for (std::uint32_t p = 0; p < scene.parts.size(); ++p) {
    if (!scene.parts[p].casts && !receives[p]) continue;
    for (const VertexId v : scene.loop(scene.parts[p])) {
      const GridPositions& grid = scene.geometry.grid;
      if (chart.of({grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)})[2] > 0) continue;
      return fail(ErrorCode::kGeometry,
                  "light inside the view: polygon " + polygon_name(task.options.scene, scene, p) +
                      " reaches beside or behind it",
                  "everything ahead of the light, as the picture looks; or hemisphere=cube");
    }
  }
  return {};
}

}  // namespace

Expected<LightTables> LightTables::make(const PixelTask& task, std::uint32_t light,
                                        const std::vector<TableObject>& objects,
                                        const std::vector<bool>& receives) {
  const PreparedScene& scene = task.scene;
  const LightPoint& point = scene.lights[light].point;
  const MethodOptionValues& options = task.options.options;
  const std::vector<TableChart> charts = charts_of(task.frame, point, options.hemisphere);
  if (options.hemisphere == Hemisphere::kOne && !point.directional) {
    const auto checked = check_ahead(task, charts.front(), receives);
    if (!checked) return tl::unexpected(checked.error());
  }
  if (options.depth == TableDepth::kHidden) {
    const auto checked = check_light(scene, task.options.scene, objects, point);
    if (!checked) return tl::unexpected(checked.error());
  }
  const std::vector<Sign> signs = signs_at_light(scene, point);
  LightTables result;
  result.objects_ = &objects;
  result.is_sun_ = point.directional;
  result.object_of_.resize(scene.parts.size(), 0);
  for (std::uint32_t o = 0; o < objects.size(); ++o) {
    for (const std::uint32_t p : objects[o].component.parts) result.object_of_[p] = o;
  }
  result.tables_.reserve(charts.size());
  for (const TableChart& chart : charts) {
    if (task.interrupted()) return fail(ErrorCode::kInterrupted, "interrupted");
    result.tables_.emplace_back(TableTask{scene, objects, signs, options, task.rules}, chart);
    result.near_.emplace_back(scene.geometry, chart, point);
  }
  return result;
}

void LightTables::count(WorkCounts& work) const {
  for (const AngularTable& table : tables_) table.count(work);
}

}  // namespace gnomon
