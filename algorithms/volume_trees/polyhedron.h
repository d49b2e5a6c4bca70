// SPDX-License-Identifier: LGPL-3.0-or-later
// Convex polyhedra of the volume trees: shadow volumes, and the pieces that a tree cuts them into.
//
// A vertex is shared by the faces that meet in it. A face is a convex loop, counter-clockwise seen
// from outside, on a plane whose front is the inside; each of its corners names the plane of the
// neighbouring face across the edge that starts there, so that a corner is the meeting point of
// three planes, as everywhere (corner.h), and its plane is the support of the loop.
//
// Splitting has two steps (split.h): a side a vertex, asked for once; then both children, with each
// crossing constructed once and shared by the two faces of its edge and by both children, and a cap
// made of the edges that lie in the cutting plane.
//
// Guarantee: on exact kernels the children are convex polyhedra that tile the parent. On rounded
// ones a child whose cap does not close is left open, which is reported and harmless: its faces are
// clipped as loops, each on its own.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_POLYHEDRON_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_POLYHEDRON_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/split.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

struct PolyhedronFace {
  PlaneRef plane;                      // inside in front
  std::uint32_t first = 0, count = 0;  // into Polyhedron::corners
  bool own = false;  // a face of the volume itself; else where a tree, or the scene's box, cut it
};

struct FaceCorner {
  std::uint32_t vertex = 0;
  PlaneRef edge;  // plane of the face across the edge to the next corner, inside in front
};

template <class Vertex>
struct Polyhedron {
  std::vector<Vertex> vertices;
  std::vector<PolyhedronFace> faces;
  std::vector<FaceCorner> corners;

  void clear() {
    vertices.clear();
    faces.clear();
    corners.clear();
  }
  bool empty() const { return faces.empty(); }
  std::span<const FaceCorner> loop(const PolyhedronFace& face) const {
    return {corners.data() + face.first, face.count};
  }
  /// Corner i of a face as a kernel understands it.
  Corner<Vertex> corner(const PolyhedronFace& face, std::uint32_t i) const {
    const FaceCorner* loop = corners.data() + face.first;
    return {loop[i == 0 ? face.count - 1 : i - 1].edge, vertices[loop[i].vertex], loop[i].edge,
            face.plane.index()};
  }
};

/// PolyhedronSplitter splits polyhedra; it holds the record of the last decision and its workspace.
template <VolumeSpaceModel Space>
class PolyhedronSplitter {
 public:
  using Vertex = typename Space::Vertex;

  /// Asks the kernel for the side of every vertex. A polyhedron that has a face on `plane` lies on
  /// the inside of it (identity), without a question.
  Placement decide(Space& space, PlaneRef plane, const Polyhedron<Vertex>& polyhedron) {
    for (const PolyhedronFace& face : polyhedron.faces) {
      if (face.plane.same_plane(plane)) {
        return face.plane == plane ? Placement::kFront : Placement::kBack;
      }
    }
    sides_.resize(polyhedron.vertices.size());
    known_.assign(polyhedron.vertices.size(), false);
    bool front = false, back = false;
    for (const PolyhedronFace& face : polyhedron.faces) {
      for (std::uint32_t i = 0; i < face.count; ++i) {
        const std::uint32_t vertex = polyhedron.corners[face.first + i].vertex;
        if (known_[vertex]) continue;
        known_[vertex] = true;
        const Side side = space.side_of_plane(plane, polyhedron.corner(face, i));
        sides_[vertex] = side;
        front |= side == Side::kFront;
        back |= side == Side::kBack;
      }
    }
    if (front && back) return Placement::kSpanning;
    return front ? Placement::kFront : back ? Placement::kBack : Placement::kOn;
  }

  /// Makes both children of a polyhedron that the last decision called spanning. Their caps are not
  /// own faces.
  void split(const Space& space, PlaneRef plane, const Polyhedron<Vertex>& parent,
             Polyhedron<Vertex>& front, Polyhedron<Vertex>& back) {
    construct_crossings(space, plane, parent);
    make_child(plane, parent, Side::kFront, false, front);
    make_child(plane, parent, Side::kBack, false, back);
  }

  /// Keeps what is in front of `plane`, which may be nothing. `own`: the cap is a face of the
  /// volume itself.
  void clip(Space& space, PlaneRef plane, bool own, Polyhedron<Vertex>& polyhedron) {
    switch (decide(space, plane, polyhedron)) {
      case Placement::kFront:
        break;
      case Placement::kBack:
      case Placement::kOn:
        polyhedron.clear();
        break;
      case Placement::kSpanning:
        construct_crossings(space, plane, polyhedron);
        make_child(plane, polyhedron, Side::kFront, own, clipped_);
        std::swap(polyhedron, clipped_);
        break;
    }
  }

  /// Counts caps that did not close, faces and children that vanished: 0 on exact kernels.
  std::uint64_t findings() const { return findings_; }

 private:
  /// A vertex that the parent does not have: where its edge a-b, a < b, crosses the plane.
  struct Crossing {
    std::uint32_t a, b;
    std::uint32_t child = kUnset;  // its number in the child that is being made
    Vertex vertex;
  };
  /// An edge of the cap, in its direction there, and the plane of the other face that it is on.
  struct CapEdge {
    std::uint32_t from, to;
    PlaneRef face;
  };
  static constexpr std::uint32_t kUnset = 0xffffffffu;

