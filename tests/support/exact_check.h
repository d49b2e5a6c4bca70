// SPDX-License-Identifier: GPL-3.0-or-later
// What every exact kernel promises, as one check of one scene: fractions that add up to exactly 1,
// equal each other, equal the oracle's; fragments that the oracle calls identical; witnesses that
// hold.
#ifndef GNOMON_TESTS_SUPPORT_EXACT_CHECK_H
#define GNOMON_TESTS_SUPPORT_EXACT_CHECK_H

#include <string>
#include <vector>

#include "solve.h"

namespace gnomon::test {

inline const std::vector<KernelId> kExactKernels = {KernelId::kPlane, KernelId::kRational,
                                                    KernelId::kEpeck};

/// How the kernels are varied while they are compared: none of it may change the answer.
struct ExactCheck {
  std::vector<KernelId> kernels = kExactKernels;
  /// Each further kernel gets other options than the one before: merge, prefix, seed.
  bool vary_options = true;
  bool witnesses = true;
  bool fragments = true;  // overlay of the first kernel's fragments with the exact regions
};

/// Empty if all is well; else the first thing that is wrong.
std::string check_exact(const Case& scene, const ExactCheck& check = {});

/// Exact lit fraction of each part under each light (parts of light 0, then of light 1, ...).
std::vector<mpq_class> lit_fractions(const Case& scene, const ShadowOptions& options);

/// Exact lit fraction of a polygon, which must be one part or coplanar parts, under a light.
mpq_class lit_fraction_of(const Case& scene, const ShadowOptions& options, const std::string& light,
                          const std::string& polygon);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_EXACT_CHECK_H
