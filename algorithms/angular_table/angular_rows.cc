// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/angular_rows.h"

#include <utility>
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

/// Where three planes meet, if they do in one point.
std::optional<RationalVector> meet(const GridPlane& a, const GridPlane& b, const GridPlane& c) {
  const mpz_class det = dot(a.n, cross(b.n, c.n));
  if (det == 0) return std::nullopt;
  const DirectionVector bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
  RationalVector x;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = mpq_class(a.d * bc[k] + b.d * ca[k] + c.d * ab[k], det);
    x[k].canonicalize();
  }
  return x;
}

GridPlane support_plane(const PreparedScene& scene, std::uint32_t part) {
  const SupportTriple& triple = scene.geometry.planes[scene.parts[part].plane];
  const auto at = [&](VertexId v) {
    const GridPositions& grid = scene.geometry.grid;
    return DirectionVector{grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)};
  };
  const DirectionVector a = at(triple.a);
  GridPlane plane{cross(minus(at(triple.b), a), minus(at(triple.c), a)), 0};
  plane.d = dot(plane.n, a);
  return plane;
}

}  // namespace

struct AngularRows::Data {
  const PreparedScene& scene;
  std::vector<TableOutline> outlines;  // by charts

  std::optional<RationalVector> middle_in(const TableOutline& outline, std::uint32_t part,
                                          const RationalVector& x) const;
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

std::optional<RationalVector> AngularRows::Data::middle_in(const TableOutline& outline,
                                                           std::uint32_t part,
                                                           const RationalVector& x) const {
  const TableChart& chart = outline.mesh.chart();
  const mpq_class ahead = value(chart.ahead, x);
  if (ahead <= 0 || outline.rows->count() == 0) return std::nullopt;
  const mpq_class s = value(chart.across, x) / ahead, t = value(chart.upwards, x) / ahead;
  if (chart.is_pyramid && (abs(s) > 1 || abs(t) > 1)) return std::nullopt;
  const auto row = outline.rows->holding(t);
  if (!row) return std::nullopt;
  const auto middle =
      meet(chart.column(s), chart.row(outline.rows->middle(*row)), support_plane(scene, part));
  if (!middle || value(chart.ahead, *middle) <= 0) return std::nullopt;
  return middle;
}

std::optional<RationalVector> AngularRows::middle(std::uint32_t part,
                                                  const RationalVector& point) const {
  const Geometry& geometry = data_->scene.geometry;
  RationalVector x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = (point[k] - geometry.origin[k]) / geometry.step;
  for (const TableOutline& outline : data_->outlines) {
    auto found = data_->middle_in(outline, part, x);
    if (!found) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      (*found)[k] = geometry.origin[k] + geometry.step * (*found)[k];
    }
    return found;
  }
  return std::nullopt;
}

}  // namespace gnomon