  bool crosses(std::uint32_t from, std::uint32_t to) const {
    return sides_[from] != Side::kOn && sides_[to] == opposite(sides_[from]);
  }
  Crossing* find_crossing(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t a = std::min(from, to), b = std::max(from, to);
    for (Crossing& crossing : crossings_) {
      if (crossing.a == a && crossing.b == b) return &crossing;
    }
    return nullptr;
  }

  void construct_crossings(const Space& space, PlaneRef plane, const Polyhedron<Vertex>& parent) {
    crossings_.clear();
    for (const PolyhedronFace& face : parent.faces) {
      for (std::uint32_t i = 0; i < face.count; ++i) {
        const std::uint32_t next = i + 1 == face.count ? 0 : i + 1;
        const FaceCorner& here = parent.corners[face.first + i];
        const FaceCorner& there = parent.corners[face.first + next];
        if (!crosses(here.vertex, there.vertex)) continue;
        if (find_crossing(here.vertex, there.vertex) != nullptr) continue;
        crossings_.push_back({std::min(here.vertex, there.vertex),
                              std::max(here.vertex, there.vertex), kUnset,
                              space.crossing(plane, here.edge, sides_[here.vertex] == Side::kFront,
                                             parent.corner(face, i), parent.corner(face, next))});
      }
    }
  }

  void make_child(PlaneRef plane, const Polyhedron<Vertex>& parent, Side kept, bool own_cap,
                  Polyhedron<Vertex>& child) {
    const PlaneRef cut = kept == Side::kFront ? plane : -plane;
    child.clear();
    cap_.clear();
    numbers_.assign(parent.vertices.size(), kUnset);
    for (Crossing& crossing : crossings_) crossing.child = kUnset;
    for (const PolyhedronFace& face : parent.faces) add_face(parent, face, kept, cut, child);
    if (child.faces.empty()) {
      ++findings_;
      return;
    }
    if (!add_cap(cut, own_cap, child)) ++findings_;
  }

  /// Sutherland & Hodgman for one face, with what make_children of split.h says of the new edge. An
  /// edge that lies in the plane as it is becomes one of the cap, too.
  void add_face(const Polyhedron<Vertex>& parent, const PolyhedronFace& face, Side kept,
                PlaneRef cut, Polyhedron<Vertex>& child) {
    const std::span<const FaceCorner> loop = parent.loop(face);
    if (std::none_of(loop.begin(), loop.end(),
                     [&](const FaceCorner& corner) { return sides_[corner.vertex] == kept; })) {
      return;
    }
    const auto first = static_cast<std::uint32_t>(child.corners.size());
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const FaceCorner& corner = loop[i];
      const std::uint32_t next = loop[i + 1 == face.count ? 0 : i + 1].vertex;
      const Side here = sides_[corner.vertex], there = sides_[next];
      if (here != opposite(kept)) {
        const bool in_plane = here == Side::kOn && there != kept;
        child.corners.push_back(
            {number(parent, corner.vertex, child), in_plane ? cut : corner.edge});
      }
      if (crosses(corner.vertex, next)) {
        child.corners.push_back(
            {number(*find_crossing(corner.vertex, next), child), here == kept ? cut : corner.edge});
      }
    }
    const auto count = static_cast<std::uint32_t>(child.corners.size()) - first;
    if (count < 3) {
      child.corners.resize(first);
      ++findings_;
      return;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const FaceCorner& corner = child.corners[first + i];
      if (corner.edge != cut) continue;
      cap_.push_back(
          {child.corners[first + (i + 1 == count ? 0 : i + 1)].vertex, corner.vertex, face.plane});
    }
    child.faces.push_back({face.plane, first, count, face.own});
  }

  std::uint32_t number(const Polyhedron<Vertex>& parent, std::uint32_t vertex,
                       Polyhedron<Vertex>& child) {
    if (numbers_[vertex] == kUnset) {
      numbers_[vertex] = static_cast<std::uint32_t>(child.vertices.size());
      child.vertices.push_back(parent.vertices[vertex]);
    }
    return numbers_[vertex];
  }
  static std::uint32_t number(Crossing& crossing, Polyhedron<Vertex>& child) {
    if (crossing.child == kUnset) {
      crossing.child = static_cast<std::uint32_t>(child.vertices.size());
      child.vertices.push_back(crossing.vertex);
    }
    return crossing.child;
  }

  /// Whether the edges in the plane form one loop.
  bool add_cap(PlaneRef cut, bool own, Polyhedron<Vertex>& child) {
    if (cap_.size() < 3) return false;
    const auto first = static_cast<std::uint32_t>(child.corners.size());
    std::uint32_t at = cap_.front().from;
    for (std::size_t done = 0; done < cap_.size(); ++done) {
      const auto next = std::find_if(cap_.begin() + static_cast<std::ptrdiff_t>(done), cap_.end(),
                                     [&](const CapEdge& edge) { return edge.from == at; });
      if (next == cap_.end()) break;
      child.corners.push_back({at, next->face});
      at = next->to;
      std::iter_swap(next, cap_.begin() + static_cast<std::ptrdiff_t>(done));
    }
    const auto count = static_cast<std::uint32_t>(child.corners.size()) - first;
    if (count != cap_.size() || at != cap_.front().from) {
      child.corners.resize(first);
      return false;
    }
    child.faces.push_back({cut, first, count, own});
    return true;
  }

  std::vector<Side> sides_;
  std::vector<bool> known_;
  std::vector<Crossing> crossings_;
  std::vector<CapEdge> cap_;
  std::vector<std::uint32_t> numbers_;  // of the parent's vertices in the child
  Polyhedron<Vertex> clipped_;
  std::uint64_t findings_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_POLYHEDRON_H
