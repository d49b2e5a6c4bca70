// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/cells.h"

#include <algorithm>

namespace gnomon::oracle {

namespace {

constexpr std::array kLayerOf{kLit, kShadow, kPenumbra, kUmbra};  // by LightState

bool is_class_of_light(LightState state, bool area) {
  return state == LightState::kLit || (state != LightState::kShadow) == area;
}

}  // namespace

Layer layer_of(LightState state, bool area) {
  if (state == LightState::kLit) return kLit;
  if (!area) return kShadow;
  return state == LightState::kUmbra ? kUmbra : kPenumbra;
}

LightState class_of(Layer layer) {
  return kClasses[static_cast<std::size_t>(std::ranges::find(kLayerOf, layer) - kLayerOf.begin())];
}

Rules rules_of(const ClaimedTerms& terms, bool area, const ReceiverGroup& group) {
  Rules rules;
  rules.area = area;
  rules.per_caster = terms.per_caster_umbra;
  rules.layered = terms.cover == Cover::kOverlay;
  rules.optional = group.optional;
  rules.tiling = group.tiling;
  if (terms.listed) {
    rules.told = {};
    for (const LightState state : *terms.listed) rules.told[static_cast<std::size_t>(state)] = true;
    rules.left_out.emplace();
    for (const LightState state : kClasses) {
      const auto c = static_cast<std::size_t>(state);
      (*rules.left_out)[c] = is_class_of_light(state, area) && !rules.told[c];
    }
  } else if (terms.background) {
    rules.left_out.emplace();
    const LightState state = class_of(layer_of(*terms.background, area));
    (*rules.left_out)[static_cast<std::size_t>(state)] = true;
  }
  return rules;
}

Claimed claimed_by(const Winding& winding) {
  Claimed claimed;
  for (const LightState state : kClasses) {
    const int loops = winding[kLayerOf[static_cast<std::size_t>(state)]];
    claimed.loops += loops;
    if (loops > 0) claimed.add(state);
  }
  return claimed;
}

bool Cell::accepts(LightState state, const Rules& rules) const {
  if (state == truth) return true;
  if (!rules.area || rules.per_caster) return false;
  return (truth == LightState::kUmbra && state == LightState::kPenumbra) ||
         (truth == LightState::kPenumbra && state == LightState::kUmbra && deep);
}

void compare_claims(Cell& cell, const Claimed& claimed, const Rules& rules) {
  cell.claimed = claimed.states;
  cell.overlapping = rules.tiling && !rules.layered && claimed.loops > 1;
  if (claimed.loops == 0 && (rules.optional || !rules.tiling)) return;
  // A class in which membership is not told says no more than nothing.
  ClassSet told{};
  for (std::size_t c = 0; c < told.size(); ++c) told[c] = claimed.states[c] && rules.told[c];
  const auto classes = std::ranges::count(told, true);
  const auto some_right = [&](const ClassSet& states) {
    return std::ranges::any_of(kClasses, [&](LightState state) {
      return states[static_cast<std::size_t>(state)] && cell.accepts(state, rules);
    });
  };
  const bool costs = !rules.per_caster && cell.truth == LightState::kUmbra;
  if (classes > 0) {
    cell.misclassified = classes > 1 || !some_right(told);
    cell.missing_umbra = costs && classes == 1 && cell.claims(LightState::kPenumbra);
    return;
  }
  cell.misclassified = !rules.left_out || !some_right(*rules.left_out);
  // One class that all the rest has is as good as found there.
  if (rules.left_out && std::ranges::count(*rules.left_out, true) == 1) {
    cell.claimed = *rules.left_out;
  }
  cell.uncovered = cell.misclassified && std::ranges::count(cell.claimed, true) == 0;
  cell.missing_umbra = costs && !cell.misclassified && !rules.may_be_left_out(LightState::kUmbra);
}

std::optional<LightState> wrong_class(const Cell& cell, const Rules& rules) {
  std::optional<LightState> found;
  for (const LightState state : kClasses) {
    if (!cell.claims(state)) continue;
    found = state;
    if (!cell.accepts(state, rules)) break;
  }
  return found;
}

Cell read_cell(const Winding& winding, const Claimed& claimed, const Rules& rules) {
  Cell cell;
  cell.inside = winding[kReceiver] != 0;
  cell.truth = winding[kTrueUmbra] != 0 ? LightState::kUmbra
               : winding[kTruth] == 0   ? LightState::kLit
               : rules.area             ? LightState::kPenumbra
                                        : LightState::kShadow;
  cell.deep = winding[kDeep] != 0;
  if (cell.inside) {
    compare_claims(cell, claimed, rules);
    return cell;
  }
  cell.claimed = claimed.states;
  cell.overlapping = rules.tiling && !rules.layered && claimed.loops > 1;
  cell.outside = rules.tiling && claimed.loops > 0;
  return cell;
}

ErrorKind kind_of(const Cell& cell) {
  if (cell.uncovered) return ErrorKind::kUncovered;
  if (cell.misclassified) return ErrorKind::kMisclassified;
  if (cell.outside) return ErrorKind::kOutside;
  return cell.overlapping ? ErrorKind::kOverlapping : ErrorKind::kNone;
}

}  // namespace gnomon::oracle
