// SPDX-License-Identifier: GPL-3.0-or-later
#include "process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>

extern char** environ;

namespace gnomon::bench {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// The stream that is kept goes to ends[1].
std::optional<pid_t> started(const std::string& program, std::vector<std::string>& words, Keep keep,
                             const int (&ends)[2]) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (keep == Keep::kErrors) {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  posix_spawn_file_actions_adddup2(&actions, ends[1],
                                   keep == Keep::kErrors ? STDERR_FILENO : STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return std::nullopt;
  return child;
}

}  // namespace

std::optional<ProcessRun> run_process(const std::string& program, std::vector<std::string> words,
                                      Keep keep) {
  words.insert(words.begin(), program);
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const std::optional<pid_t> child = started(program, words, keep, ends);
  close(ends[1]);
  ProcessRun run;
  char buffer[4096];
  for (ssize_t n = 0; child && (n = read(ends[0], buffer, sizeof buffer)) > 0;) {
    run.text.append(buffer, static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int status = 0;
  rusage usage{};
  if (!child || wait4(*child, &status, 0, &usage) != *child) return std::nullopt;
  constexpr int kSignalled = 128;
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
  run.cpu = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  constexpr std::uint64_t kUnit = 1024;  // of ru_maxrss
  run.peak_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * kUnit;
  return run;
}

}  // namespace gnomon::bench
