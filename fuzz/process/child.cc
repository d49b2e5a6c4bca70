// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/process/child.h"

#include <unistd.h>

#include <array>
#include <ctime>
#include <utility>

namespace gnomon::fuzz {

namespace {

template <class Handle>
uv_handle_t* base(Handle& handle) {
  return reinterpret_cast<uv_handle_t*>(&handle);
}

template <class Handle>
uv_stream_t* stream(Handle& handle) {
  return reinterpret_cast<uv_stream_t*>(&handle);
}

/// A pipe of which the child gets one end. Pipes of our own, since those that libuv makes are
/// sockets, and programs that open /dev/stdout cannot open a socket.
class PipeToChild {
 public:
  enum class Direction : std::uint8_t { kFromChild, kToChild };

  /// Errors: kFile.
  static Expected<PipeToChild> make(Direction direction) {
    const int our_end = direction == Direction::kFromChild ? 0 : 1;
    uv_file ends[2];
    const int status =
        uv_pipe(ends, our_end == 0 ? UV_NONBLOCK_PIPE : 0, our_end == 1 ? UV_NONBLOCK_PIPE : 0);
    if (status != 0) return fail(ErrorCode::kFile, std::string("no pipe: ") + uv_strerror(status));
    return PipeToChild(ends[our_end], ends[1 - our_end]);
  }
  PipeToChild(PipeToChild&& other) noexcept
      : ours_(std::exchange(other.ours_, -1)), childs_(std::exchange(other.childs_, -1)) {}
  PipeToChild(const PipeToChild&) = delete;
  PipeToChild& operator=(const PipeToChild&) = delete;
  ~PipeToChild() {
    for (const int end : {ours_, childs_}) {
      if (end >= 0) ::close(end);
    }
  }

  int childs() const { return childs_; }
  /// Our end belongs to the handle from here on.
  void open(uv_pipe_t& handle) { uv_pipe_open(&handle, std::exchange(ours_, -1)); }

