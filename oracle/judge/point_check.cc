// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/point_check.h"

#include <algorithm>

#include "oracle/geometry/group_overlay.h"
#include "oracle/judge/cells.h"

namespace gnomon::oracle {

namespace {

/// splitmix64: the same points everywhere.
std::uint64_t next_random(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

/// Non-zero winding of any loop around a point; nothing if the point is on the loop.
std::optional<bool> winds_around(const std::vector<ChartPoint>& loop, const ChartPoint& point) {
  int winding = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const ChartPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const int from = compare_y(a, point), to = compare_y(b, point);
    const int side = orientation(a, b, point);
    if (side == 0 && compare(a, point) * compare(point, b) >= 0) return std::nullopt;
    if (from <= 0 && to > 0 && side > 0) ++winding;
    if (from > 0 && to <= 0 && side < 0) --winding;
  }
  return winding != 0;
}

/// A point strictly inside a convex loop: weights of its vertices, all positive.
ChartPoint inside_of(const std::vector<ChartPoint>& loop, std::uint64_t& state) {
  mpq_class x, y, sum;
  for (const ChartPoint& vertex : loop) {
    const mpq_class weight(static_cast<unsigned long>(1 + (next_random(state) >> 44)));
    mpq_class vx(vertex.x, vertex.w), vy(vertex.y, vertex.w);
    vx.canonicalize();
    vy.canonicalize();
    x += weight * vx;
    y += weight * vy;
    sum += weight;
  }
  x /= sum;
  y /= sum;
  const mpz_class w = lcm(x.get_den(), y.get_den());
  ChartPoint point{x.get_num() * (w / x.get_den()), y.get_num() * (w / y.get_den()), w};
  reduce(point);
  return point;
}

/// What is true at one point, and why.
struct PointTruth {
  LightState state = LightState::kShadow;
  bool on_boundary = false, deep = false;
  std::optional<std::uint32_t> caster;
};

PointTruth truth_at(const ExactAnswer& answer, std::uint32_t light, const ReceiverGroup& group,
                    std::uint32_t part, const RationalPoint& place, bool ask_deep,
                    const VisibilityTest* visibility) {
  PointTruth truth;
  if (visibility) {
    if (!group.faces) return truth;
    const PointVisibility seen = visibility->at(part, place);
    truth.state = seen.visibility == Visibility::kLit ? LightState::kLit : LightState::kShadow;
    truth.on_boundary = seen.visibility == Visibility::kBoundary;
    truth.caster = seen.caster;
    return truth;
  }
  truth.state = LightState::kUmbra;
  truth.deep = true;
  if (!group.faces) return truth;
  const AreaPointVisibility seen =
      answer.area_visibility(light).at(part, group.side, place, ask_deep);
  truth.state = seen.state;
  truth.on_boundary = seen.on_boundary;
  truth.deep = ask_deep && seen.deep();
  truth.caster = seen.caster;
  return truth;
}

/// A candidate's fragments in the chart of one receiver.
struct ChartFragments {
  std::vector<std::vector<ChartPoint>> loops;
  std::vector<std::vector<std::vector<ChartPoint>>> holes;  // one list a loop
  std::vector<LightState> states;
  std::vector<std::uint64_t> levels;
};

ChartFragments in_chart(const Chart& chart, const Geometry& geometry,
                        const ClaimedPolygon* candidate) {
  ChartFragments fragments;
  if (candidate == nullptr) return fragments;
  const auto projected = [&](const RationalLoop& points) {
    std::vector<ChartPoint> loop;
    for (const RationalPoint& point : points)
      loop.push_back(chart.project(to_grid(geometry, point)));
    return loop;
  };
  for (const ClaimedFragment& fragment : candidate->fragments) {
    fragments.loops.push_back(projected(fragment.loop));
    auto& holes = fragments.holes.emplace_back();
    for (const RationalLoop& hole : fragment.holes) holes.push_back(projected(hole));
    fragments.states.push_back(fragment.state);
    fragments.levels.push_back(fragment.level);
  }
  return fragments;
}

/// The classes that are claimed at one point.
struct ClaimedStates : Claimed {
  bool on_border = false;  // of a fragment
};

class PointChecker {
 public:
  PointChecker(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry,
               const ClaimedTerms& terms, const VisibilityTest* visibility)
      : answer_(answer),
        prepared_(answer.prepared()),
        light_(light),
        entry_(entry),
        terms_(terms),
        visibility_(visibility),
        area_(answer.is_area(light)) {}

  /// `count` points in fragments of the candidate, and as many in parts of each group.
  PointCheck run(const ClaimedPolygon* candidate, std::uint32_t count, std::uint64_t seed) {
    if (terms_.shares_alone && candidate) {
      // Points tell nothing of a share, but of a side that is said to have one class.
      // Under an area light what is all dark has two classes.
      if (!candidate->share.whole || (area_ && *candidate->share.whole != LightState::kLit)) {
        return {};
      }
      whole_ = candidate->share.whole;
    }
    std::uint64_t state = seed ^ (std::uint64_t{entry_.polygon} << 32) ^ light_;
    for (const ReceiverGroup& group : entry_.groups) {
      if (group.optional) continue;
      const Chart chart(support_of(prepared_, group.parts.front()));
      const ChartFragments fragments = in_chart(chart, prepared_.geometry, candidate);
      for (const ChartPoint& point : points_in(group, chart, fragments, count, state)) {
        check(group, chart, fragments, point);
      }
    }
    return std::move(result_);
  }

