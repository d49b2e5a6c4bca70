// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the witnesses of a result by the definition alone: a shadow fragment names a caster that
// must shadow all of it. Plain rational arithmetic in space; no code of the algorithms, kernels or
// oracle.
#ifndef GNOMON_TESTS_SUPPORT_WITNESS_CHECK_H
#define GNOMON_TESTS_SUPPORT_WITNESS_CHECK_H

#include <string>

#include "solve.h"

namespace gnomon::test {

/// Empty if every shadow fragment's caster shadows all of it, every fragment is convex, planar and
/// of positive area; else what is wrong first. Requires: exact points were kept.
std::string find_false_witness(const Case& scene, const ShadowResult& result);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_WITNESS_CHECK_H
