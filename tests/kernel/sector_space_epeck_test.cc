// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernel/cgal/epeck_space.h"
#include "sector_space_test.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<EpeckLightSpace>;
INSTANTIATE_TYPED_TEST_SUITE_P(Epeck, SectorSpace, Kernels);

}  // namespace
}  // namespace gnomon::test
