// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernel/cgal/epeck_volume_space.h"
#include "volume_space_test.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<EpeckVolumeSpace>;
INSTANTIATE_TYPED_TEST_SUITE_P(Epeck, VolumeSpace, Kernels);
INSTANTIATE_TYPED_TEST_SUITE_P(Epeck, ExactVolumeSpace, Kernels);

}  // namespace
}  // namespace gnomon::test
