// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict on a file of samples, for people and for programs.
#ifndef GNOMON_COMPARISON_SAMPLES_SAMPLE_VERDICT_H
#define GNOMON_COMPARISON_SAMPLES_SAMPLE_VERDICT_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "comparison/samples/sample_file.h"
#include "gnomon/oracle/sample_judge.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/text/text_sink.h"

namespace gnomon::comparison {

struct SampleCounts {
  std::array<std::uint64_t, oracle::kSampleOutcomes> of{};
  /// Of the wrong ones: more light was seen than there is, or less; the rest is no share at all.
  std::uint64_t too_light = 0, too_dark = 0;

  std::uint64_t operator[](oracle::SampleOutcome outcome) const {
    return of[static_cast<std::size_t>(outcome)];
  }
  std::uint64_t all() const;
  std::uint64_t wrong() const { return (*this)[oracle::SampleOutcome::kWrong]; }
  std::uint64_t out_of_range() const { return wrong() - too_light - too_dark; }
  void add(const oracle::JudgedSample& judged);
};

/// Samples that were moved onto their polygon, or lack one.
struct SamplePlaces {
  std::uint64_t moved = 0;  // not exactly on their polygon
  double farthest = 0;      // scene units
  std::uint64_t farthest_line = 0;
  std::uint64_t found = 0;    // without a polygon
  std::uint64_t several = 0;  // of them, those that may belong to several
};

struct CountsOf {
  std::string id;  // of a light, or of a polygon
  SampleCounts counts;
};

/// A sample that missed.
struct SampleMiss {
  SampleRow row;
  oracle::JudgedSample judged;
  oracle::SampleCause cause;
};

struct SampleVerdict {
  std::string file, scene, geometry_digest;
  std::size_t polygons = 0, parts = 0;  // of the scene
  NumberMeaning numbers = NumberMeaning::kDouble;
  double width = 0, clearance = 0;       // scene units
  std::optional<double> tolerance;       // of shares of area lights; none: by digits
  bool has_area_lights = false;          // among the lights that were asked for
  std::int32_t decimals = 0;             // most of these shares
  bool doubles = false;                  // they have all digits of doubles
  std::uint64_t samples = 0;             // in the file, of the lights that were asked for
  std::uint64_t left_out = 0;            // of other lights
  std::vector<std::string> passed_over;  // columns
  SampleCounts counts;
  SamplePlaces places;
  std::uint64_t far_dark = 0;                    // seen dark, truly lit and far from every shadow
  std::vector<CountsOf> lights, polygon_counts;  // with samples, in the order of the scene
  std::vector<SampleMiss> misses;                // worst first
  bool interrupted = false;

  bool failed() const { return counts.wrong() > 0; }
  std::uint64_t judged() const { return counts.all(); }
};

/// `prepared`, `scene`: of the verdict, for the names in it.
std::string sample_verdict_text(const SampleVerdict& verdict, const Scene& scene,
                                const PreparedScene& prepared);
/// "gnomon-certificate" with a run a file. Requires: at least one, all of that scene.
void write_sample_verdicts_json(report::TextSink& sink, const std::vector<SampleVerdict>& verdicts,
                                const Scene& scene, const PreparedScene& prepared);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_SAMPLES_SAMPLE_VERDICT_H
