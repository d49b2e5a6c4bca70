// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/samples/sample_tally.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gnomon::comparison {

namespace {

using oracle::JudgedSample;
using oracle::SampleOutcome;

/// A share of the scene's diagonal: what is farther from all shadows is no matter of rounding.
constexpr double kFar = 1e-3;

double size_of(double off) {
  return std::isfinite(off) ? std::fabs(off) : std::numeric_limits<double>::infinity();
}

/// Failures first, then by how wrong they are, then by how far from where they would be right.
bool is_worse(const JudgedSample& a, const JudgedSample& b) {
  if (a.outcome != b.outcome) return a.outcome > b.outcome;
  if (size_of(a.off) != size_of(b.off)) return size_of(a.off) > size_of(b.off);
  return a.from_border.value_or(0) > b.from_border.value_or(0);
}

std::vector<CountsOf> with_samples(const std::vector<SampleCounts>& counts, const auto& entries) {
  std::vector<CountsOf> result;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].all() > 0) result.push_back({entries[i].id, counts[i]});
  }
  return result;
}

}  // namespace

std::uint64_t SampleCounts::all() const {
  return std::accumulate(of.begin(), of.end(), std::uint64_t{0});
}

void SampleCounts::add(const JudgedSample& judged) {
  ++of[static_cast<std::size_t>(judged.outcome)];
  if (judged.outcome != SampleOutcome::kWrong || judged.out_of_range) return;
  ++(judged.off > 0 ? too_light : too_dark);
}

SampleTally::SampleTally(const Scene& scene, double diagonal, std::size_t most_misses)
    : scene_(scene),
      far_(kFar * diagonal),
      most_misses_(most_misses),
      lights_(scene.lights.size()),
      polygons_(scene.polygons.size()) {}

void SampleTally::add(const SampleRow& row, const JudgedSample& judged) {
  counts_.add(judged);
  lights_[row.sample.light].add(judged);
  polygons_[judged.polygon].add(judged);
  if (judged.moved > 0) ++places_.moved;
  if (judged.moved > places_.farthest) {
    places_.farthest = judged.moved;
    places_.farthest_line = row.line;
  }
  if (!row.sample.polygon) {
    ++places_.found;
    if (judged.candidates > 1) ++places_.several;
  }
  if (!judged.is_miss()) return;
  if (judged.outcome == SampleOutcome::kWrong && judged.off < 0 && judged.truth == 1 &&
      judged.from_border.value_or(0) > far_) {
    ++far_dark_;
  }
  keep(row, judged);
}

void SampleTally::keep(const SampleRow& row, const JudgedSample& judged) {
  if (most_misses_ == 0) return;
  if (misses_.size() == most_misses_) {
    if (!is_worse(judged, misses_.back().judged)) return;
    misses_.pop_back();
  }
  const auto place = std::ranges::find_if(
      misses_, [&](const SampleMiss& miss) { return is_worse(judged, miss.judged); });
  misses_.insert(place, {row, judged, {}});
}

void SampleTally::tell(SampleVerdict& verdict) const {
  verdict.counts = counts_;
  verdict.places = places_;
  verdict.far_dark = far_dark_;
  verdict.lights = with_samples(lights_, scene_.lights);
  verdict.polygon_counts = with_samples(polygons_, scene_.polygons);
  verdict.misses = misses_;
}

}  // namespace gnomon::comparison
