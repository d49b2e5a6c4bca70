// SPDX-License-Identifier: LGPL-3.0-or-later
// scan-out, Crow's first class: lists of possible casters for each polygon, a primary scan that
// finds what is visible in each row, and a secondary scan of each visible span by the list of its
// polygon. Nothing is clipped in object space, and all polygons stay in memory.
//
// The primary scan comes first and as a whole, so that lists can be made of visible polygons alone
// (`lazy=on`) and once for all threads. Rows are independent, and threads take them in turns.
// Exactness: that of the kernel.
#ifndef GNOMON_ALGORITHMS_SCAN_OUT_SCAN_OUT_RUN_H
#define GNOMON_ALGORITHMS_SCAN_OUT_SCAN_OUT_RUN_H

#include <cstdint>
#include <optional>
#include <vector>

#include "algorithms/pixels/by_rows.h"
#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/part_balls.h"
#include "algorithms/pixels/span_light.h"
#include "algorithms/pixels/visible_parts.h"
#include "algorithms/scan_out/by_scan_out.h"
#include "algorithms/scan_out/overlap_lists.h"
#include "algorithms/scan_out/scan_line.h"

namespace gnomon {

template <ImageSpaceModel Space>
class PrimaryScan {
 public:
  explicit PrimaryScan(const PixelTask& task)
      : task_(task),
        scene_(task),
        balls_(task.scene, task.frame),
        line_(scene_, balls_, task.frame.height) {}

  void fill_row(std::uint32_t row) {
    const auto seen = task_.sink.row(row).part;
    line_.draw_row(row, seen, work_);
    for_each_run(seen, [&](std::uint32_t, Span run) { work_[Counter::kSamples] += run.size(); });
  }

  PixelWork work() const { return {work_, {}}; }
  StageCounts stages() { return scene_.space().stage_counts(); }
  std::uint64_t covered() const { return line_.covered(); }

 private:
  const PixelTask& task_;
  ImageScene<Space> scene_;
  PartBalls balls_;
  ScanLine<Space> line_;
  WorkCounts work_;
};

template <ImageSpaceModel Space>
class SecondaryScan {
 public:
  SecondaryScan(const PixelTask& task, const OverlapLists<Space>& lists)
      : task_(task), lists_(lists), scene_(task), light_(scene_, task) {}

  void fill_row(std::uint32_t row) {
    const PixelSink::Row out = task_.sink.row(row);
    for_each_run(out.part, [&](std::uint32_t part, Span run) {
      for (std::size_t l = 0; l < scene_.light_count(); ++l) {
        if (!scene_.seen_side_faces(part, l)) continue;
        light_.light(part, run, row, l, lists_.of(part, l), out.lit_by, work_);
      }
    });
  }

  PixelWork work() const { return {work_, {}}; }
  StageCounts stages() { return scene_.space().stage_counts(); }
  std::uint64_t covered() const { return 0; }

 private:
  const PixelTask& task_;
  const OverlapLists<Space>& lists_;
  ImageScene<Space> scene_;
  SpanLight<Space> light_;
  WorkCounts work_;
};

/// The parts that some sample of the picture shows.
inline std::vector<bool> shown_parts(const PixelTask& task) {
  std::vector<bool> shown(task.scene.parts.size(), false);
  for (std::uint32_t row = 0; row < task.frame.height; ++row) {
    for_each_run(task.sink.row(row).part, [&](std::uint32_t part, Span) { shown[part] = true; });
  }
  return shown;
}

template <class Kernel>
Expected<PixelWork> ByScanOut<Kernel>::run(const PixelTask& task) {
  return with_image_space<Kernel>(
      task.options.stage_counts, [&]<class Space>() -> Expected<PixelWork> {
        auto done = by_rows<PrimaryScan<Space>>(task);
        if (!done || task.lights.empty()) return done;
        const MethodOptionValues& options = task.options.options;
        ImageScene<Space> scene(task);
        const PartBalls balls(task.scene, task.frame);
        std::optional<std::vector<bool>> shown;
        if (options.lazy) shown = shown_parts(task);
        const OverlapLists<Space> lists(scene, balls, options.lists, shown ? &*shown : nullptr);
        const auto second = by_rows_of(task, [&] { return SecondaryScan<Space>(task, lists); });
        if (!second) return second;
        lists.count(done->work);
        done->work += second->work;
        done->stages += second->stages;
        done->stages += scene.space().stage_counts();
        return done;
      });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SCAN_OUT_SCAN_OUT_RUN_H
