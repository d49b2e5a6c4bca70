// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/cgal/epeck_volume_space.h"

#include <cmath>

#include "kernel/cgal/epeck_numbers.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {

using namespace epeck_detail;

static_assert(VolumeSpaceModel<EpeckVolumeSpace>);

namespace {

/// Whether intervals are good enough on the scale of `size`, so that rationals need not be
/// evaluated. No tolerance: an enclosure it is in any case.
bool is_narrow(const std::array<Ball, 3>& point, double size) {
  for (const Ball& x : point) {
    if (!x.is_finite() || !(x.radius <= 0x1p-44 * size)) return false;
  }
  return true;
}

}  // namespace

EpeckVolumeSpace::EpeckVolumeSpace(const SceneSpace& scene, const KernelOptions&)
    : Base(scene, true) {}

std::optional<Epeck::Plane_3> EpeckVolumeSpace::plane_of(const Vertex& a, const Vertex& b,
                                                         const Vertex& c) const {
  if (CGAL::collinear(a.point, b.point, c.point)) return std::nullopt;
  return Epeck::Plane_3(a.point, b.point, c.point);
}

std::optional<Epeck::Plane_3> EpeckVolumeSpace::plane_of(const Vertex& a, const Vertex& b,
                                                         const LightPoint& direction) const {
  const Epeck::Vector_3 to_light(number_from(direction.grid[0]), number_from(direction.grid[1]),
                                 number_from(direction.grid[2]));
  return plane_of(a, b, Vertex{a.point + to_light, kMadeVertex});
}

Epeck::Plane_3 EpeckVolumeSpace::axis_plane(int axis, double value) const {
  // Not default-constructed: CGAL's default zero has an interval that is not initialized.
  const Number zero(0), one(1);
  std::array<Number, 3> normal{zero, zero, zero}, point = normal;
  normal[axis] = one;
  point[axis] = Number(value) * number_from(mpz_class(1) << geometry().grid.bits());
  return {Epeck::Point_3(point[0], point[1], point[2]),
          Epeck::Vector_3(normal[0], normal[1], normal[2])};
}

EpeckVertex EpeckVolumeSpace::axis_point(const std::array<double, 3>& fractions) const {
  const Number extent = number_from(mpz_class(1) << geometry().grid.bits());
  return {Epeck::Point_3(Number(fractions[0]) * extent, Number(fractions[1]) * extent,
                         Number(fractions[2]) * extent),
          kMadeVertex};
}

Side EpeckVolumeSpace::side(const Epeck::Plane_3& plane, const Vertex& vertex) const {
  return epeck_detail::side_of(plane, vertex.point);
}

EpeckVertex EpeckVolumeSpace::meet(const Epeck::Plane_3& plane, const Vertex& from,
                                   const Vertex& to) const {
  return meeting_point(plane, from.point, to.point);
}

std::array<Ball, 3> EpeckVolumeSpace::by_intervals(const Numbers& grid) const {
  std::array<Ball, 3> result;
  // Scaling by a power of two rounds only where it underflows.
  const int exponent = -static_cast<int>(geometry().grid.bits());
  for (int k = 0; k < 3; ++k) {
    const Ball x = epeck_detail::enclose(grid[k]);
    result[k] = {std::ldexp(x.middle, exponent), std::ldexp(x.radius, exponent) + Ball::kTiny};
  }
  return result;
}

std::array<Ball, 3> EpeckVolumeSpace::by_rationals(const Numbers& grid) const {
  std::array<Ball, 3> result;
  for (int k = 0; k < 3; ++k) {
    mpq_class x = to_mpq(grid[k].exact());
    x /= mpz_class(1) << geometry().grid.bits();
    result[k] = gnomon::enclose(x);
  }
  return result;
}

std::array<Ball, 3> EpeckVolumeSpace::position(const Corner<Vertex>& corner) const {
  const Epeck::Point_3& p = corner.vertex.point;
  const Numbers grid{p.x(), p.y(), p.z()};
  const std::array<Ball, 3> result = by_intervals(grid);
  return is_narrow(result, 1) ? result : by_rationals(grid);
}

std::array<Ball, 3> EpeckVolumeSpace::offset(VertexId origin, const Corner<Vertex>& corner) const {
  if (corner.vertex.source == origin) return {};
  const Epeck::Point_3 from = input_vertex(origin).point;
  const Epeck::Point_3& p = corner.vertex.point;
  const Numbers grid{p.x() - from.x(), p.y() - from.y(), p.z() - from.z()};
  const std::array<Ball, 3> result = by_intervals(grid);
  const double size =
      std::fmax(std::fabs(result[0].middle),
                std::fmax(std::fabs(result[1].middle), std::fabs(result[2].middle)));
  return is_narrow(result, size) ? result : by_rationals(grid);
}

std::array<mpq_class, 3> EpeckVolumeSpace::exact_position(const Corner<Vertex>& corner) const {
  return exact_point(geometry(), corner.vertex.point);
}

std::array<double, 3> EpeckVolumeSpace::nearest_position(const Corner<Vertex>& corner) const {
  if (corner.vertex.source != kMadeVertex) return geometry().positions[corner.vertex.source];
  const std::array<mpq_class, 3> exact = exact_position(corner);
  return {nearest_double(exact[0]), nearest_double(exact[1]), nearest_double(exact[2])};
}

}  // namespace gnomon
