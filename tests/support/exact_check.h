// SPDX-License-Identifier: GPL-3.0-or-later
// What every exact kernel promises by both algorithms, as one check of one scene: fractions that
// add up to exactly 1, equal each other, equal the oracle's; bounds that hold them; fragments that
// the oracle calls identical; witnesses that hold.
#ifndef GNOMON_TESTS_SUPPORT_EXACT_CHECK_H
#define GNOMON_TESTS_SUPPORT_EXACT_CHECK_H

#include <string>
#include <vector>

#include "solve.h"

namespace gnomon::test {

inline const std::vector<KernelId> kExactKernels = {KernelId::kPlane, KernelId::kRational,
                                                    KernelId::kEpeck};

/// Empty if all is well; else the first thing that is wrong. All exact kernels by both algorithms,
/// with options that may not change the answer; the kernel `plane` also by sectors with small
/// cells.
std::string check_exact(const Case& scene);

/// As check_exact(), for every method of method_variants() under point and directional lights on
/// every exact kernel: fractions that are the oracle's, add up to exactly 1 and lie in their
/// bounds; witnesses that hold; fragments that the oracle calls identical.
std::string check_methods(const Case& scene);

/// The method `contour` alone, without the oracle: on every exact kernel the exact shares of
/// sectors on `plane`, and bounds that hold them with proven classes; shares as they are printed
/// are within 1e-14 of the polygon's area.
std::string check_contour(const Case& scene);

/// Exact lit fraction of each part under each light (parts of light 0, then of light 1, ...).
std::vector<mpq_class> lit_fractions(const Case& scene, const ShadowOptions& options);

/// Exact lit fraction of a polygon, which must be one part or coplanar parts, under a light.
mpq_class lit_fraction_of(const Case& scene, const ShadowOptions& options, const std::string& light,
                          const std::string& polygon);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_EXACT_CHECK_H
