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
#include <limits>
#include <span>
#include <vector>

#include "algorithms/area_contour/chunked_list.h"
#include "algorithms/area_contour/exact_lines.h"
#include "algorithms/area_contour/largest_first.h"
#include "algorithms/area_contour/receiver_chart.h"
#include "gnomon/kernel/sign.h"
#include "kernel/signs/ball.h"

namespace gnomon::area_contour {

/// Of the unit roundings of a computation on an edge, in units of ReceiverChart::reach.
inline constexpr double kSlack = 0x1p-47;

struct UnionShare {
  double covered = 0, error = 0;  // of the receiver's area
  bool hidden = false;            // all of it is covered
  bool some = false;              // something certainly is; the union itself does not say so
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
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  /// Where a stretch of a line begins or ends: the place lies between the two values; seen from
  /// inside the stretch, `outer` is beyond `inner`.
  struct End {
    double inner = 0, outer = 0;
    std::uint32_t line = kNoLine;   // which makes the place, if that is known
    std::uint32_t other = kNoLine;  // or this one, whichever is farther inside

    bool is_known() const { return line != kNoLine && other == kNoLine; }
  };
  struct Stretch {
    End low, high;
    bool is_certain = true;  // false: perhaps none of it is covered
    bool may_be() const { return low.outer < high.outer; }
    bool certainly_is() const { return is_certain && low.inner < high.inner; }
    double length() const { return high.inner - low.inner; }
    /// Whether it certainly is, and holds all that another one may be.
    bool certainly_holds(const Stretch& other) const {
      return certainly_is() && low.inner <= other.low.outer && high.inner >= other.high.outer;
    }
  };
  /// Coordinates along the receiver and across it, so that a narrow one has small heights: what is
  /// not known of places along it then hardly matters. The integral over a border of the height
  /// times the way along is the area.
  struct Frame {
    double x = 1, y = 0;          // the unit vector along
    double middle = 0, most = 0;  // heights are taken from the middle, and are at most that
    double along(double dx, double dy) const { return x * dx + y * dy; }
    double height(double px, double py) const { return x * py - y * px - middle; }
  };
  /// What stretches are of: a line, or an edge of the receiver, with its height at place 0 and how
  /// that grows.
  struct Carrier {
    std::uint32_t line = kNoLine, corner = 0;
    double height = 0, slope = 0;
    double integral(double from, double to) const {
      return (to - from) * (height + slope * ((from + to) / 2));
    }
  };
  /// Rounded outward.
  struct Box {
    float low[2], high[2];
  };
  static constexpr float kNoEnd = std::numeric_limits<float>::infinity();
  static constexpr Box kEverything = {{-kNoEnd, -kNoEnd}, {kNoEnd, kNoEnd}};
  /// Four lines of an outline, and its edges on them: what its own lines and the receiver leave of
  /// each. What fills up the last block is positive everywhere and no edge. A line's number is that
  /// of its block times four and its place there. As small as can be: there may be 100,000.
  struct alignas(32) LineBlock {
    double a[4], b[4], c[4], error[4];
    double from[4], to[4];                  // outer ends; from >= to where no edge is
    double inner_from[4], inner_to[4];      // inner ends
    std::uint8_t from_line[4], to_line[4];  // that make ends: places in the outline
    std::uint16_t sides[4];                 // as number_of() has them
    PlaneRef plane[4];

    void fill(std::uint32_t k);
    void take(std::uint32_t k, const LineBlock& block, std::uint32_t i);
  };
  static constexpr double kFar = 0x1p100;
  /// Instead of a line that makes an end: none, or it is not known which; cut_by_own() tells.
  static constexpr int kUnnamed = 255, kAsk = 254;
  /// Corners strictly on either side of a line.
  struct Sides {
    CornerMask before = 0, behind = 0;
  };
  static constexpr std::uint32_t kFewCorners = 8;
  // Of a convex receiver with n corners there are at most (2n)^2 kinds: sides change at two
  // corners, or between two.
  static_assert(4 * kMostCorners * kMostCorners < 0xffff);
  struct Outline {
    std::uint32_t first = 0, end = 0;  // of blocks_
    Box box;
  };
  /// A part of an edge of an outline, between outer ends.
  struct Edge {
    std::uint32_t line = 0, outline = 0;
    double a = 0, b = 0, c = 0, error = 0;  // of its line
    double from = 0, to = 0;
  };
  /// What a line does to a stretch that it crosses.
  struct Trimming {
    double place = 0, radius = 0;
    std::uint32_t line = 0;
    bool is_near = false;   // perhaps the line that the stretch is of; no place
    bool begins = false;    // what is inside begins there
    bool is_known = false;  // the lines certainly cross
  };
  /// Where a line meets an edge of the receiver, as a share of that.
  struct BorderShare {
    double share = 0, radius = 0;
  };
  /// What a line is to a stretch that it may be the line of: the same, or with all of that inside
  /// or outside, or one that cuts it.
  enum class Near : std::uint8_t { kSame, kInside, kOutside, kCuts };
  enum class Cover : std::uint8_t { kNothing, kSome, kAll, kUnknown };
  /// Of stretches: their lengths, and the integrals of their heights.
  struct Lengths {
    double certain = 0, perhaps = 0;
    double certain_integral = 0, perhaps_integral = 0;
  };
  /// What lies between two places, the first of which ends a cover or begins the stretch.
  struct Gap {
    double before, after;
  };
  struct Trim;
  /// The border of the covered part, as a walk that must come back to where it began: whoever has
  /// lost a piece of it does not.
  struct Walk {
    double x = 0, y = 0, error = 0;
    void add(double dx, double dy, double middle, double radius);
    bool is_closed() const;
  };
  /// An outline in a cell.
  struct Member {
    Box box;
    std::uint32_t outline = 0;
  };
  /// Boxes of eight outlines of a cell: their least and greatest coordinates.
  struct alignas(32) BoxBlock {
    float x[2][8], y[2][8];
    std::uint32_t outline[8];
  };
  /// An outline that may hold some of the receiver's border: of its edges behind those corners.
  struct Bordering {
    std::uint32_t outline = 0;
    CornerMask edges = 0;
  };
  /// A rectangle of the chart: a range of members_, the outlines that may meet it.
  struct Cell {
    double low[2] = {}, high[2] = {};
    std::uint32_t first = 0, end = 0;
    int depth = 0, in_vain = 0;
  };

