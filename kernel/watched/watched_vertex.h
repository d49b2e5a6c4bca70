// SPDX-License-Identifier: LGPL-3.0-or-later
// A vertex that two kernels have: as the exact one has it, as the rounded one does, and the planes
// that it was made from, by which it is known.
//
// In a run with a flipped decision an edge may be cut where no point of it is on the plane, and a
// vertex may be said to be on a plane that misses it. Kernel `plane` would then find the vertex
// where the planes of its corner meet, far away or nowhere. So a made vertex keeps the planes of
// its making there, and what is cut because of a flip is cut in the vertex that was flipped: a
// rounded kernel, which believes that vertex to be on the other side by a hair, cuts there, too.
#ifndef GNOMON_KERNEL_WATCHED_WATCHED_VERTEX_H
#define GNOMON_KERNEL_WATCHED_WATCHED_VERTEX_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <utility>

#include "kernel/watched/decision_watch.h"

namespace gnomon {

template <class Exact>
struct WatchedVertex {
  Exact exact{};
  WideVertex tested;
  VertexId source = kMadeVertex;
  PlaneId support = 0;
  PlaneRef before, after;  // of its making; made vertices only
  std::uint64_t hash = 0;  // of what it was made from
};

/// The exact point in a rounded kernel's numbers: of a vertex that this kernel would not have made,
/// since it finds the ends of the edge on no two sides.
inline WideVertex rounded_vertex(const std::array<mpq_class, 3>& point) {
  WideVertex vertex;
  for (std::size_t k = 0; k < 3; ++k) {
    const double high = point[k].get_d();
    const mpq_class rest = point[k] - mpq_class(high);
    vertex.x[k] = static_cast<long double>(high) + static_cast<long double>(rest.get_d());
  }
  return vertex;
}

inline std::array<double, 3> nearest_doubles_of(const WideVertex& vertex) {
  return {static_cast<double>(vertex.x[0]), static_cast<double>(vertex.x[1]),
          static_cast<double>(vertex.x[2])};
}

/// A corner by the planes by which kernel `plane` is to know it: in a flipped run those of the
/// making of a made vertex, else those of its loop. Planes are a stack, so that those of the making
/// may be gone and their numbers be of others: `hash(corner)` is that of a made vertex whose planes
/// these are, or 0 if there are none of these numbers.
template <class Vertex, class Hash>
Corner<Vertex> known_corner(const Corner<Vertex>& loop_corner, bool flips, const Hash& hash) {
  const Vertex& vertex = loop_corner.vertex;
  if (!flips || vertex.source != kMadeVertex || !vertex.before.valid()) return loop_corner;
  const Corner<Vertex> made{vertex.before, vertex, vertex.after, vertex.support};
  return hash(made) == vertex.hash ? made : loop_corner;
}

/// The planes of a vertex on `edge`, which leaves the front of `plane` or enters it, in a loop of
/// `support`.
template <class Vertex>
void name_making(Vertex& vertex, PlaneRef plane, PlaneRef edge, bool leaving, PlaneId support) {
  vertex.support = support;
  vertex.before = leaving ? edge : plane;
  vertex.after = leaving ? plane : edge;
}

/// A hash of a made vertex from the hashes of the two planes of its edges. The same whichever comes
/// first, with the sign that tells the vertex from its antipode.
inline std::uint64_t hash_of_made(std::uint64_t before, std::uint64_t after, bool opposed,
                                  std::uint64_t support) {
  if (before > after) {
    std::swap(before, after);
    opposed = !opposed;
  }
  return mixed(mixed(mixed(before, after), opposed ? 1 : 2), support);
}
inline std::uint64_t hash_of_input(VertexId vertex) { return mixed(0x76657274u, vertex); }

}  // namespace gnomon

#endif  // GNOMON_KERNEL_WATCHED_WATCHED_VERTEX_H
