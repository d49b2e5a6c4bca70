// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/light_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace gnomon {
namespace {

std::array<double, 3> rounded(const PairPoint& point) {
  return {point[0].high, point[1].high, point[2].high};
}
std::array<double, 3> minus(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
std::array<double, 3> cross_product(const std::array<double, 3>& a,
                                    const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// The plane through a point. Its error, for |x| <= 1 and points of at most `reach`: with R = 1 +
/// reach, differences err by at most 3uR, normals by 16 u R^2 a component, each of n . x and n . p
/// by at most 66 u R^2 (1 or reach), and the point's own rounding by 6 u R^2 reach; 80 u R^3 in
/// all.
LightShaft::Plane shaft_plane(const std::array<double, 3>& normal,
                              const std::array<double, 3>& point, double reach) {
  const double r = 1 + reach;
  return {normal, normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2],
          128 * Ball::kUnit * r * r * r};
}
std::array<double, 3> negated(const std::array<double, 3>& a) { return {-a[0], -a[1], -a[2]}; }

void enclose_point(Box& box, const PairPoint& point) {
  for (int k = 0; k < 3; ++k) {
    const double value = point[k].high, error = 2 * Ball::kUnit * std::fabs(value) + Ball::kTiny;
    box.low[k] = std::min(box.low[k], value - error);
    box.high[k] = std::max(box.high[k], value + error);
  }
}

/// Appends the members whose boxes may reach into the shaft, in no particular order.
void find_in(const BoxTree& tree, const LightShaft& shaft, std::vector<std::uint32_t>& found) {
  tree.find([&](const BoxTree::Node& node, std::uint32_t) { return !shaft.misses(node.box); },
            [&](std::uint32_t number) { return !shaft.misses(tree.box(number)); }, found);
}

}  // namespace

LightView::LightView(const PreparedScene& scene, std::uint32_t light)
    : scene_(scene), light_(light), pairs_(scene.geometry) {
  const PreparedLight& own = scene.lights[light];
  const mpz_class one = 1;
  const auto add = [&](const std::array<mpz_class, 3>& point) {
    light_grid_.push_back(point);
    std::size_t bits = scene.geometry.grid.bits();
    if (own.point.directional) {
      bits = 0;
      for (const mpz_class& c : point) bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
    }
    PairPoint pairs;
    for (std::size_t k = 0; k < 3; ++k) {
      pairs[k] = pair_of(point[k], one, static_cast<unsigned>(bits));
    }
    light_pairs_.push_back(pairs);
  };
  if (own.has_area()) {
    for (const auto& point : own.area_loop) add(point);
    make_chart();
  } else {
    add(own.point.grid);
  }
  find_sides();
}

void LightView::make_chart() {
  const std::size_t n = light_grid_.size();
  axes_ = {difference(light_grid_[1], light_grid_[0]),
           difference(light_grid_[n - 1], light_grid_[0])};
  near_axes_ = {difference_of(light_pairs_[1], light_pairs_[0], 1),
                difference_of(light_pairs_[n - 1], light_pairs_[0], 1)};
  light_plane_.normal = cross(axes_[0], axes_[1]);
  light_plane_.offset = dot(light_plane_.normal, light_grid_[0]);
  light_normal_ = cross(near_axes_[0], near_axes_[1]);
  const mpz_class& weight = dot(light_plane_.normal, light_plane_.normal);
  for (std::size_t i = 0; i < n; ++i) {
    // s = N . (d x e2) / N^2, t = N . (e1 x d) / N^2.
    const ExactVector d = difference(light_grid_[i], light_grid_[0]);
    ExactVector corner{dot(light_plane_.normal, cross(d, axes_[1])),
                       dot(light_plane_.normal, cross(axes_[0], d)), weight};
    mpz_class common;
    mpz_gcd(common.get_mpz_t(), corner[0].get_mpz_t(), corner[1].get_mpz_t());
    mpz_gcd(common.get_mpz_t(), common.get_mpz_t(), corner[2].get_mpz_t());
    for (mpz_class& c : corner) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), common.get_mpz_t());
    std::array<Ball, 2> near;
    for (std::size_t k = 0; k < 2; ++k) {
      near[k] = rounded_ball(pair_of(corner[k], corner[2], 0).high);
    }
    near_corners_.push_back(near);
    corners_.push_back(std::move(corner));
  }
  for (std::size_t i = 0; i < n; ++i) {
    ExactVector line = cross(corners_[i], corners_[(i + 1) % n]);
    // Scaled as pairs of doubles are, by one power of two.
    std::size_t bits = 0;
    for (const mpz_class& c : line) bits = std::max(bits, mpz_sizeinbase(c.get_mpz_t(), 2));
    std::array<Ball, 3> near;
    const mpz_class one = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      near[k] = rounded_ball(pair_of(line[k], one, static_cast<unsigned>(bits)).high);
    }
    near_edge_lines_.push_back(near);
    edge_lines_.push_back(std::move(line));
  }
}

