// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/hidden_lines/breakpoint.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon {

namespace {

/// before / (before + after): both terms are off by 2^-52 of themselves, and nothing cancels.
double near_share(const mpz_class& before, const mpz_class& after) {
  long of_before = 0, of_after = 0;
  const double first = mpz_get_d_2exp(&of_before, before.get_mpz_t());
  const double second = mpz_get_d_2exp(&of_after, after.get_mpz_t());
  // A term that is 2^-100 of the other may be off as much as it likes.
  const long by = std::clamp(of_after - of_before, -100L, 100L);
  const double scaled = std::ldexp(second, static_cast<int>(by));
  return first / (first + scaled);
}

}  // namespace

Breakpoint::Breakpoint(mpz_class at_start, mpz_class at_end, BothSides its_change)
    : change(its_change), before_(std::move(at_start)), after_(std::move(at_end)) {
  mpz_abs(before_.get_mpz_t(), before_.get_mpz_t());
  mpz_abs(after_.get_mpz_t(), after_.get_mpz_t());
  near_ = near_share(before_, after_);
}

int Breakpoint::compare(const Breakpoint& other) const {
  if (std::fabs(near_ - other.near_) > 2 * kError) return near_ < other.near_ ? -1 : 1;
  const mpz_class mine = before_ * other.after_, its = other.before_ * after_;
  return cmp(mine, its);
}

mpq_class Breakpoint::parameter() const {
  mpq_class result(before_, before_ + after_);
  result.canonicalize();
  return result;
}

void sort_and_merge(std::vector<Breakpoint>& breakpoints) {
  std::ranges::sort(breakpoints,
                    [](const Breakpoint& a, const Breakpoint& b) { return a.compare(b) < 0; });
  std::size_t kept = 0;
  for (std::size_t i = 0, end = 0; i < breakpoints.size(); i = end) {
    for (end = i + 1; end < breakpoints.size() && breakpoints[i].compare(breakpoints[end]) == 0;
         ++end) {
      breakpoints[i].change += breakpoints[end].change;
    }
    if (breakpoints[i].change == BothSides{}) continue;
    if (kept != i) breakpoints[kept] = std::move(breakpoints[i]);
    ++kept;
  }
  breakpoints.erase(breakpoints.begin() + static_cast<std::ptrdiff_t>(kept), breakpoints.end());
}

}  // namespace gnomon