  OutlineLine line_of(std::uint32_t line) const;
  std::uint16_t number_of(const Sides& sides);
  /// Of a line, by number.
  Sides sides_of(std::uint16_t number) const {
    constexpr std::uint16_t kMask = (1 << kFewCorners) - 1;
    if (receiver_->size() > kFewCorners) return sides_[number];
    return {CornerMask{number} & kMask, CornerMask{number} >> kFewCorners};
  }
  Edge edge_on(std::uint32_t line, std::uint32_t outline, double from, double to) const;
  struct FourStretches;
  void in_receiver(std::uint32_t number, FourStretches& stretches) const;
  bool is_twin(std::uint32_t line) const;
  unsigned find_same(std::uint32_t line, std::uint32_t number, unsigned near);
  unsigned find_ends(const Outline& outline, std::uint32_t count, std::uint32_t number);
  void drop_lines(Outline& outline, std::uint32_t count);
  bool find_edges(Outline& outline, std::uint32_t count, double (&low)[2], double (&high)[2]);
  Stretch own_stretch(const Edge& edge);
  CornerMask edges_of_border(std::span<const OutlineLine> lines) const;
  bool trim(const Edge& own, const Outline& outline);
  bool cut_by_own(const Outline& outline, std::uint32_t line, Stretch& stretch);
  struct OpenLines;
  struct EdgeLanes;
  Cover find_open(const EdgeLanes& edge, std::uint32_t other, OpenLines& open) const;
  Cover cover(const Edge& edge, const OpenLines& open, Stretch& stretch) const;
  Cover cover_slowly(const Edge& edge, std::uint32_t other, Stretch& stretch);
  static Cover cover_between(const Edge& edge, const Stretch& stretch);
  bool hides_or_note(const Edge& edge, std::uint32_t other, const OpenLines* open);
  bool hides(const Edge& edge, const EdgeLanes& lanes, std::uint32_t other);
  bool cover_border(std::uint32_t corner, const Outline& outline, Stretch& stretch) const;
  BorderShare share_of_border(std::uint32_t line, std::uint32_t corner) const;
  Near resolve(std::uint32_t line, std::uint32_t by, Trim& trimmed) const;
  bool has_gap(const Carrier& carrier, const End& before, const End& after, bool is_end) const;
  Lengths rest_of(const Carrier& carrier, Stretch stretch);
  static End outside(const End& end);
  void find_certain(const Carrier& carrier, const Stretch& stretch, Lengths& rest);
  void find_perhaps(const Carrier& carrier, const Stretch& stretch, Lengths& rest);
  void sharpen(const Carrier& carrier, End& end, bool begins) const;
  void sharpen(const Carrier& carrier, Stretch& stretch);
  void set_frame();
  void add_integral(double along, double along_error, double height_error, const Lengths& lengths);
  void add_borders();
  void add_edge(const Edge& edge);
  void add_rest(const Edge& edge);
  bool is_hidden(const Edge& edge);
  void add_cells();
  void sort_members();
  static float size_of(const Box& box);
  bool holds(const Outline& outline, const double (&low)[2], const double (&high)[2]) const;
  Box ends_in(const Cell& cell, const Outline& outline) const;
  bool is_outside(const Outline& outline, const Cell& cell, const Box& ends, const Box& box) const;
  bool drop_held(Cell& cell);
  bool halve(const Cell& cell);
  void clip(const LineBlock& block, const Cell& cell, LineBlock& part) const;
  void add_leaf(const Cell& cell, bool is_cut);
  Box box_of(double low_x, double low_y, double high_x, double high_y) const;
  Box box_of(const Edge& edge) const;

  const ReceiverChart* receiver_ = nullptr;
  ExactLines* exact_ = nullptr;
  Frame frame_;
  double slack_ = 0, most_error_ = 0;  // of lines
  double margin_ = 0;                  // of places in a cell
  ChunkedList<LineBlock> blocks_;
  std::vector<Sides> sides_;
  std::vector<Outline> outlines_;
  std::vector<Bordering> bordering_;
  std::vector<std::uint32_t> twins_;  // lines that an earlier one of the outline at hand is, too
  std::vector<Trimming> trimmings_;   // of the line at hand, in the order of lines
  std::vector<Stretch> covers_;       // of the edge at hand
  std::vector<Member> members_, high_members_;
  std::vector<Cell> cells_;     // that are left
  std::vector<BoxBlock> leaf_;  // the cell at hand
  LargestFirst order_;
  std::vector<double> ends_;
  std::uint32_t last_hider_ = 0;   // the outline that hid the last edge that was hidden
  std::vector<Gap> perhaps_gaps_;  // of the stretch at hand
  double sharpen_above_ = 0;       // what an edge may leave open of the area
  Walk walk_;
  double sum_ = 0, error_ = 0;  // of the covered area
  bool is_flat_ = false;        // the outline at hand has no area
  bool some_left_ = false;      // something is perhaps not covered
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_OUTLINE_UNION_H