void LightView::find_sides() {
  std::vector<Sides> sides(scene_.geometry.planes.size());
  std::vector<bool> known(scene_.geometry.planes.size());
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < scene_.parts.size(); ++i) {
    const Part& part = scene_.parts[i];
    if (!part.casts) continue;
    if (!known[part.plane]) {
      sides[part.plane] = sides_of(part.plane);
      known[part.plane] = true;
    }
    Sides own = sides[part.plane];
    const bool cuts = own.front && own.back;
    if (part.flipped) std::swap(own.front, own.back);
    if (!part.two_sided) own.back = false;
    if (!own.front && !own.back) continue;
    casters_.push_back({i, own.front, own.back, cuts});
    Box box;
    for (const VertexId vertex : scene_.loop(part)) enclose_point(box, pairs_[vertex]);
    boxes.push_back(box);
  }
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0u);
  tree_ = BoxTree(std::move(boxes), std::move(all));
}

ExactVector LightView::grid_point(VertexId vertex) const {
  const GridPositions& grid = scene_.geometry.grid;
  return {grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)};
}

LightView::ExactPlane LightView::exact_plane(PlaneId plane) const {
  const SupportTriple& triple = scene_.geometry.planes[plane];
  const ExactVector a = grid_point(triple.a);
  ExactPlane result;
  result.normal = cross(difference(grid_point(triple.b), a), difference(grid_point(triple.c), a));
  result.offset = dot(result.normal, a);
  return result;
}

BallVector LightView::normal(PlaneId plane) const {
  const SupportTriple& triple = scene_.geometry.planes[plane];
  return cross(difference_of(pairs_[triple.b], pairs_[triple.a], 1),
               difference_of(pairs_[triple.c], pairs_[triple.a], 1));
}

Sign LightView::side_of(PlaneId plane, const Apex& apex, SignCounts& counts) const {
  ++counts.all;
  const SupportTriple& triple = scene_.geometry.planes[plane];
  const Sign sign =
      certain_sign(dot(normal(plane), difference_of(apex.near, pairs_[triple.a], apex.reach)));
  if (sign != Sign::kZero) return sign;
  ++counts.exact;
  const ExactPlane exact = exact_plane(plane);
  return sign_of(mpz_class(dot(exact.normal, apex.point) - exact.offset * apex.weight));
}

Sign LightView::side_of_light(const Apex& apex, SignCounts& counts) const {
  ++counts.all;
  const Sign sign =
      certain_sign(dot(light_normal_, difference_of(apex.near, light_pairs_[0], apex.reach)));
  if (sign != Sign::kZero) return sign;
  ++counts.exact;
  return sign_of(
      mpz_class(dot(light_plane_.normal, apex.point) - light_plane_.offset * apex.weight));
}

LightView::Sides LightView::sides_of(PlaneId plane) const {
  Sides result;
  const SupportTriple& triple = scene_.geometry.planes[plane];
  const BallVector near = normal(plane);
  for (std::size_t i = 0; i < light_pairs_.size(); ++i) {
    const bool directional = light().point.directional;
    const BallVector difference = directional ? BallVector{rounded_ball(light_pairs_[i][0].high),
                                                           rounded_ball(light_pairs_[i][1].high),
                                                           rounded_ball(light_pairs_[i][2].high)}
                                              : difference_of(light_pairs_[i], pairs_[triple.a], 1);
    Sign sign = certain_sign(dot(near, difference));
    if (sign == Sign::kZero) {
      const ExactPlane exact = exact_plane(plane);
      mpz_class value = dot(exact.normal, light_grid_[i]);
      if (!directional) value -= exact.offset;
      sign = sign_of(value);
    }
    if (sign == Sign::kPositive) result.front = true;
    if (sign == Sign::kNegative) result.back = true;
  }
  return result;
}

BallVector LightView::edge_normal(EdgeId edge, const Apex& apex) const {
  const EdgeEnds& ends = scene_.geometry.edges[edge];
  return cross(difference_of(pairs_[ends.b], pairs_[ends.a], 1),
               difference_of(apex.near, pairs_[ends.a], apex.reach));
}

Sign LightView::side_of_edge_plane(EdgeId edge, const Apex& apex, const Apex& point,
                                   SignCounts& counts) const {
  ++counts.all;
  const PairPoint& a = pairs_[scene_.geometry.edges[edge].a];
  const Sign sign =
      certain_sign(dot(edge_normal(edge, apex), difference_of(point.near, a, point.reach)));
  if (sign != Sign::kZero) return sign;
  ++counts.exact;
  const ExactPlane exact = exact_edge_plane(edge, apex);
  return sign_of(mpz_class(dot(exact.normal, point.point) - exact.offset * point.weight));
}

