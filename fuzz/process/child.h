// SPDX-License-Identifier: GPL-3.0-or-later
// The one way in which this program runs others: child processes on one event loop (libuv), in one
// thread. A child has a process group of its own, so that everything it starts ends with it, and a
// limit on its time. What it writes is handed on as it comes. Limits of its memory are its own to
// set (worker.h) or those of the shell that starts it (command.h).
#ifndef GNOMON_FUZZ_PROCESS_CHILD_H
#define GNOMON_FUZZ_PROCESS_CHILD_H

#include <uv.h>

#include <csignal>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"

namespace gnomon::fuzz {

/// Children and callbacks of one thread. It must outlive its children.
class EventLoop {
 public:
  EventLoop();
  EventLoop(const EventLoop&) = delete;
  EventLoop& operator=(const EventLoop&) = delete;
  ~EventLoop();

  /// Until stop() is called, or nothing is left to wait for.
  void run() { uv_run(&loop_, UV_RUN_DEFAULT); }
  void stop() { uv_stop(&loop_); }
  /// Calls `tick` in each of these periods while the loop runs. An empty function ends that.
  void every(std::uint64_t milliseconds, std::function<void()> tick);

  uv_loop_t& handle() { return loop_; }

 private:
  uv_loop_t loop_{};
  uv_timer_t timer_{};
  std::function<void()> tick_;
};

/// Keeps SIGPIPE from ending the program when a child ends before it has read its input: the signal
/// is held back in this thread, and taken away at the end. How the program treats the signal
/// elsewhere stays its own.
class BrokenPipesAreErrors {
 public:
  BrokenPipesAreErrors();
  BrokenPipesAreErrors(const BrokenPipesAreErrors&) = delete;
  BrokenPipesAreErrors& operator=(const BrokenPipesAreErrors&) = delete;
  ~BrokenPipesAreErrors();

 private:
  sigset_t broken_pipe_, before_;
  bool was_pending_ = false;
};

struct ChildCommand {
  std::string program;
  std::vector<std::string> arguments;
  int input = -1;  // an open file for its standard input; -1: what write() sends
};

/// How a child ended.
struct ChildEnd {
  int status = 0;  // the exit status, if no signal ended it
  int signal = 0;
  bool timed_out = false;  // it was killed at the end of its time
};

/// One process at a time; another can be started when that has ended.
class Child {
 public:
  struct Callbacks {
    std::function<void(std::string_view)> output;  // a part of its standard output
    std::function<void(std::string_view)> errors;  // a part of its standard error
    /// After everything that it wrote before it ended.
    std::function<void(const ChildEnd&)> ended;
  };

  Child(EventLoop& loop, Callbacks callbacks) : loop_(loop), callbacks_(std::move(callbacks)) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { abandon(); }

  /// Errors: kFile. Requires: it is not running.
  Expected<void> start(const ChildCommand& command);
  bool running() const { return handles_ != nullptr; }
  /// Kills it after so many seconds from now, unless it has ended or the limit is lifted by then.
  void limit_time(double seconds);
  void lift_time_limit();
  /// To its standard input. A child that is gone makes this fail, which its end tells. Requires:
  /// BrokenPipesAreErrors, in this thread.
  void write(std::string text);
  /// Kills it and all that it started.
  void kill();
  /// Kills it; nothing is called back any more.
  void abandon();

 private:
  struct Handles;
  void end(std::int64_t status, int signal);

  EventLoop& loop_;
  Callbacks callbacks_;
  Handles* handles_ = nullptr;  // freed by the loop when the last of them is closed
  bool timed_out_ = false;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_PROCESS_CHILD_H
