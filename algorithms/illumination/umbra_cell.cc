// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/umbra_cell.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>

namespace gnomon {
namespace {

constexpr std::size_t kCorners = 3;

/// One side of a caster as the corners of a cell see it.
class CellShadow {
 public:
  CellShadow(LightPieces& pieces, const LightView& view, const CasterSide& side)
      : pieces_(pieces), view_(view), caster_(view.casters()[side.caster]), front_(side.front) {
    const Part& part = view.scene().parts[caster_.part];
    for (std::uint32_t c = 0; c < kCorners; ++c) {
      // Negative: behind the side that stops the light.
      heights_[c] = view.side_of(part.plane, pieces.apex(c), pieces.counts);
      if (part.flipped == front_) heights_[c] = -heights_[c];
      if (heights_[c] == Sign::kNegative && deepest_ == kCorners) deepest_ = c;
      in_front_ |= heights_[c] == Sign::kPositive;
    }
  }

  /// Whether some of the cell is behind that side.
  bool exists() const { return deepest_ != kCorners; }

  /// Finds the lines between which the light is hidden from every point of the cell. Returns false
  /// if none of it is.
  bool inner(std::vector<PlaneRef>& region) {
    region.clear();
    if (!exists() || in_front_) return false;
    for (const PlaneRef edge : edges()) {
      // The tightest of the planes through the edge and a corner.
      std::uint32_t best = deepest_;
      for (std::uint32_t c = 0; c < kCorners; ++c) {
        if (c == deepest_) continue;
        if (heights_[c] == Sign::kZero) {
          // In the caster's plane: the plane of the two is the caster's, and the light is on its
          // wrong side unless the corner is on the caster's side of the edge, or on its line.
          if (turn(edge, deepest_, c) == Sign::kNegative) return false;
        } else if (turn(edge, best, c) == Sign::kNegative) {
          best = c;
        }
      }
      region.push_back(line(edge, best));
    }
    add_plane(region);
    return true;
  }

  /// The caster's edges as seen from its blocking side: counter-clockwise from the light.
  std::span<const PlaneRef> edges() const {
    return view_.scene().edges(view_.scene().parts[caster_.part]);
  }
  std::span<const VertexId> loop() const {
    return view_.scene().loop(view_.scene().parts[caster_.part]);
  }
  /// Whether the caster is in front of the planes through one of its edges as line_of_edge has
  /// them.
  bool is_in_front_of(PlaneRef edge) const { return edge.flipped() != front_; }

  /// Finds lines between which lies all that is hidden from any point of the cell.
  void outer(std::vector<PlaneRef>& region) {
    region.clear();
    for (const PlaneRef edge : edges()) {
      std::uint32_t best = deepest_;
      bool is_bounded = true;
      for (std::uint32_t c = 0; c < kCorners && is_bounded; ++c) {
        if (c == deepest_) continue;
        switch (heights_[c]) {
          case Sign::kNegative:
            if (turn(edge, best, c) == Sign::kPositive) best = c;
            break;
          case Sign::kZero:
            is_bounded = turn(edge, deepest_, c) != Sign::kPositive;
            break;
          case Sign::kPositive:
            // Between a corner behind and this one the cell crosses the caster's plane: beyond the
            // edge, or not.
            for (std::uint32_t d = 0; d < kCorners && is_bounded; ++d) {
              if (heights_[d] != Sign::kNegative) continue;
              is_bounded = turn(edge, d, c) == Sign::kNegative;
            }
            break;
        }
      }
      if (is_bounded) region.push_back(line(edge, best));
    }
    add_plane(region);
  }

 private:
  PlaneRef line(PlaneRef edge, std::uint32_t corner) {
    const PlaneRef made = pieces_.line_of_edge(edge.index(), corner);
    return edge.flipped() == front_ ? -made : made;
  }
  /// On which side of the plane through the edge and corner `from` is corner `to`; positive: the
  /// plane through `to` hides more.
  Sign turn(PlaneRef edge, std::uint32_t from, std::uint32_t to) {
    const Sign sign = view_.side_of_edge_plane(edge.index(), pieces_.apex(from), pieces_.apex(to),
                                               pieces_.counts);
    return edge.flipped() == front_ ? -sign : sign;
  }
  void add_plane(std::vector<PlaneRef>& region) {
    if (!caster_.cuts) return;
    const Part& part = view_.scene().parts[caster_.part];
    const PlaneRef made = pieces_.line_of_plane(part.plane);
    region.push_back(part.flipped == front_ ? -made : made);
  }

