// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/repair/rational_space.h"

#include <algorithm>
#include <cmath>

namespace gnomon::scene_detail {

RationalPoint operator-(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RationalPoint moved(const RationalPoint& a, const mpq_class& s, const RationalPoint& b) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

RationalPoint cross_product(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class dot_product(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool is_zero(const RationalPoint& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

mpq_class RationalPlane::square_from(const RationalPoint& p) const {
  const mpq_class off = dot_product(normal, p) - offset;
  return off * off / square_of(normal);
}

bool RationalPlane::is_same_as(const RationalPlane& other) const {
  return is_zero(cross_product(normal, other.normal)) && holds(other.points[0]);
}

std::optional<RationalPlane> plane_through(const RationalPoint& a, const RationalPoint& b,
                                           const RationalPoint& c) {
  RationalPlane plane{cross_product(b - a, c - a), 0, {a, b, c}};
  if (is_zero(plane.normal)) return std::nullopt;
  plane.offset = dot_product(plane.normal, a);
  return plane;
}

namespace {

/// The exponent of the smallest power of ten whose multiple the value is; nothing if it is none.
std::optional<long> decimal_places(const mpq_class& value) {
  constexpr long kMostPlaces = 300;
  mpz_class rest = value.get_den();
  const auto twos =
      static_cast<long>(mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), mpz_class(2).get_mpz_t()));
  const auto fives =
      static_cast<long>(mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), mpz_class(5).get_mpz_t()));
  const long places = std::max(twos, fives);
  if (rest != 1 || places > kMostPlaces) return std::nullopt;
  return places;
}

mpz_class power_of_ten(long exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(exponent));
  return power;
}

/// The nearest multiple of 10^-places.
mpq_class rounded_to(const mpq_class& value, long places) {
  const mpz_class scale = power_of_ten(places);
  const mpq_class scaled = value * scale + mpq_class(1, 2);
  mpz_class whole;
  mpz_fdiv_q(whole.get_mpz_t(), scaled.get_num_mpz_t(), scaled.get_den_mpz_t());
  mpq_class result(whole, scale);
  result.canonicalize();
  return result;
}

/// Places with which a share of a vector of this length is finer than `fineness`.
long places_for(const RationalPoint& vector, const mpq_class& fineness) {
  constexpr double kMuchFiner = 1e-6;
  const double ratio = std::sqrt(square_of(vector).get_d()) / (fineness.get_d() * kMuchFiner);
  return std::clamp(static_cast<long>(std::ceil(std::log10(std::max(ratio, 1.0)))), 0L, 60L);
}

int greatest_axis(const RationalPoint& vector) {
  int axis = 2;
  for (int k = 1; k >= 0; --k) {
    const auto at = static_cast<std::size_t>(k), best = static_cast<std::size_t>(axis);
    if (abs(vector[at]) > abs(vector[best])) axis = k;
  }
  return axis;
}

/// Of one plane: along the axis to which it is steepest, or else shares of two of its edges.
std::optional<RationalPoint> on_plane(const RationalPlane& plane, const RationalPoint& p,
                                      const mpq_class& fineness) {
  const auto axis = static_cast<std::size_t>(greatest_axis(plane.normal));
  RationalPoint along = p;
  along[axis] += (plane.offset - dot_product(plane.normal, p)) / plane.normal[axis];
  if (is_decimal(along[axis])) return along;
  const RationalPoint first = plane.points[1] - plane.points[0],
                      second = plane.points[2] - plane.points[0], to = along - plane.points[0];
  // to = s first + t second, by the two coordinates in which the plane is seen best.
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const mpq_class determinant = first[u] * second[v] - first[v] * second[u];
  const mpq_class s = (to[u] * second[v] - to[v] * second[u]) / determinant;
  const mpq_class t = (first[u] * to[v] - first[v] * to[u]) / determinant;
  const RationalPoint at_first =
      moved(plane.points[0], rounded_to(s, places_for(first, fineness)), first);
  return moved(at_first, rounded_to(t, places_for(second, fineness)), second);
}

/// Of two planes that meet in a line: at a coordinate of p, or else a share of a known stretch.
std::optional<RationalPoint> on_line(const RationalPlane& a, const RationalPlane& b,
                                     const RationalPoint& p, const mpq_class& fineness,
                                     const std::vector<RationalPoint>& on_all) {
  const RationalPoint direction = cross_product(a.normal, b.normal);
  const auto axis = static_cast<std::size_t>(greatest_axis(direction));
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const mpq_class determinant = a.normal[u] * b.normal[v] - a.normal[v] * b.normal[u];
  const mpq_class at_a = a.offset - a.normal[axis] * p[axis],
                  at_b = b.offset - b.normal[axis] * p[axis];
  RationalPoint crossing = p;
  crossing[u] = (at_a * b.normal[v] - at_b * a.normal[v]) / determinant;
  crossing[v] = (a.normal[u] * at_b - b.normal[u] * at_a) / determinant;
  if (is_decimal(crossing)) return crossing;
  for (std::size_t i = 1; i < on_all.size(); ++i) {
    const RationalPoint stretch = on_all[i] - on_all[0];
    if (stretch[axis] == 0) continue;
    const mpq_class s = (p[axis] - on_all[0][axis]) / stretch[axis];
    return moved(on_all[0], rounded_to(s, places_for(stretch, fineness)), stretch);
  }
  return std::nullopt;
}

std::optional<RationalPoint> on_three(const RationalPlane& a, const RationalPlane& b,
                                      const RationalPlane& c) {
  const RationalPoint bc = cross_product(b.normal, c.normal),
                      ca = cross_product(c.normal, a.normal),
                      ab = cross_product(a.normal, b.normal);
  const mpq_class determinant = dot_product(a.normal, bc);
  if (determinant == 0) return std::nullopt;
  RationalPoint point;
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = (a.offset * bc[k] + b.offset * ca[k] + c.offset * ab[k]) / determinant;
  }
  return is_decimal(point) ? std::optional(point) : std::nullopt;
}

}  // namespace

