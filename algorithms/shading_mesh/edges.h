// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges of the faces of a shading mesh, and vertices put into them: an edge is a pair of vertices,
// and what is inserted between the two is inserted in every face that has this edge. So there are
// no T-vertices afterwards if there were none before. fit_edges() removes those that are there at
// first, by the lines that edges lie on.
//
// Exactness: lines are compared by their Pluecker coordinates, made primitive.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_EDGES_H
#define GNOMON_ALGORITHMS_SHADING_MESH_EDGES_H

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/shading_mesh/points.h"
#include "gnomon/algorithms/shading_mesh.h"

namespace gnomon {

/// Faces with their loops of vertex numbers; MeshFace::first counts in `corners`.
struct FaceLoops {
  std::vector<MeshFace> faces;
  std::vector<std::uint32_t> corners;

  std::span<const std::uint32_t> loop(const MeshFace& face) const {
    return {corners.data() + face.first, face.count};
  }
  /// Appends a face of the same side and classes as `like`.
  void add(MeshFace like, std::span<const std::uint32_t> loop);
};

/// The distinct edges of faces, sorted, each from its smaller vertex number to its larger one.
class EdgeList {
 public:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// `takes`: whether it has the edges of a face, by the face's number.
  EdgeList(const FaceLoops& loops, const std::function<bool(std::size_t)>& takes);

  std::size_t size() const { return edges_.size(); }
  std::uint32_t from(std::size_t edge) const {
    return static_cast<std::uint32_t>(edges_[edge] >> 32);
  }
  std::uint32_t to(std::size_t edge) const { return static_cast<std::uint32_t>(edges_[edge]); }
  /// kNone if it is not in the list.
  std::size_t find(std::uint32_t a, std::uint32_t b) const;

 private:
  std::vector<std::uint64_t> edges_;
};

/// Returns the loops with vertices put into their edges; inserted[e]: those of edge e, in order
/// from its smaller vertex to its larger one. Edges that are not in the list stay as they are.
FaceLoops insert_vertices(const FaceLoops& loops, const EdgeList& edges,
                          const std::vector<std::vector<std::uint32_t>>& inserted);

/// Inserts, into every edge, the ends of all edges on the same line that lie inside it.
FaceLoops fit_edges(const FaceLoops& loops, const PointTable& points);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_EDGES_H
