// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/painters_order.h"

#include <algorithm>
#include <numeric>

#include "algorithms/scene_bsp/scene_bsp.h"
#include "algorithms/scene_bsp/scene_bsp.inl.h"
#include "kernel/implicit/implicit_scene_space.h"

namespace gnomon {

std::vector<OrderedPiece> back_to_front(const PreparedScene& scene,
                                        const std::array<double, 3>& eye) {
  using Space = ImplicitSceneSpace<NoStats>;
  Space space(scene.geometry, {});
  std::vector<std::uint32_t> parts(scene.parts.size());
  std::iota(parts.begin(), parts.end(), 0u);
  const auto bsp = build_scene_bsp(space, scene, parts, 1, true);
  std::array<mpq_class, 3> grid_eye;
  for (int k = 0; k < 3; ++k) {
    grid_eye[k] = (mpq_class(eye[k]) - scene.geometry.origin[k]) / scene.geometry.step;
  }
  const ExactGeometry<mpz_class> exact(scene.geometry);
  std::vector<std::uint32_t> order = front_to_back(bsp.nodes, [&](PlaneId id) {
    const ExactPlane<mpz_class> plane = exact.plane(id);
    mpq_class value = -plane.d;
    for (int k = 0; k < 3; ++k) value += plane.n[k] * grid_eye[k];
    return sign_of(value);
  });
  std::reverse(order.begin(), order.end());
  std::vector<OrderedPiece> pieces;
  for (const std::uint32_t node : order) {
    const BspNode& at = bsp.nodes[node];
    const std::size_t first = pieces.size();
    for (std::uint32_t i = 0; i < at.count; ++i) {
      const LoopRange& range = bsp.pieces[bsp.node_pieces[at.first + i]];
      OrderedPiece piece{range.part, {}};
      for (std::uint32_t v = 0; v < range.count; ++v) {
        const auto& vertex = bsp.loops.vertex(range.first + v);
        piece.loop.push_back(vertex.source != kMadeVertex ? scene.geometry.positions[vertex.source]
                                                          : space.approximate(vertex));
      }
      pieces.push_back(std::move(piece));
    }
    std::stable_sort(pieces.begin() + static_cast<std::ptrdiff_t>(first), pieces.end(),
                     [](const OrderedPiece& a, const OrderedPiece& b) { return a.part < b.part; });
  }
  return pieces;
}

}  // namespace gnomon
