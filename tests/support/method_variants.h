// SPDX-License-Identifier: GPL-3.0-or-later
// Every way to the shadows of point and directional lights on polygons that the table of methods
// has. Suites ask here, so that a method joins them by its row.
#ifndef GNOMON_TESTS_SUPPORT_METHOD_VARIANTS_H
#define GNOMON_TESTS_SUPPORT_METHOD_VARIANTS_H

#include <string>
#include <vector>

#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/shadow_options.h"

namespace gnomon::test {

/// The methods that find regions of point and directional lights on polygons, on exact and rounded
/// kernels, and take every scene. In order of the table.
std::vector<MethodId> object_methods();

/// Each of object_methods() with its options at their defaults, and with each option by itself at
/// each other value; of numbers the lowest and the one three above it.
std::vector<MethodSelection> method_variants();

/// As on the command line.
std::string text_of(const MethodSelection& selection);
/// The same in letters, digits and underscores, for names of tests.
std::string test_name_of(const MethodSelection& selection);

/// `options` by that method.
ShadowOptions with_method(ShadowOptions options, const MethodSelection& selection);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_SUPPORT_METHOD_VARIANTS_H
