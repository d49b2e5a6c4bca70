// SPDX-License-Identifier: LGPL-3.0-or-later
// The light on a span of samples of one part: each of its possible casters takes away the samples
// that are behind its plane and inside all planes of its edges through the light. Each of these
// half-spaces takes a prefix or a suffix of the span (Bouknight & Kelley's secondary scan, as Crow
// 1977 tells of it).
//
// Exactness: that of the space.
#ifndef GNOMON_ALGORITHMS_PIXELS_SPAN_LIGHT_H
#define GNOMON_ALGORITHMS_PIXELS_SPAN_LIGHT_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/visible_row.h"

namespace gnomon {

template <ImageSpaceModel Space>
class SpanLight {
 public:
  SpanLight(ImageScene<Space>& scene, const PixelTask& task)
      : scene_(scene), task_(task), lit_(task.frame.width) {}

  /// Sets the light's bit of the samples that it reaches. `casters`: all that may shadow the part.
  /// Requires: the seen side faces the light.
  void light(std::uint32_t part, Span run, std::uint32_t row, std::size_t l,
             std::span<const std::uint32_t> casters, std::span<std::uint64_t> lit_by,
             WorkCounts& work) {
    run = part_in_region(scene_.space(), run, task_.scene.lights[task_.lights[l]],
                         scene_.facing_eye(part), row);
    if (run.empty()) return;
    std::fill(lit_.begin() + run.begin, lit_.begin() + run.end, std::uint8_t{1});
    std::uint32_t left = run.size();
    for (const std::uint32_t caster : casters) {
      ++work[Counter::kCasterTests];
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

 private:
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

  ImageScene<Space>& scene_;
  const PixelTask& task_;
  std::vector<std::uint8_t> lit_;  // of the samples of a span
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_SPAN_LIGHT_H
