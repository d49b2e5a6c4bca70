// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/render_lights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/common/interrupt.h"
#include "gnomon/algorithms/facing_chain.h"
#include "gnomon/algorithms/facing_sides.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/result/read_claims.h"
#include "report/sides/claims_of.h"

namespace gnomon::cli {

Expected<Claims> lights_together(const LoadedScene& loaded, const std::string& result,
                                 const AlgorithmChoice& algorithm) {
  if (!result.empty()) {
    auto claims = read_claims(result, loaded.scene);
    if (!claims || claims->combined || claims->overlay) return claims;
    ErrorPlace where;
    where.file = result;
    return fail(ErrorCode::kUsage, "tells nothing of lights together",
                "a result of `gnomon shadows --combined`", where);
  }
  ShadowOptions options;
  algorithm.apply(options.method);
  options.lights = loaded.lights;
  options.output.combined = true;
  options.output.points = true;
  options.control.interrupted = &interrupted();
  const auto computed = compute_shadows(loaded.prepared, options);
  if (!computed) return tl::unexpected(computed.error());
  Claims claims = report::claims_of(loaded.scene, loaded.prepared, *computed, "exact", false);
  // Nothing at all may be in shadow.
  if (!claims.combined && !claims.overlay) claims.overlay.emplace();
  return claims;
}

std::vector<std::vector<report::Point>> shadow_polygons(const PreparedScene& prepared,
                                                        std::uint32_t light) {
  const LightPoint& point = prepared.lights[light].point;
  const FacingChain chain = facing_chain(prepared, facing_sides(prepared, point));
  report::Point low{}, high{};
  bool is_first = true;
  for (const VertexId v : prepared.loop_vertices) {
    const report::Point& p = prepared.geometry.positions[v];
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = is_first ? p[k] : std::min(low[k], p[k]);
      high[k] = is_first ? p[k] : std::max(high[k], p[k]);
    }
    is_first = false;
  }
  const double reach = 2 * std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  const auto behind = [&](const report::Point& p) {
    report::Point away, end;
    for (std::size_t k = 0; k < 3; ++k) {
      away[k] = point.directional ? -point.nearest[k] : p[k] - point.nearest[k];
    }
    const double length = std::hypot(away[0], away[1], away[2]);
    for (std::size_t k = 0; k < 3; ++k) end[k] = p[k] + reach / length * away[k];
    return end;
  };
  std::vector<std::vector<report::Point>> walls;
  walls.reserve(chain.contour.size());
  for (const ContourEdge& contour : chain.contour) {
    const EdgeEnds ends = prepared.geometry.edges[contour.edge.index()];
    const report::Point a = prepared.geometry.positions[ends.a],
                        b = prepared.geometry.positions[ends.b];
    walls.push_back({a, b, behind(b), behind(a)});
  }
  return walls;
}

}  // namespace gnomon::cli
