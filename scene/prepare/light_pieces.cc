// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/light_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/geometry/loop_geometry.h"
#include "scene/prepare/prepare_lights.h"

namespace gnomon {

namespace {

using scene_detail::Vec3;
using Loop = std::vector<Vec3<mpz_class>>;

Loop as_loop(const std::vector<std::array<mpz_class, 3>>& points) {
  Loop loop;
  for (const std::array<mpz_class, 3>& point : points)
    loop.push_back({point[0], point[1], point[2]});
  return loop;
}

/// No point of `other` is beyond any edge of a convex loop. Requires: one plane with that normal.
bool holds(const Loop& loop, const Vec3<mpz_class>& normal, const Loop& other) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3<mpz_class> inward = cross(normal, loop[(i + 1) % loop.size()] - loop[i]);
    for (const Vec3<mpz_class>& point : other) {
      if (dot(inward, point - loop[i]) < 0) return false;
    }
  }
  return true;
}

/// Some edge of a convex loop has all of `other` on its outer side.
bool has_beyond(const Loop& loop, const Vec3<mpz_class>& normal, const Loop& other) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3<mpz_class> inward = cross(normal, loop[(i + 1) % loop.size()] - loop[i]);
    if (std::ranges::all_of(other, [&](const Vec3<mpz_class>& point) {
          return dot(inward, point - loop[i]) <= 0;
        })) {
      return true;
    }
  }
  return false;
}

class PieceMaker {
 public:
  PieceMaker(const Scene& scene, const PreparedScene& prepared,
             const std::vector<LightPiece>& pieces)
      : scene_(scene), prepared_(prepared), pieces_(pieces) {}

  Expected<SceneWithPieces> make() {
    result_.scene = scene_;
    result_.prepared = prepared_;
    result_.scene.lights.clear();
    result_.prepared.lights.clear();
    result_.prepared.light_notes.clear();
    refine();
    for (const LightPiece& piece : pieces_) {
      const bool known = std::ranges::any_of(scene_.lights, [&](const Light& light) {
        return light.id == piece.of && light.has_area();
      });
      if (!known) return wrong(piece, "the scene has no area light '" + piece.of + "'");
    }
    for (const PreparedLight& light : prepared_.lights) {
      if (auto added = add(light); !added) return tl::unexpected(added.error());
    }
    return std::move(result_);
  }

 private:
  static tl::unexpected<Error> wrong(const LightPiece& piece, std::string what) {
    return fail(ErrorCode::kGeometry, fmt::format("piece '{}': {}", piece.id, what),
                "a convex piece of an area light, exactly in its plane");
  }

  /// The least factor that makes the corners of all pieces whole numbers of the grid.
  void refine() {
    Geometry& geometry = result_.prepared.geometry;
    for (const LightPiece& piece : pieces_) {
      for (const auto& point : piece.loop) {
        for (std::size_t k = 0; k < 3; ++k) {
          mpq_class steps = (point[k] - geometry.origin[k]) / geometry.step;
          factor_ = lcm(factor_, steps.get_den());
        }
      }
    }
    if (factor_ == 1) return;
    std::vector<mpz_class> coordinates;
    for (VertexId vertex = 0; vertex < geometry.grid.size(); ++vertex) {
      for (int k = 0; k < 3; ++k) coordinates.push_back(geometry.grid.at(vertex, k) * factor_);
    }
    geometry.grid = GridPositions::from(std::move(coordinates));
    geometry.step /= mpq_class(factor_);
    result_.prepared.position_bits += static_cast<unsigned>(mpz_sizeinbase(factor_.get_mpz_t(), 2));
  }

