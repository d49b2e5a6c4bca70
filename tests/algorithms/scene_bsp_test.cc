// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <type_traits>

#include "kernel/coordinate/coordinate_kernels.h"
#include "kernel/implicit/implicit_kernel.h"
#include "scene_bsp_order_test.h"

namespace gnomon::test {
namespace {

using Kernels = testing::Types<ImplicitKernel::LightSpace, RationalKernel::LightSpace>;
/// What the tests' names say.
struct KernelNames {
  template <class Space>
  static std::string GetName(int) {
    return std::is_same_v<Space, ImplicitKernel::LightSpace> ? "plane" : "rational";
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Kernels, SceneBspOrder, Kernels, KernelNames);

}  // namespace
}  // namespace gnomon::test
