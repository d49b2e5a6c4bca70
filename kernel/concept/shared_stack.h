// SPDX-License-Identifier: LGPL-3.0-or-later
// A stack whose lower part copies have in common, so that many of them cost little.
#ifndef GNOMON_KERNEL_CONCEPT_SHARED_STACK_H
#define GNOMON_KERNEL_CONCEPT_SHARED_STACK_H

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace gnomon {

template <class T>
class SharedStack {
 public:
  std::size_t size() const { return shared_size_ + own_.size(); }
  bool empty() const { return size() == 0; }
  const T& operator[](std::size_t i) const {
    return i < shared_size_ ? shared_begin_[i] : own_[i - shared_size_];
  }
  const T& back() const { return (*this)[size() - 1]; }

  void push_back(T value) { own_.push_back(std::move(value)); }
  void reserve(std::size_t size) {
    if (size > shared_size_) own_.reserve(size - shared_size_);
  }
  /// Keeps the first `size`. Cost: if fewer than those in common, their number.
  void truncate(std::size_t size) {
    if (size < shared_size_) {
      own_.assign(shared_begin_, shared_begin_ + size);
      shared_.reset();
      shared_begin_ = nullptr;
      shared_size_ = 0;
    } else {
      own_.erase(own_.begin() + static_cast<std::ptrdiff_t>(size - shared_size_), own_.end());
    }
  }
  /// Empties it. Requires: copies have nothing in common with it.
  std::vector<T> take() { return std::exchange(own_, {}); }
  /// What is there now copies that are made from now on have in common. Room to spare stays: nobody
  /// has touched it, so that it takes no memory, which a tighter copy would for a while.
  void share() {
    if (own_.empty()) return;
    if (shared_size_ > 0) own_.insert(own_.begin(), shared_begin_, shared_begin_ + shared_size_);
    shared_ = std::make_shared<const std::vector<T>>(std::exchange(own_, {}));
    shared_begin_ = shared_->data();
    shared_size_ = shared_->size();
  }

 private:
  std::shared_ptr<const std::vector<T>> shared_;
  const T* shared_begin_ = nullptr;
  std::size_t shared_size_ = 0;
  std::vector<T> own_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_SHARED_STACK_H
