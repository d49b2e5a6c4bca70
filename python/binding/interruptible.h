// SPDX-License-Identifier: GPL-3.0-or-later
// Work without the GIL, which Ctrl-C can stop.
#ifndef GNOMON_PYTHON_BINDING_INTERRUPTIBLE_H
#define GNOMON_PYTHON_BINDING_INTERRUPTIBLE_H

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <optional>

namespace gnomon::python {

/// Runs work(stop) on a thread of its own, while other threads of Python go on and this one asks
/// for signals. Where a handler raises, `stop` becomes true, and its exception (KeyboardInterrupt)
/// is thrown once the work has ended. Requires: the GIL is held; the work uses nothing of Python.
template <class Work>
auto interruptibly(const Work& work) {
  namespace nb = nanobind;
  constexpr std::chrono::milliseconds kBetweenLooks{50};
  std::atomic<bool> stop = false;
  auto done = std::async(std::launch::async, [&] { return work(stop); });
  std::optional<nb::python_error> raised;
  {
    const nb::gil_scoped_release released;
    while (done.wait_for(kBetweenLooks) != std::future_status::ready) {
      if (stop) continue;
      const nb::gil_scoped_acquire held;
      if (PyErr_CheckSignals() == 0) continue;
      raised.emplace();
      stop = true;
    }
  }
  auto result = done.get();
  if (raised) throw std::move(*raised);
  return result;
}

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_INTERRUPTIBLE_H