bool is_decimal(const mpq_class& value) { return decimal_places(value).has_value(); }

bool is_decimal(const RationalPoint& point) {
  return std::ranges::all_of(point, [](const mpq_class& value) { return is_decimal(value); });
}

double not_less_than(const mpq_class& distance) { return distance.get_d() * (1 + 1e-12); }

Number to_number(const mpq_class& value, NumberMeaning meaning) {
  const double nearest = value.get_d();  // truncated
  for (const double candidate :
       {nearest, std::nextafter(nearest, nearest < 0 ? -INFINITY : INFINITY)}) {
    if (meaning == NumberMeaning::kDouble && mpq_class(candidate) == value)
      return Number(candidate);
  }
  const long places = *decimal_places(value);
  const mpq_class scaled = value * power_of_ten(places);
  return Number::from_decimal(scaled.get_num(), static_cast<std::int32_t>(-places));
}

std::optional<RationalPoint> decimal_point_on(const std::vector<RationalPlane>& planes,
                                              const RationalPoint& p, const mpq_class& fineness,
                                              const std::vector<RationalPoint>& on_all) {
  // Planes that say something new: at most three whose normals are independent.
  std::vector<const RationalPlane*> independent;
  for (const RationalPlane& plane : planes) {
    if (independent.empty()) {
      independent.push_back(&plane);
    } else if (independent.size() == 1) {
      if (!is_zero(cross_product(independent[0]->normal, plane.normal))) {
        independent.push_back(&plane);
      }
    } else if (independent.size() == 2) {
      const RationalPoint line = cross_product(independent[0]->normal, independent[1]->normal);
      if (dot_product(line, plane.normal) != 0) independent.push_back(&plane);
    }
  }
  std::optional<RationalPoint> point;
  switch (independent.size()) {
    case 0:
      return p;
    case 1:
      point = on_plane(*independent[0], p, fineness);
      break;
    case 2:
      point = on_line(*independent[0], *independent[1], p, fineness, on_all);
      break;
    default:
      point = on_three(*independent[0], *independent[1], *independent[2]);
  }
  if (!point ||
      !std::ranges::all_of(planes, [&](const auto& plane) { return plane.holds(*point); })) {
    return std::nullopt;
  }
  return point;
}

}  // namespace gnomon::scene_detail
