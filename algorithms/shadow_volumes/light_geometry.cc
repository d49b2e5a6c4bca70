// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shadow_volumes/light_geometry.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernel/numbers/exact_integer.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {
namespace {

using GridPoint = std::array<mpz_class, 3>;

class Builder {
 public:
  explicit Builder(const PreparedScene& scene) {
    result_.scene = &scene;
    result_.geometry = scene.geometry;
    first_new_ = static_cast<VertexId>(scene.geometry.positions.size());
  }

  LightGeometry build() {
    const PreparedScene& scene = *result_.scene;
    for (const PreparedLight& light : scene.lights) {
      LightFace face;
      if (light.has_area()) {
        for (const GridPoint& point : light.area_loop) face.loop.push_back(vertex(point));
      } else if (light.is_point()) {
        face.loop.push_back(vertex(light.point.grid));
      }
      result_.faces.push_back(std::move(face));
    }
    put_positions();
    reserve_edges_and_planes();
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
      if (scene.lights[i].has_area()) complete(result_.faces[i]);
    }
    return std::move(result_);
  }

 private:
  VertexId vertex(const GridPoint& point) {
    const GridPositions& grid = result_.geometry.grid;
    const LowBits low = low_bits(point);
    for (VertexId v = 0; v < grid.size(); ++v) {
      if (low_bits(v) == low && at(v) == point) return v;
    }
    const auto found = std::find(added_.begin(), added_.end(), point);
    if (found == added_.end()) {
      added_.push_back(point);
      return first_new_ + static_cast<VertexId>(added_.size() - 1);
    }
    return first_new_ + static_cast<VertexId>(found - added_.begin());
  }

  void put_positions() {
    if (added_.empty()) return;
    Geometry& geometry = result_.geometry;
    geometry.positions.reserve(geometry.positions.size() + added_.size());
    for (const GridPoint& point : added_) {
      std::array<double, 3> nearest{};
      for (int k = 0; k < 3; ++k) {
        nearest[k] =
            nearest_double(mpq_class(geometry.origin[k] + geometry.step * mpq_class(point[k])));
      }
      geometry.positions.push_back(nearest);
    }
    geometry.grid = with_added(geometry.grid);
    geometry.light_vertices += static_cast<std::uint32_t>(added_.size());
  }

  /// A list that grows by one more takes twice its memory.
  void reserve_edges_and_planes() {
    std::size_t edges = 0, planes = 0;
    for (const LightFace& face : result_.faces) {
      if (face.loop.size() < 2) continue;
      edges += face.loop.size();
      ++planes;
    }
    Geometry& geometry = result_.geometry;
    geometry.edges.reserve(geometry.edges.size() + edges);
    geometry.planes.reserve(geometry.planes.size() + planes);
  }

  GridPositions with_added(const GridPositions& grid) const {
    const auto is_narrow = [](const GridPoint& point) {
      return std::ranges::all_of(
          point, [](const mpz_class& x) { return sgn(x) >= 0 && x.fits_slong_p(); });
    };
    const std::size_t size = 3 * (grid.size() + added_.size());
    if (grid.is_narrow() && std::ranges::all_of(added_, is_narrow)) {
      std::vector<std::int64_t> all;
      all.reserve(size);
      if (grid.size() > 0) {
        all.assign(grid.narrow_point(0), grid.narrow_point(0) + 3 * grid.size());
      }
      for (const GridPoint& point : added_) {
        for (const mpz_class& x : point) all.push_back(x.get_si());
      }
      return GridPositions::from_narrow(std::move(all));
    }
    std::vector<mpz_class> all;
    all.reserve(size);
    for (VertexId v = 0; v < grid.size(); ++v) {
      for (int k = 0; k < 3; ++k) all.push_back(grid.at(v, k));
    }
    for (const GridPoint& point : added_) all.insert(all.end(), point.begin(), point.end());
    return GridPositions::from(std::move(all));
  }

