// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/moves/moves.h"

#include "fuzz/moves/move_tools.h"

namespace gnomon::fuzz {

std::span<const Move> moves() {
  static const std::vector<Move> kMoves = [] {
    std::vector<Move> all;
    // What is near something comes after what it may be near to; what changes everything, last.
    for (const auto& group :
         {polygon_moves(), light_moves(), area_moves(), near_moves(), whole_moves()}) {
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }();
  return kMoves;
}

const Move* move_by_name(std::string_view name) {
  for (const Move& move : moves()) {
    if (move.name() == name) return &move;
  }
  return nullptr;
}

}  // namespace gnomon::fuzz
