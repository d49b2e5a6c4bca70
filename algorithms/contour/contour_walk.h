// SPDX-License-Identifier: LGPL-3.0-or-later
// One polygon of the contour method: along each of its edges, where it is seen from the light, and
// on what lies behind it its edge casts a shadow's border.
//
// Binding rule (docs/contour.md): on a line of an edge each side h has the polygons that cover it
// there, each with a key, (depth, slope into h). Seen on h is what has a key not below that of the
// greatest caster. What is seen on one side only gets the boundary integral of the line there,
// once. Taken edge by edge of a polygon O, with its inner and outer side:
//  own     O gets the integral where no caster has a greater key on the inner side;
//  acting  there, if O casts, it is taken from every polygon that covers both sides, lies below
//          O on the inner side, and is seen on the outer one: those of the plane of the first
//          caster behind, and those before it that cast none. Of several casters of one plane with
//          an edge on this line and the same inner side the one of the smallest number acts; none
//          does where a caster of O's plane goes on across the line.
//  crease  where another caster B passes through O, O gets the integral of the line in which they
//          meet, where it is not hidden on the side on which it is nearer than B.
//
// Certified numbers: which intervals there are, and who is nearer there, is exact (edge_survey.h).
// Where two places on an edge cannot be told apart there may be a sliver between them: it is
// counted into the bounds of all shares that it can change, and as "perhaps" for their classes.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_WALK_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_WALK_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/contour/contour_sums.h"
#include "algorithms/contour/edge_lists.h"
#include "algorithms/contour/edge_survey.h"
#include "algorithms/partition/rules.h"

namespace gnomon {

/// What a polygon's share is measured by: boundary integrals around its corner 0, and the sum of
/// those of its own edges.
template <class Numbers>
struct ContourMeasure {
  using T = typename Numbers::T;
  std::vector<T> scale;                // by polygon: 1 / the sum over its whole border
  std::vector<double> relative_error;  // certified: of scale; infinite: nothing is known
};

template <class Numbers, class Sides>
class ContourWalk {
 public:
  using T = typename Numbers::T;
  using Survey = EdgeSurvey<Numbers, Sides>;

  ContourWalk(const LightRays<Numbers>& light, const FacingPolygons<Numbers>& polygons,
              const ContourMeasure<Numbers>& measure, std::span<const std::uint8_t> dark,
              const Rules& rules, Sides& sides, const Lanes& lanes,
              std::span<ContourSum<Numbers>> sums)
      : light_(&light),
        polygons_(&polygons),
        measure_(&measure),
        dark_(dark),
        rules_(rules),
        survey_(light, polygons, sides, lanes),
        sums_(sums) {}

  /// Adds what polygon p gets by its own edges and takes from those behind it. `neighbours`: all
  /// polygons that may overlap it as seen from the light.
  void walk(std::uint32_t p, std::span<const std::uint32_t> neighbours);

  std::uint64_t intervals() const { return intervals_; }
  std::uint64_t segments() const { return segments_; }
  /// Decisions that numbers made; the kernel counts its own.
  std::uint64_t filtered() const { return survey_.filtered(); }

 private:
  using PlaceOnEdge = Place<Numbers>;
  /// A sliver that may be there is as large as its bound says: what is above this is open.
  static constexpr double kLeast = 16 * Ball::kUnit;
  /// The bound of a depth between the ends of an edge, in units of that at the ends: there is
  /// rounded by 3u of the greater one, at most 9u M R (ContourBounds::kDepth is some more than what
  /// it bounds).
  static constexpr double kDepthBetween = 1.3;
  bool is_sharp(const PlaceOnEdge& low, const PlaceOnEdge& high, double error) const {
    const bool named =
        low.name.kind() != PlaceName::Kind::kNone && high.name.kind() != PlaceName::Kind::kNone;
    return error <= (named ? light_->rough() : 2 * kLeast);
  }
  static constexpr std::uint32_t kSegment = 0xffffffffu;
  /// A polygon behind a segment begins or ends, or the segment itself.
  struct Event {
    PlaceOnEdge place;
    std::uint32_t entry = 0;  // of lists_[k].behind, or kSegment
    bool begins = false;
  };
  /// A place in a pair of doubles.
  struct SharpestPlace {
    DoubleDouble t;
    double error = 0;
  };
  /// From one place to another: where the first is, how far it is to the last, which is off by the
  /// errors of the two and u of itself.
  struct SharpStretch {
    double first = 0, width = 0, first_error = 0, last_error = 0;
  };
  /// Events up to `end` of events_, from one place to another; open if they are not in one place.
  struct EventGroup {
    PlaceOnEdge low, high;
    std::size_t end = 0;
    bool is_open = false;
  };

