// SPDX-License-Identifier: GPL-3.0-or-later
// The table of targets: what was aimed at, what was measured, and whether that is enough.
#ifndef GNOMON_BENCH_VERDICTS_H
#define GNOMON_BENCH_VERDICTS_H

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::bench {

enum class Unit { kRatio, kSeconds, kExponent, kGigabytes, kShare };

struct Target {
  std::string text;  // as it was set: "at most 1.25x"
  double limit = 0;
  bool at_least = false;  // else at most
  Unit unit = Unit::kRatio;
};

/// "at least 5x": a ratio that is to be reached.
Target at_least(double ratio);
/// "at most 1.15x", "at most 30 s", "at most 20 %".
Target at_most(double limit, Unit unit = Unit::kRatio);

class Verdicts {
 public:
  /// `columns`: one a measured value; the verdict is on `judged`.
  Verdicts(std::string title, std::vector<std::string> columns, std::size_t judged = 0)
      : title_(std::move(title)), columns_(std::move(columns)), judged_(judged) {}

  /// `measured`: one a column; NaN where there is nothing to measure. `note`: what the values come
  /// from, or why there are none.
  void add(const std::string& work, const std::string& scene, const Target& target,
           const std::vector<double>& measured, const std::string& note = {});
  void print() const;
  /// An array of objects: work, scene, target, limit, at_least, unit, measured (by column, null
  /// where there is nothing), met (of the judged column; null there too), note.
  std::string json() const;

 private:
  struct Row {
    std::string work, scene;
    Target target;
    std::vector<double> measured;
    std::string note;
  };
  std::string title_;
  std::vector<std::string> columns_;
  std::size_t judged_;
  std::vector<Row> rows_;
};

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_VERDICTS_H
