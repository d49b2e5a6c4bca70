// SPDX-License-Identifier: GPL-3.0-or-later
// Child processes that answer, crash, hang, talk nonsense or do not start. Most are shell scripts
// that speak the protocol of worker.h.
#include "fuzz/workers/worker_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fuzz/workers/isolated.h"
#include "gnomon/scene/generate.h"
#include "tests/support/test_directory.h"

namespace gnomon::fuzz {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A worker that runs `script` for each request line, in $line.
WorkerCommand shell(const std::string& script) {
  return {"/bin/sh", {"-c", "while read -r line; do " + script + "; done"}};
}
std::string answer_of_digest(const std::string& digest) {
  WorkerAnswer answer;
  answer.report.digest = digest;
  return "=" + answer_text(answer);
}
const std::string kAnswer = "echo '" + answer_of_digest("d") + "'";

std::vector<std::string> outcomes(const WorkerCommand& command, std::uint64_t requests,
                                  unsigned workers = 1, double seconds = 5) {
  WorkerPool pool(command, seconds, workers);
  std::vector<std::string> outcomes(requests, "unanswered");
  std::uint64_t next = 0;
  WorkerPool::Callbacks callbacks;
  callbacks.next = [&]() -> std::optional<Request> {
    if (next == requests) return std::nullopt;
    const std::uint64_t index = next++;
    return case_request(index, 100 + index, 0);
  };
  callbacks.answered = [&](const Request& request, const WorkerAnswer& answer) {
    std::string& outcome = outcomes[request.index];
    EXPECT_EQ(outcome, "unanswered");
    outcome = answer.report.digest;
    for (const Failure& failure : answer.report.failures) outcome += failure.signature();
  };
  const auto done = pool.run(callbacks);
  if (!done) return {to_string(done.error())};
  return outcomes;
}

TEST(WorkerPool, AnswersAllRequests) {
  for (const unsigned workers : {1u, 4u}) {
    EXPECT_EQ(outcomes(shell(kAnswer), 50, workers), std::vector<std::string>(50, "d"));
  }
}

TEST(WorkerPool, ACrashIsAFailureOfWhatItWasAtAndTheNextGoesOn) {
  const auto crash_at_second = shell(
      "echo '@subject double'; case $line in 'case 1 '*) kill -SEGV "
      "$$;; 'case 2 '*) exit 3;; esac; " +
      kAnswer);
  EXPECT_THAT(outcomes(crash_at_second, 4),
              ElementsAre("d", "no-crash:signal 11:double", "no-crash:status 3:double", "d"));
}

// Schedulers end all processes of a job: what was under way is done again.
TEST(WorkerPool, WhoIsToldToEndIsNoFailure) {
  for (const std::string signal : {"TERM", "HUP", "INT", "KILL"}) {
    const test::TestDirectory directory;
    const std::string flag = directory.file("flag");
    const auto told_once =
        shell("echo '@subject double'; case $line in 'case 1 '*) if [ ! -e " + flag +
              " ]; then touch " + flag + "; kill -" + signal + " $$; fi;; esac; " + kAnswer);
    EXPECT_THAT(outcomes(told_once, 3), ElementsAre("d", "d", "d")) << signal;
  }
  const auto always = [](const std::string& signal) {
    return outcomes(shell("echo '@subject double'; kill -" + signal + " $$"), 1);
  };
  EXPECT_THAT(always("TERM"), ElementsAre(HasSubstr("ended by signal 15 again and again")));
  // That is how the system ends who takes too much memory.
  EXPECT_THAT(always("KILL"), ElementsAre("no-crash:signal 9:double"));
}

TEST(WorkerPool, AProcessThatReadsNoMoreEndsOnlyItself) {
  // Its input is closed when the second request is written; the signal of that would end this test.
  const WorkerCommand deaf{"/bin/sh", {"-c", "read -r line; exec <&-; " + kAnswer + "; exit 3"}};
  EXPECT_THAT(outcomes(deaf, 2), ElementsAre("d", "no-crash:status 3:start"));
}

TEST(WorkerPool, AHangIsOfTheBudget) {
  const auto hang =
      shell("echo '@oracle on plane'; case $line in 'case 1 '*) sleep 100;; esac; " + kAnswer);
  EXPECT_THAT(outcomes(hang, 3, 1, 2), ElementsAre("d", "budget:time:plane", "d"));
}

TEST(WorkerPool, NonsenseIsNoAnswer) {
  EXPECT_THAT(outcomes(shell("echo '={nonsense'"), 1),
              ElementsAre(StartsWith("no-crash:nonsense")));
  EXPECT_THAT(outcomes(shell("echo '={\"digest\": 1}'"), 1),
              ElementsAre(StartsWith("no-crash:nonsense")));
}

TEST(WorkerPool, APartialLineIsWaitedFor) {
  const std::string answer = answer_of_digest("d");
  const auto slow = shell("printf '@sub'; sleep 0.05; echo 'ject x'; printf '%s' '" +
                          answer.substr(0, 9) + "'; sleep 0.05; echo '" + answer.substr(9) + "'");
  EXPECT_THAT(outcomes(slow, 2), ElementsAre("d", "d"));
}

TEST(WorkerPool, AProgramThatCannotStartIsAnError) {
  EXPECT_THAT(outcomes({"/nonexistent/gnomon", {}}, 1),
              ElementsAre(HasSubstr("cannot be started")));
  EXPECT_THAT(outcomes({"/bin/sh", {"-c", "echo no such option >&2; exit 2"}}, 1),
              ElementsAre(HasSubstr("no such option")));
}

TEST(WorkerPool, ATickStopsAtOnce) {
  WorkerPool pool(shell("sleep 100"), 100, 2);
  std::uint64_t next = 0;
  WorkerPool::Callbacks callbacks;
  callbacks.next = [&] { return std::optional(case_request(next++, 1, 0)); };
  callbacks.answered = [](const Request&, const WorkerAnswer&) { FAIL(); };
  callbacks.tick = [] { return false; };
  EXPECT_TRUE(pool.run(callbacks));
  EXPECT_EQ(next, 2u);
}

TEST(Worker, AnswersReadBack) {
  WorkerAnswer answer;
  answer.recipe = "lattice+\"quoted\"";
  answer.kinds = {1, 7};
  answer.report.digest = "0123";
  answer.report.polygons = 5;
  answer.report.subjects = {"plane", "command:x \\ y"};
  answer.report.failures.push_back({Property::kOracle, "double", "misclassified", "sun", "a \"b\"",
                                    "line\nbreak", 0.125, 1e-300});
  const std::string text = answer_text(answer);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const auto read = parse_answer(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(answer_text(*read), text);
  EXPECT_EQ(read->report.failures.at(0).text, "line\nbreak");
  EXPECT_EQ(read->report.failures.at(0).share, 1e-300);
  EXPECT_FALSE(parse_failure("{\"property\": \"none such\"}"));
  // What is missing is an error, and no zero.
  std::string partial = text;
  partial.replace(partial.find("\"fragments\""), 11, "\"fragment\"");
  const auto missing = parse_answer(partial);
  ASSERT_FALSE(missing);
  EXPECT_THAT(to_string(missing.error()), HasSubstr("/fragments"));
}

TEST(IsolatedChecker, ChecksAScene) {
  CheckOptions options;
  options.subjects = {*parse_subject("plane"), *parse_subject("command:kill -9 $$")};
  IsolatedChecker checker(GNOMON_PROGRAM, options, {});
  const Expected<Scene> scene = generate("table-chair");
  ASSERT_TRUE(scene);
  CheckOptions here;
  here.subjects = {options.subjects[0]};
  const std::string digest = check_scene(*scene, here).digest;
  for (int i = 0; i < 2; ++i) {
    const auto report = checker.check(*scene);
    ASSERT_TRUE(report) << to_string(report.error());
    ASSERT_EQ(report->failures.size(), 1u);
    EXPECT_EQ(report->failures[0].signature(), "no-crash:signal 9:command:kill -9 $$");
    EXPECT_EQ(report->subjects.size(), 2u);
    EXPECT_EQ(report->digest, digest);
  }
}

TEST(IsolatedChecker, MemoryIsLimited) {
  CheckOptions options;
  options.subjects = {*parse_subject("plane")};
  IsolatedChecker checker(GNOMON_PROGRAM, options, {.seconds = 60, .megabytes = 24});
  const Expected<Scene> scene = generate("quads", {{"n", 20000}});
  ASSERT_TRUE(scene);
  const auto report = checker.check(*scene);
  ASSERT_TRUE(report) << to_string(report.error());
  ASSERT_FALSE(report->failures.empty());
  EXPECT_THAT(report->failures[0].signature(),
              testing::AnyOf(StartsWith("budget:memory"), StartsWith("no-crash:signal 6")));
}

}  // namespace
}  // namespace gnomon::fuzz
