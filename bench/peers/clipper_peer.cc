// SPDX-License-Identifier: GPL-3.0-or-later
// Clipper 6: per receiver the shadows of its casters are taken from it in one call, non-zero
// winding joining them. Vertices are computed in doubles and rounded to integers below 2^30 across
// the receiver's box, within which Clipper multiplies in 64 bits. Not exact.
#include <fmt/format.h>

#include <algorithm>
#include <clipper.hpp>
#include <cmath>
#include <vector>

#include "machine.h"
#include "peers/caster_search.h"
#include "peers/peer.h"
#include "peers/shadow_projection.h"
#include "table.h"

namespace gnomon::bench {
namespace {

/// From a chart to Clipper's integers.
class Rounding {
 public:
  explicit Rounding(const ChartLoop<double>& receiver) {
    ChartPoint<double> low = receiver[0], high = receiver[0];
    for (const ChartPoint<double>& point : receiver) {
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], point[k]);
        high[k] = std::max(high[k], point[k]);
      }
    }
    origin_ = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
    scale_ = 0x1p29 / std::max((high[0] - low[0]) / 2, (high[1] - low[1]) / 2);
  }
  void round(const ChartLoop<double>& loop, ClipperLib::Path& path) const {
    path.clear();
    for (const ChartPoint<double>& point : loop) {
      path.emplace_back(std::llround((point[0] - origin_[0]) * scale_),
                        std::llround((point[1] - origin_[1]) * scale_));
    }
  }

 private:
  ChartPoint<double> origin_{};
  double scale_ = 1;
};

}  // namespace

PeerResult run_clipper(const PreparedScene& scene, std::uint32_t light) {
  const double start = cpu_seconds();
  const LightView view(scene, light);
  CasterSearch search(view);
  using Projection = ShadowProjection<double>;
  Projection::Loop caster_loop;
  const auto read_loop = [&](std::uint32_t part, Projection::Loop& loop) {
    loop.clear();
    for (const VertexId vertex : view.loop(part)) loop.push_back(view.ray(vertex));
  };
  PeerResult result;
  result.lit.assign(scene.parts.size(), 0);
  const std::vector<double> areas = part_areas(scene);
  std::vector<std::uint32_t> casters;
  ChartLoop<double> shadow;
  ClipperLib::Clipper clipper;
  ClipperLib::Path path;
  ClipperLib::Paths lit;
  std::uint64_t pairs = 0;
  for (const std::uint32_t part : view.facing()) {
    search.casters_of(part, casters);
    Projection::Loop loop;
    read_loop(part, loop);
    Projection projection(view.plane(part), std::move(loop), Projection::Clip::kAtReceiver);
    const Rounding rounding(projection.receiver());
    rounding.round(projection.receiver(), path);
    const double whole = ClipperLib::Area(path);
    clipper.Clear();
    clipper.AddPath(path, ClipperLib::ptSubject, true);
    bool covered = false, shadowed = false;
    for (const std::uint32_t caster : casters) {
      read_loop(caster, caster_loop);
      if (!projection.shadow_of(caster_loop, shadow)) continue;
      rounding.round(shadow, path);
      covered = ClipperLib::Area(path) >= whole;
      if (covered) break;
      shadowed = clipper.AddPath(path, ClipperLib::ptClip, true) || shadowed;
      ++pairs;
    }
    if (covered) continue;
    double lit_area = whole;
    if (shadowed) {
      clipper.Execute(ClipperLib::ctDifference, lit, ClipperLib::pftNonZero,
                      ClipperLib::pftNonZero);
      lit_area = 0;
      for (const ClipperLib::Path& piece : lit) lit_area += ClipperLib::Area(piece);
    }
    result.lit[part] = lit_area / whole;
    result.lit_area += result.lit[part] * areas[part];
  }
  result.seconds = cpu_seconds() - start;
  result.work = grouped(pairs) + " shadows clipped";
  return result;
}

}  // namespace gnomon::bench
