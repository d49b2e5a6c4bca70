// SPDX-License-Identifier: LGPL-3.0-or-later
// What one side of one part comes to under one light, whoever cut it: collects classified pieces,
// puts the part together again if all agree, measures and exports. Used by all algorithms whose
// loops live in three dimensions.
//
// Exactness: on exact kernels the fractions are certified enclosures, and exact rationals on
// request, that add up to exactly 1: the class that is measured least is what the others leave.
#ifndef GNOMON_ALGORITHMS_PARTITION_FRAGMENT_SINK_H
#define GNOMON_ALGORITHMS_PARTITION_FRAGMENT_SINK_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "algorithms/partition/fractions.h"
#include "algorithms/partition/fragment_stays.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/piece_class.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/run_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

struct SideFragments {
  std::vector<Fragment> fragments;
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<mpq_class, 3>> exact_points;
  std::vector<std::vector<std::uint32_t>> caster_sets;  // of the fragments
};

/// The result of one side; put one after another they are a LightResult. Many have shares alone,
/// and there is one of each part at a time, so that what few have is kept elsewhere.
struct SideResult {
  PartResult part;
  AreaFractions area;
  std::unique_ptr<ExactFractions> exact;  // if asked for
  std::unique_ptr<SideFragments> cut;     // if there are any

  /// Leaves classes and shares alone.
  void drop_fragments() {
    part.fragment_count = 0;
    cut.reset();
  }
};

/// A side without fragments: all of it is in shadow for that reason.
inline SideResult dark_side(std::uint32_t part, Side side, ShadowReason reason, bool area,
                            bool exactly) {
  SideResult result;
  result.part.part = part;
  result.part.side = side;
  result.part.reason = reason;
  (area ? result.area.umbra : result.part.shadow) = {1, 1};
  if (exactly) {
    result.exact = std::make_unique<ExactFractions>();
    (area ? result.exact->umbra : result.exact->shadow) = 1;
  }
  return result;
}

/// Appends the points of a loop to those that the options ask for; a back side's is reversed, so
/// that it is counter-clockwise seen from that side.
template <VolumeSpaceModel Space, class OutputFragment>
void export_volume_loop(const Space& space, const RunOptions& options,
                        const LoopView<typename Space::Vertex>& loop, bool reversed,
                        OutputFragment& fragment, std::vector<std::array<double, 3>>& points,
                        std::vector<std::array<mpq_class, 3>>& exact_points) {
  fragment.first =
      static_cast<std::uint32_t>(options.output.points ? points.size() : exact_points.size());
  fragment.count = loop.size();
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const auto corner = loop.corner(reversed ? loop.size() - 1 - i : i);
    if (options.output.points) points.push_back(space.nearest_position(corner));
    if (options.output.exact_points) exact_points.push_back(space.exact_position(corner));
  }
}

template <VolumeSpaceModel Space>
class FragmentSink {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  FragmentSink(const PreparedScene& scene, const RunOptions& options, const Rules& rules)
      : scene_(&scene), options_(&options), rules_(&rules) {}

  void begin(std::uint32_t part, Side side, bool area) {
    part_ = part;
    side_ = side;
    area_ = area;
    loops_.clear();
    pieces_.clear();
    sets_.clear();
  }
  void add(const PieceClass& state, const Loop& loop) {
    pieces_.push_back({state, loops_.append(loop)});
  }
  std::size_t size() const { return pieces_.size(); }
  /// Puts the input polygon in the place of pieces that are all alike (1989, sec. 6). `whole`: the
  /// part's own loop.
  void collapse(const Loop& whole) {
    if (!options_->output.merge || pieces_.size() < 2 ||
        !std::all_of(pieces_.begin(), pieces_.end(),
                     [&](const Piece& piece) { return piece.state == pieces_.front().state; })) {
      return;
    }
    pieces_.resize(1);
    pieces_.front().loop = loops_.append(whole);
  }
  /// Calls name(caster, loop) for every piece with a witness. Where it returns parts, they stand in
  /// the witness's place: one, or a set.
  template <class Name>
  void name_witnesses(const Name& name) {
    for (Piece& piece : pieces_) {
      if (piece.state.caster == Fragment::kNoCaster) continue;
      std::vector<std::uint32_t> casters =
          name(piece.state.caster, loops_.view(piece.loop, scene_->parts[part_].plane));
      if (casters.empty()) continue;
      const auto polygon_of = [&](std::uint32_t part) { return scene_->parts[part].polygon; };
      if (std::ranges::all_of(casters, [&](std::uint32_t part) {
            return polygon_of(part) == polygon_of(casters.front());
          })) {
        piece.state.caster = casters.front();
        continue;
      }
      piece.state.caster = Fragment::kNoCaster;
      piece.state.casters = static_cast<std::uint32_t>(sets_.size());
      sets_.push_back(std::move(casters));
    }
  }
  /// `whole`: the part's own loop.
  SideResult finish(const Space& space, const Loop& whole);

