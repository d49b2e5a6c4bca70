// SPDX-License-Identifier: GPL-3.0-or-later
#include "process.h"

#include <gtest/gtest.h>

namespace gnomon::bench {
namespace {

TEST(BenchProcess, KeepsOneStream) {
  const std::vector<std::string> words = {"-c", "echo out; echo err >&2; exit 3"};
  const auto output = run_process("/bin/sh", words, Keep::kOutput),
             errors = run_process("/bin/sh", words, Keep::kErrors);
  ASSERT_TRUE(output && errors);
  EXPECT_EQ(output->text, "out\n");
  EXPECT_EQ(output->status, 3);
  EXPECT_EQ(errors->text, "err\n");
  EXPECT_GT(errors->peak_bytes, 0u);
}

TEST(BenchProcess, TellsCpuTimeAndSignals) {
  const auto busy = run_process(
      "/bin/sh", {"-c", "i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done"}, Keep::kOutput);
  ASSERT_TRUE(busy);
  EXPECT_GT(busy->cpu, 0.005);
  const auto ended = run_process("/bin/sh", {"-c", "kill -TERM $$"}, Keep::kOutput);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->status, 128 + 15);
}

TEST(BenchProcess, NoneWhereThereIsNoProgram) {
  EXPECT_FALSE(run_process("/nowhere/gnomon", {}, Keep::kOutput));
}

}  // namespace
}  // namespace gnomon::bench
