// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/process/command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "scene/base/text_file.h"

extern char** environ;

namespace gnomon::fuzz {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostErrors = 64 * 1024;
constexpr int kNotExecutable = 126, kNotFoundStatus = 127, kSignalBase = 128;  // of the shell

tl::unexpected<Error> system_error(std::string what, int number) {
  return fail(ErrorCode::kFile, std::move(what) + ": " + std::strerror(number));
}

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }
  int number() const { return number_; }
  bool open() const { return number_ >= 0; }

 private:
  int number_ = -1;
};

struct Pipe {
  Descriptor read, write;
};

Expected<Pipe> make_pipe() {
  int ends[2];
  // Closed in every other process that is started meanwhile.
  if (::pipe2(ends, O_CLOEXEC) != 0) return system_error("no pipe", errno);
  Pipe pipe{Descriptor(ends[0]), Descriptor(ends[1])};
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  return pipe;
}

/// A file without a name that holds the input: there is nothing to feed, and no SIGPIPE.
Expected<Descriptor> input_file(const std::string& text) {
  if (text.empty()) {
    Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    if (!nothing.open()) return system_error("/dev/null", errno);
    return nothing;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  if (!file) return system_error("no temporary file", errno);
  if (std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
      std::fflush(file.get()) != 0) {
    return system_error("temporary file", errno);
  }
  std::rewind(file.get());
  Descriptor copy(::fcntl(::fileno(file.get()), F_DUPFD_CLOEXEC, 0));
  if (!copy.open()) return system_error("temporary file", errno);
  return copy;
}

/// False once nothing more can come.
bool read_some(Descriptor& from, std::string& text, std::size_t most) {
  std::array<char, 65536> buffer;
  const ssize_t count = ::read(from.number(), buffer.data(), buffer.size());
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  if (count == 0) {
    from.close();
    return false;
  }
  const std::size_t room = most - std::min(most, text.size());
  text.append(buffer.data(), std::min(room, static_cast<std::size_t>(count)));
  return true;
}

/// A shell in a process group of its own, with our pipes.
Expected<pid_t> start(const std::string& command, const CommandOptions& options, int in, int out,
                      int errors) {
  // Limits that no program can raise again; no core files.
  std::string script = "ulimit -c 0; ";
  if (options.megabytes > 0) script += fmt::format("ulimit -v {} && ", options.megabytes * 1024);
  script += options.arguments.empty() ? "{ " + command + "\n}" : "{ " + command + " \"$@\"\n}";
  std::vector<std::string> words = {"sh", "-c", script, "sh"};
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  // What we ignore or block, it does not.
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGQUIT}) sigaddset(&usual, signal);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(
      &attributes,
      static_cast<short>(POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  pid_t child = -1;
  const int failure = ::posix_spawn(&child, "/bin/sh", &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) return system_error("/bin/sh cannot be started", failure);
  return child;
}

}  // namespace

Expected<CommandResult> run_command(const std::string& command, const CommandOptions& options) {
  auto input = input_file(options.input);
  if (!input) return tl::unexpected(input.error());
  auto out = make_pipe();
  if (!out) return tl::unexpected(out.error());
  auto errors = make_pipe();
  if (!errors) return tl::unexpected(errors.error());

  const Clock::time_point begin = Clock::now();
  const auto child =
      start(command, options, input->number(), out->write.number(), errors->write.number());
  if (!child) return tl::unexpected(child.error());
  out->write.close();
  errors->write.close();

  CommandResult result;
  int status = 0;
  bool ended = false, killed = false, stopped = false;
  while (!ended) {
    std::array<pollfd, 2> waiting{};
    nfds_t count = 0;
    for (const Descriptor* pipe : {&out->read, &errors->read}) {
      if (pipe->open()) waiting[count++] = {pipe->number(), POLLIN, 0};
    }
    // A program may go on after it has closed its pipes, and end while its children hold them.
    ::poll(waiting.data(), count, count == 0 ? 1 : 10);
    if (out->read.open()) read_some(out->read, result.out, options.most_output + 1);
    if (errors->read.open()) read_some(errors->read, result.errors, kMostErrors);
    ended = ::waitpid(*child, &status, WNOHANG) == *child;
    result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (ended || killed) continue;
    stopped = options.interrupted != nullptr && *options.interrupted;
    if (result.out.size() > options.most_output) {
      result.end = CommandEnd::kTooLong;
    } else if (result.seconds > options.seconds) {
      result.end = CommandEnd::kTimeout;
    } else if (!stopped) {
      continue;
    }
    killed = true;
    ::kill(-*child, SIGKILL);
  }
  // What it left running, it left for nobody.
  ::kill(-*child, SIGKILL);
  while (out->read.open() && result.out.size() <= options.most_output) {
    const std::size_t before = result.out.size();
    if (!read_some(out->read, result.out, options.most_output + 1)) break;
    if (result.out.size() == before) break;
  }
  while (errors->read.open() && result.errors.size() < kMostErrors) {
    const std::size_t before = result.errors.size();
    if (!read_some(errors->read, result.errors, kMostErrors)) break;
    if (result.errors.size() == before) break;
  }
  if (stopped) return fail(ErrorCode::kInterrupted, "interrupted");
  if (killed) return result;
  if (result.out.size() > options.most_output) {
    result.end = CommandEnd::kTooLong;
    return result;
  }
  if (WIFSIGNALED(status)) {
    result.end = CommandEnd::kSignal;
    result.status = WTERMSIG(status);
    return result;
  }
  result.status = WEXITSTATUS(status);
  if (result.status == kNotExecutable || result.status == kNotFoundStatus) {
    result.end = CommandEnd::kNotFound;
  } else if (result.status > kSignalBase && result.status < kSignalBase + NSIG) {
    result.end = CommandEnd::kSignal;
    result.status -= kSignalBase;
  }
  return result;
}

std::string how_it_ended(const CommandResult& result) {
  std::string text;
  switch (result.end) {
    case CommandEnd::kExited:
      text = fmt::format("exit status {}", result.status);
      break;
    case CommandEnd::kSignal:
      text = fmt::format("signal {} ({})", result.status, ::strsignal(result.status));
      break;
    case CommandEnd::kTimeout:
      text = fmt::format("no end within {:.3g} s", result.seconds);
      break;
    case CommandEnd::kTooLong:
      text = fmt::format("more than {} bytes of output", result.out.size() - 1);
      break;
    case CommandEnd::kNotFound:
      text = "it cannot be run";
      break;
  }
  const std::string first = result.errors.substr(0, result.errors.find('\n'));
  if (!first.empty()) text += ": " + first.substr(0, 300);
  return text;
}

}  // namespace gnomon::fuzz