LightView::ExactPlane LightView::exact_edge_plane(EdgeId edge, const Apex& apex) const {
  // Times the weight W of p = P / W: normal W (a x b) + (b - a) x P, offset (a x b) . P.
  const EdgeEnds& ends = scene_.geometry.edges[edge];
  const ExactVector a = grid_point(ends.a), b = grid_point(ends.b);
  const ExactVector product = cross(a, b);
  ExactPlane result;
  result.normal = cross(difference(b, a), apex.point);
  for (std::size_t k = 0; k < 3; ++k) result.normal[k] += apex.weight * product[k];
  result.offset = dot(product, apex.point);
  return result;
}

ExactVector LightView::line_of(const ExactPlane& plane) const {
  return {dot(plane.normal, axes_[0]), dot(plane.normal, axes_[1]),
          mpz_class(dot(plane.normal, light_grid_[0]) - plane.offset)};
}

std::array<Ball, 3> LightView::line_of(const BallVector& normal,
                                       const BallVector& to_origin) const {
  return {dot(normal, near_axes_[0]), dot(normal, near_axes_[1]), dot(normal, to_origin)};
}

LightShaft LightView::shaft_of(const Apex& apex, PlaneId receiver, bool back) const {
  LightShaft shaft;
  enclose_point(shaft.box, apex.near);
  const std::array<double, 3> p = rounded(apex.near);
  if (light().point.directional) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const int direction = sgn(light_grid_[0][k]);
      if (direction > 0) shaft.box.high[k] = kInfinity;
      if (direction < 0) shaft.box.low[k] = -kInfinity;
    }
  } else {
    for (const PairPoint& point : light_pairs_) enclose_point(shaft.box, point);
  }
  if (light().has_area()) {
    const std::size_t n = light_pairs_.size();
    for (std::size_t i = 0; i < n; ++i) {
      // Seen from its front the light is counter-clockwise: the rest of it is behind this plane.
      const auto normal = cross_product(minus(rounded(light_pairs_[i]), p),
                                        minus(rounded(light_pairs_[(i + 1) % n]), p));
      shaft.planes.push_back(shaft_plane(negated(normal), p, apex.reach));
    }
  }
  if (!light().has_area()) {
    // Planes along the ray, each parallel to one axis, from both sides.
    std::array<double, 3> ray = rounded(light_pairs_[0]);
    if (!light().point.directional) ray = minus(ray, p);
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> axis{};
      axis[k] = 1;
      const auto normal = cross_product(axis, ray);
      shaft.planes.push_back(shaft_plane(normal, p, apex.reach));
      shaft.planes.push_back(shaft_plane(negated(normal), p, apex.reach));
    }
  }
  add_planes(shaft, receiver, back);
  return shaft;
}

void LightView::add_planes(LightShaft& shaft, PlaneId receiver, bool back) const {
  if (light().has_area()) {
    const auto first = rounded(light_pairs_[0]);
    shaft.planes.push_back(shaft_plane(cross_product(minus(rounded(light_pairs_[1]), first),
                                                     minus(rounded(light_pairs_.back()), first)),
                                       first, 1));
  }
  if (receiver != kNoPlane) {
    const SupportTriple& triple = scene_.geometry.planes[receiver];
    const auto a = rounded(pairs_[triple.a]);
    const auto normal =
        cross_product(minus(rounded(pairs_[triple.b]), a), minus(rounded(pairs_[triple.c]), a));
    shaft.planes.push_back(shaft_plane(back ? negated(normal) : normal, a, 1));
  }
}

void LightView::find_casters(const Apex& apex, PlaneId receiver, bool back,
                             std::vector<std::uint32_t>& found) const {
  find_in(tree_, shaft_of(apex, receiver, back), found);
  // Only the work depends on this order: the more a caster hides, the less is left to be cut.
  std::vector<std::pair<double, std::uint32_t>> keys;
  keys.reserve(found.size());
  for (const std::uint32_t caster : found) {
    const Box& box = tree_.box(caster);
    double size = 0, distance = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double extent = box.high[k] - box.low[k];
      const double away = (box.high[k] + box.low[k]) / 2 - apex.near[k].high;
      size += extent * extent;
      distance += away * away;
    }
    keys.emplace_back(-size / distance, caster);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = keys[i].second;
}

void LightView::find_casters(std::span<const Apex> apexes, PlaneId receiver, bool back,
                             std::vector<std::uint32_t>& found) const {
  LightShaft shaft;
  for (const Apex& apex : apexes) enclose_point(shaft.box, apex.near);
  for (const PairPoint& point : light_pairs_) enclose_point(shaft.box, point);
  add_planes(shaft, receiver, back);
  find_in(tree_, shaft, found);
}

}  // namespace gnomon
