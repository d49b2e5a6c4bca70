// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/process/command.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "fuzz/process/child.h"

namespace gnomon::fuzz {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostErrors = 64 * 1024;
constexpr int kNotExecutable = 126, kNotFoundStatus = 127, kSignalBase = 128;  // of the shell
constexpr std::uint64_t kTickMilliseconds = 10;

tl::unexpected<Error> system_error(std::string what, int number) {
  return fail(ErrorCode::kFile, std::move(what) + ": " + std::strerror(number));
}

/// An open file that holds the input of a command: there is nothing to feed, and no SIGPIPE.
class InputFile {
 public:
  static Expected<InputFile> make(const std::string& text) {
    return text.empty() ? of_nothing() : of_text(text);
  }
  InputFile() = default;
  InputFile(InputFile&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  InputFile& operator=(InputFile&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~InputFile() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }

 private:
  explicit InputFile(int number) : number_(number) {}

  static Expected<InputFile> of_nothing() {
    InputFile nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    if (nothing.number_ < 0) return system_error("/dev/null", errno);
    return nothing;
  }

  /// A file without a name.
  static Expected<InputFile> of_text(const std::string& text) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
    if (!file) return system_error("no temporary file", errno);
    if (std::fwrite(text.data(), 1, text.size(), file.get()) != text.size() ||
        std::fflush(file.get()) != 0) {
      return system_error("temporary file", errno);
    }
    std::rewind(file.get());
    InputFile copy(::fcntl(::fileno(file.get()), F_DUPFD_CLOEXEC, 0));
    if (copy.number_ < 0) return system_error("temporary file", errno);
    return copy;
  }

  int number_ = -1;
};

/// The shell with the command and its limits, which no program can raise again; no core files.
ChildCommand shell_command(const std::string& command, const CommandOptions& options) {
  std::string script = "ulimit -c 0; ";
  if (options.megabytes > 0) script += fmt::format("ulimit -v {} && ", options.megabytes * 1024);
  script += options.arguments.empty() ? "{ " + command + "\n}" : "{ " + command + " \"$@\"\n}";
  ChildCommand shell{"/bin/sh", {"-c", std::move(script), "sh"}};
  shell.arguments.insert(shell.arguments.end(), options.arguments.begin(), options.arguments.end());
  return shell;
}

void append_up_to(std::size_t most, std::string& text, std::string_view more) {
  text += more.substr(0, most - std::min(most, text.size()));
}

/// Puts into the result what the exit of the shell means.
void interpret(const ChildEnd& end, CommandResult& result) {
  if (end.signal != 0) {
    result.end = CommandEnd::kSignal;
    result.status = end.signal;
    return;
  }
  result.status = end.status;
  if (result.status == kNotExecutable || result.status == kNotFoundStatus) {
    result.end = CommandEnd::kNotFound;
  } else if (result.status > kSignalBase && result.status < kSignalBase + NSIG) {
    result.end = CommandEnd::kSignal;
    result.status -= kSignalBase;
  }
}

/// One command, from its start to its end.
class Run {
 public:
  explicit Run(const CommandOptions& options) : options_(options) {}

  Expected<CommandResult> operator()(const ChildCommand& command) {
    const Clock::time_point begin = Clock::now();
    if (auto started = child_.start(command); !started) {
      return tl::unexpected(std::move(started.error()));
    }
    child_.limit_time(options_.seconds);
    if (options_.interrupted != nullptr) {
      loop_.every(kTickMilliseconds, [this] { look_for_interruption(); });
    }
    loop_.run();
    result_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (interrupted_) return fail(ErrorCode::kInterrupted, "interrupted");
    return std::move(result_);
  }

 private:
  bool too_long() const { return result_.out.size() > options_.most_output; }

  void take_output(std::string_view text) {
    append_up_to(options_.most_output + 1, result_.out, text);
    if (too_long()) child_.kill();
  }

  void look_for_interruption() {
    if (interrupted_ || !*options_.interrupted) return;
    interrupted_ = true;
    child_.kill();
  }

  void ended(const ChildEnd& end) {
    if (too_long()) {
      result_.end = CommandEnd::kTooLong;
    } else if (end.timed_out) {
      result_.end = CommandEnd::kTimeout;
    } else {
      interpret(end, result_);
    }
    loop_.stop();
  }

  const CommandOptions& options_;
  CommandResult result_;
  bool interrupted_ = false;
  EventLoop loop_;
  Child child_{loop_,
               {[this](std::string_view text) { take_output(text); },
                [this](std::string_view text) { append_up_to(kMostErrors, result_.errors, text); },
                [this](const ChildEnd& end) { ended(end); }}};
};

}  // namespace

Expected<CommandResult> run_command(const std::string& command, const CommandOptions& options) {
  const auto input = InputFile::make(options.input);
  if (!input) return tl::unexpected(input.error());
  ChildCommand shell = shell_command(command, options);
  shell.input = input->number();
  return Run(options)(shell);
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
