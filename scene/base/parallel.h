// SPDX-License-Identifier: LGPL-3.0-or-later
// Loops over many elements on all cores. A range is cut into pieces of a fixed size, whatever the
// number of threads, and results of pieces are kept in the order of the range: so what is computed
// does not depend on the number of threads. Ranges of one piece run on the calling thread.
#ifndef GNOMON_SCENE_BASE_PARALLEL_H
#define GNOMON_SCENE_BASE_PARALLEL_H

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon::scene_detail {

/// Elements of one piece where each costs some nanoseconds.
inline constexpr std::size_t kPieceOfCheapElements = std::size_t{1} << 15;

inline std::size_t piece_count(std::size_t n, std::size_t piece) { return (n + piece - 1) / piece; }

/// Polygons of one piece.
inline constexpr std::size_t kPieceOfPolygons = std::size_t{1} << 12;

/// Calls f(begin, end) for every piece of [0, n).
template <class F>
void for_each_piece(std::size_t n, std::size_t piece, const F& f) {
  const std::size_t pieces = piece_count(n, piece);
  if (pieces == 1) f(std::size_t{0}, n);
  if (pieces <= 1) return;
  tbb::parallel_for(std::size_t{0}, pieces,
                    [&](std::size_t k) { f(k * piece, std::min(n, (k + 1) * piece)); });
}

/// Calls f(i) for every i in [0, n).
template <class F>
void for_each_index(std::size_t n, const F& f) {
  for_each_piece(n, kPieceOfCheapElements, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f(i);
  });
}

/// The results f(begin, end) of all pieces of [0, n), in order.
template <class F>
auto map_pieces(std::size_t n, std::size_t piece, const F& f) {
  std::vector<decltype(f(n, n))> results(piece_count(n, piece));
  for_each_piece(n, piece, [&](std::size_t begin, std::size_t end) {
    results[begin / piece] = f(begin, end);
  });
  return results;
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_BASE_PARALLEL_H
