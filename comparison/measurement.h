// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a comparison: what is asked, and what came of it. Both have a text form, since a run
// is a process of its own (run_measurement.h).
#ifndef GNOMON_COMPARISON_MEASUREMENT_H
#define GNOMON_COMPARISON_MEASUREMENT_H

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/work_counts.h"
#include "gnomon/kernel/error.h"

namespace gnomon::comparison {

/// The lights of a scene that count: a comparison is of methods that take the same ones.
enum class LightsAsked : std::uint8_t { kPoint, kArea };

struct RunRequest {
  std::string scene;                  // SceneSource::parse()
  std::optional<std::uint64_t> size;  // polygons asked for
  std::uint64_t seed = 1;
  std::string system;  // parse_method()
  std::string kernel;  // parse_kernel_choice()
  LightsAsked lights = LightsAsked::kPoint;
  std::uint64_t repeat = 0;           // times that the clock runs; 0: up to 25, while all are short
  std::uint64_t certify_up_to = 0;    // polygons of scenes that are judged
  std::optional<double> thickness{};  // of planes; else the kernel's own
  std::string change{};               // of scene_change.h: also what it changes; empty: none
  bool points = false;                // what has more polygons is judged by exact points
  bool stages = false;                // also who decides, in a run of its own
  friend bool operator==(const RunRequest&, const RunRequest&) = default;
};

/// On one line.
std::string request_text(const RunRequest& request);
/// Errors: kSyntax, kFormat.
Expected<RunRequest> parse_request(std::string_view text);

enum class RunEnd : std::uint8_t {
  kMeasured,
  kRefused,  // the method does not take the scene, or the kernel was not built
  kLimit,    // a limit of the run itself: fragments, digits
  kTime,     // no end within the time that it had
  kMemory,   // no memory within what it had
  kCrashed,  // a signal, or nonsense
  kNotRun,   // a smaller scene was too much already
};

/// What the oracle said.
struct Judgement {
  std::string verdict;    // of oracle/verdict.h
  bool confirms = false;  // what an exact kernel must reach
  bool by_points = false;
  double wrong = 0;  // area that is misclassified, uncovered, covered twice or outside, as a share
                     // of all that is judged
  std::string breaks;      // the worst witness: "misclassified: found lit, true shadow"
  std::string reason;      // the oracle's sentence; empty unless it failed
  double worst_share = 0;  // wrong area of the polygon that has most of it, as its share
  double width = 0;        // of the widest region of error, scene units
  double diagonal = 0;     // of the scene, in the same units
  std::uint64_t invented = 0, lost = 0;
  friend bool operator==(const Judgement&, const Judgement&) = default;
};

/// How often each stage of the exact predicates decided: identity, the filter, integers of 64, 128,
/// 256, 512 and 1024 bits, GMP.
using DecidedBy = std::array<std::uint64_t, 8>;

/// What a change of the scene that changes no exact answer did to this one.
struct Difference {
  std::uint64_t sides = 0;  // of polygons whose share is another double
  double worst_share = 0;   // by which a share differs
  std::string worst;        // where: light, polygon, side
  friend bool operator==(const Difference&, const Difference&) = default;
};

struct Measurement {
  RunEnd end = RunEnd::kMeasured;
  std::string why;  // in words, of every other end; also why it was not judged
  std::uint64_t polygons = 0, parts = 0, lights = 0;
  std::uint64_t position_bits = 0, direction_bits = 0;  // of the scene's grid
  std::uint64_t fragments = 0, nodes = 0;               // nodes of trees, cells
  WorkCounts work;                                      // of all lights
  double seconds = 0;                                   // CPU time of one thread, the median
  std::uint64_t runs = 0;                               // of which that is the median
  std::uint64_t peak_bytes = 0;  // resident, of the process, before it was judged
  std::string checksum;          // answer_checksum.h
  bool exact = false;            // of an exact kernel: the same for every right answer
  std::optional<Judgement> judgement;
  std::optional<Difference> difference;  // where a change was asked for
  DecidedBy decided_by{};                // of kernel plane: which stage decided how often

  bool timed() const { return runs > 0; }
  friend bool operator==(const Measurement&, const Measurement&) = default;
};

std::string_view name_of(RunEnd end);

/// On one line.
std::string measurement_text(const Measurement& measurement);
/// Errors: kSyntax, kFormat.
Expected<Measurement> parse_measurement(std::string_view text);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_MEASUREMENT_H