  // Filling of lists_.
  void find_silent_edges();
  void find_beside(std::uint32_t k);
  void meet(std::uint32_t q);
  void find_order(std::uint32_t q);
  void meet_block(std::uint32_t q);
  void meet_outside(std::uint32_t q);
  void meet_on_edge(std::uint32_t k, std::uint32_t q, const LineThrough& through);
  void meet_in_plane(EdgeLists<Numbers>& lists, std::uint32_t q, LineCover cover,
                     const Behind<Numbers>& entry);
  void meet_level(EdgeLists<Numbers>& lists, std::uint32_t k, std::uint32_t q, LineCover cover,
                  const Behind<Numbers>& entry);
  int nearer_beside(std::uint32_t q);
  int nearer_corner(std::uint32_t q, std::uint32_t j);
  bool find_interval(std::uint32_t k, std::uint32_t q, const LineThrough& through,
                     Stretch<Numbers>& stretch) {
    if constexpr (Survey::kInBlocks) {
      if (in_block_) return survey_.interval_in_block(p_, k, q, through, stretch);
    }
    return survey_.interval(p_, k, q, through, stretch);
  }
  void hide(std::uint32_t k, const Stretch<Numbers>& stretch);
  void put(EdgeLists<Numbers>& lists, LineCover cover, bool other_above, bool casts,
           const Behind<Numbers>& entry);
  // Creases.
  void crease(std::uint32_t q);
  bool find_crease(std::uint32_t q, Crease<Numbers>& crease);
  void hide_crease(const Crease<Numbers>& crease, std::uint32_t other, bool& open);

  // One edge.
  void walk_edge(std::uint32_t k);
  void act_level(std::uint32_t k, const Behind<Numbers>& receiver);
  bool is_above_outside(std::uint32_t k, std::uint32_t q, std::uint32_t than);
  void act_along(std::uint32_t k, const Segment<Numbers>& segment);
  void find_events(std::uint32_t k, const Segment<Numbers>& segment);
  EventGroup group_of_events(std::size_t begin) const;
  void go_to(std::uint32_t k, PlaceOnEdge at, const PlaceOnEdge& next);
  bool piece(std::uint32_t k, const PlaceOnEdge& low, PlaceOnEdge& high);
  int depth_order(const Behind<Numbers>& a, const Behind<Numbers>& b,
                  const PlaceOnEdge& place) const;
  /// 1 if all of a is nearer than all of b, -1 if it is behind it.
  int range_order(std::uint32_t a, std::uint32_t b) const {
    const DepthRange of_a = polygons_->polygons[a].depth, of_b = polygons_->polygons[b].depth;
    if (of_a.low > of_b.high) return 1;
    return of_a.high < of_b.low ? -1 : 0;
  }
  const Behind<Numbers>* find_top(std::uint32_t k, const PlaceOnEdge& low, const PlaceOnEdge& high);
  int order_just_after(std::uint32_t k, const Behind<Numbers>& a, const Behind<Numbers>& b,
                       const PlaceOnEdge& low, const PlaceOnEdge& high);
  int level_order(std::uint32_t k, std::uint32_t a, std::uint32_t b);
  int known_order(std::uint32_t a, std::uint32_t b);
  PlaceOnEdge passing(const Behind<Numbers>& a, const Behind<Numbers>& b, const PlaceOnEdge& low,
                      const PlaceOnEdge& high) const;
  void end_where_order_changes(const Behind<Numbers>& entry, const Behind<Numbers>& top,
                               const PlaceOnEdge& low, PlaceOnEdge& high);
  bool is_behind(std::uint32_t k, const Behind<Numbers>& entry, const Behind<Numbers>& top,
                 const PlaceOnEdge& low, const PlaceOnEdge& high);
  void perhaps_at(std::uint32_t k, const PlaceOnEdge& low, const PlaceOnEdge& high);

