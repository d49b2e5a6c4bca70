// SPDX-License-Identifier: GPL-3.0-or-later
// A value that is made when it is first asked for, from any thread: what several make at once is
// the same, and the first one made stays.
#ifndef GNOMON_ORACLE_JUDGE_MADE_ONCE_H
#define GNOMON_ORACLE_JUDGE_MADE_ONCE_H

#include <atomic>
#include <memory>

namespace gnomon::oracle {

template <class Value>
class MadeOnce {
 public:
  MadeOnce() = default;
  MadeOnce(const MadeOnce&) = delete;
  MadeOnce& operator=(const MadeOnce&) = delete;
  ~MadeOnce() { delete value_.load(std::memory_order_relaxed); }

  /// `make` gives the same value whoever calls it.
  template <class Make>
  const Value& get(const Make& make) {
    if (const Value* own = value_.load(std::memory_order_acquire)) return *own;
    auto made = std::make_unique<const Value>(make());
    const Value* none = nullptr;
    // On failure `none` is what another thread made first.
    if (!value_.compare_exchange_strong(none, made.get(), std::memory_order_acq_rel)) return *none;
    return *made.release();
  }

 private:
  std::atomic<const Value*> value_ = nullptr;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_MADE_ONCE_H