 private:
  struct Piece {
    PieceClass state;
    LoopRange loop;
  };
  static Interval rest_of(const Interval& a, const Interval& b) {
    // Each operation rounds by at most half a unit of a number below 2; two units outwards are
    // safe.
    constexpr double kOutwards = 4 * Ball::kUnit;
    return {std::max(0.0, 1 - a.upper - b.upper - kOutwards),
            std::min(1.0, 1 - a.lower - b.lower + kOutwards)};
  }
  void measure(const Space& space, const Loop& whole, SideResult& result) const;

  const PreparedScene* scene_;
  const RunOptions* options_;
  const Rules* rules_;
  std::uint32_t part_ = 0;
  Side side_ = Side::kFront;
  bool area_ = true;
  LoopStore<Vertex> loops_;
  std::vector<Piece> pieces_;
  std::vector<std::vector<std::uint32_t>> sets_;  // of casters
};

template <VolumeSpaceModel Space>
SideResult FragmentSink<Space>::finish(const Space& space, const Loop& whole) {
  SideResult result;
  result.part.part = part_;
  result.part.side = side_;
  collapse(whole);
  if (pieces_.size() > 1) {
    std::erase_if(pieces_, [&](const Piece& piece) {
      return !fragment_stays(space, loops_.view(piece.loop, scene_->parts[part_].plane), *rules_);
    });
  }
  measure(space, whole, result);
  const PlaneId plane = scene_->parts[part_].plane;
  const bool keep = options_->keeps_any_points();
  result.cut = std::make_unique<SideFragments>();
  SideFragments& cut = *result.cut;
  cut.fragments.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    Fragment fragment;
    fragment.state = piece.state.state;
    fragment.reason = piece.state.reason;
    fragment.caster = piece.state.caster;
    fragment.casters = piece.state.casters;
    if (keep) {
      export_volume_loop(space, *options_, loops_.view(piece.loop, plane), side_ == Side::kBack,
                         fragment, cut.points, cut.exact_points);
    }
    cut.fragments.push_back(fragment);
  }
  result.part.fragment_count = static_cast<std::uint32_t>(cut.fragments.size());
  cut.caster_sets = std::move(sets_);
  return result;
}

template <VolumeSpaceModel Space>
void FragmentSink<Space>::measure(const Space& space, const Loop& whole, SideResult& result) const {
  Interval* const interval[] = {&result.part.lit, &result.part.shadow, &result.area.penumbra,
                                &result.area.umbra};
  const bool exactly = options_->output.exact_fractions;
  std::array<mpq_class*, 4> exact{};
  if (exactly) {
    result.exact = std::make_unique<ExactFractions>();
    ExactFractions& fractions = *result.exact;
    exact = {&fractions.lit, &fractions.shadow, &fractions.penumbra, &fractions.umbra};
  }
  std::array<std::size_t, 4> count{};
  for (const Piece& piece : pieces_) ++count[static_cast<std::size_t>(piece.state.state)];
  for (std::size_t state = 0; state < 4; ++state) {
    if (count[state] != pieces_.size() || pieces_.empty()) continue;
    *interval[state] = {1, 1};
    if (exactly) *exact[state] = 1;
    return;
  }
  const PlaneId plane = scene_->parts[part_].plane;
  PartMeasure<Space> part(space, chart_of(space.geometry(), plane), whole, exactly);
  // The class of most pieces is left out on exact kernels.
  std::size_t most = 0;
  for (std::size_t state = 1; state < 4; ++state) {
    if (count[state] > count[most]) most = state;
  }
  std::array<FractionSum, 4> sums;
  for (const Piece& piece : pieces_) {
    const auto state = static_cast<std::size_t>(piece.state.state);
    if (Space::kExact && state == most) continue;
    sums[state].add(part.fraction(loops_.view(piece.loop, plane)));
  }
  Interval others[2];
  std::size_t k = 0;
  mpq_class rest = 1;
  for (std::size_t state = 0; state < 4; ++state) {
    if (count[state] == 0 || (Space::kExact && state == most)) continue;
    *interval[state] = sums[state].interval(Space::kExact);
    if (Space::kExact && k < 2) others[k++] = *interval[state];
    if (exactly) {
      *exact[state] = sums[state].exact();
      rest -= *exact[state];
    }
  }
  if constexpr (Space::kExact) {
    *interval[most] = rest_of(others[0], others[1]);
    if (exactly) *exact[most] = rest;
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_FRAGMENT_SINK_H