  LightPieces& pieces_;
  const LightView& view_;
  const LightView::Caster& caster_;
  bool front_;
  std::array<Sign, kCorners> heights_{};
  std::uint32_t deepest_ = kCorners;
  bool in_front_ = false;
};

/// Casters that share edges hide what passes by them: whatever passes one of the two at their
/// common edge meets the other.
class JoinedShadows {
 public:
  JoinedShadows(LightPieces& pieces, std::span<CellShadow> shadows) : pieces_(pieces) {
    std::vector<PlaneRef> region;
    for (CellShadow& shadow : shadows) {
      if (!shadow.inner(region)) continue;
      pieces_.subtract(region);
      if (pieces_.empty()) return;
      const auto number = static_cast<std::uint32_t>(faces_.size());
      faces_.push_back({&shadow, region});
      for (std::uint32_t i = 0; i < shadow.edges().size(); ++i) {
        const PlaneRef edge = shadow.edges()[i];
        sides_[key(edge.index(), shadow.is_in_front_of(edge))].push_back({number, i});
      }
    }
    subtract_pairs();
    subtract_fans();
  }

 private:
  struct Face {
    CellShadow* shadow;
    std::vector<PlaneRef> region;  // a line for each edge, and perhaps the caster's plane
  };
  struct FaceEdge {
    std::uint32_t face = 0, edge = 0;
  };
  static constexpr std::size_t kLongestFan = 16;

  static std::uint64_t key(EdgeId edge, bool in_front) {
    return std::uint64_t{edge} * 2 + (in_front ? 1 : 0);
  }
  /// What lies on the other side of an edge.
  std::span<const FaceEdge> across(FaceEdge at) const {
    const CellShadow& shadow = *faces_[at.face].shadow;
    const PlaneRef edge = shadow.edges()[at.edge];
    const auto found = sides_.find(key(edge.index(), !shadow.is_in_front_of(edge)));
    if (found == sides_.end()) return {};
    return found->second;
  }
  /// The face's region without the bounds of one or two of its edges.
  static void append(std::vector<PlaneRef>& region, const Face& face, std::uint32_t left_out,
                     std::uint32_t left_out_too) {
    for (std::uint32_t i = 0; i < face.region.size(); ++i) {
      if (i != left_out && i != left_out_too) region.push_back(face.region[i]);
    }
  }

  void subtract_pairs() {
    std::vector<PlaneRef> region;
    for (std::uint32_t f = 0; f < faces_.size() && !pieces_.empty(); ++f) {
      for (std::uint32_t e = 0; e < faces_[f].shadow->edges().size(); ++e) {
        for (const FaceEdge other : across({f, e})) {
          if (other.face < f) continue;  // the other face has handled it
          region.clear();
          append(region, faces_[f], e, e);
          append(region, faces_[other.face], other.edge, other.edge);
          pieces_.subtract(region);
        }
      }
    }
  }

  /// Goes all the way round a vertex, from face to face.
  void subtract_fans() {
    std::vector<PlaneRef> region;
    for (std::uint32_t f = 0; f < faces_.size() && !pieces_.empty(); ++f) {
      const auto size = static_cast<std::uint32_t>(faces_[f].shadow->edges().size());
      for (std::uint32_t e = 0; e < size; ++e) {
        const VertexId vertex = faces_[f].shadow->loop()[e];
        region.clear();
        FaceEdge at{f, e};
        bool closed = false, is_first = true;
        for (std::size_t steps = 0; steps < kLongestFan; ++steps) {
          // Into the face over one of its edges at the vertex, out over the other.
          const CellShadow& shadow = *faces_[at.face].shadow;
          const auto n = static_cast<std::uint32_t>(shadow.edges().size());
          const std::uint32_t out =
              shadow.loop()[at.edge] == vertex ? (at.edge + n - 1) % n : (at.edge + 1) % n;
          append(region, faces_[at.face], at.edge, out);
          const std::span<const FaceEdge> next = across({at.face, out});
          if (next.empty()) break;
          at = next[0];
          if (at.face == f) {
            closed = at.edge == e;
            break;
          }
          is_first = is_first && at.face > f;
        }
        // Each fan is taken once, from its first face.
        if (closed && is_first) pieces_.subtract(region);
      }
    }
  }

