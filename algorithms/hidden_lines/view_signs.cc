// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/hidden_lines/view_signs.h"

#include <algorithm>
#include <cmath>

#include "scene/base/exact_int.h"

namespace gnomon {

namespace {

template <class Int>
using Row = std::array<Int, 3>;

template <class Int>
Row<Int> cross_product(const Row<Int>& a, const Row<Int>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Int>
Int determinant(const Row<Int>& a, const Row<Int>& b, const Row<Int>& c) {
  const Row<Int> normal = cross_product(b, c);
  return a[0] * normal[0] + a[1] * normal[1] + a[2] * normal[2];
}
Row<scene_detail::Int128> widened(const Row<std::int64_t>& row) { return {row[0], row[1], row[2]}; }
Row<mpz_class> exactly(const Row<std::int64_t>& row) {
  return {mpz_class(static_cast<long>(row[0])), mpz_class(static_cast<long>(row[1])),
          mpz_class(static_cast<long>(row[2]))};
}

/// The sign where doubles are sure of it, else 0. With u = 2^-53 an entry is off by u of itself, a
/// product of three entries by less than 3.1 u more than its two roundings, and at most four sums
/// come on top: below 10 u of the sum of the absolute products, which is itself computed to within
/// 8 u. 16 u are more than both together. Entries are integers below 2^64: nothing under- or
/// overflows.
int filtered_sign(const Row<std::int64_t>& a, const Row<std::int64_t>& b,
                  const Row<std::int64_t>& c) {
  double value = 0, size = 0;
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const double x = static_cast<double>(b[u]) * static_cast<double>(c[v]);
    const double y = static_cast<double>(b[v]) * static_cast<double>(c[u]);
    const double entry = static_cast<double>(a[k]);
    value += entry * (x - y);
    size += std::fabs(entry) * (std::fabs(x) + std::fabs(y));
  }
  if (std::fabs(value) <= 0x1p-49 * size) return 0;
  return value > 0 ? 1 : -1;
}

/// Whether it is between -2^bits and 2^bits.
bool is_below(const mpz_class& value, unsigned bits) {
  return mpz_sizeinbase(value.get_mpz_t(), 2) <= bits;
}

}  // namespace

ViewSigns::ViewSigns(const Geometry& geometry, const LightPoint& viewer)
    : grid_(geometry.grid), directional_(viewer.directional), viewer_(viewer.grid) {
  // Positions are not negative, so that two of them differ by no more bits than one has.
  constexpr unsigned kNarrowBits = 61;
  const auto all_below = [&](unsigned bits) {
    return grid_.is_narrow() && grid_.bits() <= bits &&
           std::ranges::all_of(viewer_, [&](const mpz_class& x) { return is_below(x, bits); });
  };
  is_narrow_ = all_below(kNarrowBits);
  if (!is_narrow_) return;
  for (std::size_t k = 0; k < 3; ++k) narrow_viewer_[k] = viewer_[k].get_si();
  // Entries below 2^41: six products of three of them are below 2^126.
  fits_128_ = all_below(40);
}

ViewSigns::Narrow ViewSigns::narrow_difference(VertexId from, VertexId to) const {
  const std::int64_t *const a = grid_.narrow_point(from), *const b = grid_.narrow_point(to);
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}

ViewSigns::Narrow ViewSigns::narrow_view(VertexId vertex) const {
  const Narrow& viewer = narrow_viewer_;
  if (directional_) return {-viewer[0], -viewer[1], -viewer[2]};
  const std::int64_t* const at = grid_.narrow_point(vertex);
  return {at[0] - viewer[0], at[1] - viewer[1], at[2] - viewer[2]};
}

ViewSigns::Wide ViewSigns::wide_difference(VertexId from, VertexId to) const {
  return {grid_.at(to, 0) - grid_.at(from, 0), grid_.at(to, 1) - grid_.at(from, 1),
          grid_.at(to, 2) - grid_.at(from, 2)};
}

ViewSigns::Wide ViewSigns::wide_view(VertexId vertex) const {
  if (directional_) return {-viewer_[0], -viewer_[1], -viewer_[2]};
  return {grid_.at(vertex, 0) - viewer_[0], grid_.at(vertex, 1) - viewer_[1],
          grid_.at(vertex, 2) - viewer_[2]};
}

int ViewSigns::sign(const Narrow& a, const Narrow& b, const Narrow& c) const {
  if (const int sure = filtered_sign(a, b, c); sure != 0) return sure;
  if (fits_128_) {
    const auto value = determinant(widened(a), widened(b), widened(c));
    return value > 0 ? 1 : value < 0 ? -1 : 0;
  }
  return sgn(determinant(exactly(a), exactly(b), exactly(c)));
}

int ViewSigns::bracket(VertexId p, VertexId q, VertexId r) const {
  if (p == q || q == r || p == r) return 0;
  if (is_narrow_) return sign(narrow_view(p), narrow_difference(p, q), narrow_difference(p, r));
  return sgn(exact_bracket(p, q, r));
}

mpz_class ViewSigns::exact_bracket(VertexId p, VertexId q, VertexId r) const {
  if (fits_128_) {
    return scene_detail::to_mpz(determinant(widened(narrow_view(p)),
                                            widened(narrow_difference(p, q)),
                                            widened(narrow_difference(p, r))));
  }
  return determinant(wide_view(p), wide_difference(p, q), wide_difference(p, r));
}

int ViewSigns::volume(VertexId a, VertexId b, VertexId c, VertexId d) const {
  if (d == a || d == b || d == c || a == b || a == c || b == c) return 0;
  if (is_narrow_) {
    return sign(narrow_difference(a, b), narrow_difference(a, c), narrow_difference(a, d));
  }
  return sgn(exact_volume(a, b, c, d));
}

mpz_class ViewSigns::exact_volume(VertexId a, VertexId b, VertexId c, VertexId d) const {
  if (fits_128_) {
    return scene_detail::to_mpz(determinant(widened(narrow_difference(a, b)),
                                            widened(narrow_difference(a, c)),
                                            widened(narrow_difference(a, d))));
  }
  return determinant(wide_difference(a, b), wide_difference(a, c), wide_difference(a, d));
}

bool ViewSigns::are_collinear(VertexId a, VertexId b, VertexId c) const {
  const Wide normal = cross_product(wide_difference(a, b), wide_difference(a, c));
  return normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
}

bool ViewSigns::is_towards_viewer(VertexId a, VertexId b) const {
  const Wide normal = cross_product(wide_difference(a, b), wide_view(a));
  return normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
}

}  // namespace gnomon
