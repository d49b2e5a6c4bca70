// SPDX-License-Identifier: LGPL-3.0-or-later
// An area light as convex pieces in the chart of its plane (light_view.h), from which the shadows
// of casters are taken away. The vertices of pieces are named by the two lines that meet in them,
// and have enclosures; exact coordinates are made only where a sign needs them.
//
// Exactness: exact, all of it. Regularised: pieces have positive area. An arena for one point or
// cell; not thread-safe.
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_VISIBLE_PIECES_H
#define GNOMON_ALGORITHMS_ILLUMINATION_VISIBLE_PIECES_H

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "algorithms/illumination/light_view.h"
#include "gnomon/kernel/orientation.h"

namespace gnomon {

class LightPieces {
 public:
  /// Convex, counter-clockwise in the chart: vertex i, and the line of the edge from it to the next
  /// one, the piece in front.
  struct Piece {
    std::vector<std::uint32_t> vertices;
    std::vector<PlaneRef> lines;
  };

  /// Makes the piece that is the whole light.
  explicit LightPieces(const LightView& view);

  std::uint32_t add_apex(Apex apex);
  const Apex& apex(std::uint32_t i) const { return apexes_[i]; }

  /// Where a support plane cuts the chart; front is the plane's front.
  PlaneRef line_of_plane(PlaneId plane);
  /// Where the plane through an edge and an apex cuts the chart, front as edge_normal has it.
  PlaneRef line_of_edge(EdgeId edge, std::uint32_t apex);
  /// Whether there is no such plane, because the apex is on the line of the edge. Exact.
  bool is_on_edge(EdgeId edge, std::uint32_t apex) const;

  /// Keeps what is in front of a line.
  void clip(PlaneRef line);
  /// Takes away what is in front of all the lines.
  void subtract(std::span<const PlaneRef> region);

  const std::vector<Piece>& pieces() const { return pieces_; }
  bool empty() const { return pieces_.empty(); }
  void clear() { pieces_.clear(); }
  /// Requires: pieces of this arena.
  void set_pieces(std::vector<Piece> pieces) { pieces_ = std::move(pieces); }
  /// Whether one of the lines has all of the piece behind it or on it.
  bool is_apart(const Piece& piece, std::span<const PlaneRef> region);

  const std::array<Ball, 2>& near(std::uint32_t vertex) const { return vertices_[vertex].near; }
  /// Homogeneous chart coordinates (s w, t w, w), w > 0.
  const ExactVector& exact(std::uint32_t vertex);
  /// Makes the enclosures of all vertices of pieces from their exact coordinates.
  void refine();
  /// Twice the area of a piece in the chart.
  mpq_class twice_area(const Piece& piece);

  SignCounts counts;

 private:
  enum class Source : std::uint8_t { kLightEdge, kPlane, kEdge };
  struct Line {
    std::array<Ball, 3> near;
    ExactVector exact;
    bool has_exact = false;
    Source source = Source::kLightEdge;
    std::uint32_t index = 0;  // light edge, plane or edge
    std::uint32_t apex = 0;
  };
  struct Vertex {
    static constexpr std::uint32_t kMost = 4;
    std::array<Ball, 2> near;
    ExactVector exact;
    bool has_exact = false;
    std::uint32_t known = 0;                // lines that it is known to be on
    std::array<std::uint32_t, kMost> on{};  // the first two made it, unless it is a corner
  };
  /// Enclosures of coordinates wider than this (the light is about 1) are made from exact ones.
  static constexpr double kCoarse = 0x1p-30;

  void enclose_exactly(std::uint32_t vertex);
  const ExactVector& exact_line(std::uint32_t line);
  /// Returns the sign of the line's value; `value` encloses it.
  Sign sign(PlaneRef line, std::uint32_t vertex, Ball& value);
  std::uint32_t crossing(PlaneRef edge, PlaneRef line, std::uint32_t from, const Ball& from_value,
                         std::uint32_t to, const Ball& to_value);
  /// Signs and values of a piece's vertices.
  struct Classified {
    std::vector<Sign> signs;
    std::vector<Ball> values;
    bool front = false, back = false;
  };
  void classify(PlaneRef line, const Piece& piece, Classified& result);
  /// Requires: some vertex in front and some behind.
  void split(const Piece& piece, PlaneRef line, const Classified& sides, Piece& front, Piece& back);

  const LightView& view_;
  std::vector<Apex> apexes_;
  std::vector<Line> lines_;
  std::vector<Vertex> vertices_;
  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, std::uint32_t> line_numbers_;
  Classified sides_;
};

/// The lines between which the caster hides the light from the apex, or from the limit towards it
/// from a second apex (see Illuminator::at). Empty: it hides nothing.
std::vector<PlaneRef> shadow_of(LightPieces& pieces, const LightView& view,
                                const LightView::Caster& caster, std::uint32_t apex,
                                const std::uint32_t* inwards);

/// Clips the pieces by the receiver's plane; false: nothing is left, or the apex is not in front of
/// the light.
bool clip_to_receiver(LightPieces& pieces, const LightView& view, const Part& part, Side side,
                      std::uint32_t apex);

/// Takes away what casters hide. Stops when nothing is left. Returns how many casters it asked.
std::uint64_t subtract_casters(LightPieces& pieces, const LightView& view, const Part& part,
                               Side side, std::uint32_t apex, const std::uint32_t* inwards);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_VISIBLE_PIECES_H
