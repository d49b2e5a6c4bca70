// SPDX-License-Identifier: LGPL-3.0-or-later
// zbuffer, the reference renderer: row by row, the nearest part at each sample, and of each span of
// a part the samples that every one of its possible casters shadows. A caster O shadows the samples
// that are behind its plane and inside all planes of its edges through the light; each of these
// half-spaces takes a prefix or a suffix of the span.
//
// Rows are independent, and threads take them in turns. Exactness: that of the kernel.
#ifndef GNOMON_ALGORITHMS_ZBUFFER_ZBUFFER_RUN_H
#define GNOMON_ALGORITHMS_ZBUFFER_ZBUFFER_RUN_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/pixels/by_rows.h"
#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/part_balls.h"
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
        lit_(task.frame.width) {}

  void fill_row(std::uint32_t row) {
    const PixelSink::Row out = task_.sink.row(row);
    visible_.draw_row(row, out.part, work_);
    for_each_run(out.part, [&](std::uint32_t part, Span run) {
      work_[Counter::kSamples] += run.size();
      for (std::size_t l = 0; l < scene_.light_count(); ++l) {
        if (scene_.seen_side_faces(part, l)) light_span(part, run, row, l, out.lit_by);
      }
    });
  }

  PixelWork work() const { return {work_, {}}; }
  StageCounts stages() { return scene_.space().stage_counts(); }
  std::uint64_t covered() const { return visible_.covered(); }

 private:
  void light_span(std::uint32_t part, Span run, std::uint32_t row, std::size_t l,
                  std::span<std::uint64_t> lit_by) {
    run = part_in_region(scene_.space(), run, task_.scene.lights[task_.lights[l]],
                         scene_.facing_eye(part), row);
    if (run.empty()) return;
    std::fill(lit_.begin() + run.begin, lit_.begin() + run.end, std::uint8_t{1});
    std::uint32_t left = run.size();
    for (const std::uint32_t caster : casters_.of(part, l)) {
      ++work_[Counter::kCasterTests];
      const Span dark = shadowed(caster, part, run, row, l);
      for (std::uint32_t i = dark.begin; i < dark.end; ++i) {
        left -= lit_[i];
        lit_[i] = 0;
      }
      if (left == 0) return;
    }
    for (std::uint32_t i = run.begin; i < run.end; ++i) {
      if (lit_[i] != 0) lit_by[i] |= std::uint64_t{1} << l;
    }
  }
  Span shadowed(std::uint32_t caster, std::uint32_t part, Span span, std::uint32_t row,
                std::size_t l) {
    const PlaneRef on = scene_.facing_eye(part);
    span = part_on_side(scene_.space(), span, scene_.facing_light(caster, l), on, row,
                        Sign::kNegative);
    const std::size_t edges = task_.scene.parts[caster].count;
    for (std::size_t k = 0; k < edges && !span.empty(); ++k) {
      span = part_on_side(scene_.space(), span, scene_.shadow_plane(caster, k, l), on, row,
                          Sign::kPositive);
    }
    return span;
  }

  const PixelTask& task_;
  ImageScene<Space> scene_;
  PartBalls balls_;
  VisibleParts<Space> visible_;
  CasterLists<Space> casters_;
  std::vector<std::uint8_t> lit_;  // of the samples of a span
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
