// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/joined_shadows.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

class JoinedShadows {
 public:
  JoinedShadows(LightPieces& pieces, const EdgeLines& lines, std::span<CellShadow> shadows)
      : pieces_(pieces), lines_(lines) {
    Face face;
    for (CellShadow& shadow : shadows) {
      if (!shadow.inner(face.region, face.shut)) continue;
      const auto number = static_cast<std::uint32_t>(faces_.size());
      face.shadow = &shadow;
      faces_.push_back(face);
      for (std::uint32_t i = 0; i < shadow.edges().size(); ++i) {
        sides_[key({number, i}, false)].push_back({number, i});
      }
    }
  }

  /// One caster, two, those round a vertex, and all that are connected: the larger a set, the more
  /// it takes to find what it hides.
  void subtract() {
    for (const Face& face : faces_) {
      if (face.shut.empty()) pieces_.subtract(face.region);
      if (pieces_.empty()) return;
    }
    subtract_pairs();
    subtract_fans();
    subtract_sheets();
  }

 private:
  struct Face {
    CellShadow* shadow = nullptr;
    std::vector<PlaneRef> region;     // a line for each edge, and perhaps the caster's plane
    std::vector<std::uint32_t> shut;  // edges whose bounds leave nothing
  };
  struct FaceEdge {
    std::uint32_t face = 0, edge = 0;
  };
  /// A way round a vertex: the edge of a face that is passed, the vertex's rank on the edge's line,
  /// and whether the edge goes up the line from there.
  struct Passage {
    FaceEdge at;
    std::uint32_t rank = 0;
    bool up = false;
  };
  static constexpr std::size_t kLongestFan = 16;

  const EdgeOnLine& on_line(FaceEdge at) const { return lines_[edge(at).index()]; }
  PlaneRef edge(FaceEdge at) const { return faces_[at.face].shadow->edges()[at.edge]; }
  /// A line and one of its sides: that of the face, or the one across.
  std::uint64_t key(FaceEdge at, bool across) const {
    const EdgeOnLine& place = on_line(at);
    const bool in_front =
        faces_[at.face].shadow->is_in_front_of(edge(at)) != (place.runs_down != across);
    return std::uint64_t{place.line} * 2 + (in_front ? 1 : 0);
  }
  /// The edges on the same line of what lies on its other side.
  std::span<const FaceEdge> across(FaceEdge at) const {
    const auto found = sides_.find(key(at, true));
    if (found == sides_.end()) return {};
    return found->second;
  }
  /// Appends the face's region without the bounds of some of its edges. Returns false if another
  /// edge leaves nothing of it.
  template <class IsLeftOut>
  static bool append(std::vector<PlaneRef>& region, const Face& face, IsLeftOut&& is_left_out) {
    for (std::uint32_t i = 0; i < face.region.size(); ++i) {
      if (!is_left_out(i)) region.push_back(face.region[i]);
    }
    return std::ranges::all_of(face.shut, is_left_out);
  }

  void subtract_pairs() {
    std::vector<PlaneRef> region;
    for_each_contact([&](FaceEdge at, FaceEdge other) {
      if (other.face < at.face || pieces_.empty()) return;  // each pair once
      region.clear();
      const bool is_open =
          append(region, faces_[at.face], [&](std::uint32_t i) { return i == at.edge; }) &&
          append(region, faces_[other.face], [&](std::uint32_t i) { return i == other.edge; });
      if (is_open) pieces_.subtract(region);
    });
  }

  /// From a vertex of a face along one of its edges there.
  Passage along(FaceEdge at, VertexId vertex) const {
    const std::uint32_t rank = lines_.rank(edge(at).index(), vertex);
    return {at, rank, rank == on_line(at).low};
  }
  /// How the face that was entered is left: over its other edge at the vertex, or, where the vertex
  /// is inside the edge, along the same edge the other way.
  Passage way_out(const Passage& in, VertexId vertex) const {
    const EdgeOnLine& place = on_line(in.at);
    if (place.low < in.rank && in.rank < place.high) return {in.at, in.rank, !in.up};
    const CellShadow& shadow = *faces_[in.at.face].shadow;
    const auto n = static_cast<std::uint32_t>(shadow.edges().size());
    const std::uint32_t out =
        shadow.loop()[in.at.edge] == vertex ? (in.at.edge + n - 1) % n : (in.at.edge + 1) % n;
    return along({in.at.face, out}, vertex);
  }
  /// What lies across an edge where it begins at the vertex.
  std::optional<Passage> next(const Passage& out) const {
    for (const FaceEdge other : across(out.at)) {
      const EdgeOnLine& place = on_line(other);
      const bool there = out.up ? place.low <= out.rank && out.rank < place.high
                                : place.low < out.rank && out.rank <= place.high;
      if (there) return Passage{other, out.rank, out.up};
    }
    return std::nullopt;
  }

  /// Goes all the way round a vertex, from face to face.
  void subtract_fans() {
    std::vector<PlaneRef> region;
    for (std::uint32_t f = 0; f < faces_.size() && !pieces_.empty(); ++f) {
      const auto size = static_cast<std::uint32_t>(faces_[f].shadow->edges().size());
      for (std::uint32_t e = 0; e < size; ++e) {
        if (closed_fan(f, e, region)) pieces_.subtract(region);
      }
    }
  }