  // Sums.
  T value_of(std::uint32_t k, std::uint32_t q, double& error) const;
  /// Of a lamp: n / h of a receiver at two places of an edge, what each is off by, and how much it
  /// changes from one end of the edge to the other.
  struct Quotients {
    T low{}, high{};
    double error = 0;
    T change{};
  };
  Quotients quotients(std::uint32_t k, const Behind<Numbers>& receiver, const PlaceOnEdge& low,
                      const PlaceOnEdge& high) const;
  void add_own(std::uint32_t k, const Segment<Numbers>& segment);
  double share_error(std::uint32_t q, double rate, double line_value_error, const PlaceOnEdge& low,
                     const PlaceOnEdge& high, double depth_low, double depth_high,
                     double depth_error, double depth_rate) const;
  void take_from(std::uint32_t k, const Behind<Numbers>& receiver, const PlaceOnEdge& low,
                 const PlaceOnEdge& high);
  void take_perhaps(std::uint32_t k, const Behind<Numbers>& receiver, const PlaceOnEdge& low,
                    const PlaceOnEdge& high);
  PlaceOnEdge sharpened(std::uint32_t k, const PlaceOnEdge& place, double most) const;
  SharpestPlace sharpest(std::uint32_t k, const PlaceOnEdge& place) const;
  void sharpen(std::uint32_t k, const Behind<Numbers>* receiver, const PlaceOnEdge& low,
               const PlaceOnEdge& high, bool perhaps, double& share, double& error) const;
  void integrate_sharp(std::uint32_t k, const Behind<Numbers>* receiver, SharpStretch stretch,
                       bool perhaps, double& share, double& error) const;
  static T depth_at(const Behind<Numbers>& entry, const PlaceOnEdge& place) {
    return T(entry.depth_from + place.t * T(entry.depth_to - entry.depth_from));
  }
  bool casts(std::uint32_t q) const { return polygons_->polygons[q].casts; }
  PlaneId plane(std::uint32_t q) const { return polygons_->polygons[q].plane; }

  const LightRays<Numbers>* light_;
  const FacingPolygons<Numbers>* polygons_;
  const ContourMeasure<Numbers>* measure_;
  std::span<const std::uint8_t> dark_;  // polygons that need not be met
  const Rules& rules_;
  Survey survey_;
  std::span<ContourSum<Numbers>> sums_;
  std::uint32_t p_ = 0;                    // the polygon
  std::vector<EdgeLists<Numbers>> lists_;  // of its edges
  // Of its edges: whether it casts nothing on what is strictly below it, since it is not a
  // caster's, or another caster goes on from it.
  std::vector<std::uint8_t> silent_;
  bool all_edges_silent_ = false;
  // Bit 4 k: of edge k < 4, whether it is silent, and whether it is hidden from end to end.
  unsigned silent_edges_ = 0, hidden_edges_ = 0;
  bool in_block_ = false;  // the polygon that is met: survey_ has the values of its lines
  CornerSet nearer_;       // corners of p_ against it
  int order_ = 0;          // of the polygon that is met: 1: all of it is behind p_, -1: before it
  std::vector<Segment<Numbers>> seen_, free_;
  std::vector<Stretch<Numbers>> covers_;
  std::vector<Event> events_;          // along a segment
  std::vector<std::uint32_t> active_;  // of lists_[k].behind
  std::span<const std::uint32_t> neighbours_;
  std::uint64_t intervals_ = 0, segments_ = 0;
};

}  // namespace gnomon

#include "algorithms/contour/contour_acts.h"
#include "algorithms/contour/contour_crease.h"
#include "algorithms/contour/contour_integrals.h"
#include "algorithms/contour/contour_meets.h"
#include "algorithms/contour/contour_sharpen.h"

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_WALK_H
