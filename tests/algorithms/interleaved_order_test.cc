// SPDX-License-Identifier: GPL-3.0-or-later
// The order of interleaved trees, from the definition: whatever hides a point of the light from a
// point of a piece has cast when the piece receives. Segments are met with polygons in rational
// numbers of the test's own. That the order of a lamp in the light's middle does not have that
// property shows that the property asks for something.
#include "algorithms/volume_trees/interleaved_order.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "algorithms/scene_bsp/scene_bsp.inl.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/scene/prepare.h"
#include "kernel/coordinate/coordinate_volume_space.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // pens

using Space = CoordinateVolumeSpace<mpq_class>;
using Point = std::array<mpq_class, 3>;

Point minus(const Point& a, const Point& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
mpq_class determinant(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}
/// On which side of the plane through a, b, c, in sixths of a volume.
mpq_class side_of(const Point& a, const Point& b, const Point& c, const Point& p) {
  return determinant(minus(b, a), minus(c, a), minus(p, a));
}
Point point_of(const Position& position) {
  return {position[0].exact(), position[1].exact(), position[2].exact()};
}
Point middle_of(const std::vector<Point>& points) {
  Point middle{};
  for (const Point& point : points) {
    for (std::size_t k = 0; k < 3; ++k) middle[k] += point[k] / points.size();
  }
  return middle;
}

std::vector<std::uint32_t> all_parts(const PreparedScene& scene) {
  std::vector<std::uint32_t> parts(scene.parts.size());
  std::iota(parts.begin(), parts.end(), 0u);
  return parts;
}

/// Light 0 is a panel; light 1 a lamp in its middle.
struct Orders {
  explicit Orders(Scene made) : scene(with_lamp(std::move(made))), prepared(*prepare(scene)) {
    nodes = build_scene_bsp(scene_space, prepared, all_parts(prepared), 1, true).nodes;
  }
  static Scene with_lamp(Scene scene) {
    std::vector<Point> corners;
    for (const Position& corner : scene.lights[0].loop) corners.push_back(point_of(corner));
    Light& lamp = scene.lights.emplace_back();
    lamp.id = "lamp";
    const Point middle = middle_of(corners);
    for (std::size_t k = 0; k < 3; ++k) lamp.position[k] = Number(middle[k].get_d());
    return scene;
  }
  std::vector<Point> loop_of(std::uint32_t part) const {
    std::vector<Point> loop;
    for (const VertexId vertex : prepared.loop(prepared.parts[part])) {
      const auto& at = prepared.geometry.positions[vertex];
      loop.push_back({mpq_class(at[0]), mpq_class(at[1]), mpq_class(at[2])});
    }
    return loop;
  }
  /// Whether a part has a point strictly between p and a.
  bool hides(std::uint32_t part, const Point& p, const Point& a) const {
    const std::vector<Point> loop = loop_of(part);
    const int at_p = sgn(side_of(loop[0], loop[1], loop[2], p)),
              at_a = sgn(side_of(loop[0], loop[1], loop[2], a));
    if (at_p * at_a >= 0) return false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int side = sgn(side_of(p, loop[i], loop[(i + 1) % loop.size()], a));
      if (side == 0 || (side > 0) != (sgn(side_of(p, loop[0], loop[1], a)) > 0)) return false;
    }
    return true;
  }

  Scene scene;
  PreparedScene prepared;
  LightGeometry geometry = make_light_geometry(prepared);
  Space::SceneSpace scene_space{geometry.geometry, KernelOptions{}};
  Space space{scene_space, KernelOptions{}};
  CasterTree tree{geometry.geometry, prepared, all_parts(prepared)};
  std::vector<BspNode> nodes;
};

struct Found {
  std::uint64_t missed = 0;   // hidden by what has not cast yet
  std::uint64_t met = 0;      // by what has
  std::uint64_t waiting = 0;  // pieces
};