  LightPieces& pieces_;
  std::vector<Face> faces_;
  std::unordered_map<std::uint64_t, std::vector<FaceEdge>> sides_;
};

}  // namespace

std::array<UmbraCell, 2> UmbraCell::halves(const Geometry& geometry) const {
  std::array<double, kCorners> lengths{};
  std::array<Apex, kCorners> corners;
  for (std::size_t c = 0; c < kCorners; ++c) corners[c] = Apex::from(geometry, points[c], weight);
  for (std::size_t c = 0; c < kCorners; ++c) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = corners[(c + 1) % kCorners].near[k].high - corners[c].near[k].high;
      lengths[c] += step * step;
    }
  }
  const auto longest =
      static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  const std::size_t next = (longest + 1) % kCorners;
  ExactVector middle;
  std::array<UmbraCell, 2> result;
  for (UmbraCell& half : result) {
    half = *this;
    half.weight *= 2;
    for (ExactVector& point : half.points) {
      for (mpz_class& c : point) c *= 2;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) middle[k] = points[longest][k] + points[next][k];
  result[0].points[next] = middle;
  result[1].points[longest] = middle;
  return result;
}

std::vector<CasterSide> UmbraCells::casters_of(const UmbraCell& cell) const {
  std::vector<Apex> corners;
  for (const ExactVector& point : cell.points) {
    corners.push_back(Apex::from(view_.scene().geometry, point, cell.weight));
  }
  std::vector<std::uint32_t> found;
  view_.find_casters(corners, part_.plane, part_.flipped == (side_ == Side::kFront), found);
  std::vector<CasterSide> result;
  for (const std::uint32_t caster : found) {
    if (view_.casters()[caster].front) result.push_back({caster, true});
    if (view_.casters()[caster].back) result.push_back({caster, false});
  }
  return result;
}

CellAnswer UmbraCells::decide(const UmbraCell& cell, std::vector<CasterSide>& casters) const {
  const Geometry& geometry = view_.scene().geometry;
  LightPieces pieces(view_);
  ExactVector middle{0, 0, 0};
  for (const ExactVector& point : cell.points) {
    pieces.add_apex(Apex::from(geometry, point, cell.weight));
    for (std::size_t k = 0; k < 3; ++k) middle[k] += point[k];
  }
  const std::uint32_t centre =
      pieces.add_apex(Apex::from(geometry, middle, mpz_class(cell.weight * 3)));
  if (!clip_to_receiver(pieces, view_, part_, side_, centre)) return CellAnswer::kUndecided;
  const std::vector<LightPieces::Piece> in_front = pieces.pieces();

  std::vector<CellShadow> shadows;
  std::vector<CasterSide> reaching;
  std::vector<PlaneRef> region;
  for (const CasterSide& caster : casters) {
    CellShadow shadow(pieces, view_, caster);
    if (!shadow.exists()) continue;
    shadow.outer(region);
    if (pieces.is_apart(in_front[0], region)) continue;
    shadows.push_back(std::move(shadow));
    reaching.push_back(caster);
  }
  casters = std::move(reaching);
  // What the cell's centre sees says which of the two may be true.
  for (const CasterSide& caster : casters) {
    if (pieces.empty()) break;
    LightView::Caster one_side = view_.casters()[caster.caster];
    (caster.front ? one_side.back : one_side.front) = false;
    region = shadow_of(pieces, view_, one_side, centre, nullptr);
    if (!region.empty()) pieces.subtract(region);
  }
  const bool is_dark = pieces.empty();
  pieces.set_pieces(in_front);
  if (is_dark) {
    JoinedShadows(pieces, shadows);
    return pieces.empty() ? CellAnswer::kDeep : CellAnswer::kUndecided;
  }
  for (CellShadow& shadow : shadows) {
    if (pieces.empty()) break;
    shadow.outer(region);
    pieces.subtract(region);
  }
  return pieces.empty() ? CellAnswer::kUndecided : CellAnswer::kSeen;
}

}  // namespace gnomon
