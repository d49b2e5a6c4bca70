// SPDX-License-Identifier: LGPL-3.0-or-later
// ridge-edges: shadows from an angular table while polygons are drawn (Thakur, Cheng & Miura,
// section 3.4, with the z-buffer as their host). Whatever a polygon shows when it is drawn is
// looked up at once, also what a later one hides: so far polygons before near ones are the worst
// case.
//
// Tables are made first, once for all threads; then rows of the picture are independent.
// Exactness: with rows=exact that of the kernel; with rows=N as table_look_up.h has it.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_RIDGE_EDGES_RUN_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_RIDGE_EDGES_RUN_H

#include <time.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/angular_table/by_ridge_edges.h"
#include "algorithms/angular_table/solid_checks.h"
#include "algorithms/angular_table/table_look_up.h"
#include "algorithms/partition/import_export.h"
#include "algorithms/pixels/by_rows.h"
#include "algorithms/pixels/part_balls.h"
#include "algorithms/pixels/visible_parts.h"

namespace gnomon {

template <ImageSpaceModel Space>
class RidgeEdgesRun {
 public:
  RidgeEdgesRun(const PixelTask& task, const std::vector<LightTables>& tables)
      : task_(task), scene_(task), balls_(task.scene, task.frame), visible_(scene_, task, balls_) {
    look_ups_.reserve(tables.size());
    for (std::size_t l = 0; l < tables.size(); ++l) {
      look_ups_.emplace_back(scene_, task, tables[l], l);
    }
  }

  void fill_row(std::uint32_t row) {
    const PixelSink::Row out = task_.sink.row(row);
    visible_.draw_row(row, out.part, work_, [&](std::uint32_t part, Span span) {
      std::fill(out.lit_by.begin() + span.begin, out.lit_by.begin() + span.end, 0);
      const double start = thread_seconds();
      for (std::size_t l = 0; l < look_ups_.size(); ++l) {
        if (scene_.seen_side_faces(part, l)) look_ups_[l].light(part, span, row, out.lit_by, work_);
      }
      seconds_ += thread_seconds() - start;
    });
    for_each_run(out.part,
                 [&](std::uint32_t, Span run) { work_[Counter::kSamples] += run.size(); });
  }

  PixelWork work() const { return {work_, {}, 0, seconds_}; }
  StageCounts stages() { return scene_.space().stage_counts(); }
  std::uint64_t covered() const { return visible_.covered(); }

 private:
  /// CPU time of this thread.
  static double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  const PixelTask& task_;
  ImageScene<Space> scene_;
  PartBalls balls_;
  VisibleParts<Space> visible_;
  std::vector<TableLookUp<Space>> look_ups_;
  double seconds_ = 0;
  WorkCounts work_;
};

/// The tables of all lights.
template <ImageSpaceModel Space>
Expected<std::vector<LightTables>> tables_of(const PixelTask& task,
                                             const std::vector<TableObject>& objects) {
  if (task.options.options.depth == TableDepth::kHidden) {
    const auto checked = check_solids(task.scene, task.options.scene, objects);
    if (!checked) return tl::unexpected(checked.error());
  }
  ImageScene<Space> scene(task);
  std::vector<LightTables> tables;
  for (std::size_t l = 0; l < task.lights.size(); ++l) {
    std::vector<bool> receives(task.scene.parts.size());
    for (std::uint32_t p = 0; p < receives.size(); ++p) {
      receives[p] = scene.facing_eye(p).valid() && scene.seen_side_faces(p, l);
    }
    auto own = LightTables::make(task, task.lights[l], objects, receives);
    if (!own) return tl::unexpected(std::move(own.error()));
    tables.push_back(*std::move(own));
  }
  return tables;
}

template <class Kernel>
Expected<PixelWork> ByRidgeEdges<Kernel>::run(const PixelTask& task) {
  return with_image_space<Kernel>(
      task.options.stage_counts, [&]<class Space>() -> Expected<PixelWork> {
        const double start = cpu_seconds();
        const std::vector<TableObject> objects = table_objects(task.scene);
        const auto tables = tables_of<Space>(task, objects);
        if (!tables) return tl::unexpected(tables.error());
        const double seconds = cpu_seconds() - start;
        auto done = by_rows_of(task, [&] { return RidgeEdgesRun<Space>(task, *tables); });
        if (!done) return done;
        for (const LightTables& own : *tables) own.count(done->work);
        done->table_seconds = seconds;
        return done;
      });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_RIDGE_EDGES_RUN_H
