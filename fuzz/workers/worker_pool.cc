// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/workers/worker_pool.h"

#include <fmt/format.h>

#include <list>
#include <utility>

#include "fuzz/process/child.h"
#include "fuzz/process/order_to_end.h"
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

}  // namespace

Request case_request(std::uint64_t index, std::uint64_t seed, std::size_t generator) {
  return {index, fmt::format("case {} {} {}\n", index, seed, generator)};
}

std::optional<Request> scene_request(const Scene& scene, std::uint64_t seed) {
  const Expected<WrittenScene> written = scene_to_text(scene, SceneFormat::kJson);
  if (!written) return std::nullopt;
  return Request{0, fmt::format("scene {} {}\n", seed, written->text.size()) + written->text};
}

struct WorkerPool::State {
  /// One process after another.
  struct Worker {
    Worker(State& pool, EventLoop& loop)
        : child(loop, {[this, &pool](std::string_view text) { pool.take_output(*this, text); },
                       [this](std::string_view text) { keep_end_of_errors(text); },
                       [this, &pool](const ChildEnd& end) { pool.ended(*this, end); }}) {}

    void keep_end_of_errors(std::string_view text) {
      error_text += text;
      if (error_text.size() <= kMostErrorText) return;
      error_text.erase(0, error_text.size() - kMostErrorText);
    }

    Child child;
    bool answered_once = false;  // by the present process
    std::string output_text;     // of a line whose end has not come yet
    std::string error_text, stage;
    std::optional<Request> request;
    int asked_to_end = 0;  // processes that were, with this request
  };

  State(WorkerCommand own_command, double own_seconds, unsigned count)
      : command(std::move(own_command)), seconds(own_seconds) {
    for (unsigned i = 0; i < count; ++i) workers.emplace_back(*this, loop);
  }

  bool start(Worker& worker) {
    worker.answered_once = false;
    worker.output_text.clear();
    worker.error_text.clear();
    worker.stage.clear();
    if (auto started = worker.child.start({command.program, command.arguments}); !started) {
      stop_with(std::move(started.error()));
      return false;
    }
    return true;
  }

  void stop_with(Error reason) {
    error = std::move(reason);
    loop.stop();
  }

  /// Gives an idle worker something to do, as long as there is something.
  void feed(Worker& worker) {
    if (error || worker.request) return;
    worker.request = callbacks->next();
    if (!worker.request) return;
    ++under_way;
    worker.asked_to_end = 0;
    give_request(worker);
  }

  void give_request(Worker& worker) {
    if (!worker.child.running() && !start(worker)) return;
    worker.stage.clear();
    worker.child.limit_time(seconds);
    worker.child.write(worker.request->text);
  }

  void take_output(Worker& worker, std::string_view text) {
    worker.output_text += text;
    std::size_t begin = 0;
    for (;;) {
      const std::size_t end = worker.output_text.find('\n', begin);
      if (end == std::string::npos) break;
      take_line(worker, worker.output_text.substr(begin, end - begin));
      begin = end + 1;
    }
    worker.output_text.erase(0, begin);
  }

  void take_line(Worker& worker, const std::string& line) {
    if (line.starts_with('@')) {
      worker.stage = line.substr(1);
    } else if (line.starts_with('=') && worker.request) {
      worker.answered_once = true;
      Expected<WorkerAnswer> answer = parse_answer(std::string_view(line).substr(1));
      finish(worker, answer
                         ? std::move(*answer)
                         : failed(worker, Property::kCrash, "nonsense", to_string(answer.error())));
    }
  }

  static WorkerAnswer failed(const Worker& worker, Property property, std::string disagreement,
                             std::string text) {
    WorkerAnswer answer;
    Failure failure;
    failure.property = property;
    failure.subject = subject_of_stage(worker.stage);
    failure.disagreement = std::move(disagreement);
    failure.text = "at '" + worker.stage + "': " + std::move(text);
    answer.report.failures.push_back(std::move(failure));
    return answer;
  }

  void finish(Worker& worker, WorkerAnswer answer) {
    worker.child.lift_time_limit();
    --under_way;
    const Request request = std::move(*worker.request);
    worker.request.reset();
    callbacks->answered(request, std::move(answer));
    feed(worker);
    end_if_done();
  }

  /// The process of a worker has ended; the next request gets a new one.
  void ended(Worker& worker, const ChildEnd& end) {
    if (!worker.request) return end_if_done();
    // A process that the system kills twice has earned it: by its memory.
    const bool killed = end.signal == SIGKILL && worker.asked_to_end == 0;
    if (!end.timed_out && (killed || is_order_to_end(end.signal))) {
      return begin_again(worker, end.signal);
    }
    std::string last = worker.error_text;
    while (!last.empty() && last.back() == '\n') last.pop_back();
    if (!last.empty()) last = "; it said: " + last;
    if (end.timed_out) {
      finish(worker, failed(worker, Property::kBudget, "time",
                            fmt::format("no answer within {} s", seconds)));
    } else if (end.signal != 0) {
      finish(worker, failed(worker, Property::kCrash, fmt::format("signal {}", end.signal),
                            fmt::format("ended by signal {}{}", end.signal, last)));
    } else if (worker.stage.empty() && !worker.answered_once) {
      // It never began: that says nothing about a scene, but how it was called.
      stop_with({ErrorCode::kFile,
                 {},
                 command.program + " ended with status " + std::to_string(end.status) + last,
                 {}});
    } else {
      finish(worker, failed(worker, Property::kCrash, fmt::format("status {}", end.status),
                            fmt::format("ended with status {}{}", end.status, last)));
    }
  }

  /// Somebody else ended the process, which says nothing about the scene.
  void begin_again(Worker& worker, int signal) {
    constexpr int kMostOrders = 20;
    if (++worker.asked_to_end <= kMostOrders) return give_request(worker);
    stop_with({ErrorCode::kFile,
               {},
               fmt::format("{} is ended by signal {} again and again", command.program, signal),
               {}});
  }

  void end_if_done() {
    if (under_way == 0) loop.stop();
  }

  Expected<void> run(const Callbacks& own) {
    const BrokenPipesAreErrors no_signal;
    callbacks = &own;
    error.reset();
    bool gave_up = false;
    if (own.tick) {
      loop.every(kTickMilliseconds, [&] {
        if (callbacks->tick()) return;
        gave_up = true;
        loop.stop();
      });
    }
    for (Worker& worker : workers) feed(worker);
    if (under_way > 0 && !error) loop.run();
    loop.every(0, {});
    if (gave_up || error) {
      for (Worker& worker : workers) {
        worker.child.abandon();
        worker.request.reset();
      }
      under_way = 0;
    }
    if (error) return tl::unexpected(*error);
    return {};
  }

  WorkerCommand command;
  double seconds;
  EventLoop loop;
  std::list<Worker> workers;
  const Callbacks* callbacks = nullptr;
  std::size_t under_way = 0;  // requests
  std::optional<Error> error;
};

WorkerPool::WorkerPool(WorkerCommand command, double seconds, unsigned workers)
    : state_(std::make_unique<State>(std::move(command), seconds, workers)) {}
WorkerPool::~WorkerPool() = default;

Expected<void> WorkerPool::run(const Callbacks& callbacks) { return state_->run(callbacks); }

}  // namespace gnomon::fuzz
