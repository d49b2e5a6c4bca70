// SPDX-License-Identifier: GPL-3.0-or-later
// A comparison: scenes by sizes, systems and kernels, each of them run in a process of its own with
// limits on its time and memory, and what came of all. A run that crashes, hangs or takes too much
// is a row like any other.
#ifndef GNOMON_COMPARISON_COMPARISON_H
#define GNOMON_COMPARISON_COMPARISON_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "comparison/measurement.h"
#include "comparison/scene_source.h"
#include "gnomon/kernel/error.h"

namespace gnomon::comparison {

struct RunLimits {
  double seconds = 60;             // of the clock on the wall, for all that a run does
  std::uint64_t megabytes = 4096;  // of address space, beyond what the program itself takes
  friend bool operator==(const RunLimits&, const RunLimits&) = default;
};

/// Up to so many polygons a scene is judged where nobody says otherwise: seconds a run.
inline constexpr std::uint64_t kCertifyUpTo = 1000;

struct ComparePlan {
  std::vector<SceneSource> scenes;
  std::vector<std::uint64_t> sizes;  // polygons; empty: each scene as it is by default
  std::vector<std::string> systems;  // parse_method(); empty: all that take the lights
  std::vector<std::string> kernels;  // parse_kernel_choice()
  // Kernels that run on scenes of at most so many polygons; a kernel without an entry runs on all.
  std::map<std::string, std::uint64_t> most_polygons;
  std::uint64_t seed = 1, repeat = 0, certify_up_to = kCertifyUpTo;
  RunLimits limits;
};

/// How to start a run's process: a program whose last argument comes to measurement_main().
struct RunProgram {
  std::string program;
  std::vector<std::string> arguments;
};

struct Planned {
  RunRequest request;
  std::uint64_t polygons = 0;  // of its scene
};

struct Row {
  RunRequest request;
  std::uint64_t polygons = 0;
  Measurement measurement;
  std::optional<double> ratio;  // of CPU time to the reference run on the same scene
  std::string command;          // that repeats it
};

/// How time grows with the polygons of one scene's sizes.
struct Growth {
  std::string scene, system, kernel;
  double exponent = 0;    // least squares of log time over log polygons
  std::size_t sizes = 0;  // that were measured, 2 or more
  std::size_t last = 0;   // index of the row of the greatest of them
};

struct Comparison {
  std::vector<Row> rows;
  std::vector<Growth> growth;
  bool interrupted = false;  // rows that were not reached are missing
  /// Of exact kernels: verdicts that do not confirm, checksums that differ; one sentence each.
  std::vector<std::string> contradictions;
};

/// Each scene in each size, from the smallest, with a request that names it; sizes that give a
/// scene again are left out, and what takes none is made once. Errors: kUsage, for a scene without
/// lights; those of making scenes.
Expected<void> for_each_scene(
    const std::vector<SceneSource>& scenes, std::vector<std::uint64_t> sizes, std::uint64_t seed,
    const std::function<void(const Scene& scene, const RunRequest& request)>& visit);

/// The runs of a plan in the order of the rows: by scene, size, system and kernel. Sizes that
/// give a scene again are left out. Errors: kUsage, for a scene without lights; those of making
/// scenes.
Expected<std::vector<Planned>> planned_runs(const ComparePlan& plan);

/// The methods that take these lights and are chosen by name.
std::vector<std::string> systems_for(LightsAsked lights);

/// Of exact kernels: verdicts that do not confirm, checksums of one scene that differ; one sentence
/// each.
std::vector<std::string> contradictions_of(const std::vector<const Row*>& rows);

/// What ratios are of: svbsp, or for area lights receiver, on doubles.
RunRequest reference_of(const RunRequest& request);

/// The least squares slope of log y over log x. Requires: two or more, positive, not all of one x.
double growth_exponent(const std::vector<double>& x, const std::vector<double>& y);

/// One run in a process of its own. Errors: kFile (it cannot be started), kInterrupted.
Expected<Measurement> run_in_process(const RunProgram& program, const RunRequest& request,
                                     const RunLimits& limits,
                                     const std::atomic<bool>* interrupted = nullptr);

struct CompareControl {
  /// Before each run: what it is, how many are done, and of how many.
  std::function<void(const RunRequest&, std::size_t done, std::size_t all)> progress;
  const std::atomic<bool>* interrupted = nullptr;
};

/// Runs all of it, one run at a time; also the reference where it is no row itself. What is larger
/// than a scene on which a system ran out of time or memory is not run. Errors: those of
/// planned_runs() and run_in_process(); an interrupted comparison is none.
Expected<Comparison> compare(const ComparePlan& plan, const RunProgram& program,
                             const CompareControl& control = {});

/// `gnomon compare` with the words that make this row again.
std::string command_of(const RunRequest& request, const RunLimits& limits);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_COMPARISON_H
