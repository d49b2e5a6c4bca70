// SPDX-License-Identifier: GPL-3.0-or-later
// The overlay: closed loops of several layers put into one planar subdivision, with every cell's
// winding number in each layer.
//
// Exactness: exact throughout. Doubles only decide what they can prove; everything else falls
// through to integers. Edges whose windings cancel (two fragments of one class side by side)
// vanish, so that a cell is a maximal region of one combination of windings, in general with holes,
// and a face that exists has a positive area. Crash-freedom: no construction can fail, and the
// windings are checked across every edge; consistent() is false if they contradict each other,
// which the caller reports as a finding.
#ifndef GNOMON_ORACLE_GEOMETRY_OVERLAY_H
#define GNOMON_ORACLE_GEOMETRY_OVERLAY_H

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "gnomon/oracle/enclosure.h"
#include "oracle/geometry/chart.h"

namespace gnomon::oracle {

/// kTruth: true shadow, or true penumbra volumes. kTrueUmbra: true umbra volumes and what is behind
/// the light. kDeep: certified deep umbra. The rest is what a candidate claims.
enum Layer : int {
  kReceiver = 0,
  kTruth = 1,
  kLit = 2,
  kShadow = 3,
  kPenumbra = 4,
  kUmbra = 5,
  kTrueUmbra = 6,
  kDeep = 7,
  kLayers = 8
};
using Winding = std::array<std::int32_t, kLayers>;

class Overlay {
 public:
  struct Halfedge {
    std::uint32_t origin = 0, next = 0, face = 0;
  };
  struct Face {
    Winding winding{};
    std::vector<std::uint32_t> cycles;  // one halfedge of each boundary cycle
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Adds a closed loop; its interior is to the left of its edges (counter-clockwise: winding +1).
  void add_loop(const std::vector<ChartPoint>& loop, Layer layer, int weight = 1);
  /// Adds one directed edge; all edges added must make closed loops in the end. Edges with a mark
  /// belong to a loop of that number, and stay even where their layer's windings cancel: such loops
  /// can be told apart on every face.
  void add_edge(const ChartPoint& a, const ChartPoint& b, Layer layer, int weight = 1,
                std::uint32_t mark = kNone);
  void build();

  bool consistent() const { return consistent_; }
  const std::vector<Face>& faces() const { return faces_; }  // face 0 is the unbounded one
  const std::vector<Halfedge>& halfedges() const { return halfedges_; }
  static std::uint32_t twin(std::uint32_t halfedge) { return halfedge ^ 1u; }
  std::uint32_t target(std::uint32_t halfedge) const { return halfedges_[twin(halfedge)].origin; }
  const ChartPoint& point(std::uint32_t vertex) const { return points_[vertex]; }
  std::size_t vertex_count() const { return points_.size(); }
  /// Calls for every halfedge of a face's boundary.
  void for_each_halfedge(std::uint32_t face, const std::function<void(std::uint32_t)>& visit) const;
  /// A marked loop and its winding number, which is not zero.
  struct MarkWinding {
    std::uint32_t mark = 0;
    std::int32_t winding = 0;
  };
  using MarkWindings = std::vector<MarkWinding>;
  /// Calls for every face but the unbounded one, with the marked loops that wind around it.
  void for_each_marked_face(
      const std::function<void(std::uint32_t face, const MarkWindings&)>& visit) const;
  /// Vertices of a candidate's layers that lie inside an edge of these layers.
  std::uint64_t t_vertices() const { return t_vertices_; }

