// SPDX-License-Identifier: GPL-3.0-or-later
#include "sector_space_test.h"

#include "gnomon/kernel/coordinate_space.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<CoordinateLightSpace<float>, CoordinateLightSpace<double>,
                               CoordinateLightSpace<long double>, CoordinateLightSpace<mpq_class>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, SectorSpace, Kernels);

}  // namespace
}  // namespace gnomon::test
