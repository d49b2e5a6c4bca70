// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL: regularised Boolean operations on Polygon_set_2 over exact constructions. Per receiver the
// shadows of its casters, with exact rational vertices, are joined in one call (CGAL then sweeps
// several polygons at a time); what they leave is lit. Exact.
//
// Vertices are computed in rationals first, so that they are leaves with tight intervals for CGAL's
// lazy numbers. Shadows are cut off at the receiver, and a receiver that one caster covers is done:
// whole shadows, subtracted from the receiver by CGAL, took 1.2 times as long.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <fmt/format.h>
#include <gmpxx.h>

#include <iterator>
#include <vector>

#include "machine.h"
#include "peers/caster_search.h"
#include "peers/peer.h"
#include "peers/shadow_projection.h"
#include "table.h"

namespace gnomon::bench {
namespace {

using Epeck = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Epeck>;
using PolygonSet = CGAL::Polygon_set_2<Epeck>;
using PolygonWithHoles = PolygonSet::Polygon_with_holes_2;
using Rational = Epeck::FT::ET;

/// Whatever rational type CGAL was built with.
template <class Number>
mpq_class to_mpq(const Number& value) {
  if constexpr (requires { mpq_class(value.mpq()); }) {
    return mpq_class(value.mpq());
  } else if constexpr (requires { mpq_class(value.backend().data()); }) {
    return mpq_class(value.backend().data());
  } else {
    return mpq_class(value);
  }
}

Polygon polygon_of(const ChartLoop<mpq_class>& loop) {
  Polygon polygon;
  for (const ChartPoint<mpq_class>& point : loop) {
    polygon.push_back(Epeck::Point_2(Epeck::FT(Rational(point[0].get_mpq_t())),
                                     Epeck::FT(Rational(point[1].get_mpq_t()))));
  }
  return polygon;
}

mpq_class area_of(const PolygonSet& set) {
  std::vector<PolygonWithHoles> pieces;
  set.polygons_with_holes(std::back_inserter(pieces));
  mpq_class area = 0;
  for (const PolygonWithHoles& piece : pieces) {
    area += to_mpq(piece.outer_boundary().area().exact());
    // Holes are clockwise.
    for (const Polygon& hole : piece.holes()) area += to_mpq(hole.area().exact());
  }
  return area;
}

}  // namespace

PeerResult run_cgal(const PreparedScene& scene, std::uint32_t light) {
  const double start = cpu_seconds();
  const LightView view(scene, light);
  CasterSearch search(view);
  std::vector<Point<mpq_class>> rays(scene.geometry.grid.size());
  for (VertexId v = 0; v < rays.size(); ++v) {
    const Point<mpz_class> ray = view.exact_ray(v);
    rays[v] = {mpq_class(ray[0]), mpq_class(ray[1]), mpq_class(ray[2])};
  }
  using Projection = ShadowProjection<mpq_class>;
  Projection::Loop caster_loop;
  const auto read_loop = [&](std::uint32_t part, Projection::Loop& loop) {
    loop.clear();
    for (const VertexId vertex : view.loop(part)) loop.push_back(rays[vertex]);
  };
  PeerResult result;
  result.lit.assign(scene.parts.size(), 0);
  const std::vector<double> areas = part_areas(scene);
  std::vector<std::uint32_t> casters;
  std::vector<Polygon> shadows;
  ChartLoop<mpq_class> shadow;
  std::uint64_t pairs = 0;
  for (const std::uint32_t part : view.facing()) {
    search.casters_of(part, casters);
    Projection::Loop loop;
    read_loop(part, loop);
    // The loop is clockwise seen from the light; its normal is turned towards it.
    LitPlane<mpq_class> plane;
    plane.normal = cross(minus(loop[2], loop[0]), minus(loop[1], loop[0]));
    plane.offset = dot(plane.normal, loop[0]);
    Projection projection(plane, std::move(loop), Projection::Clip::kAtReceiver);
    const mpq_class whole = twice_area(projection.receiver());
    shadows.clear();
    bool covered = false;
    for (const std::uint32_t caster : casters) {
      read_loop(caster, caster_loop);
      if (!projection.shadow_of(caster_loop, shadow)) continue;
      covered = twice_area(shadow) == whole;
      if (covered) break;
      shadows.push_back(polygon_of(shadow));
    }
    pairs += shadows.size();
    if (covered) continue;
    mpq_class lit = 1;
    if (!shadows.empty()) {
      PolygonSet shadowed;
      shadowed.join(shadows.begin(), shadows.end());
      lit -= 2 * area_of(shadowed) / whole;
    }
    result.lit[part] = lit.get_d();
    result.lit_area += result.lit[part] * areas[part];
  }
  result.seconds = cpu_seconds() - start;
  result.work = grouped(pairs) + " shadows joined";
  return result;
}

}  // namespace gnomon::bench
