// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/border_proof.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "oracle/geometry/group_overlay.h"
#include "oracle/geometry/plane_frame.h"
#include "oracle/geometry/rounding.h"
#include "oracle/judge/border_fragments.h"
#include "oracle/judge/border_shades.h"
#include "oracle/judge/border_tiling.h"
#include "oracle/judge/claimed_groups.h"

namespace gnomon::oracle {

namespace {

/// Coplanar parts of the side, and what is claimed of them.
struct Plane {
  const ReceiverGroup* group = nullptr;
  PlaneFrame frame;
  std::vector<RationalLoop> part_loops;
  std::vector<const ClaimedFragment*> claimed;
};

RationalLoop loop_of_part(const PreparedScene& prepared, std::uint32_t part) {
  const Geometry& geometry = prepared.geometry;
  RationalLoop loop;
  for (const VertexId vertex : prepared.loop(prepared.parts[part])) {
    RationalPoint& point = loop.emplace_back();
    for (int k = 0; k < 3; ++k) {
      point[k] = geometry.origin[k] + geometry.step * geometry.grid.at(vertex, k);
    }
  }
  return loop;
}

/// The same polygon, from any vertex and either way around.
bool is_same_loop(const RationalLoop& a, const RationalLoop& b) {
  const std::size_t size = a.size();
  if (size == 0 || b.size() != size) return false;
  const auto first = static_cast<std::size_t>(std::ranges::find(b, a[0]) - b.begin());
  if (first == size) return false;
  const auto matches = [&](std::size_t step) {
    for (std::size_t i = 1; i < size; ++i) {
      if (a[i] != b[(first + i * step) % size]) return false;
    }
    return true;
  };
  return matches(1) || matches(size - 1);
}

long double greatest_of(const RationalLoop& loop) {
  long double greatest = 0;
  for (const RationalPoint& point : loop) {
    for (const mpq_class& coordinate : point) {
      greatest = std::max(greatest, std::fabs(nearest(coordinate)));
    }
  }
  return greatest;
}

/// What borders show of one plane.
class PlaneProof {
 public:
  PlaneProof(const ExactAnswer& answer, std::uint32_t light, const Plane& plane,
             const BorderLimits& limits, long double radius)
      : answer_(answer),
        light_(light),
        plane_(plane),
        limits_(limits),
        radius_(radius),
        tiling_(radius),
        classes_(radius) {}

  bool prove();

  long double area() const { return area_; }
  long double perimeter() const { return perimeter_; }
  long double error() const { return error_; }
  long double lit() const { return lit_; }
  /// An upper bound.
  long double off_plane() const { return exact_ ? 0 : off_plane_ + error_; }
  /// Of what is not covered once, and of what has the wrong class besides.
  const ErrorStrips& tiling() const { return tiling_; }
  const ErrorStrips& classes() const { return classes_; }

 private:
  void measure();
  bool read_fragments();
  bool tiles();
  bool are_classes_right();
  void compare_lit(const BorderFragment& fragment, const BorderShade& shade);
  bool is_shadowed(const BorderFragment& fragment, const std::vector<std::uint32_t>& near);
  bool is_shadowed_by(const BorderFragment& fragment, const BorderShade& shade, long double most);
  bool is_shadowed_together(const BorderFragment& fragment, const std::vector<std::uint32_t>& near);
  bool covers_exactly() const;
  /// Both together are within the limits so far.
  bool within() const {
    ErrorStrips all = tiling_;
    all.add(classes_);
    return all.within(limits_.share * area_, limits_.width);
  }
  const std::string& id_of(std::uint32_t part) const {
    return answer_.scene().polygons[answer_.prepared().parts[part].polygon].id;
  }

