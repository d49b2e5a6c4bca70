// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/kernel/kernel_list.h"

#include <gtest/gtest.h>

#include <string>

namespace gnomon {
namespace {

TEST(KernelList, IsIndexedByItsIds) {
  for (std::size_t i = 0; i < kernel_list().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kernel_list()[i].id), i);
    EXPECT_EQ(kernel_info(kernel_list()[i].id).name, kernel_list()[i].name);
  }
}

TEST(KernelList, FindsEachByItsName) {
  for (const KernelInfo& info : kernel_list()) EXPECT_EQ(kernel_by_name(info.name), info.id);
  EXPECT_EQ(kernel_by_name("longdouble"), KernelId::kLongDouble);
  EXPECT_EQ(kernel_by_name("Plane"), std::nullopt);
  EXPECT_EQ(kernel_by_name(""), std::nullopt);
}

TEST(KernelList, ExactMeansTheDefaultExactKernel) {
  ASSERT_EQ(kernel_by_name("exact"), kDefaultExactKernel);
  EXPECT_TRUE(kernel_info(kDefaultExactKernel).exact);
}

TEST(KernelList, SaysWhichAreExact) {
  std::string exact;
  for (const KernelInfo& info : kernel_list()) {
    if (info.exact) exact += std::string(info.name) + ' ';
  }
  EXPECT_EQ(exact, "epeck rational plane ");
}

}  // namespace
}  // namespace gnomon
