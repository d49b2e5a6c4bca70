// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/workers/worker_pool.h"

#include <fmt/format.h>
#include <uv.h>

#include <csignal>
#include <ctime>
#include <list>
#include <utility>
#include <vector>

#include "gnomon/scene/write.h"

namespace gnomon::fuzz {

namespace {

/// What is kept of a process's standard error.
constexpr std::size_t kMostErrorText = 2000;
constexpr std::uint64_t kTickMilliseconds = 100;

/// A stage that names the subject at work, and the subject; else both are the stage.
std::string subject_of_stage(const std::string& stage) {
  for (const std::string_view prefix : {"subject ", "oracle on ", "claims of "}) {
    if (stage.starts_with(prefix)) return stage.substr(prefix.size());
  }
  return stage.empty() ? "start" : stage;
}

/// Keeps SIGPIPE from ending the program when a child ends before it has read its request: held
/// back in this thread, and taken away at the end. How the program treats the signal elsewhere
/// stays its own.
class BrokenPipesAreErrors {
 public:
  BrokenPipesAreErrors() {
    sigemptyset(&broken_pipe_);
    sigaddset(&broken_pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &broken_pipe_, &before_);
  }
  BrokenPipesAreErrors(const BrokenPipesAreErrors&) = delete;
  BrokenPipesAreErrors& operator=(const BrokenPipesAreErrors&) = delete;
  ~BrokenPipesAreErrors() {
    const timespec at_once{};
    if (!was_pending_) sigtimedwait(&broken_pipe_, nullptr, &at_once);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t broken_pipe_, before_;
  bool was_pending_ = false;
};

}  // namespace

Request case_request(std::uint64_t index, std::uint64_t seed, std::size_t generator) {
  return {index, fmt::format("case {} {} {}\n", index, seed, generator)};
}

std::optional<Request> scene_request(const Scene& scene, std::uint64_t seed) {
  const Expected<WrittenScene> written = scene_to_text(scene, SceneFormat::kJson);
  if (!written) return std::nullopt;
  return Request{0, fmt::format("scene {} {}\n", seed, written->text.size()) + written->text};
}

/// One process at a time; handles are closed before the next is started in its place.
struct WorkerPool::State {
  struct Child {
    State* pool = nullptr;
    uv_process_t process{};
    uv_pipe_t input{}, output{}, errors{};
    uv_timer_t timer{};
    uv_write_t write{};
    int open_handles = 0;  // of the five above
    bool running = false, exited = false, output_ended = false;
    bool timed_out = false, answered_once = false;
    std::int64_t exit_status = 0;
    int signal = 0;
    std::string output_text, error_text, stage;
    std::optional<Request> request;
  };

  State(WorkerCommand own_command, double own_seconds, unsigned workers)
      : command(std::move(own_command)), seconds(own_seconds), children(workers) {
    uv_loop_init(&loop);
    for (Child& child : children) child.pool = this;
    uv_timer_init(&loop, &tick_timer);
    tick_timer.data = this;
  }

  ~State() {
    for (Child& child : children) stop(child);
    uv_close(reinterpret_cast<uv_handle_t*>(&tick_timer), nullptr);
    uv_run(&loop, UV_RUN_DEFAULT);
    uv_loop_close(&loop);
  }

  template <class Handle>
  static uv_handle_t* handle(Handle& of) {
    return reinterpret_cast<uv_handle_t*>(&of);
  }

  static void on_closed(uv_handle_t* closed) {
    Child& child = *static_cast<Child*>(closed->data);
    if (--child.open_handles == 0 && !child.pool->stopping) child.pool->ended(child);
  }

  static void allocate(uv_handle_t*, std::size_t suggested, uv_buf_t* buffer) {
    *buffer = uv_buf_init(new char[suggested], static_cast<unsigned>(suggested));
  }

  static void on_output(uv_stream_t* stream, ssize_t length, const uv_buf_t* buffer) {
    Child& child = *static_cast<Child*>(stream->data);
    if (length > 0) {
      child.output_text.append(buffer->base, static_cast<std::size_t>(length));
      child.pool->take_lines(child);
    }
    delete[] buffer->base;
    if (length < 0) {
      uv_read_stop(stream);
      child.output_ended = true;
      child.pool->close_if_over(child);
    }
  }

