// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <limits>

#include "peers/peer.h"

namespace gnomon::bench {

std::span<const Peer> peers() {
#if GNOMON_BENCH_PEERS
  constexpr double kNone = std::numeric_limits<double>::infinity();
  // CGAL is exact, so only the conversion to doubles rounds. Clipper rounds to 2^-29 of a
  // receiver's box, which is much of a thin polygon's area. Embree stops at a standard error of
  // 1e-4; five of them is an error once in two million runs.
  static const std::array<Peer, 3> kPeers{{{"CGAL Polygon_set_2", run_cgal, 1e-9, 1e-9},
                                           {"Clipper", run_clipper, 1e-6, kNone},
                                           {"Embree", run_embree, 5e-4, kNone}}};
  return kPeers;
#else
  return {};
#endif
}

std::vector<double> part_areas(const PreparedScene& scene) {
  std::vector<double> areas;
  areas.reserve(scene.parts.size());
  for (const Part& part : scene.parts) {
    const auto loop = scene.loop(part);
    const std::array<double, 3>& origin = scene.geometry.positions[loop[0]];
    std::array<double, 3> twice{};
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      std::array<double, 3> u, v;
      for (std::size_t k = 0; k < 3; ++k) {
        u[k] = scene.geometry.positions[loop[i]][k] - origin[k];
        v[k] = scene.geometry.positions[loop[i + 1]][k] - origin[k];
      }
      for (std::size_t k = 0; k < 3; ++k) {
        twice[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
      }
    }
    areas.push_back(std::hypot(twice[0], twice[1], twice[2]) / 2);
  }
  return areas;
}

}  // namespace gnomon::bench
