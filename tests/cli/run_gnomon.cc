// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_gnomon.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

namespace gnomon::test {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

namespace {

/// Whether the process has a handler of the signal; what Linux tells of its signals is a mask.
bool catches(pid_t process, int signal) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("SigCgt:")) {
      return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
    }
  }
  return false;
}

/// A signal that comes too early tests nothing, and how long a start takes depends on the machine:
/// waits for the program to be ready for it, at most until it ends by itself.
void send_signal(pid_t process, const RunOptions& options) {
  const auto ended = [&] {
    siginfo_t info = {};
    return ::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
           info.si_pid != 0;
  };
  while (!catches(process, options.signal) || (options.signal_when && !options.signal_when())) {
    if (ended()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(options.signal_after));
  ::kill(process, options.signal);
}

}  // namespace

RunResult run_gnomon(const std::vector<std::string>& arguments, const RunOptions& options) {
  const TestDirectory directory;
  const std::string in = directory.file("in"), err = directory.file("err");
  const std::string out = options.stdout_path.empty() ? directory.file("out") : options.stdout_path;
  write_text(in, options.input);

  std::vector<std::string> words = {GNOMON_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  int pipe_ends[2] = {-1, -1};
  if (options.close_pipe && ::pipe(pipe_ends) != 0) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    for (const std::string& variable : options.environment)
      ::putenv(const_cast<char*>(variable.c_str()));
    ::dup2(::open(in.c_str(), O_RDONLY), STDIN_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    if (options.close_pipe) {
      ::close(pipe_ends[0]);
      ::dup2(pipe_ends[1], STDOUT_FILENO);
    } else {
      ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    }
    ::signal(SIGPIPE, SIG_DFL);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  if (options.close_pipe) {
    ::close(pipe_ends[0]);
    ::close(pipe_ends[1]);
  }
  if (options.signal != 0) send_signal(child, options);
  int status = 0;
  ::waitpid(child, &status, 0);
  RunResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
  if (!options.close_pipe && options.stdout_path.empty()) result.out = read_text(out);
  result.err = read_text(err);
  return result;
}

}  // namespace gnomon::test
