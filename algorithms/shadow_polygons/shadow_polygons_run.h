// SPDX-License-Identifier: LGPL-3.0-or-later
// shadow-polygons, Crow's third class: a scan line finds the visible polygons of a row, and of each
// span of one the volumes of each light that hold it, counted over walls and caps. Walls are
// invisible, and never end a span; they are looked at only where a polygon is visible.
//
// Rows are independent, and threads take them in turns. Exactness: that of the kernel.
#ifndef GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_POLYGONS_RUN_H
#define GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_POLYGONS_RUN_H

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/pixels/by_rows.h"
#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/part_balls.h"
#include "algorithms/pixels/visible_parts.h"
#include "algorithms/shadow_polygons/by_shadow_polygons.h"
#include "algorithms/shadow_polygons/clip_planes.h"
#include "algorithms/shadow_polygons/wall_counter.h"

namespace gnomon {

template <ImageSpaceModel Space>
class ShadowPolygonsRun {
 public:
  explicit ShadowPolygonsRun(const PixelTask& task)
      : clipped_(clipped(task)),
        task_{clipped_ ? clipped_->scene : task.scene,
              clipped_ ? clipped_->frame : task.frame,
              task.options,
              task.rules,
              task.lights,
              task.sink},
        scene_(task_),
        balls_(task_.scene, task_.frame),
        visible_(scene_, task_, balls_),
        counts_(task_.frame.width) {
    const ClipPlanes planes = clipped_ ? clipped_->planes : ClipPlanes{};
    std::size_t walls = 0, bytes = 0;
    for (std::size_t l = 0; l < scene_.light_count(); ++l) {
      counters_.emplace_back(scene_, task_, planes, l);
      walls += counters_.back().walls();
      bytes += counters_.back().bytes();
    }
    work_.at_least(Counter::kWalls, walls);
    work_.at_least(Counter::kWallBytes, bytes);
  }

  void fill_row(std::uint32_t row) {
    const PixelSink::Row out = task_.sink.row(row);
    visible_.draw_row(row, out.part, work_);
    bool has_walls = false;
    for_each_run(out.part, [&](std::uint32_t part, Span run) {
      work_[Counter::kSamples] += run.size();
      for (std::size_t l = 0; l < counters_.size(); ++l) {
        // Rows without a visible polygon have no use for walls.
        if (!has_walls) counters_[l].start_row(row, work_);
      }
      has_walls = true;
      for (std::size_t l = 0; l < counters_.size(); ++l) {
        if (scene_.seen_side_faces(part, l)) light_run(part, run, row, l, out);
      }
    });
  }

  PixelWork work() const { return {work_, {}}; }
  StageCounts stages() { return scene_.space().stage_counts(); }
  std::uint64_t covered() const { return visible_.covered(); }

 private:
  static std::optional<ClippedScene> clipped(const PixelTask& task) {
    const MethodOptionValues& options = task.options.options;
    const double near = options.count == WallCount::kZPass ? options.near : 0;
    const double far = options.count == WallCount::kZFail ? options.far : 0;
    if (near <= 0 && far <= 0) return std::nullopt;
    return with_clip_planes(task.scene, task.frame, near, far);
  }

  void light_run(std::uint32_t part, Span run, std::uint32_t row, std::size_t l,
                 const PixelSink::Row& out) {
    counters_[l].count(part, run, counts_, work_);
    const Span inside = part_in_region(scene_.space(), run, task_.scene.lights[task_.lights[l]],
                                       scene_.facing_eye(part), row);
    for (std::uint32_t i = inside.begin; i < inside.end; ++i) {
      if (counts_[i] <= 0) out.lit_by[i] |= std::uint64_t{1} << l;
    }
    const std::span<std::int32_t> casters = task_.sink.casters(row, l);
    if (casters.empty()) return;
    std::copy(counts_.begin() + run.begin, counts_.begin() + run.end, casters.begin() + run.begin);
  }

  std::optional<ClippedScene> clipped_;
  PixelTask task_;  // of the clipped scene, if there is one
  ImageScene<Space> scene_;
  PartBalls balls_;
  VisibleParts<Space> visible_;
  std::vector<WallCounter<Space>> counters_;  // by lights
  std::vector<std::int32_t> counts_;
  WorkCounts work_;
};

template <class Kernel>
Expected<PixelWork> ByShadowPolygons<Kernel>::run(const PixelTask& task) {
  return with_image_space<Kernel>(task.options.stage_counts, [&]<class Space>() {
    return by_rows<ShadowPolygonsRun<Space>>(task);
  });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_POLYGONS_SHADOW_POLYGONS_RUN_H
