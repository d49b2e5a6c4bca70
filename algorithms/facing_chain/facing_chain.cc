// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/facing_chain.h"

#include <algorithm>
#include <cstdlib>

#include "algorithms/facing_chain/contour.h"

namespace gnomon {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// The place of a directed edge in arrays that have both directions of every edge.
std::size_t slot_of(PlaneRef edge) { return 2 * std::size_t{edge.index()} + edge.flipped(); }
VertexId start_of(const Geometry& geometry, PlaneRef edge) {
  const EdgeEnds ends = geometry.edges[edge.index()];
  return edge.flipped() ? ends.b : ends.a;
}
VertexId end_of(const Geometry& geometry, PlaneRef edge) { return start_of(geometry, -edge); }

/// The edges of all parts of the chain, part after part, each counter-clockwise as seen from the
/// light.
struct FacingEdges {
  std::vector<PlaneRef> edges;
  std::vector<std::uint32_t> next;  // the edge after this one around its part

  FacingEdges(const PreparedScene& scene, std::span<const Side> facing) {
    for (std::uint32_t i = 0; i < scene.parts.size(); ++i) {
      const Part& part = scene.parts[i];
      if (facing[i] == Side::kOn) continue;
      const auto first = static_cast<std::uint32_t>(edges.size());
      const auto loop = scene.edges(part);
      for (std::uint32_t k = 0; k < part.count; ++k) {
        edges.push_back(facing[i] == Side::kFront ? loop[k] : -loop[part.count - 1 - k]);
        next.push_back(k + 1 == part.count ? first : first + k + 1);
      }
    }
  }
};

std::vector<ContourEdge> contour_of(const PreparedScene& scene, const FacingEdges& facing) {
  std::vector<std::int32_t> sums(scene.geometry.edges.size(), 0);
  for (const PlaneRef edge : facing.edges) sums[edge.index()] += edge.flipped() ? -1 : 1;
  std::vector<ContourEdge> contour;
  for (EdgeId edge = 0; edge < sums.size(); ++edge) {
    if (sums[edge] == 0) continue;
    contour.push_back(
        {PlaneRef(edge, sums[edge] < 0), static_cast<std::uint32_t>(std::abs(sums[edge]))});
  }
  return contour;
}

/// Strings the contour into loops.
class LoopStringer {
 public:
  LoopStringer(const PreparedScene& scene, const FacingEdges& facing, FacingChain& chain)
      : geometry_(scene.geometry),
        facing_(facing),
        chain_(chain),
        some_facing_(2 * geometry_.edges.size(), kNone),
        contour_at_(2 * geometry_.edges.size(), kNone),
        first_leaving_(geometry_.positions.size() + 1, 0),
        fan_size_(geometry_.positions.size(), 0) {
    for (std::uint32_t i = 0; i < facing.edges.size(); ++i) {
      std::uint32_t& one = some_facing_[slot_of(facing.edges[i])];
      if (one == kNone) one = i;
      ++fan_size_[start_of(geometry_, facing.edges[i])];
    }
    for (std::uint32_t i = 0; i < chain.contour.size(); ++i) {
      const ContourEdge& edge = chain.contour[i];
      contour_at_[slot_of(edge.edge)] = i;
      left_.push_back(edge.multiplicity);
      ++first_leaving_[start_of(geometry_, edge.edge) + 1];
    }
    for (std::size_t v = 1; v < first_leaving_.size(); ++v) {
      first_leaving_[v] += first_leaving_[v - 1];
    }
    leaving_.resize(chain.contour.size());
    std::vector<std::uint32_t> place(first_leaving_.begin(), first_leaving_.end() - 1);
    for (std::uint32_t i = 0; i < chain.contour.size(); ++i) {
      leaving_[place[start_of(geometry_, chain.contour[i].edge)]++] = i;
    }
  }

  void string_all() {
    chain_.loop_start.push_back(0);
    for (std::uint32_t start = 0; start < chain_.contour.size(); ++start) {
      // The start stays free until the loop comes back to it.
      while (left_[start] > 0) {
        std::uint32_t edge = start;
        do {
          chain_.loop_edges.push_back(edge);
          edge = next_after(chain_.contour[edge].edge);
          --left_[edge];
        } while (edge != start);
        chain_.loop_start.push_back(static_cast<std::uint32_t>(chain_.loop_edges.size()));
      }
    }
  }

 private:
  /// A contour edge that starts where this one ends and is not used up. There is one: as many edges
  /// start in a vertex as end there.
  std::uint32_t next_after(PlaneRef edge) const {
    const VertexId vertex = end_of(geometry_, edge);
    const std::uint32_t first = first_leaving_[vertex], last = first_leaving_[vertex + 1];
    if (last - first > 1) {
      if (const std::uint32_t found = through_fan(edge, vertex); found != kNone) return found;
    }
    return *std::find_if(leaving_.begin() + first, leaving_.begin() + last,
                         [&](std::uint32_t i) { return left_[i] > 0; });
  }

  /// The first contour edge met when turning around the vertex inside the facing side. Where edges
  /// have many parts the fan may turn in a circle, and then tells nothing.
  std::uint32_t through_fan(PlaneRef edge, VertexId vertex) const {
    for (std::uint32_t step = 0; step < fan_size_[vertex]; ++step) {
      const std::uint32_t part_edge = some_facing_[slot_of(edge)];
      if (part_edge == kNone) return kNone;
      const PlaneRef out = facing_.edges[facing_.next[part_edge]];
      const std::uint32_t found = contour_at_[slot_of(out)];
      if (found != kNone && left_[found] > 0) return found;
      edge = -out;
    }
    return kNone;
  }

  const Geometry& geometry_;
  const FacingEdges& facing_;
  FacingChain& chain_;
  std::vector<std::uint32_t> some_facing_;    // by directed edge: a facing part's edge
  std::vector<std::uint32_t> contour_at_;     // by directed edge: the contour edge
  std::vector<std::uint32_t> first_leaving_;  // by vertex, into leaving_
  std::vector<std::uint32_t> leaving_;        // contour edges by the vertex that they start in
  std::vector<std::uint32_t> fan_size_;       // by vertex: facing parts around it
  std::vector<std::uint32_t> left_;           // by contour edge: how often it may still be used
};

}  // namespace

std::vector<ContourEdge> contour_of(const PreparedScene& scene, std::span<const Side> sides) {
  return contour_of(scene, FacingEdges(scene, sides));
}

FacingChain facing_chain(const PreparedScene& scene, std::span<const Side> facing) {
  std::vector<Side> casting(facing.begin(), facing.end());
  for (std::uint32_t i = 0; i < casting.size(); ++i) {
    if (!scene.parts[i].casts) casting[i] = Side::kOn;
  }
  const FacingEdges edges(scene, casting);
  FacingChain chain;
  chain.facing_edges = edges.edges.size();
  chain.contour = contour_of(scene, edges);
  LoopStringer(scene, edges, chain).string_all();
  return chain;
}

}  // namespace gnomon
