// SPDX-License-Identifier: GPL-3.0-or-later
// The table of targets: what was aimed at, what was measured, and whether that is enough.
#ifndef GNOMON_BENCH_VERDICTS_H
#define GNOMON_BENCH_VERDICTS_H

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::bench {

enum class Unit { kRatio, kSeconds, kExponent, kGigabytes };

struct Target {
  std::string text;  // as it was set: "at most 1.25x"
  double limit = 0;
  bool at_least = false;  // else at most
  Unit unit = Unit::kRatio;
};

class Verdicts {
 public:
  /// `algorithms`: one column each; the verdict is on `judged`, the one that runs by default.
  Verdicts(std::vector<std::string> algorithms, std::size_t judged)
      : algorithms_(std::move(algorithms)), judged_(judged) {}

  /// `measured`: one an algorithm; NaN where there is nothing to measure.
  void add(const std::string& work, const std::string& scene, const Target& target,
           const std::vector<double>& measured);
  void print() const;

 private:
  std::vector<std::string> algorithms_;
  std::size_t judged_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_VERDICTS_H
