// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/scan_out/direction_tiles.h"

#include <algorithm>

namespace gnomon {

DirectionTiles::DirectionTiles(std::span<const Box> boxes, std::span<const std::uint32_t> members,
                               std::uint32_t cells)
    : cells_(cells), tiles_(std::size_t{cells} * cells * cells) {
  for (const std::uint32_t member : members) all_.add(boxes[member]);
  for (const std::uint32_t member : members) {
    for_each_tile(range_of(boxes[member]), [&](std::vector<std::uint32_t>& own) {
      own.push_back(member);
      ++writes_;
    });
  }
}

/// The same monotone rounding for every box, so that boxes which meet share a tile.
DirectionTiles::Range DirectionTiles::range_of(const Box& box) const {
  Range range{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double size = all_.high[k] - all_.low[k];
    const auto cell = [&](double value) {
      // Flat boxes, and those without a size in doubles, have one cell along an axis.
      if (!(size > 0)) return std::uint32_t{0};
      const double share = (value - all_.low[k]) / size * cells_;
      if (!(share > 0)) return std::uint32_t{0};
      return share < cells_ ? static_cast<std::uint32_t>(share) : cells_ - 1;
    };
    range.low[k] = cell(box.low[k]);
    range.high[k] = cell(box.high[k]);
  }
  return range;
}

template <class Use>
void DirectionTiles::for_each_tile(const Range& range, const Use& use) {
  for (std::uint32_t z = range.low[2]; z <= range.high[2]; ++z) {
    for (std::uint32_t y = range.low[1]; y <= range.high[1]; ++y) {
      for (std::uint32_t x = range.low[0]; x <= range.high[0]; ++x) use(tile(x, y, z));
    }
  }
}

void DirectionTiles::find(const Box& box, std::vector<std::uint32_t>& found) {
  const std::size_t first = found.size();
  for_each_tile(range_of(box), [&](const std::vector<std::uint32_t>& own) {
    found.insert(found.end(), own.begin(), own.end());
  });
  const auto begin = found.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, found.end());
  found.erase(std::unique(begin, found.end()), found.end());
}

}  // namespace gnomon