  void complete(LightFace& face) {
    const std::size_t n = face.loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      face.edges.push_back(edge(face.loop[i], face.loop[(i + 1) % n]));
    }
    face.plane = plane(wide_triple(face.loop), face.flipped);
  }

  /// Three corners that are far apart, in the loop's order, since rounded kernels have the light's
  /// plane from them; the same wherever the loop begins, so that places and no numbers decide
  /// between corners that are as far.
  SupportTriple wide_triple(const std::vector<VertexId>& loop) const {
    const auto square = [](const Vector3<mpz_class>& v) { return dot(v, v); };
    const auto farthest = [&](const auto& measure) {
      std::size_t best = 0;
      mpz_class most = measure(loop[0]);
      for (std::size_t i = 1; i < loop.size(); ++i) {
        mpz_class own = measure(loop[i]);
        if (own > most || (own == most && at(loop[i]) < at(loop[best]))) {
          best = i;
          most = std::move(own);
        }
      }
      return best;
    };
    const auto by_place = [&](VertexId v, VertexId w) { return at(v) < at(w); };
    const VertexId first = *std::min_element(loop.begin(), loop.end(), by_place);
    const std::size_t a =
        farthest([&](VertexId v) { return square(difference(at(v), at(first))); });
    const std::size_t b =
        farthest([&](VertexId v) { return square(difference(at(v), at(loop[a]))); });
    const std::size_t c = farthest([&](VertexId v) {
      return square(normal({loop[a], loop[b], v}));
    });
    std::array<std::size_t, 3> corners{a, b, c};
    std::sort(corners.begin(), corners.end());
    return {loop[corners[0]], loop[corners[1]], loop[corners[2]]};
  }

  PlaneRef edge(VertexId from, VertexId to) {
    const EdgeEnds ends{std::min(from, to), std::max(from, to)};
    std::vector<EdgeEnds>& edges = result_.geometry.edges;
    // An edge that polygons share with the light has two vertices that they share.
    auto found = edges.end();
    if (ends.b < first_new_) found = std::find(edges.begin(), edges.end(), ends);
    for (auto e = edges.begin() + static_cast<std::ptrdiff_t>(result_.scene->geometry.edges.size());
         found == edges.end() && e != edges.end(); ++e) {
      if (*e == ends) found = e;
    }
    const auto index = static_cast<EdgeId>(found - edges.begin());
    if (found == edges.end()) edges.push_back(ends);
    return PlaneRef(index, from > to);
  }

  // Numbers modulo 2^64. What is equal, or zero, is so modulo 2^64: nearly all vertices and planes
  // of a scene are told from the light's by that alone.
  using LowBits = std::array<std::uint64_t, 3>;
  static std::uint64_t low_bits(const mpz_class& x) {
    const std::uint64_t magnitude = mpz_get_ui(x.get_mpz_t());
    return sgn(x) < 0 ? -magnitude : magnitude;
  }
  static LowBits low_bits(const GridPoint& point) {
    return {low_bits(point[0]), low_bits(point[1]), low_bits(point[2])};
  }
  LowBits low_bits(VertexId v) const {
    const GridPositions& grid = result_.geometry.grid;
    LowBits low{};
    for (int k = 0; k < 3; ++k) {
      low[k] = grid.is_narrow() ? static_cast<std::uint64_t>(grid.narrow(v, k))
                                : low_bits(grid.wide(v, k));
    }
    return low;
  }
  static LowBits low_difference(const LowBits& a, const LowBits& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
  static std::uint64_t sum_of_products(const LowBits& a, const LowBits& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  Vector3<mpz_class> at(VertexId v) const {
    const GridPositions& grid = result_.geometry.grid;
    return {grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)};
  }
  Vector3<mpz_class> normal(const SupportTriple& t) const {
    return cross(difference(at(t.b), at(t.a)), difference(at(t.c), at(t.a)));
  }

  PlaneId plane(const SupportTriple& triple, bool& flipped) {
    std::vector<SupportTriple>& planes = result_.geometry.planes;
    const Vector3<mpz_class> n = normal(triple), origin = at(triple.a);
    const LowBits low_n = low_bits(n), low_origin = low_bits(origin);
    const auto contains = [&](VertexId v) {
      return sum_of_products(low_n, low_difference(low_bits(v), low_origin)) == 0 &&
             sgn(dot(n, difference(at(v), origin))) == 0;
    };
    for (PlaneId id = 0; id < planes.size(); ++id) {
      if (!contains(planes[id].a) || !contains(planes[id].b) || !contains(planes[id].c)) continue;
      flipped = sgn(dot(n, normal(planes[id]))) < 0;
      return id;
    }
    flipped = false;
    planes.push_back(triple);
    return static_cast<PlaneId>(planes.size() - 1);
  }

  LightGeometry result_;
  VertexId first_new_ = 0;
  std::vector<GridPoint> added_;
};

}  // namespace

LightGeometry make_light_geometry(const PreparedScene& scene) { return Builder(scene).build(); }

}  // namespace gnomon
