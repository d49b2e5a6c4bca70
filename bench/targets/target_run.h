// SPDX-License-Identifier: GPL-3.0-or-later
// One run of the targets: this build's command and another one's, the files that both read, the
// table that is filled; and its groups of rows.
#ifndef GNOMON_BENCH_TARGETS_TARGET_RUN_H
#define GNOMON_BENCH_TARGETS_TARGET_RUN_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments.h"
#include "scenes.h"
#include "table.h"
#include "targets/command.h"
#include "verdicts.h"

namespace gnomon::bench {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Why rows of `--shares` are not measured.
inline constexpr const char* kNoTable = "the command writes no table of shares";

/// A directory of its own for scenes, lights and results, removed at the end.
class WorkFiles {
 public:
  WorkFiles();
  ~WorkFiles();
  WorkFiles(const WorkFiles&) = delete;
  WorkFiles& operator=(const WorkFiles&) = delete;

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  /// The scene, made by the command where it is not there yet.
  std::string scene(const Command& command, const SceneRecipe& recipe) const;
  /// A file of `count` lamps beside the scene's own one, each a unit further along x: lights alike,
  /// none of which is another one again.
  std::string more_lamps(const SceneRecipe& recipe, std::size_t count) const;
  std::string suns(const std::vector<std::array<std::int64_t, 3>>& directions) const;

 private:
  std::filesystem::path directory_;
};

struct TargetRun {
  TargetRun(Extent chosen, Command own, std::optional<Command> other, const WorkFiles& work_files)
      : extent(chosen), now(std::move(own)), before(std::move(other)), files(work_files) {}

  Extent extent;
  Command now;
  std::optional<Command> before;
  const WorkFiles& files;
  Verdicts verdicts{"Targets", {"measured"}};
  Table answers{{"answers", "scene", "shares", "before", "now", ""}};
  bool good = true;  // no answers differ
  double seconds_a_sun = kNotMeasured;

  bool small() const { return extent == Extent::kShort; }
  /// `usual` scenes and lights are measured in full, `small` ones for continuous integration.
  std::int64_t size(std::int64_t small_size, std::int64_t usual) const {
    return small() ? small_size : usual;
  }
  int rounds() const { return extent == Extent::kUsual ? 5 : 3; }
};

/// The method that the targets are of.
const Words& contour_words();

/// Names of scenes with their polygons, as rows show them: "quads, 10,001".
struct SizedScene {
  std::string title;
  SceneRecipe recipe;
};
SizedScene quads(std::int64_t n);
SizedScene triangles(std::int64_t level);
SizedScene city(std::int64_t houses);

/// "40.2 ms -> 7.1 ms".
std::string before_and_now(double before, double now);

enum class Compared {
  kRationals,  // equal: of small scenes
  kBounds,     // those of the nearest doubles overlap: of scenes as they are measured
};
/// Compares the shares of the scene under its own light and the further ones that `lights` names,
/// by the other build and by this one; without another build, by sectors and by contour.
void compare_answers(TargetRun& run, const SizedScene& scene, const Words& lights,
                     Compared compared);

// The rows. A year of suns comes first, for the peak memory of a command is never below that of
// this program when it started it.
void measure_suns(TargetRun& run);
void measure_year(TargetRun& run);
void measure_lamps(TargetRun& run);
void measure_whole_process(TargetRun& run);
void measure_clipper(TargetRun& run);
void measure_rays(TargetRun& run);
void measure_plane_and_double(TargetRun& run);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_TARGETS_TARGET_RUN_H
