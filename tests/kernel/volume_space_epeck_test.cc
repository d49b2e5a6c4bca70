// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "kernel/cgal/epeck_volume_space.h"
#include "volume_space_test.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<EpeckVolumeSpace>;
/// What the tests' names say.
struct KernelNames {
  template <class Kernel>
  static std::string GetName(int) {
    return "epeck";
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, VolumeSpace, Kernels, KernelNames);
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, ExactVolumeSpace, Kernels, KernelNames);

}  // namespace
}  // namespace gnomon::test
