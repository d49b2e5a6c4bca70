// SPDX-License-Identifier: GPL-3.0-or-later
// Times of several pieces of work in one run, and what is made of them: medians, ratios, exponents.
#ifndef GNOMON_BENCH_TIMING_H
#define GNOMON_BENCH_TIMING_H

#include <functional>
#include <vector>

namespace gnomon::bench {

/// Seconds of one piece of work, by round.
struct Times {
  std::vector<double> cpu, wall;
};

/// Runs all in turn, A B C A B C ..., so that a disturbance meets all of them alike.
std::vector<Times> interleaved(const std::vector<std::function<void()>>& work, int rounds);

/// Requires: not empty.
double median(std::vector<double> values);
/// Median over the rounds of a / b. Requires: of one interleaved run.
double median_ratio(const std::vector<double>& a, const std::vector<double>& b);
struct Line {
  double at_zero = 0, slope = 0;
};
/// By least squares of y. Requires: two different x.
Line line_through(const std::vector<double>& x, const std::vector<double>& y);
/// The exponent k of y ~ x^k by least squares of the logarithms. Requires: two different x.
double growth_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_TIMING_H