  static void on_errors(uv_stream_t* stream, ssize_t length, const uv_buf_t* buffer) {
    Child& child = *static_cast<Child*>(stream->data);
    if (length > 0) {
      child.error_text.append(buffer->base, static_cast<std::size_t>(length));
      if (child.error_text.size() > kMostErrorText) {
        child.error_text.erase(0, child.error_text.size() - kMostErrorText);
      }
    }
    delete[] buffer->base;
    if (length < 0) uv_read_stop(stream);
  }

  static void on_exit(uv_process_t* process, std::int64_t status, int signal) {
    Child& child = *static_cast<Child*>(process->data);
    child.exited = true;
    child.exit_status = status;
    child.signal = signal;
    // Whatever it started ends too, and with it the last holder of its output.
    ::kill(-process->pid, SIGKILL);
    child.pool->close_if_over(child);
  }

  /// What it wrote before it ended is read first.
  void close_if_over(Child& child) {
    if (child.exited && child.output_ended) close(child);
  }

  static void on_timeout(uv_timer_t* timer) {
    Child& child = *static_cast<Child*>(timer->data);
    child.timed_out = true;
    kill(child);
  }

  static void kill(Child& child) {
    if (child.running && !child.exited) ::kill(-child.process.pid, SIGKILL);
  }

  void close(Child& child) {
    if (!child.running) return;
    child.running = false;
    uv_timer_stop(&child.timer);
    for (uv_handle_t* each : {handle(child.process), handle(child.input), handle(child.output),
                              handle(child.errors), handle(child.timer)}) {
      if (!uv_is_closing(each)) uv_close(each, on_closed);
    }
  }

  void stop(Child& child) {
    stopping = true;
    kill(child);
    close(child);
  }

  bool start(Child& child) {
    child.exited = child.output_ended = child.timed_out = child.answered_once = false;
    child.output_text.clear();
    child.error_text.clear();
    child.stage.clear();
    uv_pipe_init(&loop, &child.input, 0);
    uv_pipe_init(&loop, &child.output, 0);
    uv_pipe_init(&loop, &child.errors, 0);
    uv_timer_init(&loop, &child.timer);
    child.process.data = child.input.data = child.output.data = child.errors.data =
        child.timer.data = &child;
    std::vector<char*> arguments{command.program.data()};
    for (std::string& argument : command.arguments) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    uv_stdio_container_t streams[3];
    const auto pipe_flags = [](uv_stdio_flags direction) {
      return static_cast<uv_stdio_flags>(UV_CREATE_PIPE | direction);
    };
    streams[0].flags = pipe_flags(UV_READABLE_PIPE);
    streams[0].data.stream = reinterpret_cast<uv_stream_t*>(&child.input);
    streams[1].flags = pipe_flags(UV_WRITABLE_PIPE);
    streams[1].data.stream = reinterpret_cast<uv_stream_t*>(&child.output);
    streams[2].flags = pipe_flags(UV_WRITABLE_PIPE);
    streams[2].data.stream = reinterpret_cast<uv_stream_t*>(&child.errors);
    uv_process_options_t options{};
    options.file = command.program.c_str();
    options.args = arguments.data();
    options.stdio = streams;
    options.stdio_count = 3;
    // A group of its own: Ctrl-C is ours alone, and what it starts ends with it.
    options.flags = UV_PROCESS_DETACHED;
    options.exit_cb = on_exit;
    child.open_handles = 5;
    child.running = true;
    const int status = uv_spawn(&loop, &child.process, &options);
    if (status != 0) {
      error = fail(ErrorCode::kFile, command.program + " cannot be started: " + uv_strerror(status))
                  .value();
      child.exited = true;
      stopping = true;
      close(child);
      uv_stop(&loop);
      return false;
    }
    uv_read_start(reinterpret_cast<uv_stream_t*>(&child.output), allocate, on_output);
    uv_read_start(reinterpret_cast<uv_stream_t*>(&child.errors), allocate, on_errors);
    return true;
  }

  /// Gives an idle child something to do, as long as there is something.
  void feed(Child& child) {
    if (stopping || child.request) return;
    child.request = callbacks->next();
    if (!child.request) return;
    ++under_way;
    if (!child.running && !start(child)) return;
    send(child);
  }

  void send(Child& child) {
    child.stage.clear();
    child.timed_out = false;
    uv_timer_start(&child.timer, on_timeout, static_cast<std::uint64_t>(seconds * 1000) + 1, 0);
    uv_buf_t buffer =
        uv_buf_init(child.request->text.data(), static_cast<unsigned>(child.request->text.size()));
    // A child that is gone makes this fail; its exit tells more.
    uv_write(&child.write, reinterpret_cast<uv_stream_t*>(&child.input), &buffer, 1,
             [](uv_write_t*, int) {});
  }

