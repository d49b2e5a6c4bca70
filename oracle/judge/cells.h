// SPDX-License-Identifier: GPL-3.0-or-later
// One cell of the overlay of truth and claims: what is true there, what is claimed there, and what
// is wrong about it.
//
// Exactness: decides by winding numbers alone, which are exact.
#ifndef GNOMON_ORACLE_JUDGE_CELLS_H
#define GNOMON_ORACLE_JUDGE_CELLS_H

#include <array>
#include <optional>

#include "gnomon/oracle/compare.h"
#include "gnomon/result/classes.h"
#include "oracle/geometry/overlay.h"

namespace gnomon::oracle {

constexpr std::array kClasses{LightState::kLit, LightState::kShadow, LightState::kPenumbra,
                              LightState::kUmbra};
using ClassSet = std::array<bool, 4>;  // by LightState

/// What a candidate's classes are judged by, on one group of parts.
struct Rules {
  bool area = false;        // of an area light
  bool per_caster = false;  // umbra is what one caster alone hides
  bool layered = false;     // loops may overlap: those on top count
  bool optional = false;    // nothing need be claimed
  bool tiling = true;       // false: gaps, overlaps and what lies outside are told elsewhere
  /// Classes that what no loop covers may have; nothing: it must be covered.
  std::optional<ClassSet> left_out;
  /// Classes in which membership is told.
  ClassSet told{true, true, true, true};

  bool may_be_left_out(LightState state) const {
    return left_out && (*left_out)[static_cast<std::size_t>(state)];
  }
};

Rules rules_of(const ClaimedTerms& terms, bool area, const ReceiverGroup& group);

/// The layer of a claimed class. One that the light does not have fails the candidate elsewhere;
/// here it is some darkness.
Layer layer_of(LightState state, bool area);
LightState class_of(Layer layer);

/// What loops claim of one place.
struct Claimed {
  int loops = 0;  // that hold it
  ClassSet states{};

  void add(LightState state) { states[static_cast<std::size_t>(state)] = true; }
};

/// All loops count.
Claimed claimed_by(const Winding& winding);

struct Cell {
  bool inside = false;  // of the receiver
  LightState truth = LightState::kLit;
  bool deep = false;  // certified: no light arrives
  ClassSet claimed{};
  bool misclassified = false, uncovered = false, overlapping = false, outside = false;
  bool missing_umbra = false;

  bool errs() const { return misclassified || overlapping || outside; }
  bool claims(LightState state) const { return claimed[static_cast<std::size_t>(state)]; }
  bool accepts(LightState state, const Rules& rules) const;
};

/// Sets what is wrong about claims of a place inside of the receiver, whose truth the cell has.
void compare_claims(Cell& cell, const Claimed& claimed, const Rules& rules);
/// Of the classes claimed one that is wrong, else any; nothing if none is claimed.
std::optional<LightState> wrong_class(const Cell& cell, const Rules& rules);
Cell read_cell(const Winding& winding, const Claimed& claimed, const Rules& rules);
/// The worst that is wrong.
ErrorKind kind_of(const Cell& cell);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_CELLS_H