  const ExactAnswer& answer_;
  std::uint32_t light_;
  const Plane& plane_;
  const BorderLimits& limits_;
  long double radius_;
  long double error_ = 0, area_ = 0, perimeter_ = 0, lit_ = 0, off_plane_ = 0;
  long double snap_ = 0;  // the farthest that a vertex is moved
  bool exact_ = false;    // the fragments are the parts
  std::vector<PlanarLoop> parts_;
  std::vector<BorderFragment> fragments_;
  std::vector<BorderShade> shades_;
  ErrorStrips tiling_, classes_;
};

void PlaneProof::measure() {
  long double greatest = 0;
  for (const RationalLoop& loop : plane_.part_loops) {
    greatest = std::max(greatest, greatest_of(loop));
    PlanarLoop own = plane_.frame.loop_at(loop);
    if (area_of(own) < 0) std::ranges::reverse(own);
    area_ += area_of(own);
    perimeter_ += perimeter_of(own);
    parts_.push_back(std::move(own));
  }
  for (const ClaimedFragment* claimed : plane_.claimed) {
    greatest = std::max(greatest, greatest_of(claimed->loop));
  }
  error_ = kLineError * greatest;
}

bool PlaneProof::read_fragments() {
  long double edges = perimeter_, count = 0;
  for (const ClaimedFragment* claimed : plane_.claimed) {
    if (claimed->loop.empty()) continue;
    if (claimed->state != LightState::kLit && claimed->state != LightState::kShadow) return false;
    for (const RationalPoint& point : claimed->loop) {
      const long double height = std::fabs(plane_.frame.height(point));
      off_plane_ = std::max(off_plane_, height);
    }
    PlanarLoop loop = plane_.frame.loop_at(claimed->loop);
    if (!is_finite(loop)) return false;
    fragments_.push_back(border_fragment(*claimed, std::move(loop)));
    edges += perimeter_of(fragments_.back().loop);
    count += static_cast<long double>(claimed->loop.size());
  }
  // A quarter of what the limits leave to each edge.
  snap_ = std::min(limits_.share * area_ / (8 * edges), limits_.width / (8 * count));
  snap_ = std::max({snap_, radius_, 64 * error_});
  return !(off_plane_ + error_ > limits_.width) || off_plane_ + error_ <= radius_;
}

bool PlaneProof::tiles() {
  const auto attempt = [&](long double snap) {
    ErrorStrips strips(radius_);
    std::vector<TilingLoop> loops;
    for (const PlanarLoop& part : parts_) loops.push_back({&part, -1, 0});
    for (const BorderFragment& fragment : fragments_) {
      if (fragment.regular && fragment.slack <= snap) {
        loops.push_back({&fragment.loop, 1, fragment.slack});
        continue;
      }
      if (!(fragment.thickness <= snap)) return false;
      const long double width = fragment.thickness + 2 * error_;
      strips.add(width, fragment.length + 2 * width, width);
    }
    if (!cancel(loops, snap, error_, strips)) return false;
    tiling_ = strips;
    return true;
  };
  // What rounding alone moves first: it makes fewer vertices one.
  const long double near = std::max(8 * radius_, 64 * error_);
  return (near < snap_ && attempt(near)) || attempt(snap_);
}

/// A lit fragment and a shadow are apart but for a strip along an edge of one of them.
void PlaneProof::compare_lit(const BorderFragment& fragment, const BorderShade& shade) {
  long double depth = std::numeric_limits<long double>::infinity();
  const PlanarLine* along = nullptr;
  const auto take = [&](const PlanarLine& line, long double own) {
    if (own < depth) {
      depth = own;
      along = &line;
    }
  };
  for (const PlanarLine& line : shade.lines) {
    take(line, extent_of(fragment.loop, line).high + error_);
    if (depth <= 0) return;
  }
  for (const PlanarLine& line : fragment.lines) {
    take(line, extent_of(shade.region, line).high + fragment.slack + error_);
    if (depth <= 0) return;
  }
  const long double length =
      along ? std::min(length_along(fragment.loop, *along), length_along(shade.region, *along))
            : fragment.length;
  if (!along) depth = fragment.length + 2 * error_;
  classes_.add(depth, length + 2 * error_ + 2 * depth, depth + fragment.slack + 2 * error_);
}

bool PlaneProof::is_shadowed_by(const BorderFragment& fragment, const BorderShade& shade,
                                long double most) {
  ErrorStrips strips(radius_);
  for (const PlanarLine& line : shade.lines) {
    const long double depth = error_ - extent_of(fragment.loop, line).low;
    if (depth <= 0) continue;
    if (depth > most) return false;
    strips.add(depth, length_along(fragment.loop, line) + 2 * error_,
               depth + fragment.slack + 2 * error_);
  }
  classes_.add(strips);
  return true;
}

/// What no shadow holds, each widened by a strip along its edges, is nothing.
bool PlaneProof::is_shadowed_together(const BorderFragment& fragment,
                                      const std::vector<std::uint32_t>& near) {
  const long double widened = 8 * error_;
  std::vector<PlanarLoop> left{fragment.loop};
  ErrorStrips strips(radius_);
  constexpr std::size_t kMostPieces = 200;
  for (const std::uint32_t index : near) {
    std::vector<PlanarLine> lines = shades_[index].lines;
    for (PlanarLine& line : lines) line = line.grown(widened);
    left = without(std::move(left), lines);
    for (const PlanarLine& line : shades_[index].lines) {
      const Extent extent = extent_of(fragment.loop, line);
      if (extent.low > error_ || extent.high < -widened - error_) continue;
      strips.add(widened + 2 * error_, length_along(fragment.loop, line) + 2 * error_,
                 std::numeric_limits<long double>::infinity());
    }
    if (left.size() > kMostPieces) return false;
    if (left.empty()) break;
  }
  // Of what is left each piece is a strip.
  for (const PlanarLoop& piece : left) {
    const BorderFragment own = border_fragment(*fragment.claimed, piece);
    if (!(own.thickness <= snap_)) return false;
    const long double width = own.thickness + 2 * widened;
    strips.add(width, own.length + 2 * width, std::numeric_limits<long double>::infinity());
  }
  classes_.add(strips);
  return true;
}

bool PlaneProof::is_shadowed(const BorderFragment& fragment,
                             const std::vector<std::uint32_t>& near) {
  // The caster that is named is looked at first; it is a hint, no more.
  for (const bool named : {true, false}) {
    for (const long double most : {error_, snap_}) {
      for (const std::uint32_t index : near) {
        const BorderShade& shade = shades_[index];
        if (named != (id_of(shade.caster) == fragment.claimed->caster)) continue;
        if (is_shadowed_by(fragment, shade, most)) return true;
      }
    }
  }
  return is_shadowed_together(fragment, near);
}

bool PlaneProof::are_classes_right() {
  if (!plane_.group->faces) {
    return std::ranges::all_of(fragments_, [&](const BorderFragment& fragment) {
      return fragment.claimed->state == LightState::kShadow || fragment.thickness <= error_;
    });
  }
  PlanarLoop all;
  for (const PlanarLoop& part : parts_) all.insert(all.end(), part.begin(), part.end());
  shades_ = border_shades(answer_, light_, *plane_.group, plane_.frame, box_of(all), error_);
  std::vector<PlanarBox> boxes;
  for (const BorderFragment& fragment : fragments_) boxes.push_back(box_of(fragment.loop));
  const std::vector<std::vector<std::uint32_t>> near = shades_near(boxes, shades_);
  for (std::size_t f = 0; f < fragments_.size(); ++f) {
    const BorderFragment& fragment = fragments_[f];
    if (fragment.loop.size() < 3) continue;  // all of it is in a strip already
    if (fragment.claimed->state == LightState::kLit) {
      lit_ += area_of(fragment.loop);
      for (const std::uint32_t index : near[f]) compare_lit(fragment, shades_[index]);
    } else if (!is_shadowed(fragment, near[f])) {
      return false;
    }
    if (!within()) return false;
  }
  return true;
}

/// The fragments are the parts, exactly.
bool PlaneProof::covers_exactly() const {
  constexpr std::size_t kMostParts = 64;  // each is compared with each
  if (plane_.claimed.size() != plane_.part_loops.size() || plane_.claimed.size() > kMostParts ||
      !std::ranges::all_of(fragments_, &BorderFragment::regular)) {
    return false;
  }
  std::vector<bool> found(plane_.part_loops.size(), false);
  for (const ClaimedFragment* claimed : plane_.claimed) {
    std::size_t part = 0;
    while (part < found.size() &&
           (found[part] || !is_same_loop(claimed->loop, plane_.part_loops[part]))) {
      ++part;
    }
    if (part == found.size()) return false;
    found[part] = true;
  }
  return true;
}

bool PlaneProof::prove() {
  measure();
  // Where coordinates tell little of the area, bounds of shares tell nothing.
  constexpr long double kClear = 64;
  if (!(area_ > kClear * error_ * perimeter_) || !std::isfinite(area_)) return false;
  if (!read_fragments()) return false;
  exact_ = covers_exactly();
  // Whether exact loops are all right has to be told, and strips do not tell it.
  if (!exact_ && !(radius_ > 0)) return false;
  if (!exact_ && (!tiles() || !within())) return false;
  return are_classes_right() && within();
}

/// Bounds of a share of error from strips on several planes.
AreaShare share_of_error(long double error, long double whole) {
  AreaShare share;
  share.zero = error == 0;
  if (share.zero) {
    share.exact = 0;
    return share;
  }
  share.fraction = {0, round_up(static_cast<double>(error / whole))};
  share.area = {0, round_up(static_cast<double>(error))};
  return share;
}

/// A share that is off by at most `error`, of `whole` that is off by at most `uncertain`.
AreaShare share_of_class(long double area, long double error, long double whole,
                         long double uncertain) {
  AreaShare share;
  const long double low = std::max(area - error, 0.0L);
  const long double high = std::min(area + error, whole + uncertain);
  share.area = {std::max(0.0, round_down(static_cast<double>(low))),
                round_up(static_cast<double>(high))};
  share.fraction = {std::max(0.0, round_down(static_cast<double>(low / (whole + uncertain)))),
                    std::min(1.0, round_up(static_cast<double>(high / (whole - uncertain))))};
  share.zero = high <= 0;
  return share;
}

/// Sums over the planes of one side.
class SideProof {
 public:
  explicit SideProof(long double radius) : tiling_(radius), all_(radius), radius_(radius) {}

