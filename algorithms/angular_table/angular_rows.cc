// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/angular_rows.h"

#include <algorithm>
#include <vector>

#include "algorithms/angular_table/angular_table.h"
#include "gnomon/algorithms/facing_sides.h"
#include "scene/base/vectors.h"

namespace gnomon {

namespace {

using RationalVector = std::array<mpq_class, 3>;

mpq_class value(const GridPlane& function, const RationalVector& x) {
  mpq_class sum = -function.d;
  for (std::size_t k = 0; k < 3; ++k) sum += function.n[k] * x[k];
  return sum;
}

/// The direction (s, t) in integers.
DirectionVector direction_of(const mpq_class& s, const mpq_class& t) {
  return {s.get_num() * t.get_den(), t.get_num() * s.get_den(), s.get_den() * t.get_den()};
}

/// 1 inside of the cone of a loop of directions, 0 on its border, -1 outside.
int place_in(const std::vector<DirectionVector>& loop, const DirectionVector& direction) {
  const int turn = sgn(dot(cross(loop[0], loop[1]), loop[2]));
  int place = 1;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const DirectionVector& next = loop[i + 1 == loop.size() ? 0 : i + 1];
    const int side = turn * sgn(dot(cross(loop[i], next), direction));
    if (side < 0) return -1;
    if (side == 0) place = 0;
  }
  return turn == 0 ? -1 : place;
}

}  // namespace

struct AngularRows::Data {
  const PreparedScene& scene;
  std::vector<TableOutline> outlines;  // by charts

  /// The row that holds a place of the grid, if one does, and its column.
  struct Place {
    const TableChart* chart = nullptr;
    mpq_class s, t, middle;
  };
  Place place_of(const RationalVector& x) const;
};

AngularRows::AngularRows(const PreparedScene& scene, const ImageFrame& frame,
                         const MethodOptionValues& options, std::uint32_t light)
    : data_(new Data{scene, {}}) {
  if (options.rows == MethodOptionValues::kExactRows) return;
  const LightPoint& point = scene.lights[light].point;
  const std::vector<TableObject> objects = table_objects(scene);
  const std::vector<Sign> signs = signs_at_light(scene, point);
  const Rules rules;
  for (const TableChart& chart : charts_of(frame, point, options.hemisphere)) {
    data_->outlines.emplace_back(TableTask{scene, objects, signs, options, rules}, chart);
  }
}
AngularRows::~AngularRows() = default;
AngularRows::AngularRows(AngularRows&&) noexcept = default;

AngularRows::Data::Place AngularRows::Data::place_of(const RationalVector& x) const {
  for (const TableOutline& outline : outlines) {
    const TableChart& chart = outline.mesh.chart();
    const mpq_class ahead = value(chart.ahead, x);
    if (ahead <= 0) continue;
    const mpq_class s = value(chart.across, x) / ahead, t = value(chart.upwards, x) / ahead;
    if (chart.is_pyramid && (abs(s) > 1 || abs(t) > 1)) continue;
    if (const auto row = outline.rows->holding(t))
      return {&chart, s, t, outline.rows->middle(*row)};
  }
  return {};
}

bool AngularRows::has_edge_near(const RationalVector& point) const {
  const Geometry& geometry = data_->scene.geometry;
  RationalVector x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = (point[k] - geometry.origin[k]) / geometry.step;
  const Data::Place place = data_->place_of(x);
  if (place.chart == nullptr) return false;
  const DirectionVector own = direction_of(place.s, place.t);
  const DirectionVector middle = direction_of(place.s, place.middle);
  return std::ranges::any_of(data_->scene.parts, [&](const Part& part) {
    if (!part.casts) return false;
    std::vector<DirectionVector> loop;
    for (const VertexId v : data_->scene.loop(part)) {
      const GridPositions& grid = geometry.grid;
      loop.push_back(place.chart->of({grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)}));
    }
    const int here = place_in(loop, own), there = place_in(loop, middle);
    return here != there || here == 0;
  });
}

}  // namespace gnomon
