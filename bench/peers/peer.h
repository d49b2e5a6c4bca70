// SPDX-License-Identifier: GPL-3.0-or-later
// Other ways to the lit area of every polygon, as users of other libraries would compute it well:
// CGAL's Boolean set operations over exact constructions, Clipper in 64-bit integers, Embree's
// shadow rays. Built only with the option GNOMON_BENCH_PEERS; without it there are none.
//
// All start from the prepared scene and one point light, and use one thread. CGAL and Clipper work
// per receiver and are given the same culling of casters (caster_search.h).
#ifndef GNOMON_BENCH_PEERS_PEER_H
#define GNOMON_BENCH_PEERS_PEER_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon::bench {

struct PeerResult {
  std::vector<double> lit;  // fraction of each part's area, by part; empty: only the sum is known
  double lit_area = 0;      // of all parts, scene units squared
  double seconds = 0;       // CPU time from the prepared scene to the areas
  std::string work;         // such as "12,345 pairs"
};

struct Peer {
  std::string name;
  PeerResult (*run)(const PreparedScene& scene, std::uint32_t light);
  double sum_tolerance;   // relative, of lit_area: beyond it the peer or we are wrong
  double part_tolerance;  // of each fraction; infinite where the peer promises none
};

/// Those that were built.
std::span<const Peer> peers();

PeerResult run_cgal(const PreparedScene& scene, std::uint32_t light);
PeerResult run_clipper(const PreparedScene& scene, std::uint32_t light);
PeerResult run_embree(const PreparedScene& scene, std::uint32_t light);
/// 4,096 rays to every quadrangle that faces the light, 2,048 to a triangle: no polygon's own share
/// is known better than to one or two digits then.
PeerResult run_embree_rays(const PreparedScene& scene, std::uint32_t light);

/// Area of each part, scene units squared.
std::vector<double> part_areas(const PreparedScene& scene);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_PEERS_PEER_H
