// SPDX-License-Identifier: GPL-3.0-or-later
// What the targets of algorithms ask of a scene.
#ifndef GNOMON_TESTS_FUZZERS_ALGORITHM_CHECK_H
#define GNOMON_TESTS_FUZZERS_ALGORITHM_CHECK_H

#include <initializer_list>
#include <string_view>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzzers {

/// All properties of the scene (fuzz/check.h) by the exact subjects named, and a run of rounded
/// kernels that need not be right. A scene that cannot be prepared is left alone, if the error says
/// why.
void check_algorithms(const Scene& scene, std::initializer_list<std::string_view> subjects,
                      std::initializer_list<std::string_view> rounded, std::uint64_t seed);

/// The scene's code reads back to it.
void check_code(const Scene& scene);

}  // namespace gnomon::fuzzers

#endif  // GNOMON_TESTS_FUZZERS_ALGORITHM_CHECK_H
