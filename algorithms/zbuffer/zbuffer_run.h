// SPDX-License-Identifier: LGPL-3.0-or-later
// zbuffer, the reference renderer: row by row, the nearest part at each sample, and of each span of
// a part the samples that every one of its possible casters shadows.
//
// Rows are independent, and threads take them in turns. Exactness: that of the kernel.
#ifndef GNOMON_ALGORITHMS_ZBUFFER_ZBUFFER_RUN_H
#define GNOMON_ALGORITHMS_ZBUFFER_ZBUFFER_RUN_H

#include <cstdint>

#include "algorithms/pixels/by_rows.h"
#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/part_balls.h"
#include "algorithms/pixels/span_light.h"
#include "algorithms/pixels/visible_parts.h"
#include "algorithms/zbuffer/by_zbuffer.h"
#include "algorithms/zbuffer/caster_lists.h"

namespace gnomon {

template <ImageSpaceModel Space>
class ZbufferRun {
 public:
  explicit ZbufferRun(const PixelTask& task)
      : task_(task),
        scene_(task),
        balls_(task.scene, task.frame),
        visible_(scene_, task, balls_),
        casters_(scene_, balls_),
        light_(scene_, task) {}

  void fill_row(std::uint32_t row) {
    const PixelSink::Row out = task_.sink.row(row);
    visible_.draw_row(row, out.part, work_);
    for_each_run(out.part, [&](std::uint32_t part, Span run) {
      work_[Counter::kSamples] += run.size();
      for (std::size_t l = 0; l < scene_.light_count(); ++l) {
        if (!scene_.seen_side_faces(part, l)) continue;
        light_.light(part, run, row, l, casters_.of(part, l), out.lit_by, work_);
      }
    });
  }

  PixelWork work() const { return {work_, {}}; }
  StageCounts stages() { return scene_.space().stage_counts(); }
  std::uint64_t covered() const { return visible_.covered(); }

 private:
  const PixelTask& task_;
  ImageScene<Space> scene_;
  PartBalls balls_;
  VisibleParts<Space> visible_;
  CasterLists<Space> casters_;
  SpanLight<Space> light_;
  WorkCounts work_;
};

template <class Kernel>
Expected<PixelWork> ByZbuffer<Kernel>::run(const PixelTask& task) {
  static_assert(ImageKernelModel<Kernel>);
  return with_image_space<Kernel>(task.options.stage_counts,
                                  [&]<class Space>() { return by_rows<ZbufferRun<Space>>(task); });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ZBUFFER_ZBUFFER_RUN_H
