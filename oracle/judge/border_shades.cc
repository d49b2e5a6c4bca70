// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/border_shades.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

namespace {

PlanarLoop loop_around(const PlanarBox& box) {
  const long double margin = (box.high.x - box.low.x) + (box.high.y - box.low.y);
  return {{box.low.x - margin, box.low.y - margin},
          {box.high.x + margin, box.low.y - margin},
          {box.high.x + margin, box.high.y + margin},
          {box.low.x - margin, box.high.y + margin}};
}

/// Nothing if no point around the receiver is inside.
std::optional<BorderShade> shade_of(const std::vector<ExactPlane>& planes, const PlaneFrame& frame,
                                    const Integers3& point, PlanarLoop around, long double error) {
  BorderShade shade;
  shade.region = std::move(around);
  for (const ExactPlane& plane : planes) {
    const std::optional<PlanarLine> line = frame.trace(plane);
    if (!line) {
      if (sgn(value_at(plane, point)) <= 0) return std::nullopt;
      continue;
    }
    shade.lines.push_back(*line);
    shade.region = cut(shade.region, line->grown(error));
    if (shade.region.empty()) return std::nullopt;
  }
  shade.box = box_of(shade.region);
  return shade;
}

}  // namespace

std::vector<BorderShade> border_shades(const ExactAnswer& answer, std::uint32_t light,
                                       const ReceiverGroup& group, const PlaneFrame& frame,
                                       const PlanarBox& around, long double error) {
  const PointRegions& regions = answer.regions(light);
  std::vector<std::uint32_t> casters;
  for (const std::uint32_t part : group.parts) {
    const std::vector<std::uint32_t> own = regions.casters_near(part);
    casters.insert(casters.end(), own.begin(), own.end());
  }
  std::ranges::sort(casters);
  casters.erase(std::unique(casters.begin(), casters.end()), casters.end());
  const Integers3 point = grid_loop(answer.prepared(), group.parts.front())[0];
  std::vector<BorderShade> shades;
  for (const std::uint32_t caster : casters) {
    std::optional<BorderShade> shade =
        shade_of(regions.shadow_planes(caster), frame, point, loop_around(around), error);
    if (!shade) continue;
    shade->caster = caster;
    shades.push_back(std::move(*shade));
  }
  return shades;
}

std::vector<std::vector<std::uint32_t>> shades_near(const std::vector<PlanarBox>& boxes,
                                                    const std::vector<BorderShade>& shades) {
  // Both swept along x.
  struct Start {
    long double x = 0;
    bool shade = false;
    std::uint32_t index = 0;
  };
  std::vector<Start> starts;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) starts.push_back({boxes[i].low.x, false, i});
  for (std::uint32_t i = 0; i < shades.size(); ++i) {
    starts.push_back({shades[i].box.low.x, true, i});
  }
  std::ranges::sort(starts, {}, &Start::x);
  std::vector<std::vector<std::uint32_t>> near(boxes.size());
  std::vector<std::uint32_t> open_boxes, open_shades;
  const auto box_at = [&](bool shade, std::uint32_t index) -> const PlanarBox& {
    return shade ? shades[index].box : boxes[index];
  };
  for (const Start& start : starts) {
    const PlanarBox& own = box_at(start.shade, start.index);
    std::vector<std::uint32_t>& others = start.shade ? open_boxes : open_shades;
    std::erase_if(others, [&](std::uint32_t other) {
      return box_at(!start.shade, other).high.x < own.low.x;
    });
    for (const std::uint32_t other : others) {
      if (!own.meets(box_at(!start.shade, other))) continue;
      start.shade ? near[other].push_back(start.index) : near[start.index].push_back(other);
    }
    (start.shade ? open_shades : open_boxes).push_back(start.index);
  }
  for (std::vector<std::uint32_t>& own : near) std::ranges::sort(own);
  return near;
}

}  // namespace gnomon::oracle
