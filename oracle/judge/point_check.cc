// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/point_check.h"

#include <algorithm>
#include <array>

#include "oracle/geometry/group_overlay.h"

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

}  // namespace

namespace {

/// What is true at one point, and why.
struct PointTruth {
  ShadeClass shade = ShadeClass::kShadow;
  bool on_boundary = false, deep = false;
  std::optional<std::uint32_t> caster;
};

PointTruth truth_at(const ExactAnswer& answer, std::uint32_t light, const ReceiverGroup& group,
                    std::uint32_t part, const ExactPoint& place, bool ask_deep,
                    const VisibilityTest* visibility) {
  PointTruth truth;
  if (visibility) {
    if (!group.faces) return truth;
    const PointVisibility seen = visibility->at(part, place);
    truth.shade = seen.visibility == Visibility::kLit ? ShadeClass::kLit : ShadeClass::kShadow;
    truth.on_boundary = seen.visibility == Visibility::kBoundary;
    truth.caster = seen.caster;
    return truth;
  }
  truth.shade = ShadeClass::kUmbra;
  truth.deep = true;
  if (!group.faces) return truth;
  const Side side = group.side == PolygonSide::kFront ? Side::kFront : Side::kBack;
  const AreaPointVisibility seen = answer.area_visibility(light).at(part, side, place, ask_deep);
  truth.shade = seen.shade;
  truth.on_boundary = seen.on_boundary;
  truth.deep = ask_deep && seen.deep();
  truth.caster = seen.caster;
  return truth;
}

}  // namespace

PointCheck check_points(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry,
                        const CandidatePolygon* candidate, const ClaimedTerms& terms,
                        const VisibilityTest* visibility, std::uint32_t count, std::uint64_t seed) {
  const bool area = answer.is_area(light);
  const auto class_of = [&](ShadeClass shade) {
    return area || shade == ShadeClass::kLit ? shade : ShadeClass::kShadow;
  };
  PointCheck result;
  const PreparedScene& prepared = answer.prepared();
  std::uint64_t state = seed ^ (std::uint64_t{entry.polygon} << 32) ^ light;
  for (const ReceiverGroup& group : entry.groups) {
    if (group.optional) continue;
    const Chart chart(support_of(prepared, group.parts.front()));
    std::vector<std::vector<ChartPoint>> fragments;
    std::vector<ShadeClass> shades;
    if (candidate) {
      for (const CandidateFragment& fragment : candidate->fragments) {
        std::vector<ChartPoint> loop;
        for (const ExactPoint& point : fragment.loop) {
          loop.push_back(chart.project(to_grid(prepared.geometry, point)));
        }
        fragments.push_back(std::move(loop));
        shades.push_back(fragment.shade);
      }
    }
    std::vector<ChartPoint> points;
    for (std::uint32_t i = 0; i < count && !fragments.empty(); ++i) {
      const auto& loop = fragments[next_random(state) % fragments.size()];
      if (loop.size() >= 3) points.push_back(inside_of(loop, state));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t part = group.parts[next_random(state) % group.parts.size()];
      std::vector<ChartPoint> loop;
      for (const Integers3& vertex : grid_loop(prepared, part)) loop.push_back(chart.at(vertex));
      points.push_back(inside_of(loop, state));
    }
    for (const ChartPoint& point : points) {
      bool inside = false;
      std::uint32_t around = group.parts.front();
      for (std::uint32_t part : group.parts) {
        std::vector<ChartPoint> loop;
        for (const Integers3& vertex : grid_loop(prepared, part)) loop.push_back(chart.at(vertex));
        if (winds_around(loop, point).value_or(false)) {
          inside = true;
          around = part;
        }
      }
      if (!inside) continue;  // a fragment beyond the polygon; its share inside is asked elsewhere
      std::array<bool, 4> claimed{};
      bool on_border = false;
      for (std::size_t f = 0; f < fragments.size(); ++f) {
        const std::optional<bool> within = winds_around(fragments[f], point);
        on_border = on_border || !within;
        if (within.value_or(false)) claimed[static_cast<std::size_t>(class_of(shades[f]))] = true;
      }
      if (on_border) {
        ++result.on_boundary;
        continue;
      }
      auto classes = std::count(claimed.begin(), claimed.end(), true);
      if (classes == 0 && terms.background) {
        claimed[static_cast<std::size_t>(class_of(*terms.background))] = true;
        classes = 1;
      }
      const ExactPoint place = chart.lift_to_scene(prepared.geometry, point);
      const auto claims = [&](ShadeClass shade) {
        return claimed[static_cast<std::size_t>(shade)];
      };
      const bool ask_deep = !terms.per_caster_umbra && claims(ShadeClass::kUmbra);
      const PointTruth truth = truth_at(answer, light, group, around, place, ask_deep, visibility);
      if (truth.on_boundary) {
        ++result.on_boundary;
        continue;
      }
      ++result.checked;
      const auto accepts = [&](ShadeClass shade) {
        if (shade == truth.shade) return true;
        if (!area || terms.per_caster_umbra) return false;
        return (truth.shade == ShadeClass::kUmbra && shade == ShadeClass::kPenumbra) ||
               (truth.shade == ShadeClass::kPenumbra && shade == ShadeClass::kUmbra && truth.deep);
      };
      // Of several classes one that is wrong.
      std::optional<ShadeClass> found;
      bool wrong = classes != 1, named = false;
      for (const ShadeClass shade :
           {ShadeClass::kLit, ShadeClass::kShadow, ShadeClass::kPenumbra, ShadeClass::kUmbra}) {
        if (!claims(shade) || named) continue;
        found = shade;
        named = !accepts(shade);
        wrong = wrong || named;
      }
      if (!wrong) continue;
      ++result.wrong;
      if (result.worst) continue;
      Witness witness;
      witness.light = answer.scene().lights[prepared.lights[light].light].id;
      witness.polygon = answer.scene().polygons[entry.polygon].id;
      witness.side = entry.side;
      witness.kind = classes > 0 ? ErrorKind::kMisclassified : ErrorKind::kUncovered;
      witness.point = place;
      for (int k = 0; k < 3; ++k) witness.nearest[k] = enclose(place[k]).middle();
      witness.truth = truth.shade;
      witness.found = found;
      if (truth.caster) {
        witness.caster = answer.scene().polygons[prepared.parts[*truth.caster].polygon].id;
      }
      witness.text = std::string(witness.found ? "found " : "nothing found") +
                     (witness.found ? name_of(*witness.found) : "") + ", truly " +
                     name_of(*witness.truth) +
                     (witness.caster.empty() ? "" : " behind '" + witness.caster + "'");
      result.worst = std::move(witness);
    }
  }
  return result;
}

}  // namespace gnomon::oracle
