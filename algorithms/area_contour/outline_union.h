// SPDX-License-Identifier: LGPL-3.0-or-later
// How much of a convex receiver the union of convex outlines covers, without a piece: each edge of
// an outline less what other outlines hold of it, each edge of the receiver less what outlines hold
// of it, and the boundary integral of what is left.
//
// Everything lies in a chart of the receiver, in doubles with bounds. Of each edge two lengths are
// found: what certainly is not covered, and what perhaps is not. The true integral lies between
// those of the two. Where the bounds leave open whether there is something between two places, or
// whether two lines are one, integers tell (ExactLines).
//
// Edges on one line: where two outlines lie on one side of it, the one of the smaller number acts;
// where they lie on different sides, each hides the other's edge.
//
// Guarantee: `covered` is within `error` of the share of the receiver that the union covers, and
// `hidden` is said only where it covers all but a part of zero area. Proof: README.md.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_UNION_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_UNION_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/area_contour/receiver_chart.h"
#include "gnomon/kernel/sign.h"
#include "kernel/signs/ball.h"

namespace gnomon::area_contour {

/// Of the unit roundings of a computation on an edge, in units of ReceiverChart::reach.
inline constexpr double kSlack = 0x1p-47;

/// Exact answers about lines of a receiver.
class ExactLines {
 public:
  virtual ~ExactLines() = default;
  /// Whether two lines are one.
  virtual bool is_same(const OutlineLine& a, const OutlineLine& b) = 0;
  /// On which side of `line` is the point where two others meet. Requires: they cross.
  virtual Side side_of_meet(const OutlineLine& line, const OutlineLine& a,
                            const OutlineLine& b) = 0;
  /// The same for the point where a line meets the receiver's edge that follows that corner.
  /// Requires: it crosses it.
  virtual Side side_at_border(const OutlineLine& line, const OutlineLine& a,
                              std::uint32_t corner) = 0;
  /// Where another line meets a line, sharply: along the direction (b, -a) of that, as seen from
  /// the chart's origin. Requires: they cross.
  virtual Ball place_on(const OutlineLine& line, const OutlineLine& by) = 0;
};

struct UnionShare {
  double covered = 0, error = 0;  // of the receiver's area
  bool hidden = false;            // all of it is covered
};

class OutlineUnion {
 public:
  void begin(const ReceiverChart& receiver, ExactLines& exact);
  /// Adds a convex outline. Each line must have corners on both sides.
  void add(std::span<const OutlineLine> lines);
  std::size_t size() const { return outlines_.size(); }

  /// Of all outlines that were added since begin(). Where doubles leave more than a choice of
  /// error, places where seen stretches end are found again from integers. Requires: at least one.
  UnionShare share();

 private:
  static constexpr std::uint32_t kNoLine = 0xffffffffu;
  /// Where a stretch of a line begins or ends: the place lies between the two values; seen from
  /// inside the stretch, `outer` is beyond `inner`.
  struct End {
    double inner = 0, outer = 0;
    std::uint32_t line = kNoLine;   // which makes the place, if that is known
    std::uint32_t other = kNoLine;  // or this one, whichever is farther inside
    bool begins = false;            // a stretch: of two places the greater one is meant

    bool is_known() const { return line != kNoLine && other == kNoLine; }
  };
  struct Stretch {
    End low, high;
    bool is_certain = true;  // false: perhaps none of it is covered
    bool may_be() const { return low.outer < high.outer; }
    bool certainly_is() const { return is_certain && low.inner < high.inner; }
  };
  /// What stretches are of: a line, or an edge of the receiver.
  struct Carrier {
    std::uint32_t line = kNoLine, corner = 0;
  };
  struct Box {
    double low[2], high[2];
    bool meets(const Box& other) const {
      return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
             other.low[1] <= high[1];
    }
  };
  struct Outline {
    std::uint32_t first = 0, count = 0;  // of lines_
    Box box;
  };
  /// An edge of an outline: what its own lines and the receiver leave of a line.
  struct Edge {
    std::uint32_t line = 0, outline = 0;
    Stretch stretch;
    Box box;
  };
  /// Of an edge what lies in a cell, between two places.
  struct Part {
    std::uint32_t edge = 0;
    double from = 0, to = 0;
  };
  struct Lengths {
    double certain = 0, perhaps = 0;
  };
  /// What lies between two places, the first of which ends a cover or begins the stretch.
  struct Gap {
    End before, after;
  };
  struct Trim;
  /// A rectangle of the chart: ranges of cell_outlines_, those that may meet it, and cell_edges_,
  /// the stretches of edges in it.
  struct Cell {
    Box box;
    std::uint32_t first_outline = 0, end_outline = 0, first_edge = 0, end_edge = 0;
    int depth = 0, in_vain = 0;
  };

  Stretch in_receiver(const OutlineLine& line) const;
  bool trim(std::uint32_t own, std::uint32_t by, Trim& trim) const;
  bool cut_by_own(const Outline& outline, std::uint32_t line, Stretch& stretch);
  bool cover(const Edge& edge, std::uint32_t other, Stretch& stretch) const;
  bool hides(const Edge& edge, std::uint32_t other);
  bool cover_border(std::uint32_t corner, const Outline& outline, Stretch& stretch) const;
  bool is_one(std::uint32_t a, std::uint32_t b) const;
  bool has_gap(const Carrier& carrier, const End& before, const End& after, bool is_end) const;
  Lengths rest_of(const Carrier& carrier, const Stretch& stretch);
  static End outside(const End& end);
  void find_certain(const Stretch& stretch, Lengths& rest);
  void find_perhaps(const Carrier& carrier, const Stretch& stretch, Lengths& rest);
  void sharpen(const Carrier& carrier, Lengths& rest);
  UnionShare integrate();
  void add_integral(double height, double height_error, const Lengths& lengths);
  void add_borders();
  void add_edge(const Edge& edge, std::span<const std::uint32_t> others);
  void add_cells();
  bool is_held(const Cell& cell) const;
  bool halve(const Cell& cell, std::vector<Cell>& cells);
  void divide(const Part& part, int axis, double at);
  Edge edge_of(const Part& part) const;
  Box box_of(const OutlineLine& line, double from, double to) const;

  const ReceiverChart* receiver_ = nullptr;
  ExactLines* exact_ = nullptr;
  double slack_ = 0, margin_ = 0;  // of places in a cell
  std::vector<OutlineLine> lines_;
  std::vector<Outline> outlines_;
  std::vector<Edge> edges_;
  std::vector<Stretch> covers_;  // of the edge at hand
  std::vector<std::uint32_t> cell_outlines_, high_outlines_;
  std::vector<Part> cell_edges_, low_edges_, high_edges_;
  std::vector<double> ends_, sizes_;
  std::uint32_t last_hider_ = 0;  // the outline that hid the last edge that was hidden
  std::vector<Gap> certain_gaps_, perhaps_gaps_;  // of the stretch at hand
  bool is_sharp_ = false;
  double sum_ = 0, error_ = 0;  // twice the covered area
  bool is_flat_ = false;        // the outline at hand has no area
  bool some_left_ = false;      // something is perhaps not covered
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_UNION_H
