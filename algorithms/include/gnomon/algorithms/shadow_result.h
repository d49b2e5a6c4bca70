// SPDX-License-Identifier: LGPL-3.0-or-later
// What every shadow algorithm returns, whatever kernel it ran on: per light and part, classified
// fragments, with exact or nearest points on request.
#ifndef GNOMON_ALGORITHMS_SHADOW_RESULT_H
#define GNOMON_ALGORITHMS_SHADOW_RESULT_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/algorithms/method.h"
#include "gnomon/algorithms/work_counts.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "gnomon/result/classes.h"

namespace gnomon {

/// Certified bounds: the true value is in [lower, upper].
struct Interval {
  double lower = 0, upper = 0;
  double middle() const { return lower + (upper - lower) / 2; }
};

/// A convex loop, counter-clockwise seen from the side that it belongs to.
struct Fragment {
  static constexpr std::uint32_t kNoCaster = 0xffffffffu;
  LightState state = LightState::kLit;
  ShadowReason reason = ShadowReason::kNone;  // kBehindLight: of a part that reaches behind an area
                                              // light, the piece there; umbra without a caster
  std::uint32_t caster = kNoCaster;           // part index of the witness
  std::uint32_t casters = kNoCaster;   // in place of one: an index into LightResult::caster_sets
  std::uint32_t first = 0, count = 0;  // into points / exact_points of the LightResult, if kept
};

/// The side of one part that was classified, and its fragments.
struct PartResult {
  std::uint32_t part = 0;
  Side side = Side::kFront;  // the part's side that faces the light; kFront if none does
  ShadowReason reason = ShadowReason::kNone;  // set: the whole part is in shadow, no fragments
  std::uint32_t first_fragment = 0, fragment_count = 0;
  Interval lit;     // fraction of the part's area; for rounded kernels lower == upper
  Interval shadow;  // 0 for an area light: see AreaFractions
};

/// What a part's side has under an area light besides PartResult::lit. On exact kernels the three
/// fractions add up to exactly 1.
struct AreaFractions {
  Interval penumbra, umbra;
};

/// The fractions of one side as rationals; classes that the light does not know are 0. On exact
/// kernels they add up to exactly 1.
struct ExactFractions {
  mpq_class lit, shadow, penumbra, umbra;
};

struct LightResult {
  static constexpr std::uint32_t kWhole = 0xffffffffu;
  std::uint32_t light = 0;  // index into PreparedScene::lights
  // MethodId::kPieces: one result a piece of the light, in order of the pieces; else kWhole.
  std::uint32_t piece = kWhole;
  MethodId method = MethodId::kAutomatic;  // the one that ran
  // Of that piece, counter-clockwise seen from its front, scene units.
  std::vector<std::array<mpq_class, 3>> piece_loop;
  // Point and directional lights: one a part, in order. Area lights: one for each side of a part
  // that sees the light, front before back, or one with kFront and a reason if none does.
  std::vector<PartResult> parts;
  // How the fragments of a part's side cover it: kPartition tiles it; of kOverlay the last fragment
  // that holds a point tells its class. A method that returns an overlay also says what is true
  // where no fragment is.
  Cover cover = Cover::kPartition;
  // The class of all that no fragment holds, on sides that face or see the light. None: fragments
  // cover everything. Fractions count it.
  std::optional<LightState> background;
  std::vector<AreaFractions> area_fractions;  // area lights: one for each of `parts`; else empty
  // One for each of `parts` if asked for (ShadowOutput::exact_fractions); else empty.
  std::vector<ExactFractions> exact_fractions;
  std::vector<Fragment> fragments;
  /// Parts that together hide the light from all of a fragment, where no single one need do.
  std::vector<std::vector<std::uint32_t>> caster_sets;
  std::vector<std::array<double, 3>> points;           // nearest doubles, scene units
  std::vector<std::array<mpq_class, 3>> exact_points;  // scene units
  // Counts of the papers' tables.
  std::uint64_t facing_parts = 0, facing_edges = 0, tree_nodes = 0, fragment_total = 0;
  // What a rounded kernel could not do: loops that vanished, and so on. Zero on exact kernels.
  std::uint64_t dropped_slivers = 0;
  WorkCounts work;  // what the method says of itself (Method::counters)
};

/// A fragment of one side of a part, and its class under every light.
struct CombinedFragment {
  std::uint32_t part = 0;
  Side side = Side::kFront;
  std::uint64_t lit_by = 0;            // bit i: ShadowResult::lights[i] reaches all of it
  std::uint64_t penumbra_of = 0;       // bit i: it is in the penumbra of that (area) light
  std::uint32_t first = 0, count = 0;  // into combined_points / combined_exact_points
};

/// A loop painted on one side of a part, for several lights at once (docs: formats, "overlay"): of
/// the loops that hold a point, the one of the highest level tells which lights do not reach it.
/// Where none is, every light that the side faces reaches it. Point and directional lights only.
struct PaintedPolygon {
  static constexpr std::uint32_t kNoOwner = 0xffffffffu;
  std::uint32_t part = 0;
  Side side = Side::kFront;
  std::uint32_t level = 1;             // painted in ascending order; above the owner's
  std::uint64_t dark_for = 0;          // bit i: ShadowResult::lights[i] does not reach it
  std::uint32_t on = kNoOwner;         // the loop that it was cut from: an index into
                                       // ShadowResult::overlay, of the same polygon and side
  std::uint32_t first = 0, count = 0;  // into overlay_points / overlay_exact_points
};

/// What several lights together, by svbsp, have been made with, and what a step in which some of
/// them have moved has done of it.
struct TogetherCounts {
  std::uint64_t trees = 0, trees_built = 0;
  std::uint64_t filters_from_nothing = 0, filters = 0;  // loops classified by a tree
  std::uint64_t tree_bytes = 0;                         // of all trees
  std::uint64_t tree_bytes_at_once =
      0;                         // most of them at one time: those of no more use are dropped
  std::uint64_t kept_bytes = 0;  // fragments that later steps start from
};

struct ShadowResult {
  std::string kernel;     // id of formats: "plane", "double", ...
  std::string algorithm;  // "sectors", "svbsp", "receiver", "merged", "pieces"; "sectors+receiver"
                          // if point and area lights took different ways
  bool exact = false;
  bool identity = false;
  double thickness = 0;  // relative plane thickness (float kernels)
  std::vector<LightResult> lights;
  // Several lights together (ShadowOptions::combined): fragments of every side that faces a light,
  // grouped by polygon and side; sides that face none have none.
  std::vector<CombinedFragment> combined;
  std::vector<std::array<double, 3>> combined_points;
  std::vector<std::array<mpq_class, 3>> combined_exact_points;
  // Several lights as shadows painted on shadows: grouped by polygon and side; a side on which
  // nothing is painted has no entry.
  std::vector<PaintedPolygon> overlay;
  std::vector<std::array<double, 3>> overlay_points;
  std::vector<std::array<mpq_class, 3>> overlay_exact_points;
  double scene_bsp_seconds = 0, shadow_seconds = 0;  // CPU time
  StageCounts stages;  // which stage answered; all zero unless ShadowOptions::count_stages
  std::uint64_t bsp_nodes = 0, bsp_fragments = 0, bsp_depth = 0;
  TogetherCounts together;  // of svbsp
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_RESULT_H
