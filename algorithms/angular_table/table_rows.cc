// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/table_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gnomon {

namespace {

/// The range of t, times a power of two, has so many bits.
constexpr long kRangeBits = 24;

mpq_class times_two_to(const mpq_class& value, long exponent) {
  mpq_class result;
  if (exponent >= 0) {
    mpq_mul_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  } else {
    mpq_div_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  }
  return result;
}

mpz_class floor_of(const mpq_class& value) {
  mpz_class result;
  mpz_fdiv_q(result.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  return result;
}
mpz_class ceiling_of(const mpq_class& value) {
  mpz_class result;
  mpz_cdiv_q(result.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  return result;
}

}  // namespace

TableRows::TableRows(const TableMesh& mesh, std::span<const std::uint32_t> used, std::uint32_t rows)
    : is_exact_(rows == MethodOptionValues::kExactRows),
      count_(is_exact_ ? 0 : rows),
      ranks_(mesh.vertices().size(), 0) {
  if (used.empty()) {
    count_ = 0;
    return;
  }
  const auto t_of = [&](std::uint32_t vertex) {
    const DirectionVector& y = mesh.vertices()[vertex].direction;
    mpq_class t(y[1], y[2]);
    t.canonicalize();
    return t;
  };
  if (is_exact_) {
    for (const std::uint32_t vertex : used) values_.push_back(t_of(vertex));
    std::ranges::sort(values_);
    values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
    count_ = static_cast<std::uint32_t>(values_.size() - 1);
    for (const std::uint32_t vertex : used) {
      const auto place = std::ranges::lower_bound(values_, t_of(vertex));
      ranks_[vertex] = static_cast<std::uint32_t>(place - values_.begin());
    }
    for (const mpq_class& value : values_) near_values_.push_back(value.get_d());
    for (std::uint32_t k = 0; k < count_; ++k) {
      middles_.emplace_back((values_[k] + values_[k + 1]) / 2);
    }
    return;
  }
  mpq_class least = t_of(used.front()), greatest = least;
  for (const std::uint32_t vertex : used) {
    mpq_class t = t_of(vertex);
    if (t < least) least = t;
    if (t > greatest) greatest = std::move(t);
  }
  make_slices(mesh, used, least, greatest);
}

void TableRows::make_slices(const TableMesh& mesh, std::span<const std::uint32_t> used,
                            const mpq_class& least, const mpq_class& greatest) {
  const mpq_class range = greatest - least;
  long exponent = 0;
  if (range > 0) {
    exponent = kRangeBits - (static_cast<long>(mpz_sizeinbase(range.get_num_mpz_t(), 2)) -
                             static_cast<long>(mpz_sizeinbase(range.get_den_mpz_t(), 2)));
  }
  const mpz_class low = floor_of(times_two_to(least, exponent));
  mpz_class high = ceiling_of(times_two_to(greatest, exponent));
  if (high == low) ++high;
  low_ = times_two_to(mpq_class(low), -exponent);
  step_ = times_two_to(mpq_class(high - low), -exponent) / count_;
  for (std::uint32_t k = 0; k <= count_; ++k) near_values_.push_back(border(k).get_d());
  for (std::uint32_t k = 0; k < count_; ++k) {
    middles_.emplace_back(low_ + step_ * mpq_class(2 * k + 1, 2));
  }
  for (const std::uint32_t vertex : used) {
    // Rows k with low + (k + 1/2) step < t.
    const DirectionVector& y = mesh.vertices()[vertex].direction;
    mpq_class t(y[1], y[2]);
    t.canonicalize();
    const mpz_class below = ceiling_of((t - low_) / step_ - mpq_class(1, 2));
    ranks_[vertex] = below < 0        ? 0
                     : below > count_ ? count_
                                      : static_cast<std::uint32_t>(below.get_ui());
  }
}

mpq_class TableRows::border(std::uint32_t k) const {
  return is_exact_ ? values_[k] : mpq_class(low_ + step_ * k);
}

std::optional<std::uint32_t> TableRows::holding(const mpq_class& t) const {
  if (count_ == 0 || t < border(0) || t >= border(count_)) return std::nullopt;
  std::uint32_t low = 0, high = count_;
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (t >= border(middle) ? low : high) = middle;
  }
  return low;
}

std::uint32_t TableRows::guess(double t) const {
  const auto above = std::ranges::upper_bound(near_values_, t);
  const auto k = static_cast<std::uint32_t>(above - near_values_.begin());
  return std::clamp<std::uint32_t>(k, 1, std::max(count_, 1u)) - 1;
}

}  // namespace gnomon
