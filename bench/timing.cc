// SPDX-License-Identifier: GPL-3.0-or-later
#include "timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "machine.h"

namespace gnomon::bench {

std::vector<Times> interleaved(const std::vector<std::function<void()>>& work, int rounds) {
  using Clock = std::chrono::steady_clock;
  std::vector<Times> times(work.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < work.size(); ++i) {
      const Clock::time_point start = Clock::now();
      const double cpu_start = cpu_seconds();
      work[i]();
      times[i].cpu.push_back(cpu_seconds() - cpu_start);
      times[i].wall.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
  }
  return times;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double median_ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return median(std::move(ratios));
}

Line line_through(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum_x += x[i];
    sum_y += y[i];
    sum_xx += x[i] * x[i];
    sum_xy += x[i] * y[i];
  }
  const double slope = (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
  return {(sum_y - slope * sum_x) / n, slope};
}

double growth_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto logarithms = [](std::vector<double> values) {
    for (double& value : values) value = std::log(value);
    return values;
  };
  return line_through(logarithms(x), logarithms(y)).slope;
}

}  // namespace gnomon::bench