/// Follows the order of one light, and looks at what hides the panel.
Found follow(Orders& orders, std::uint32_t light) {
  const Rules rules;
  const LightInSpace<Space> own(orders.space, orders.geometry, orders.tree, light, rules),
      panel(orders.space, orders.geometry, orders.tree, 0, rules);
  const InterleavedOrder<Space> order(orders.space, own, orders.prepared, orders.nodes, rules);
  std::vector<Point> corners, samples;
  for (const Position& corner : orders.scene.lights[0].loop) corners.push_back(point_of(corner));
  const Point middle = middle_of(corners);
  for (const Point& corner : corners)
    samples.push_back(middle_of({corner, corner, corner, middle}));
  std::vector<bool> has_cast(orders.prepared.parts.size(), false);
  Found found;
  found.waiting = order.waiting();
  order.visit(
      [&](const LoopView<Space::Vertex>& piece) {
        const std::vector<Point> own_loop = orders.loop_of(piece.part);
        int front = 0, back = 0;
        for (const Point& corner : corners) {
          const int side = sgn(side_of(own_loop[0], own_loop[1], own_loop[2], corner));
          front += side > 0 ? 1 : 0;
          back += side < 0 ? 1 : 0;
        }
        if (front > 0 && back > 0) return true;  // never goes down the trees
        std::vector<Point> points;
        for (std::uint32_t i = 0; i < piece.size(); ++i) {
          points.push_back(orders.space.exact_position(piece.corner(i)));
        }
        const Point centre = middle_of(points);
        points.push_back(centre);
        for (const Point& at : points) {
          const Point p = middle_of({at, centre, centre});
          for (std::uint32_t part = 0; part < orders.prepared.parts.size(); ++part) {
            const auto [begin, end] = panel.volumes_of(part);
            if (begin == end) continue;  // casts nothing
            for (const Point& a : samples) {
              if (part == piece.part || !orders.hides(part, p, a)) continue;
              ++(has_cast[part] ? found.met : found.missed);
            }
          }
        }
        return true;
      },
      [&](std::uint32_t volume) {
        has_cast[own.volumes()[volume].caster] = true;
        return true;
      });
  return found;
}

std::vector<Triple> ceiling(std::int64_t half, std::int64_t z) {
  return {{-half, -half, z}, {-half, half, z}, {half, half, z}, {half, -half, z}};
}
void floor(ScenePen& pen) {
  pen.polygon({{-40, -40, 0}, {40, -40, 0}, {40, 40, 0}, {-40, 40, 0}});
  pen.two_sided(true);
}

TEST(InterleavedOrder, ReceiversWaitWhereAPlaneCutsTheLight) {
  // Three upright boards below the light: each side of one sees some of the light over it.
  ScenePen pen;
  floor(pen);
  for (const std::int64_t x : {-4, 0, 4}) {
    pen.polygon({{x, -8, 2}, {x, 8, 2}, {x, 8, 12}, {x, -8, 12}});
  }
  Orders orders(pen.panel(ceiling(6, 20)).take());
  const Found panel = follow(orders, 0);
  EXPECT_EQ(panel.missed, 0u);
  EXPECT_GT(panel.met, 0u);
  EXPECT_GT(panel.waiting, 0u);
}

TEST(InterleavedOrder, NobodyWaitsWhereNoPlaneDoes) {
  ScenePen pen;
  floor(pen);
  pen.polygon({{-8, -4, 8}, {-2, -4, 8}, {-2, 4, 8}, {-8, 4, 8}});
  pen.polygon({{2, -4, 10}, {8, -4, 10}, {8, 4, 10}, {2, 4, 10}});
  Orders orders(pen.panel(ceiling(6, 20)).take());
  const Found panel = follow(orders, 0);
  EXPECT_EQ(panel.missed, 0u);
  EXPECT_GT(panel.met, 0u);
  EXPECT_EQ(panel.waiting, 0u);
}

TEST(InterleavedOrder, OnSoups) {
  std::uint64_t missed_by_lamps = 0, waiting = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    ScenePen pen;
    floor(pen);
    for (int i = 0; i < 6;) {
      std::array<Triple, 3> p{};
      for (Triple& point : p) {
        point = {random.between(-9, 9), random.between(-9, 9), random.between(1, 18)};
      }
      if (is_zero(cross(p[1] - p[0], p[2] - p[0]))) continue;
      pen.polygon({p[0], p[1], p[2]});
      ++i;
    }
    Orders orders(pen.panel(ceiling(6, 20)).take());
    const Found panel = follow(orders, 0);
    EXPECT_EQ(panel.missed, 0u) << seed;
    waiting += panel.waiting;
    missed_by_lamps += follow(orders, 1).missed;
  }
  EXPECT_GT(waiting, 0u);
  // Front to back from the middle of the light alone is not enough.
  EXPECT_GT(missed_by_lamps, 0u);
}

}  // namespace
}  // namespace gnomon::test