 private:
  std::vector<ChartPoint> loop_of(const Chart& chart, std::uint32_t part) const {
    std::vector<ChartPoint> loop;
    for (const Integers3& vertex : grid_loop(prepared_, part)) loop.push_back(chart.at(vertex));
    return loop;
  }

  std::vector<ChartPoint> points_in(const ReceiverGroup& group, const Chart& chart,
                                    const ChartFragments& fragments, std::uint32_t count,
                                    std::uint64_t& state) const {
    std::vector<ChartPoint> points;
    for (std::uint32_t i = 0; i < count && !fragments.loops.empty(); ++i) {
      const auto& loop = fragments.loops[next_random(state) % fragments.loops.size()];
      if (loop.size() >= 3) points.push_back(inside_of(loop, state));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t part = group.parts[next_random(state) % group.parts.size()];
      points.push_back(inside_of(loop_of(chart, part), state));
    }
    return points;
  }

  /// The last part of the group around the point; none if it is beyond the polygon.
  std::optional<std::uint32_t> part_around(const ReceiverGroup& group, const Chart& chart,
                                           const ChartPoint& point) const {
    std::optional<std::uint32_t> around;
    for (std::uint32_t part : group.parts) {
      if (winds_around(loop_of(chart, part), point).value_or(false)) around = part;
    }
    return around;
  }

  /// Whether a fragment holds a point; nothing if it is on its border.
  static std::optional<bool> holds(const ChartFragments& fragments, std::size_t f,
                                   const ChartPoint& point) {
    std::optional<bool> within = winds_around(fragments.loops[f], point);
    for (const std::vector<ChartPoint>& hole : fragments.holes[f]) {
      if (!within || !*within) return within;
      within = winds_around(hole, point);
      if (within) within = !*within;
    }
    return within;
  }

  /// In an overlay the classes of the highest level.
  ClaimedStates claimed_at(const ChartFragments& fragments, const ChartPoint& point) const {
    ClaimedStates states;
    if (whole_) {
      states.loops = 1;
      states.add(*whole_);
      return states;
    }
    std::uint64_t level = 0;
    for (std::size_t f = 0; f < fragments.loops.size(); ++f) {
      const std::optional<bool> within = holds(fragments, f, point);
      states.on_border = states.on_border || !within;
      if (!within.value_or(false)) continue;
      if (terms_.cover == Cover::kOverlay) {
        if (states.loops > 0 && fragments.levels[f] < level) continue;
        if (fragments.levels[f] > level) states.states = {};
        level = fragments.levels[f];
      }
      ++states.loops;
      states.add(class_of(layer_of(fragments.states[f], area_)));
    }
    return states;
  }

  void check(const ReceiverGroup& group, const Chart& chart, const ChartFragments& fragments,
             const ChartPoint& point) {
    const std::optional<std::uint32_t> part = part_around(group, chart, point);
    if (!part) return;  // a fragment beyond the polygon; its share inside is asked elsewhere
    const ClaimedStates states = claimed_at(fragments, point);
    if (states.on_border) {
      ++result_.on_boundary;
      return;
    }
    const Rules rules = rules_of(terms_, area_, group);
    const RationalPoint place = chart.lift_to_scene(prepared_.geometry, point);
    const bool ask_deep =
        !terms_.per_caster_umbra && (states.states[static_cast<std::size_t>(LightState::kUmbra)] ||
                                     rules.may_be_left_out(LightState::kUmbra));
    const PointTruth truth = truth_at(answer_, light_, group, *part, place, ask_deep, visibility_);
    if (truth.on_boundary) {
      ++result_.on_boundary;
      return;
    }
    ++result_.checked;
    Cell cell;
    cell.inside = true;
    cell.truth = truth.state;
    cell.deep = truth.deep;
    compare_claims(cell, states, rules);
    if (!cell.misclassified) return;
    ++result_.wrong;
    if (!result_.worst) result_.worst = witness(wrong_class(cell, rules), truth, place);
  }

  Witness witness(const std::optional<LightState>& found, const PointTruth& truth,
                  const RationalPoint& place) const {
    Witness witness;
    witness.light = answer_.scene().lights[prepared_.lights[light_].light].id;
    witness.polygon = answer_.scene().polygons[entry_.polygon].id;
    witness.side = entry_.side;
    witness.block = terms_.block;
    witness.kind = found ? ErrorKind::kMisclassified : ErrorKind::kUncovered;
    witness.point = place;
    for (int k = 0; k < 3; ++k) witness.nearest[k] = enclose(place[k]).middle();
    witness.truth = truth.state;
    witness.found = found;
    if (truth.caster) {
      witness.caster = answer_.scene().polygons[prepared_.parts[*truth.caster].polygon].id;
    }
    witness.text = std::string(found ? "found " : "nothing found") +
                   (found ? name_of(*found) : "") + ", truly " + name_of(truth.state) +
                   (witness.caster.empty() ? "" : " behind '" + witness.caster + "'");
    return witness;
  }

  const ExactAnswer& answer_;
  const PreparedScene& prepared_;
  std::uint32_t light_;
  const AnswerEntry& entry_;
  const ClaimedTerms& terms_;
  const VisibilityTest* visibility_;
  bool area_;
  std::optional<LightState> whole_;  // claimed of all of the side, without fragments
  PointCheck result_;
};

}  // namespace

PointCheck check_points(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry,
                        const ClaimedPolygon* candidate, const ClaimedTerms& terms,
                        const VisibilityTest* visibility, std::uint32_t count, std::uint64_t seed) {
  return PointChecker(answer, light, entry, terms, visibility).run(candidate, count, seed);
}

}  // namespace gnomon::oracle