  void add(const PlaneProof& plane);
  void tell(PolygonComparison& result) const;

 private:
  ErrorStrips tiling_, all_;
  long double radius_;
  long double area_ = 0, uncertain_ = 0, lit_ = 0, off_plane_ = 0, width_ = 0;
};

void SideProof::add(const PlaneProof& plane) {
  ErrorStrips own = plane.tiling();
  own.add(plane.classes());
  tiling_.add(plane.tiling());
  all_.add(own);
  area_ += plane.area();
  uncertain_ += 4 * plane.error() * plane.perimeter() + 0x1p-55L * plane.area();
  lit_ += plane.lit();
  off_plane_ = std::max(off_plane_, plane.off_plane());
  width_ = std::max(width_, own.width());  // regions on different planes do not meet
}

void SideProof::tell(PolygonComparison& result) const {
  const long double error = all_.area();
  result.lit = share_of_class(lit_, error + uncertain_, area_, uncertain_);
  result.shadow = share_of_class(area_ - lit_, error + 2 * uncertain_, area_, uncertain_);
  result.misclassified = share_of_error(error, area_ - uncertain_);
  result.uncovered = result.overlapping = result.outside =
      share_of_error(tiling_.area(), area_ - uncertain_);
  const auto scene_units = [](long double upper) {
    return upper > 0 ? Enclosure{0, round_up(static_cast<double>(upper))} : Enclosure{};
  };
  result.width = scene_units(width_);
  result.off_plane = scene_units(off_plane_);
  if (!(off_plane_ <= radius_)) result.judged_off_plane = result.off_plane;
  for (AreaShare* none :
       {&result.penumbra, &result.umbra, &result.missing_umbra, &result.ill_conditioned}) {
    none->exact = 0;
  }
  if (all_.empty()) {
    result.rounding.exact = 0;
  } else if (all_.excused()) {
    result.rounding = result.misclassified;
  } else {
    result.judged_misclassified = result.misclassified;
    result.judged_uncovered = result.uncovered;
    result.judged_overlapping = result.overlapping;
    result.judged_outside = result.outside;
    result.judged_width = result.width;
  }
}

/// Fragments by their planes.
void assign(const ExactAnswer& answer, const AnswerEntry& entry, const ClaimedPolygon& candidate,
            double radius, std::vector<Plane>& planes) {
  if (planes.size() == 1) {
    for (const ClaimedFragment& fragment : candidate.fragments) {
      planes[0].claimed.push_back(&fragment);
    }
    return;
  }
  const PreparedScene& prepared = answer.prepared();
  std::vector<Chart> charts;
  for (const ClaimedFragment& fragment : candidate.fragments) {
    if (fragment.loop.empty()) continue;
    const long double error = kLineError * greatest_of(fragment.loop);
    // The comparison's own rule, which rounds less: where the distances leave no doubt they agree.
    const long double near = static_cast<long double>(nearly_as_near(prepared, fragment, radius)) *
                             nearest(prepared.geometry.step);
    std::vector<long double> distances;
    for (const Plane& plane : planes) {
      long double most = 0;
      for (const RationalPoint& point : fragment.loop) {
        most = std::max(most, std::fabs(plane.frame.height(point)));
      }
      distances.push_back(most);
    }
    auto best = static_cast<std::size_t>(std::ranges::min_element(distances) - distances.begin());
    const long double doubtful = 1.01L * (distances[best] + near) + 4 * error;
    if (std::ranges::count_if(distances, [&](long double d) { return d <= doubtful; }) > 1) {
      if (charts.empty()) {
        for (const ReceiverGroup& group : entry.groups) {
          charts.emplace_back(support_of(prepared, group.parts.front()));
        }
      }
      best = group_for(answer, entry, charts, fragment, radius);
    }
    planes[best].claimed.push_back(&fragment);
  }
}

}  // namespace

std::optional<PolygonComparison> prove_by_borders(const ExactAnswer& answer, std::uint32_t light,
                                                  const AnswerEntry& entry,
                                                  const ClaimedPolygon* candidate,
                                                  const ClaimedTerms& terms,
                                                  const BorderLimits& limits) {
  if (answer.is_area(light) || terms.shares_alone || terms.cover != Cover::kPartition ||
      terms.background || terms.listed || terms.block != Block::kLights) {
    return std::nullopt;
  }
  if (!candidate || !candidate->told.empty() || candidate->fragments.empty()) return std::nullopt;
  const auto is_exact = [](const ClaimedFragment& fragment) { return fragment.exact; };
  if (std::ranges::any_of(candidate->fragments,
                          [](const auto& fragment) { return !fragment.holes.empty(); })) {
    return std::nullopt;
  }
  const PreparedScene& prepared = answer.prepared();
  PolygonComparison result;
  result.polygon = answer.scene().polygons[entry.polygon].id;
  result.side = entry.side;
  result.fragments = candidate->fragments.size();
  result.by_borders = true;
  if (!std::ranges::all_of(candidate->fragments, is_exact)) {
    result.rounding_radius =
        static_cast<double>(rounding_radius(answer.scene(), prepared, entry.polygon));
  }
  std::vector<Plane> planes;
  for (const ReceiverGroup& group : entry.groups) {
    planes.push_back(
        {&group, PlaneFrame(prepared.geometry, grid_loop(prepared, group.parts.front())), {}, {}});
    for (const std::uint32_t part : group.parts) {
      planes.back().part_loops.push_back(loop_of_part(prepared, part));
    }
  }
  assign(answer, entry, *candidate, result.rounding_radius, planes);
  SideProof side(result.rounding_radius);
  for (const Plane& plane : planes) {
    if (plane.group->optional || !plane.group->tiling) {
      if (!plane.claimed.empty()) return std::nullopt;
      continue;
    }
    PlaneProof own(answer, light, plane, limits, result.rounding_radius);
    if (!own.prove()) return std::nullopt;
    side.add(own);
  }
  side.tell(result);
  return result;
}

}  // namespace gnomon::oracle
