// SPDX-License-Identifier: GPL-3.0-or-later
// Foreign programs that do everything wrong: each ends, and how is told.
#include "fuzz/process/command.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::fuzz {
namespace {

CommandResult run(const std::string& command, const CommandOptions& options = {}) {
  const auto result = run_command(command, options);
  EXPECT_TRUE(result) << to_string(result.error());
  return result.value_or(CommandResult{});
}

TEST(Command, PassesInputArgumentsOutputAndStatus) {
  CommandOptions options;
  options.input = std::string(300'000, 'x') + "end";
  EXPECT_EQ(run("cat", options).out, options.input);
  EXPECT_EQ(run("cat").out, "");
  options.arguments = {"a b", "$HOME \"'", ""};
  const CommandResult shown = run("printf '[%s]'", options);
  EXPECT_EQ(shown.out, "[a b][$HOME \"'][]");
  EXPECT_TRUE(shown.succeeded());
  const CommandResult refused = run("echo no >&2; exit 3");
  EXPECT_EQ(refused.end, CommandEnd::kExited);
  EXPECT_EQ(refused.status, 3);
  EXPECT_EQ(how_it_ended(refused), "exit status 3: no");
}

TEST(Command, CanOpenItsOutputByName) {
  EXPECT_EQ(run("echo out >/dev/stdout; echo no >/dev/stderr").out, "out\n");
}

TEST(Command, ThatReadsNoInputDoesNotHarm) {
  CommandOptions options;
  options.input = std::string(1 << 20, 'x');
  EXPECT_TRUE(run("true", options).succeeded());
}

TEST(Command, CrashAndAbsenceAreTold) {
  const CommandResult crash = run("sh -c 'kill -SEGV $$'");
  EXPECT_EQ(crash.end, CommandEnd::kSignal);
  EXPECT_EQ(crash.status, SIGSEGV);
  EXPECT_TRUE(how_it_ended(crash).starts_with("signal 11 (")) << how_it_ended(crash);
  EXPECT_EQ(run("kill -ABRT $$").end, CommandEnd::kSignal);  // the shell itself
  EXPECT_EQ(run("/no/such/program").end, CommandEnd::kNotFound);
}

TEST(Command, HangsFloodsAndLeftoversEnd) {
  CommandOptions options;
  options.seconds = 0.3;
  const CommandResult hang = run("sleep 60", options);
  EXPECT_EQ(hang.end, CommandEnd::kTimeout);
  EXPECT_LT(hang.seconds, 5);
  // Ignores everything that can be ignored, and hangs in a child.
  EXPECT_EQ(run("trap '' TERM INT; sleep 60 | cat", options).end, CommandEnd::kTimeout);
  // Closes its pipes first.
  EXPECT_EQ(run("exec >&- 2>&-; sleep 60", options).end, CommandEnd::kTimeout);
  options.seconds = 30;
  options.most_output = 100'000;
  const CommandResult flood = run("yes", options);
  EXPECT_EQ(flood.end, CommandEnd::kTooLong);
  EXPECT_LT(flood.seconds, 20);
  // A child that stays behind keeps nobody waiting, and its pipe's content is not lost.
  const CommandResult behind = run("sleep 60 & echo done", options);
  EXPECT_TRUE(behind.succeeded());
  EXPECT_EQ(behind.out, "done\n");
  EXPECT_LT(behind.seconds, 20);
  // Nor does one that has left the group, which is killed.
  const CommandResult away = run("setsid sleep 5 & echo done", options);
  EXPECT_EQ(away.out, "done\n");
  EXPECT_LT(away.seconds, 4);
}

TEST(Command, ManyRunSideBySide) {
  std::atomic<int> done = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&done, i] {
      for (int k = 0; k < 25; ++k) {
        const std::string text = std::to_string(100 * i + k);
        CommandOptions options;
        options.input = text;
        done += run("cat; exit 7", options).out == text ? 1 : 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(done, 100);
}

#if !defined(__SANITIZE_ADDRESS__)
TEST(Command, MemoryIsLimited) {
  CommandOptions options;
  options.megabytes = 64;
  options.seconds = 30;
  const CommandResult result = run("dd if=/dev/zero of=/dev/null bs=256M count=1", options);
  EXPECT_FALSE(result.succeeded());
  EXPECT_NE(result.end, CommandEnd::kTimeout);
  options.megabytes = 0;
  EXPECT_EQ(run("ulimit -v", options).status, 0);
}
#endif

TEST(Command, IsInterrupted) {
  std::atomic<bool> stop = false;
  CommandOptions options;
  options.interrupted = &stop;
  options.seconds = 60;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop = true;
  });
  const auto result = run_command("sleep 60", options);
  later.join();
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace gnomon::fuzz