  /// Positive if a, b, c turn left.
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const { return orient(a, b, c); }
  /// The sign of u x + v y at a less that at b.
  int order_along(int u, int v, std::uint32_t a, std::uint32_t b) const;
  static constexpr int kFixedBits = 256;
  /// Coordinates less those of the box's corner, in units of 2^-kFixedBits box units: floors, so
  /// that they are off by less than one.
  struct FixedPoint {
    mpz_class x, y;
  };
  const FixedPoint& fixed(std::uint32_t vertex) const;
  FixedPoint fixed(const ChartPoint& point) const;
  /// Grid units of one box unit, which doubles need not hold.
  long double box_unit() const;
  /// Area of a set of faces in the chart, in units of 2^(-2 kFixedBits) box areas; the true value
  /// is within +- error of it.
  struct FixedArea {
    mpz_class value, error;
  };
  FixedArea area(const std::vector<bool>& face_in_set) const;
  /// The same exactly, in grid units squared of the chart. Costs grow with the size of the
  /// boundary.
  mpq_class exact_area(const std::vector<bool>& face_in_set) const;
  /// Edges between a face in the set and one outside.
  std::size_t boundary_size(const std::vector<bool>& face_in_set) const;

 private:
  struct Segment {
    std::uint32_t a = 0, b = 0;  // a before b in the order x, y
    Winding delta{};             // left of a -> b minus right of it
    bool candidate = false;
    MarkWindings marks{};  // as delta, of marked loops
    bool vanishes() const;
  };
  struct PointHash {
    const std::vector<ChartPoint>* points;
    std::size_t operator()(std::uint32_t vertex) const;
  };
  struct PointEqual {
    const std::vector<ChartPoint>* points;
    bool operator()(std::uint32_t a, std::uint32_t b) const { return (*points)[a] == (*points)[b]; }
  };
  struct Approximation {
    double x = 0, y = 0;
  };

  std::uint32_t intern(const ChartPoint& point);
  void set_scale();
  void approximate();
  Approximation approximation_of(const ChartPoint& point) const;
  void fixed(const ChartPoint& point, int bits, mpz_class& x, mpz_class& y) const;
  int orient(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  int order(std::uint32_t a, std::uint32_t b) const;
  void find_intersections(std::vector<std::vector<std::uint32_t>>& splits);
  void intersect(std::size_t s, std::size_t t, std::vector<std::vector<std::uint32_t>>& splits);
  bool strictly_within(std::uint32_t vertex, const Segment& segment) const;
  const ChartLine& line_of(std::size_t segment);
  void split_segments(const std::vector<std::vector<std::uint32_t>>& splits);
  void link();
  void trace_faces();
  std::uint32_t halfedge_below(std::uint32_t vertex, std::uint32_t component,
                               const std::vector<std::uint32_t>& component_of) const;
  bool spread_windings();

  std::vector<ChartPoint> points_;
  std::vector<Approximation> approximations_;
  mutable std::vector<std::optional<FixedPoint>> fixed_;  // by vertex; made when first asked for
  std::unordered_map<std::uint32_t, std::uint32_t, PointHash, PointEqual> ids_{
      64, PointHash{&points_}, PointEqual{&points_}};
  std::unordered_map<std::uint64_t, std::uint32_t> segment_ids_;
  std::vector<Segment> segments_;
  std::vector<ChartLine> lines_;
  std::vector<bool> has_line_;
  std::vector<bool> is_t_vertex_;
  std::vector<Segment> edges_;
  std::vector<Halfedge> halfedges_;
  std::vector<std::vector<std::uint32_t>> outgoing_;
  std::vector<Face> faces_;
  // approximation = floor(coordinate 2^scale_) - corner, in units that make the box about 2^52
  // wide.
  long scale_ = 0;
  ChartPoint corner_;
  double error_ = 0;  // bound of one approximate coordinate's error
  std::uint64_t t_vertices_ = 0;
  bool consistent_ = true;

 public:
  Overlay() = default;
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;
};

/// A loop as edges whose interior is to the left: any loop becomes the boundary of what it winds
/// around (the non-zero rule).
struct NormalisedLoop {
  bool convex = false;
  bool crosses_itself = false;
  std::vector<ChartPoint> loop;                          // if convex
  std::vector<std::pair<ChartPoint, ChartPoint>> edges;  // otherwise
};
NormalisedLoop normalise(std::vector<ChartPoint> loop);
/// The same without what holes wind around.
NormalisedLoop normalise(std::vector<ChartPoint> loop,
                         const std::vector<std::vector<ChartPoint>>& holes);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_OVERLAY_H
