// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle on meshes of shaded faces: T-vertices, and how far the shade jumps there.
//
// A T-vertex is a corner of one face that lies strictly inside an edge of another, where both have
// an edge on that line, and that is no corner of the other. Interpolated shading has one value
// there on this side of the edge and another on that side: the discontinuity that 1992 ("Discussion
// and Implementation") inserts vertices to prevent; and where corners are rounded, a crack. So a
// mesh must have none at all, however fine; a partition into classes (candidate.h) may have them,
// since they change no class of any point, and is told their number only.
//
// Exactness: found in rational numbers, each line by its own coordinates; the jump is in doubles.
// Shares nothing with what makes the mesh.
#ifndef GNOMON_ORACLE_MESH_CHECK_H
#define GNOMON_ORACLE_MESH_CHECK_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gnomon/result/claims.h"

namespace gnomon::oracle {

struct MeshFaceClaim {
  std::string polygon;
  Side side = Side::kFront;
  bool dark = false;  // umbra of every light: its shade is its own and meets no neighbour's
  std::vector<RationalPoint> loop;  // in order, not closed; corners between collinear edges count
  std::vector<double> shades;       // of its corners; may be empty
};

struct TVertex {
  RationalPoint point;
  std::size_t face = 0;       // on whose edge it lies, index into the faces
  std::size_t edge = 0;       // from that corner of the face to the next
  std::size_t neighbour = 0;  // a face that has it as a corner
  /// Between the neighbour's shade at the point and what is interpolated along the edge; 0 where
  /// the faces are not of one polygon side, or one of them is dark, or no shades are given.
  double jump = 0;
};

struct MeshReport {
  std::uint64_t t_vertices = 0;  // pairs of an edge and a point
  std::vector<TVertex> worst;    // at most `most`, the largest jump first
  double largest_jump = 0;
  std::uint64_t faces = 0, edges = 0;
};

/// Cost: O(n log n) exact operations for n edges, and one for each T-vertex.
MeshReport check_mesh(std::span<const MeshFaceClaim> faces, std::size_t most = 16);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_MESH_CHECK_H
