// SPDX-License-Identifier: LGPL-3.0-or-later
// One function a kernel, each in a source of its own, so that CGAL is compiled once and in
// parallel.
#ifndef GNOMON_ALGORITHMS_RUN_SHADOW_KERNELS_H
#define GNOMON_ALGORITHMS_RUN_SHADOW_KERNELS_H

#include <vector>

#include "gnomon/algorithms/shadows.h"

namespace gnomon {

using LightList = std::vector<std::uint32_t>;
using ShadowOutcome = Expected<ShadowResult>;

ShadowOutcome shadows_float(const PreparedScene&, const ShadowOptions&, const LightList&);
ShadowOutcome shadows_double(const PreparedScene&, const ShadowOptions&, const LightList&);
ShadowOutcome shadows_long_double(const PreparedScene&, const ShadowOptions&, const LightList&);
ShadowOutcome shadows_epick(const PreparedScene&, const ShadowOptions&, const LightList&);
ShadowOutcome shadows_epeck(const PreparedScene&, const ShadowOptions&, const LightList&);
ShadowOutcome shadows_rational(const PreparedScene&, const ShadowOptions&, const LightList&);
ShadowOutcome shadows_plane(const PreparedScene&, const ShadowOptions&, const LightList&);
/// The kernel double with a mistake.
ShadowOutcome shadows_planes_from_fragments(const PreparedScene&, const ShadowOptions&,
                                            const LightList&);
ShadowOutcome shadows_vertices_per_side(const PreparedScene&, const ShadowOptions&,
                                        const LightList&);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_SHADOW_KERNELS_H
