// SPDX-License-Identifier: GPL-3.0-or-later
// Samples that were judged, counted one by one in the order of their file; the worst misses are
// kept.
#ifndef GNOMON_COMPARISON_SAMPLES_SAMPLE_TALLY_H
#define GNOMON_COMPARISON_SAMPLES_SAMPLE_TALLY_H

#include <cstddef>
#include <vector>

#include "comparison/samples/sample_verdict.h"
#include "gnomon/scene/scene.h"

namespace gnomon::comparison {

class SampleTally {
 public:
  /// `diagonal`: of the scene. `most_misses`: so many are kept.
  SampleTally(const Scene& scene, double diagonal, std::size_t most_misses);

  void add(const SampleRow& row, const oracle::JudgedSample& judged);
  /// Puts all counts into a verdict, and the misses without their causes.
  void tell(SampleVerdict& verdict) const;

 private:
  void keep(const SampleRow& row, const oracle::JudgedSample& judged);

  const Scene& scene_;
  double far_;  // from a border
  std::size_t most_misses_;
  SampleCounts counts_;
  SamplePlaces places_;
  std::uint64_t far_dark_ = 0;
  std::vector<SampleCounts> lights_, polygons_;
  std::vector<SampleMiss> misses_;  // worst first
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_SAMPLES_SAMPLE_TALLY_H
