// SPDX-License-Identifier: GPL-3.0-or-later
#include "views.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gnomon/scene/prepare.h"

namespace gnomon::bench {

Expected<PreparedView> view_from_a_corner(const Scene& scene, std::uint32_t size,
                                          ExactCamera& camera) {
  const auto prepared = prepare(scene);
  if (!prepared) return tl::unexpected(prepared.error());
  std::array<double, 3> low{}, high{};
  bool first = true;
  for (const VertexId v : prepared->loop_vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = prepared->geometry.positions[v][k];
      low[k] = first ? x : std::min(low[k], x);
      high[k] = first ? x : std::max(high[k], x);
    }
    first = false;
  }
  constexpr std::array<double, 3> kAway{0.62, -0.86, 0.62};
  CameraView view;
  double diagonal = 0;
  for (std::size_t k = 0; k < 3; ++k) diagonal = std::max(diagonal, high[k] - low[k]);
  Position eye;
  for (std::size_t k = 0; k < 3; ++k) {
    view.look_at[k] = (low[k] + high[k]) / 2;
    view.eye[k] = std::round(view.look_at[k] + 1.5 * diagonal * kAway[k]);
    eye[k] = Number(view.eye[k]);
  }
  view.width = view.height = size;
  view.field_of_view = fitting_field_of_view(*prepared, view);
  auto made = make_camera(eye, view);
  if (!made) return tl::unexpected(made.error());
  camera = *made;
  return prepare_view(scene, camera);
}

}  // namespace gnomon::bench
