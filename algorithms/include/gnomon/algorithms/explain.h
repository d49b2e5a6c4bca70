// SPDX-License-Identifier: LGPL-3.0-or-later
// Which decisions of a rounded kernel are wrong, and which of them matter? A method runs on a scene
// with every decision answered exactly, and the rounded kernel is asked the same questions beside
// it (kernel/watched/). Then the exact run is repeated with one wrong answer at a time, and the
// result says whether that answer changed a class or a share.
//
// What the rounded kernel is asked about: the vertices and planes that it would have made itself in
// this run, from its own numbers. After an answer that differs it goes on from the exact one, so
// that no difference is the consequence of another.
#ifndef GNOMON_ALGORITHMS_EXPLAIN_H
#define GNOMON_ALGORITHMS_EXPLAIN_H

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/differing_decision.h"

namespace gnomon {

/// A share that moves by no more than this has not changed: shares of these runs are sums of
/// doubles.
inline constexpr double kUnchangedShare = 1e-12;

struct ExplainOptions {
  std::uint32_t flips = 0;  // decisions that are flipped, those of the largest exact value first
  bool only_first = false;  // look no further than the first decision that differs
};

/// Fractions of a part's area.
struct SideShares {
  double lit = 0, shadow = 0, penumbra = 0, umbra = 0;
};

struct ChangedSide {
  std::uint32_t light = 0, part = 0;  // indices into PreparedScene
  Side side = Side::kFront;
  SideShares before, after;
};

/// What a run changed of the result of the exact run.
struct RunEffect {
  bool ended = true;                // false: it had to be stopped, or could not be run
  std::uint64_t changed = 0;        // sides of parts with a changed class or share
  bool classes = false;             // of one of them a class appeared or vanished
  std::optional<ChangedSide> most;  // of the largest change

  bool changes() const { return !ended || changed > 0; }
};

struct FlippedDecision {
  std::size_t decision = 0;  // into Explanation::decisions
  RunEffect effect;
};

/// Decisions that differ about the same thing in the same place.
struct DecisionGroup {
  Predicate predicate = Predicate::kFacing;
  std::optional<std::uint32_t> light;  // index into PreparedScene::lights; none: the scene BSP
  std::optional<std::uint32_t> part;   // of the point that is asked about; none: of a volume
  std::uint64_t decisions = 0, times = 0;
  std::uint64_t on = 0;        // exactly zero
  double least = 0, most = 0;  // ulps of the others
};

struct Explanation {
  std::array<std::uint64_t, kPredicateCount> asked{};  // by Predicate
  std::optional<DifferingDecision> first;              // that differs, in the order of the run
  std::vector<DifferingDecision> decisions;            // largest exact value first
  std::vector<DecisionGroup> groups;                   // most decisions first
  std::vector<FlippedDecision> flipped;
  /// Decisions that cannot be flipped alone: about vertices made in the scene BSP, which later
  /// spaces know by its planes, and planes that the exact run has not.
  std::uint64_t cannot_be_flipped = 0;
  RunEffect together;  // of all that can be flipped, at once, if any flips were asked for
  RunEffect kernel;    // of the rounded kernel's own run, likewise

  std::uint64_t times() const;
};

/// Light by light, on one thread. Uses kernel, method, lights, limits and control of the options.
/// Errors: those of compute_shadows; kUsage for an exact kernel, and for a method whose decisions
/// no kernel's spaces make (Method::explains).
Expected<Explanation> explain(const PreparedScene& scene, const ShadowOptions& options,
                              const ExplainOptions& wanted);

/// The part that the point of a decision is on; none where it is on a face of a shadow volume.
std::optional<std::uint32_t> part_of(const DifferingDecision& decision, const PreparedScene& scene);

/// One or two sentences: what was asked, what each kernel answered, of which vertex and plane.
/// Vertices in "input vertex N" and "edge A-B" count the prepared scene's distinct positions.
std::string to_sentence(const DifferingDecision& decision, const PreparedScene& scene,
                        const std::string& kernel, const std::vector<std::string>& light_names);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_EXPLAIN_H
