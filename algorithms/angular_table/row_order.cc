// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/row_order.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

/// With u = 2^-53, s and t of vertices within 2u of themselves, T and S the largest of the values
/// of t and s, and m the slope: the two differences of t err by 5uT each, so that their quotient,
/// at most 1, errs by 10uT over the lower one, and s by 10uT |m|; the difference of the two s, its
/// product and the sum err by 14uS together. 32u is for second order.
RowOrder::NearS RowOrder::near(std::uint32_t edge) const {
  constexpr double kError = 32 * 0x1p-53;
  const TableVertex& a = mesh_.vertices()[mesh_.edge(edge).from];
  const TableVertex& b = mesh_.vertices()[mesh_.edge(edge).to];
  const double over = b.t - a.t, across = b.s - a.s;
  const double most_t = std::max({std::fabs(a.t), std::fabs(b.t), std::fabs(near_t_)});
  const double most_s = std::max(std::fabs(a.s), std::fabs(b.s));
  // Where the difference is zero the error is no number, and no comparison with it decides.
  return {a.s + across * ((near_t_ - a.t) / over),
          kError * (most_s + most_t * std::fabs(across / over))};
}

mpq_class RowOrder::exact(std::uint32_t edge) const {
  const DirectionVector& a = mesh_.vertices()[mesh_.edge(edge).from].direction;
  const DirectionVector& b = mesh_.vertices()[mesh_.edge(edge).to].direction;
  // The combination of the two ends that is in the row's plane.
  const mpz_class of_b = t_.get_den() * a[1] - t_.get_num() * a[2];
  const mpz_class of_a = t_.get_den() * b[1] - t_.get_num() * b[2];
  mpq_class s(of_b * b[0] - of_a * a[0], of_b * b[2] - of_a * a[2]);
  s.canonicalize();
  return s;
}

}  // namespace gnomon
