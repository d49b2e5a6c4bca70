// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/contacts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace gnomon {

namespace {

std::vector<std::uint32_t> casting_parts(const PreparedScene& scene) {
  std::vector<std::uint32_t> parts;
  for (std::uint32_t part = 0; part < scene.parts.size(); ++part) {
    if (scene.parts[part].casts) parts.push_back(part);
  }
  return parts;
}

/// n . x - d, times the positive denominator of x.
int side_of(const MeshPlane& plane, const ExactPoint& point) {
  mpz_class value = 0;
  for (std::size_t k = 0; k < 3; ++k) value += plane.n[k] * point.numerator[k];
  return cmp(value * plane.d.get_den(), plane.d.get_num() * point.denominator);
}

bool collinear(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3;
    const mpz_class bc = b.numerator[k] * c.numerator[i] - b.numerator[i] * c.numerator[k];
    const mpz_class ca = c.numerator[k] * a.numerator[i] - c.numerator[i] * a.numerator[k];
    const mpz_class ab = a.numerator[k] * b.numerator[i] - a.numerator[i] * b.numerator[k];
    if (a.denominator * bc + b.denominator * ca + c.denominator * ab != 0) return false;
  }
  return true;
}

}  // namespace

Contacts::Contacts(const PreparedScene& scene)
    : scene_(scene), tree_(scene.geometry, scene, casting_parts(scene)) {}

bool Contacts::is_on(const ExactPoint& point, std::uint32_t number) const {
  const Part& part = scene_.parts[number];
  const MeshPlane& plane = planes_.at(part.plane);
  if (side_of(plane, point) != 0) return false;
  // Inside of all edges, seen along the axis that the chart drops; grid coordinates of the point.
  const Geometry& geometry = scene_.geometry;
  const auto loop = scene_.loop(part);
  const auto u = static_cast<std::size_t>(plane.axes[0]);
  const auto v = static_cast<std::size_t>(plane.axes[1]);
  const auto on_grid = [&](std::size_t k) {
    const mpq_class coordinate(point.numerator[k], point.denominator);
    mpq_class result = coordinate;
    result.canonicalize();
    return mpq_class((result - geometry.origin[k]) / geometry.step);
  };
  const mpq_class x = on_grid(u), y = on_grid(v);
  const int turn =
      sgn(plane.n[static_cast<std::size_t>(plane.dropped())]) * (part.flipped ? -1 : 1);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const VertexId a = loop[i], b = loop[(i + 1) % loop.size()];
    const mpz_class ax = geometry.grid.at(a, plane.axes[0]),
                    ay = geometry.grid.at(a, plane.axes[1]);
    const mpz_class dx = geometry.grid.at(b, plane.axes[0]) - ax;
    const mpz_class dy = geometry.grid.at(b, plane.axes[1]) - ay;
    if (cmp(dx * (y - ay), dy * (x - ax)) * turn < 0) return false;
  }
  return true;
}

void Contacts::find(const PointTable& points, std::span<const std::uint32_t> vertices) {
  looked_at_.resize(points.size(), 0);
  std::vector<std::uint32_t> fresh;
  for (const std::uint32_t vertex : vertices) {
    if (std::exchange(looked_at_[vertex], std::uint8_t{1}) == 0) fresh.push_back(vertex);
  }
  const Geometry& geometry = scene_.geometry;
  mpq_class extent = geometry.step;
  mpq_mul_2exp(extent.get_mpq_t(), extent.get_mpq_t(), geometry.grid.bits());
  std::vector<std::vector<std::uint32_t>> candidates(fresh.size());
  tbb::parallel_for(std::size_t{0}, fresh.size(), [&](std::size_t i) {
    const std::array<mpq_class, 3> point = points.exact(fresh[i]).rational();
    std::array<double, 3> fraction{};
    for (std::size_t k = 0; k < 3; ++k) {
      fraction[k] = mpq_class((point[k] - geometry.origin[k]) / extent).get_d();
    }
    Box box;
    box.add(fraction);
    tree_.find(Shaft(box, box), candidates[i]);
  });
  for (const auto& parts : candidates) {
    for (const std::uint32_t part : parts) {
      const PlaneId plane = scene_.parts[part].plane;
      if (!planes_.contains(plane)) planes_.emplace(plane, mesh_plane(scene_, plane));
    }
  }
  tbb::parallel_for(std::size_t{0}, fresh.size(), [&](std::size_t i) {
    std::erase_if(candidates[i],
                  [&](std::uint32_t part) { return !is_on(points.exact(fresh[i]), part); });
  });
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    if (!candidates[i].empty()) parts_.emplace(fresh[i], std::move(candidates[i]));
  }
}

bool Contacts::touches(std::uint32_t vertex, const MeshFace& face) const {
  const auto found = parts_.find(vertex);
  if (found == parts_.end()) return false;
  return std::ranges::any_of(found->second, [&](std::uint32_t part) {
    return scene_.parts[part].plane != scene_.parts[face.part].plane;
  });
}

bool Contacts::is_behind(std::uint32_t vertex, const MeshFace& face,
                         const ExactPoint& inside) const {
  const auto found = parts_.find(vertex);
  if (found == parts_.end()) return false;
  return std::ranges::any_of(found->second, [&](std::uint32_t number) {
    const Part& part = scene_.parts[number];
    if (part.plane == scene_.parts[face.part].plane) return false;
    const int side = side_of(planes_.at(part.plane), inside) * (part.flipped ? -1 : 1);
    return side < 0 || (side > 0 && part.two_sided);
  });
}

ExactPoint inner_point(std::span<const std::uint32_t> loop, const PointTable& points) {
  // Three consecutive corners that are not collinear are there, since the face has area.
  std::size_t i = 0;
  const std::size_t n = loop.size();
  while (i + 1 < n && collinear(points.exact(loop[i]), points.exact(loop[(i + 1) % n]),
                                points.exact(loop[(i + 2) % n]))) {
    ++i;
  }
  const ExactPoint& a = points.exact(loop[i]);
  const ExactPoint& b = points.exact(loop[(i + 1) % n]);
  const ExactPoint& c = points.exact(loop[(i + 2) % n]);
  ExactPoint result;
  const mpz_class ab = a.denominator * b.denominator, bc = b.denominator * c.denominator,
                  ca = c.denominator * a.denominator;
  for (std::size_t k = 0; k < 3; ++k) {
    result.numerator[k] = a.numerator[k] * bc + b.numerator[k] * ca + c.numerator[k] * ab;
  }
  result.denominator = 3 * ab * c.denominator;
  make_primitive(result);
  return result;
}

}  // namespace gnomon
