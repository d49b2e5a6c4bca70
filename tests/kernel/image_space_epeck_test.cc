// SPDX-License-Identifier: GPL-3.0-or-later
// Image spaces of the kernels that need CGAL.
#include "image_space_test.h"
#include "kernel/cgal/epeck_image_space.h"
#include "kernel/cgal/epick_image_space.h"

namespace gnomon::test {

using Spaces = testing::Types<EpickImageSpace, EpeckImageSpace>;
INSTANTIATE_TYPED_TEST_SUITE_P(Cgal, ImageSpaceOf, Spaces);
INSTANTIATE_TYPED_TEST_SUITE_P(Cgal, ExactImageSpaceOf, testing::Types<EpeckImageSpace>);

}  // namespace gnomon::test
