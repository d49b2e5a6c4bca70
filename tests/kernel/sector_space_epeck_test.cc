// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "kernel/cgal/epeck_space.h"
#include "sector_space_test.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<EpeckLightSpace>;
/// What the tests' names say.
struct KernelNames {
  template <class Kernel>
  static std::string GetName(int) {
    return "epeck";
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, SectorSpace, Kernels, KernelNames);

}  // namespace
}  // namespace gnomon::test
