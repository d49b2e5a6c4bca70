// SPDX-License-Identifier: LGPL-3.0-or-later
// Which strips a box is put into. Where tall boxes are few, each box is put into every strip that
// it reaches. Else strips are joined by eight into those of a coarser layer, these again, and each
// box has a layer of its own, the finest in which it reaches at most eight strips. A pair is found
// in the coarser of its two layers; there a strip also holds the boxes whose own layer is finer,
// and two of these are not tested.
//
// So a box has at most 8 entries in its own layer and 2 in each coarser one, and memory is
// proportional to the boxes, however tall they are.
#ifndef GNOMON_ALGORITHMS_CONTOUR_STRIP_LAYERS_H
#define GNOMON_ALGORITHMS_CONTOUR_STRIP_LAYERS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon {

/// A box that reaches more strips than this one is tall.
inline constexpr std::uint32_t kMostStrips = 8;
inline constexpr unsigned kLayerShift = 3;  // kMostStrips strips are joined into one
inline constexpr std::size_t kMostLayers = 11;

/// The strips of the finest layer that a box reaches.
struct StripSpan {
  std::uint32_t first, last;
  std::uint32_t strips(std::size_t layer) const {
    const unsigned shift = kLayerShift * static_cast<unsigned>(layer);
    return (last >> shift) - (first >> shift) + 1;
  }
};

/// How many strips of each layer are reached by boxes that are tall there.
class TallStrips {
 public:
  void add(const StripSpan& span) {
    for (std::size_t layer = 0; span.strips(layer) > kMostStrips; ++layer) {
      sums_[layer] += span.strips(layer);
    }
  }
  void add(const TallStrips& other) {
    for (std::size_t i = 0; i < kMostLayers; ++i) sums_[i] += other.sums_[i];
  }
  std::uint64_t in_layer(std::size_t layer) const { return sums_[layer]; }

 private:
  std::array<std::uint64_t, kMostLayers> sums_{};
};

/// The layers of one chart. Each strip has two bins of entries, for the boxes of its own layer and
/// for those of finer ones.
class StripLayers {
 public:
  /// `boxes`: how many there are. Bins are numbered from first_bin.
  void make(std::uint32_t boxes, std::uint32_t strips, const TallStrips& tall,
            std::uint32_t first_bin) {
    coarsest_ = 0;
    // Tall boxes in every strip are no burden as long as they add a fraction to the entries.
    while (tall.in_layer(coarsest_) > boxes / 4 + 256) ++coarsest_;
    for (std::size_t layer = 0; layer <= coarsest_; ++layer) {
      first_bin_[layer] = first_bin;
      first_bin += 2 * (((strips - 1) >> kLayerShift * layer) + 1);
    }
    end_bin_ = first_bin;
  }
  std::uint32_t end_bin() const { return end_bin_; }

  /// Calls entry(bin, starts, own) for each strip that the box is put into: whether the box starts
  /// in the strip, or else in one before it; whether the strip's layer is the box's own.
  template <class Entry>
  void for_each_entry(const StripSpan& span, const Entry& entry) const {
    std::size_t layer = 0;
    while (layer < coarsest_ && span.strips(layer) > kMostStrips) ++layer;
    std::uint32_t first = span.first >> kLayerShift * layer;
    std::uint32_t last = span.last >> kLayerShift * layer;
    for (std::uint32_t strip = first; strip <= last; ++strip) {
      entry(first_bin_[layer] + 2 * strip, strip == first, true);
    }
    while (layer < coarsest_) {  // at most two strips in each of these
      ++layer;
      first >>= kLayerShift;
      last >>= kLayerShift;
      entry(first_bin_[layer] + 2 * first + 1, true, false);
      if (first != last) entry(first_bin_[layer] + 2 * last + 1, false, false);
    }
  }

 private:
  std::size_t coarsest_ = 0;
  std::array<std::uint32_t, kMostLayers> first_bin_{};
  std::uint32_t end_bin_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_STRIP_LAYERS_H
