// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "kernel/cgal/epeck_kernel.h"
#include "scene_bsp_order_test.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<EpeckKernel::LightSpace>;
/// What the tests' names say.
struct KernelNames {
  template <class Space>
  static std::string GetName(int) {
    return "epeck";
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, SceneBspOrder, Kernels, KernelNames);

}  // namespace
}  // namespace gnomon::test
