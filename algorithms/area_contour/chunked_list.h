// SPDX-License-Identifier: LGPL-3.0-or-later
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_CHUNKED_LIST_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_CHUNKED_LIST_H

#include <cstddef>
#include <memory>
#include <vector>

namespace gnomon::area_contour {

/// A list in chunks: what it holds stays where it is when it grows, so that no memory is left over
/// from smaller ones. Keeps its chunks when it is cleared.
template <class T>
class ChunkedList {
 public:
  std::size_t size() const { return size_; }
  const T& operator[](std::size_t i) const { return chunks_[i / kChunk][i % kChunk]; }
  T& operator[](std::size_t i) { return chunks_[i / kChunk][i % kChunk]; }
  void clear() { size_ = 0; }
  /// New elements hold anything.
  void resize(std::size_t size) {
    while (chunks_.size() * kChunk < size) {
      chunks_.push_back(std::make_unique_for_overwrite<T[]>(kChunk));
    }
    size_ = size;
  }

 private:
  static constexpr std::size_t kChunk = 128;
  std::vector<std::unique_ptr<T[]>> chunks_;
  std::size_t size_ = 0;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_CHUNKED_LIST_H