 private:
  PipeToChild(int ours, int childs) : ours_(ours), childs_(childs) {}
  int ours_, childs_;
};

}  // namespace

EventLoop::EventLoop() {
  uv_loop_init(&loop_);
  uv_timer_init(&loop_, &timer_);
  timer_.data = this;
}

EventLoop::~EventLoop() {
  uv_close(base(timer_), nullptr);
  run();
  uv_loop_close(&loop_);
}

void EventLoop::every(std::uint64_t milliseconds, std::function<void()> tick) {
  tick_ = std::move(tick);
  if (!tick_) {
    uv_timer_stop(&timer_);
    return;
  }
  uv_timer_start(
      &timer_, [](uv_timer_t* timer) { static_cast<EventLoop*>(timer->data)->tick_(); },
      milliseconds, milliseconds);
}

BrokenPipesAreErrors::BrokenPipesAreErrors() {
  sigemptyset(&broken_pipe_);
  sigaddset(&broken_pipe_, SIGPIPE);
  sigset_t pending;
  sigpending(&pending);
  was_pending_ = sigismember(&pending, SIGPIPE) == 1;
  pthread_sigmask(SIG_BLOCK, &broken_pipe_, &before_);
}

BrokenPipesAreErrors::~BrokenPipesAreErrors() {
  const timespec at_once{};
  if (!was_pending_) sigtimedwait(&broken_pipe_, nullptr, &at_once);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

/// What belongs to one process. It lives until the loop has closed all of it, longer than the child
/// cares for it.
struct Child::Handles {
  Child* child = nullptr;  // null once nothing is called back any more
  uv_process_t process{};
  uv_pipe_t input{}, output{}, errors{};
  uv_timer_t timer{};
  int open = 0;
  std::array<char, 65536> buffer;

  Handles(uv_loop_t& loop, Child& owner) : child(&owner) {
    for (uv_pipe_t* pipe : {&input, &output, &errors}) uv_pipe_init(&loop, pipe, 0);
    uv_timer_init(&loop, &timer);
    for (uv_handle_t* handle : all()) handle->data = this;
    open = static_cast<int>(all().size());
  }

  std::array<uv_handle_t*, 5> all() {
    return {base(process), base(input), base(output), base(errors), base(timer)};
  }

  void close() {
    child = nullptr;
    for (uv_handle_t* handle : all()) {
      uv_close(handle, [](uv_handle_t* closed) {
        auto* const handles = static_cast<Handles*>(closed->data);
        if (--handles->open == 0) delete handles;
      });
    }
  }

  static void allocate(uv_handle_t* handle, std::size_t, uv_buf_t* buffer) {
    auto& own = static_cast<Handles*>(handle->data)->buffer;
    *buffer = uv_buf_init(own.data(), static_cast<unsigned>(own.size()));
  }

  static void on_read(uv_stream_t* from, ssize_t length, const uv_buf_t* buffer) {
    auto& handles = *static_cast<Handles*>(from->data);
    if (length < 0) uv_read_stop(from);
    if (length > 0) handles.hand_on(from, {buffer->base, static_cast<std::size_t>(length)});
  }

  void hand_on(const uv_stream_t* from, std::string_view text) const {
    if (child == nullptr) return;
    const Callbacks& callbacks = child->callbacks_;
    (from == reinterpret_cast<const uv_stream_t*>(&output) ? callbacks.output
                                                           : callbacks.errors)(text);
  }

  /// What an ended process left in a pipe. Others that have the pipe may go on writing, hence the
  /// bound, which is the most that a pipe holds.
  void drain(uv_pipe_t& pipe) {
    constexpr std::size_t kMostInPipe = std::size_t{1} << 20;
    uv_os_fd_t descriptor = -1;
    if (uv_fileno(base(pipe), &descriptor) != 0) return;
    uv_read_stop(stream(pipe));
    for (std::size_t taken = 0; taken < kMostInPipe;) {
      const ssize_t length = ::read(descriptor, buffer.data(), buffer.size());
      if (length <= 0) return;
      taken += static_cast<std::size_t>(length);
      hand_on(stream(pipe), {buffer.data(), static_cast<std::size_t>(length)});
    }
  }

  static void on_exit(uv_process_t* process, std::int64_t status, int signal) {
    auto& handles = *static_cast<Handles*>(process->data);
    if (handles.child != nullptr) handles.child->end(status, signal);
  }
};

Expected<void> Child::start(const ChildCommand& command) {
  using Direction = PipeToChild::Direction;
  auto input = PipeToChild::make(Direction::kToChild);
  auto output = PipeToChild::make(Direction::kFromChild);
  auto errors = PipeToChild::make(Direction::kFromChild);
  for (auto* pipe : {&input, &output, &errors}) {
    if (!*pipe) return tl::unexpected(pipe->error());
  }
  std::vector<char*> arguments{const_cast<char*>(command.program.c_str())};
  for (const std::string& argument : command.arguments) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  uv_stdio_container_t streams[3];
  for (uv_stdio_container_t& each : streams) each.flags = UV_INHERIT_FD;
  streams[0].data.fd = command.input >= 0 ? command.input : input->childs();
  streams[1].data.fd = output->childs();
  streams[2].data.fd = errors->childs();
  uv_process_options_t options{};
  options.file = command.program.c_str();
  options.args = arguments.data();
  options.stdio = streams;
  options.stdio_count = 3;
  // A group of its own: Ctrl-C is ours alone, and what it starts ends with it.
  options.flags = UV_PROCESS_DETACHED;
  options.exit_cb = Handles::on_exit;

  auto* const handles = new Handles(loop_.handle(), *this);  // deletes itself
  const int status = uv_spawn(&loop_.handle(), &handles->process, &options);
  if (status != 0) {
    handles->close();
    return fail(ErrorCode::kFile, command.program + " cannot be started: " + uv_strerror(status));
  }
  handles_ = handles;
  timed_out_ = false;
  if (command.input < 0) input->open(handles->input);
  output->open(handles->output);
  errors->open(handles->errors);
  for (uv_pipe_t* pipe : {&handles->output, &handles->errors}) {
    uv_read_start(stream(*pipe), Handles::allocate, Handles::on_read);
  }
  return {};
}

void Child::limit_time(double seconds) {
  if (!running()) return;
  timed_out_ = false;
  uv_update_time(&loop_.handle());  // it may be long since the loop ran
  uv_timer_start(
      &handles_->timer,
      [](uv_timer_t* timer) {
        Child* const child = static_cast<Handles*>(timer->data)->child;
        if (child == nullptr) return;
        child->timed_out_ = true;
        child->kill();
      },
      static_cast<std::uint64_t>(seconds * 1000) + 1, 0);
}

void Child::lift_time_limit() {
  if (running()) uv_timer_stop(&handles_->timer);
}

void Child::write(std::string text) {
  if (!running()) return;
  struct Write {
    uv_write_t request{};
    std::string text;
  };
  auto* const write = new Write{{}, std::move(text)};  // deleted when it is done
  write->request.data = write;
  uv_buf_t buffer = uv_buf_init(write->text.data(), static_cast<unsigned>(write->text.size()));
  const int status =
      uv_write(&write->request, stream(handles_->input), &buffer, 1,
               [](uv_write_t* done, int) { delete static_cast<Write*>(done->data); });
  if (status != 0) delete write;
}

void Child::kill() {
  if (running()) ::kill(-handles_->process.pid, SIGKILL);
}

void Child::abandon() {
  if (!running()) return;
  kill();
  std::exchange(handles_, nullptr)->close();
}

void Child::end(std::int64_t status, int signal) {
  // Whatever it started ends too.
  kill();
  uv_timer_stop(&handles_->timer);
  Handles& handles = *handles_;
  handles.drain(handles.output);
  handles.drain(handles.errors);
  if (!running()) return;  // a callback has abandoned it
  std::exchange(handles_, nullptr)->close();
  callbacks_.ended({static_cast<int>(status), signal, timed_out_});
}

}  // namespace gnomon::fuzz
