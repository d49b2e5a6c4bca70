// SPDX-License-Identifier: GPL-3.0-or-later
// A scheduler that cancels or requeues a job sends a signal to all of its processes. A campaign
// that is ended so, at whatever moment, has found nothing that is not there, and goes on to the end
// that it would have had.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// The parent of a process; 0 if there is no such process any more.
pid_t parent_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  if (!std::getline(file, text)) return 0;
  // The program's name, in brackets, may hold anything.
  const std::size_t end = text.rfind(')');
  return end == std::string::npos || end + 4 > text.size() ? 0 : std::stoi(text.substr(end + 4));
}

/// The process and all that it started and they started, whatever groups they have made.
std::set<pid_t> family_of(pid_t process) {
  std::set<pid_t> family{process};
  for (std::size_t before = 0; before != family.size();) {
    before = family.size();
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc", ignored)) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      const pid_t one = std::stoi(name);
      if (family.contains(parent_of(one))) family.insert(one);
    }
  }
  return family;
}

/// Starts the program in a process group of its own.
pid_t start(std::vector<std::string> words, const std::string& output) {
  words.insert(words.begin(), GNOMON_PROGRAM);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::setpgid(0, 0);
  if (std::freopen(output.c_str(), "w", stdout) == nullptr ||
      std::freopen(output.c_str(), "a", stderr) == nullptr) {
    ::_exit(127);
  }
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

std::vector<std::string> campaign(const std::string& database) {
  return {"fuzz", "--generator", "mix", "--count", "800", "--jobs", "3", "--db", database};
}

std::string ended_campaign(const std::string& database) {
  std::vector<std::string> command = campaign(database);
  command.insert(command.end(), {"--json", "-"});
  const RunResult run = run_gnomon(command);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  return run.out;
}

TEST(FuzzSignals, ACampaignThatIsEndedAtAnyMomentFindsNothingOfItsOwn) {
  const TestDirectory directory;
  const std::string database = directory.file("ended.db"), output = directory.file("output");
  std::minstd_rand random(1);
  std::set<int> statuses;
  for (int i = 0; i < 20; ++i) {
    const int signal = std::vector{SIGTERM, SIGHUP, SIGINT}[random() % 3];
    const pid_t program = start(campaign(database), output);
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % 300));
    ::kill(-program, signal);
    for (const pid_t process : family_of(program)) {
      if (process != program) ::kill(process, signal);
    }
    int status = 0;
    ::waitpid(program, &status, 0);
    // It may have ended before, or not yet begun to catch signals.
    statuses.insert(WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status));
    EXPECT_THAT(read_text(output), Not(HasSubstr("found "))) << i;
  }
  for (const int status : statuses) {
    EXPECT_TRUE(status == 0 || status == 130 || status > 1000) << status;
  }
  const std::string text = ended_campaign(database);
  EXPECT_THAT(text, Not(HasSubstr("no-crash")));
  EXPECT_EQ(text, ended_campaign(directory.file("whole.db")));
}

TEST(FuzzSignals, WorkersEndWithTheProgram) {
  const TestDirectory directory;
  const pid_t program = start(campaign(directory.file("a.db")), directory.file("output"));
  std::set<pid_t> family;
  for (int i = 0; i < 200 && family.size() < 4; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    family = family_of(program);
  }
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  family.erase(program);
  ASSERT_FALSE(family.empty());
  for (const pid_t worker : family) {
    for (int i = 0; i < 500 && ::kill(worker, 0) == 0 && parent_of(worker) != 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::ifstream state("/proc/" + std::to_string(worker) + "/stat");
    std::string text;
    // Whoever adopted it need not have asked how it ended.
    EXPECT_TRUE(!std::getline(state, text) || text.find(") Z") != std::string::npos) << text;
  }
}

}  // namespace
}  // namespace gnomon::test