  void take_lines(Child& child) {
    std::size_t begin = 0;
    for (;;) {
      const std::size_t end = child.output_text.find('\n', begin);
      if (end == std::string::npos) break;
      const std::string line = child.output_text.substr(begin, end - begin);
      begin = end + 1;
      if (line.starts_with('@')) {
        child.stage = line.substr(1);
      } else if (line.starts_with('=') && child.request) {
        child.answered_once = true;
        Expected<WorkerAnswer> answer = parse_answer(std::string_view(line).substr(1));
        if (answer) {
          finish(child, std::move(*answer));
        } else {
          finish(child, failed(child, Property::kCrash, "nonsense", to_string(answer.error())));
        }
      }
    }
    child.output_text.erase(0, begin);
  }

  static WorkerAnswer failed(const Child& child, Property property, std::string disagreement,
                             std::string text) {
    WorkerAnswer answer;
    Failure failure;
    failure.property = property;
    failure.subject = subject_of_stage(child.stage);
    failure.disagreement = std::move(disagreement);
    failure.text = "at '" + child.stage + "': " + std::move(text);
    answer.report.failures.push_back(std::move(failure));
    return answer;
  }

  void finish(Child& child, WorkerAnswer answer) {
    uv_timer_stop(&child.timer);
    --under_way;
    const Request request = std::move(*child.request);
    child.request.reset();
    callbacks->answered(request, std::move(answer));
    feed(child);
    end_if_done();
  }

  /// A process has ended and all its handles are closed.
  void ended(Child& child) {
    if (child.request) {
      std::string last = child.error_text;
      while (!last.empty() && last.back() == '\n') last.pop_back();
      if (!last.empty()) last = "; it said: " + last;
      if (!child.timed_out && child.signal == 0 && child.stage.empty() && !child.answered_once) {
        // It never began: no finding about a scene, but about how it was called.
        error = Error{
            ErrorCode::kFile,
            {},
            command.program + " ended with status " + std::to_string(child.exit_status) + last,
            {}};
        stopping = true;
        uv_stop(&loop);
        return;
      }
      if (child.timed_out) {
        finish(child, failed(child, Property::kBudget, "time",
                             fmt::format("no answer within {} s", seconds)));
      } else if (child.signal != 0) {
        finish(child, failed(child, Property::kCrash, fmt::format("signal {}", child.signal),
                             fmt::format("ended by signal {}{}", child.signal, last)));
      } else {
        finish(child, failed(child, Property::kCrash, fmt::format("status {}", child.exit_status),
                             fmt::format("ended with status {}{}", child.exit_status, last)));
      }
    }
    end_if_done();
  }

  void end_if_done() {
    if (under_way == 0) uv_stop(&loop);
  }

  Expected<void> run(const Callbacks& own) {
    const BrokenPipesAreErrors no_signal;
    callbacks = &own;
    error.reset();
    if (own.tick) {
      uv_timer_start(
          &tick_timer,
          [](uv_timer_t* timer) {
            State& pool = *static_cast<State*>(timer->data);
            if (pool.callbacks->tick()) return;
            pool.gave_up = true;
            uv_stop(&pool.loop);
          },
          kTickMilliseconds, kTickMilliseconds);
    }
    gave_up = false;
    for (Child& child : children) feed(child);
    if (under_way > 0 && !error) uv_run(&loop, UV_RUN_DEFAULT);
    uv_timer_stop(&tick_timer);
    if (gave_up || error) {
      for (Child& child : children) stop(child);
      uv_run(&loop, UV_RUN_DEFAULT);
      for (Child& child : children) child.request.reset();
      under_way = 0;
      stopping = false;
    }
    if (error) return tl::unexpected(*error);
    return {};
  }

  WorkerCommand command;
  double seconds;
  uv_loop_t loop{};
  uv_timer_t tick_timer{};
  std::vector<Child> children;
  const Callbacks* callbacks = nullptr;
  std::size_t under_way = 0;
  bool stopping = false, gave_up = false;
  std::optional<Error> error;
};

WorkerPool::WorkerPool(WorkerCommand command, double seconds, unsigned workers)
    : state_(std::make_unique<State>(std::move(command), seconds, workers)) {}
WorkerPool::~WorkerPool() = default;

Expected<void> WorkerPool::run(const Callbacks& callbacks) { return state_->run(callbacks); }

}  // namespace gnomon::fuzz
