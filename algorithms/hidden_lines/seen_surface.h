// SPDX-License-Identifier: LGPL-3.0-or-later
// What a viewer sees of a scene besides the edges that are asked about: the polygons that face it
// and hide, and the contour of them all, each in a tree of boxes.
#ifndef GNOMON_ALGORITHMS_HIDDEN_LINES_SEEN_SURFACE_H
#define GNOMON_ALGORITHMS_HIDDEN_LINES_SEEN_SURFACE_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/hidden_lines/sight_shaft.h"
#include "algorithms/hidden_lines/view_signs.h"
#include "algorithms/partition/box_tree.h"
#include "gnomon/algorithms/facing_chain.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// A vertex of a convex part and the next, counter-clockwise as seen from the viewer.
struct DirectedEdge {
  VertexId from = 0, to = 0;
};

struct SeenPart {
  std::uint32_t part = 0;
  bool sees_back = false;  // the viewer is behind the part's front
  int viewer_side = 0;     // of the geometry's plane: 1 in front of it, -1 behind
};

class SeenSurface {
 public:
  /// Keeps references to the scene and the light.
  SeenSurface(const PreparedScene& scene, const PreparedLight& light);

  const PreparedScene& scene() const { return scene_; }
  const ViewSigns& signs() const { return signs_; }
  std::span<const SeenPart> parts() const { return parts_; }
  std::span<const ContourEdge> contour() const { return contour_; }
  EdgeEnds ends(EdgeId edge) const { return scene_.geometry.edges[edge]; }

  /// Edge k of a part's loop.
  DirectedEdge edge(const SeenPart& seen, std::uint32_t k) const;
  std::uint32_t edge_count(const SeenPart& seen) const { return scene_.parts[seen.part].count; }
  /// 1: the vertex is between the viewer and the part's plane or further in front; 0: in the plane;
  /// -1: behind it.
  int side(const SeenPart& seen, VertexId vertex) const;
  /// The same side times a distance, in a unit of the part's.
  mpz_class exact_side(const SeenPart& seen, VertexId vertex) const;

  /// Appends the places in contour() that may meet the closed triangle between edge and viewer.
  void find_contour(const SightShaft& shaft, std::vector<std::uint32_t>& found) const;
  /// Appends the places in parts() that may meet it.
  void find_parts(const SightShaft& shaft, std::vector<std::uint32_t>& found) const;
  /// Appends the places in parts() that may meet the segment.
  void find_parts_on(VertexId a, VertexId b, std::vector<std::uint32_t>& found) const;
  SightShaft shaft(VertexId a, VertexId b) const { return {near_, a, b}; }

 private:
  const PreparedScene& scene_;
  ViewSigns signs_;
  NearPositions near_;
  std::vector<SeenPart> parts_;
  std::vector<ContourEdge> contour_;
  BoxTree part_tree_, contour_tree_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_HIDDEN_LINES_SEEN_SURFACE_H
