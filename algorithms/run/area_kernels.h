// SPDX-License-Identifier: LGPL-3.0-or-later
// Lights of any kind in three dimensions: one function a kernel, each in a source of its own.
#ifndef GNOMON_ALGORITHMS_RUN_AREA_KERNELS_H
#define GNOMON_ALGORITHMS_RUN_AREA_KERNELS_H

#include <array>
#include <string>
#include <vector>

#include "algorithms/run/shadow_kernels.h"
#include "gnomon/algorithms/shadows.h"

namespace gnomon {

struct AreaOutcome {
  std::vector<LightResult> lights;
  std::vector<CombinedFragment> combined;
  std::vector<std::array<double, 3>> combined_points;
  std::vector<std::array<mpq_class, 3>> combined_exact_points;
  StageCounts stages;
};

/// Results of `lights` one by one, and of all of `combined` (at most 64; may be none) together.
using AreaFunction = Expected<AreaOutcome> (*)(const PreparedScene&, const ShadowOptions&,
                                               const LightList& lights, const LightList& combined);

Expected<AreaOutcome> area_float(const PreparedScene&, const ShadowOptions&, const LightList&,
                                 const LightList&);
Expected<AreaOutcome> area_double(const PreparedScene&, const ShadowOptions&, const LightList&,
                                  const LightList&);
Expected<AreaOutcome> area_long_double(const PreparedScene&, const ShadowOptions&, const LightList&,
                                       const LightList&);
Expected<AreaOutcome> area_epick(const PreparedScene&, const ShadowOptions&, const LightList&,
                                 const LightList&);
Expected<AreaOutcome> area_epeck(const PreparedScene&, const ShadowOptions&, const LightList&,
                                 const LightList&);
Expected<AreaOutcome> area_rational(const PreparedScene&, const ShadowOptions&, const LightList&,
                                    const LightList&);
Expected<AreaOutcome> area_plane(const PreparedScene&, const ShadowOptions&, const LightList&,
                                 const LightList&);
/// The kernel double with a mistake.
Expected<AreaOutcome> area_vertices_per_side(const PreparedScene&, const ShadowOptions&,
                                             const LightList&, const LightList&);

inline tl::unexpected<Error> interrupted() { return fail(ErrorCode::kInterrupted, "interrupted"); }
inline tl::unexpected<Error> too_many_fragments(const ShadowOptions& options) {
  return fail(ErrorCode::kLimit,
              "more than " + std::to_string(options.max_fragments) + " fragments",
              "a simpler scene, or a higher limit");
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_AREA_KERNELS_H