  /// Finds what a closed fan hides round corner e of face f. Each fan is found once, from the first
  /// of the faces that have a corner at the vertex.
  bool closed_fan(std::uint32_t f, std::uint32_t e, std::vector<PlaneRef>& region) const {
    const VertexId vertex = faces_[f].shadow->loop()[e];
    region.clear();
    Passage in = along({f, e}, vertex);
    for (std::size_t steps = 0; steps < kLongestFan; ++steps) {
      const Passage out = way_out(in, vertex);
      const auto is_at_vertex = [&](std::uint32_t i) {
        return i == in.at.edge || i == out.at.edge;
      };
      if (!append(region, faces_[in.at.face], is_at_vertex)) return false;
      const std::optional<Passage> entered = next(out);
      if (!entered) return false;
      in = *entered;
      if (in.at.face == f) return in.at.edge == e;
      const EdgeOnLine& place = on_line(in.at);
      const bool has_corner = in.rank == place.low || in.rank == place.high;
      if (has_corner && in.at.face < f) return false;
    }
    return false;
  }

  /// A part of the light, and the faces in front of whose planes all of it is.
  struct LightPart {
    std::vector<LightPieces::Piece> pieces;
    std::vector<bool> has_face;
  };
  static constexpr std::size_t kMostParts = 64;

  /// Cuts the light by the planes of faces that cross it, at most so often.
  std::vector<LightPart> parts_by_planes() {
    std::vector<LightPart> parts{{pieces_.pieces(), std::vector<bool>(faces_.size(), true)}};
    std::vector<PlaneRef> done;
    for (const Face& face : faces_) {
      if (face.region.size() == face.shadow->edges().size()) continue;
      const PlaneRef plane = face.region.back();
      if (std::ranges::find(done, plane) != done.end()) continue;
      done.push_back(plane);
      if (2 * parts.size() > kMostParts) continue;
      std::vector<LightPart> next;
      for (LightPart& part : parts) {
        for (const PlaneRef front : {plane, -plane}) {
          pieces_.set_pieces(part.pieces);
          pieces_.clip(front);
          if (pieces_.empty()) continue;
          LightPart cut{pieces_.pieces(), part.has_face};
          for (std::uint32_t f = 0; f < faces_.size(); ++f) {
            const std::vector<PlaneRef>& region = faces_[f].region;
            if (region.size() > faces_[f].shadow->edges().size() && region.back() == -front) {
              cut.has_face[f] = false;
            }
          }
          next.push_back(std::move(cut));
        }
      }
      parts = std::move(next);
    }
    return parts;
  }

  /// Takes what only the borders of connected faces bound.
  void subtract_sheets() {
    if (faces_.size() < 3 || pieces_.empty()) return;  // two are a pair
    std::vector<std::pair<std::uint32_t, std::uint32_t>> contacts;
    for_each_contact([&](FaceEdge at, FaceEdge other) {
      if (at.face < other.face) contacts.emplace_back(at.face, other.face);
    });
    std::vector<LightPieces::Piece> left;
    for (LightPart& part : parts_by_planes()) {
      pieces_.set_pieces(std::move(part.pieces));
      subtract_sheets_of(part.has_face, contacts);
      left.insert(left.end(), pieces_.pieces().begin(), pieces_.pieces().end());
    }
    pieces_.set_pieces(std::move(left));
  }
  void subtract_sheets_of(const std::vector<bool>& has_face,
                          std::span<const std::pair<std::uint32_t, std::uint32_t>> contacts) {
    std::vector<std::uint32_t> root(faces_.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](std::uint32_t face) {
      while (root[face] != face) face = root[face] = root[root[face]];
      return face;
    };
    for (const auto& [a, b] : contacts) {
      if (has_face[a] && has_face[b]) root[find(a)] = find(b);
    }
    std::vector<std::vector<std::uint32_t>> sheets(faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      if (has_face[f]) sheets[find(f)].push_back(f);
    }
    std::vector<PlaneRef> region;
    for (const std::vector<std::uint32_t>& sheet : sheets) {
      if (sheet.size() < 3 || pieces_.empty()) continue;
      region.clear();
      const bool is_open = std::ranges::all_of(sheet, [&](std::uint32_t f) {
        return append(region, faces_[f], [&](std::uint32_t i) {
          return is_inside({f, i}, has_face);
        });
      });
      if (is_open) pieces_.subtract(region);
    }
  }
  /// Calls back with all pairs of edges that overlap on a line, from its two sides, each pair
  /// twice.
  template <class F>
  void for_each_contact(F&& f) const {
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      for (std::uint32_t e = 0; e < faces_[face].shadow->edges().size(); ++e) {
        for (const FaceEdge other : across({face, e})) {
          if (on_line({face, e}).meets(on_line(other))) f(FaceEdge{face, e}, other);
        }
      }
    }
  }
  /// Whether some of these faces are across all of an edge; of what is no edge, false.
  bool is_inside(FaceEdge at, const std::vector<bool>& has_face) const {
    if (at.edge >= faces_[at.face].shadow->edges().size()) return false;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> covered;
    for (const FaceEdge other : across(at)) {
      if (has_face[other.face]) covered.emplace_back(on_line(other).low, on_line(other).high);
    }
    std::ranges::sort(covered);
    std::uint32_t reached = on_line(at).low;
    for (const auto& [low, high] : covered) {
      if (low <= reached) reached = std::max(reached, high);
    }
    return reached >= on_line(at).high;
  }

  LightPieces& pieces_;
  const EdgeLines& lines_;
  std::vector<Face> faces_;
  std::unordered_map<std::uint64_t, std::vector<FaceEdge>> sides_;
};

}  // namespace

void subtract_joined(LightPieces& pieces, const EdgeLines& lines, std::span<CellShadow> shadows) {
  JoinedShadows(pieces, lines, shadows).subtract();
}

}  // namespace gnomon
