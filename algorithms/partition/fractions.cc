// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/partition/fractions.h"

#include <algorithm>
#include <utility>

#include "kernel/implicit/implicit_scene_space.h"

namespace gnomon {

Chart chart_of(const Geometry& geometry, PlaneId plane) {
  const Vector3<mpz_class> n = ExactGeometry<mpz_class>(geometry).plane(plane).n;
  int dropped = 2;
  for (const int k : {1, 0}) {
    if (mpz_cmpabs(n[static_cast<std::size_t>(k)].get_mpz_t(),
                   n[static_cast<std::size_t>(dropped)].get_mpz_t()) > 0) {
      dropped = k;
    }
  }
  return {(dropped + 1) % 3, (dropped + 2) % 3};
}

void FractionSum::add(Fraction fraction) {
  sum_ = sum_ + fraction.enclosure;
  if (!fraction.has_exact) return;
  mpq_class carry = std::move(fraction.exact);
  std::size_t level = 0;
  for (; level < partial_.size() && filled_[level]; ++level) {
    carry += partial_[level];
    partial_[level] = 0;
    filled_[level] = false;
  }
  if (level == partial_.size()) {
    partial_.emplace_back();
    filled_.push_back(false);
  }
  partial_[level] = std::move(carry);
  filled_[level] = true;
}

Interval FractionSum::interval(bool certified) const {
  if (!certified) return {sum_.middle, sum_.middle};
  return {std::clamp(sum_.lower(), 0.0, 1.0), std::clamp(sum_.upper(), 0.0, 1.0)};
}

mpq_class FractionSum::exact() const {
  mpq_class total = 0;
  for (const mpq_class& partial : partial_) total += partial;
  return total;
}

}  // namespace gnomon