  Expected<void> add(const PreparedLight& light) {
    const Light& own = scene_.lights[light.light];
    PreparedLight whole = light;
    if (!light.is_directional()) {
      for (mpz_class& coordinate : whole.point.grid) coordinate *= factor_;
    }
    for (auto& point : whole.area_loop) {
      for (mpz_class& coordinate : point) coordinate *= factor_;
    }
    std::vector<Loop> loops;
    for (const LightPiece& piece : pieces_) {
      if (piece.of != own.id) continue;
      auto loop = on_grid(piece, as_loop(whole.area_loop));
      if (!loop) return tl::unexpected(loop.error());
      add_light(own, light.light, piece, *loop);
      loops.push_back(std::move(*loop));
    }
    if (!loops.empty()) {
      check_tiling(own.id, as_loop(whole.area_loop), loops);
      return {};
    }
    whole.light = static_cast<std::uint32_t>(result_.scene.lights.size());
    result_.scene.lights.push_back(own);
    result_.prepared.lights.push_back(std::move(whole));
    result_.source.push_back(light.light);
    return {};
  }

  /// Without vertices that are on a line with their neighbours.
  Expected<Loop> on_grid(const LightPiece& piece, const Loop& whole) const {
    const Geometry& geometry = result_.prepared.geometry;
    Loop loop;
    std::vector<std::size_t> kept;
    for (const auto& point : piece.loop) {
      std::array<mpz_class, 3> steps;
      for (std::size_t k = 0; k < 3; ++k) {
        steps[k] = mpq_class((point[k] - geometry.origin[k]) / geometry.step).get_num();
      }
      kept.push_back(loop.size());
      loop.push_back({steps[0], steps[1], steps[2]});
    }
    scene_detail::drop_needless(kept, loop);
    if (loop.size() < 3) return wrong(piece, "it has no area");
    const Vec3<mpz_class> normal = area_vector(whole), area = area_vector(loop);
    if (!lies_in_plane(loop, whole[0], normal)) {
      return wrong(piece, "it is not in the plane of '" + piece.of + "'");
    }
    if (dot(area, normal) <= 0)
      return wrong(piece, "it faces away from the front of '" + piece.of + "'");
    if (!is_convex(loop, area)) return wrong(piece, "it is not convex");
    if (!holds(whole, normal, loop)) return wrong(piece, "it leaves '" + piece.of + "'");
    return loop;
  }

  void add_light(const Light& own, std::uint32_t source, const LightPiece& piece,
                 const Loop& loop) {
    Light& light = result_.scene.lights.emplace_back(own);
    light.id = piece.id;
    light.loop.clear();
    for (const auto& point : piece.loop) {
      light.loop.push_back(
          {Number(point[0].get_d()), Number(point[1].get_d()), Number(point[2].get_d())});
    }
    PreparedLight prepared;
    prepared.light = static_cast<std::uint32_t>(result_.scene.lights.size() - 1);
    prepared.type = LightType::kArea;
    for (const Vec3<mpz_class>& point : loop) {
      prepared.area_loop.push_back({point.x, point.y, point.z});
    }
    result_.prepared.lights.push_back(std::move(prepared));
    result_.source.push_back(source);
  }

  void check_tiling(const std::string& id, const Loop& whole, const std::vector<Loop>& loops) {
    const Vec3<mpz_class> normal = area_vector(whole);
    Vec3<mpz_class> sum{0, 0, 0};
    bool apart = true;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      sum = sum + area_vector(loops[i]);
      for (std::size_t j = 0; j < i; ++j) {
        apart = apart &&
                (has_beyond(loops[i], normal, loops[j]) || has_beyond(loops[j], normal, loops[i]));
      }
    }
    if (!apart) result_.gaps.push_back(fmt::format("pieces of light '{}' overlap", id));
    if (!(sum - normal).is_zero()) {
      result_.gaps.push_back(fmt::format("the pieces of light '{}' do not add up to it", id));
    }
  }

  const Scene& scene_;
  const PreparedScene& prepared_;
  const std::vector<LightPiece>& pieces_;
  mpz_class factor_ = 1;
  SceneWithPieces result_;
};

}  // namespace

Expected<SceneWithPieces> with_light_pieces(const Scene& scene, const PreparedScene& prepared,
                                            const std::vector<LightPiece>& pieces) {
  return PieceMaker(scene, prepared, pieces).make();
}

}  // namespace gnomon
