// SPDX-License-Identifier: GPL-3.0-or-later
// The scene BSP on an exact kernel, held directly: the pieces of each part tile it; each lies in
// its node's plane and, of every node above, strictly on the side that its place says; pieces of
// one plane are in one group or apart; and nothing in the front-to-back order hides what comes
// before it, which is found pair by pair in rationals, from the planes that the pieces' corners
// name. Two programs include this, since CGAL brings compiler flags of its own.
#ifndef GNOMON_TESTS_ALGORITHMS_SCENE_BSP_ORDER_TEST_H
#define GNOMON_TESTS_ALGORITHMS_SCENE_BSP_ORDER_TEST_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/scene_bsp/scene_bsp.h"
#include "algorithms/scene_bsp/scene_bsp.inl.h"
#include "exact_space.h"
#include "fuzz/generate/families.h"
#include "fuzz/generate/soups.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"
#include "scene/base/random.h"

namespace gnomon::test {

/// A tree with its pieces in rationals, on the grid.
struct RationalBsp {
  std::vector<BspNode> nodes;
  std::vector<std::int32_t> parent;  // of each node
  struct Piece {
    std::uint32_t node, part;
    RationalLoop loop;
  };
  std::vector<Piece> pieces;  // those in nodes
};

inline RationalPlane support_plane(const PreparedScene& scene, PlaneId id) {
  const SupportTriple& triple = scene.geometry.planes[id];
  return plane_of({grid_position(scene, triple.a), grid_position(scene, triple.b),
                   grid_position(scene, triple.c)});
}

inline Rational3 meeting_point(const RationalPlane& a, const RationalPlane& b,
                               const RationalPlane& c) {
  const Rational3 bc = cross_product(b.normal, c.normal), ca = cross_product(c.normal, a.normal),
                  ab = cross_product(a.normal, b.normal);
  const mpq_class determinant = dot_product(a.normal, bc);
  Rational3 point;
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = (a.offset * bc[k] + b.offset * ca[k] + c.offset * ab[k]) / determinant;
  }
  return point;
}

/// Where a corner is, from what it names and nothing that the kernel computed.
template <class Vertex>
Rational3 corner_position(const PreparedScene& scene, const SceneEdges& names,
                          const Corner<Vertex>& corner) {
  if (corner.vertex.source != kMadeVertex) return grid_position(scene, corner.vertex.source);
  const auto on_edge = [&](PlaneRef edge, PlaneRef cut) {
    const EdgeEnds& ends = scene.geometry.edges[names.edge(edge)];
    const Rational3 a = grid_position(scene, ends.a), b = grid_position(scene, ends.b);
    const RationalPlane plane = support_plane(scene, cut.index());
    const mpq_class at_a = plane.value(a), at_b = plane.value(b);
    return between(a, b, at_a / (at_a - at_b));
  };
  if (names.is_input_edge(corner.before)) return on_edge(corner.before, corner.after);
  if (names.is_input_edge(corner.after)) return on_edge(corner.after, corner.before);
  return meeting_point(support_plane(scene, corner.support),
                       support_plane(scene, corner.before.index()),
                       support_plane(scene, corner.after.index()));
}

template <class SceneSpace>
RationalBsp rational_bsp(SceneSpace& space, const PreparedScene& scene,
                         const std::vector<std::uint32_t>& parts, std::uint64_t seed, Roots roots) {
  const auto bsp = build_scene_bsp(space, scene, parts, seed, true, nullptr, 1'000'000, {}, roots);
  EXPECT_EQ(bsp.vanished, 0u);
  RationalBsp result{bsp.nodes, std::vector<std::int32_t>(bsp.nodes.size(), BspNode::kEmpty), {}};
  for (std::uint32_t node = 0; node < bsp.nodes.size(); ++node) {
    const BspNode& own = bsp.nodes[node];
    for (const std::int32_t child : {own.front, own.back}) {
      if (child == BspNode::kEmpty) continue;
      std::int32_t& parent = result.parent[static_cast<std::size_t>(child)];
      EXPECT_EQ(parent, BspNode::kEmpty) << "a node with two parents";
      parent = static_cast<std::int32_t>(node);
    }
    for (std::uint32_t i = 0; i < own.count; ++i) {
      const LoopRange& range = bsp.pieces[bsp.node_pieces[own.first + i]];
      const auto view = bsp.loops.view(range, scene.parts[range.part].plane);
      RationalBsp::Piece piece{node, range.part, {}};
      for (std::uint32_t v = 0; v < view.size(); ++v) {
        piece.loop.push_back(corner_position(scene, space.edges(), view.corner(v)));
      }
      result.pieces.push_back(std::move(piece));
    }
  }
  return result;
}

/// What two convex loops of one plane have in common.
inline RationalLoop common_area(RationalLoop loop, const RationalLoop& other,
                                const Rational3& normal) {
  for (std::size_t i = 0; i < other.size() && !loop.empty(); ++i) {
    const Rational3 along = difference(other[(i + 1) % other.size()], other[i]);
    loop = in_front(loop, RationalPlane::through(cross_product(normal, along), other[i]));
  }
  return loop;
}

/// Pieces lie within their part, have no area in common, and as much area as the part has together.
inline void expect_tiled(const PreparedScene& scene, const RationalBsp& bsp,
                         const std::vector<std::uint32_t>& parts) {
  std::map<std::uint32_t, std::vector<const RationalLoop*>> pieces;
  for (const RationalBsp::Piece& piece : bsp.pieces) pieces[piece.part].push_back(&piece.loop);
  ASSERT_EQ(pieces.size(), parts.size());
  for (const std::uint32_t part : parts) {
    const RationalLoop whole = grid_loop(scene, part);
    const Rational3 area = area_vector(whole);
    Rational3 sum;
    const std::vector<const RationalLoop*>& own = pieces[part];
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Rational3 piece_area = area_vector(*own[i]);
      EXPECT_GT(dot_product(piece_area, area), 0);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += piece_area[k];
      EXPECT_EQ(area_vector(common_area(*own[i], whole, area)), piece_area) << "outside its part";
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_TRUE(common_area(*own[i], *own[j], area).empty()) << "pieces overlap";
      }
    }
    EXPECT_EQ(sum, area) << "part " << part;
  }
}

inline void expect_in_place(const PreparedScene& scene, const RationalBsp& bsp) {
  std::vector<RationalPlane> planes;
  for (const BspNode& node : bsp.nodes) planes.push_back(support_plane(scene, node.plane));
  for (const RationalBsp::Piece& piece : bsp.pieces) {
    for (const Rational3& point : piece.loop) EXPECT_EQ(planes[piece.node].value(point), 0);
    std::uint32_t node = piece.node;
    while (bsp.parent[node] != BspNode::kEmpty) {
      const auto above = static_cast<std::uint32_t>(bsp.parent[node]);
      const int place = bsp.nodes[above].front == static_cast<std::int32_t>(node) ? 1 : -1;
      bool off = false;  // off the plane: then all of the piece but its border is
      for (const Rational3& point : piece.loop) {
        const int side = sgn(planes[above].value(point)) * place;
        EXPECT_GE(side, 0) << "part " << piece.part << " crosses a node above it";
        off = off || side > 0;
      }
      EXPECT_TRUE(off) << "part " << piece.part << " lies in the plane of a node above its own";
      node = above;
    }
  }
}

/// Pieces of one support plane that are in two nodes have a node above both that tells them apart:
/// neither node is above the other.
inline void expect_coplanar_together(const PreparedScene& scene, const RationalBsp& bsp) {
  for (std::uint32_t node = 0; node < bsp.nodes.size(); ++node) {
    for (std::int32_t above = bsp.parent[node]; above != BspNode::kEmpty;
         above = bsp.parent[static_cast<std::size_t>(above)]) {
      EXPECT_NE(bsp.nodes[node].plane, bsp.nodes[static_cast<std::size_t>(above)].plane);
    }
  }
  for (const RationalBsp::Piece& piece : bsp.pieces) {
    EXPECT_EQ(scene.parts[piece.part].plane, bsp.nodes[piece.node].plane);
  }
}

/// Pairs of pieces of different nodes of which the later one hides some of the earlier one.
inline std::uint64_t wrong_pairs(const RationalBsp& bsp, const std::vector<std::uint32_t>& order,
                                 const RationalLight& light) {
  std::vector<std::size_t> place(bsp.nodes.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::uint64_t wrong = 0;
  for (const RationalBsp::Piece& a : bsp.pieces) {
    for (const RationalBsp::Piece& b : bsp.pieces) {
      if (place[a.node] < place[b.node] && hides(b.loop, a.loop, light)) ++wrong;
    }
  }
  return wrong;
}

template <class LightSpace>
class SceneBspOrder : public testing::Test {
 protected:
  using SceneSpace = typename LightSpace::SceneSpace;

  /// The scene under its own lights, a lamp in one of its vertices, and a sun along an axis.
  void check(Scene scene, std::uint64_t seed) {
    const auto add = [&](LightType type, const Position& position) {
      Light& light = scene.lights.emplace_back();
      light.id = "added" + std::to_string(scene.lights.size());
      light.type = type;
      light.position = position;
    };
    add(LightType::kPoint, scene.vertices[seed % scene.vertices.size()]);
    add(LightType::kDirectional, {Number(0.0), Number(seed % 2 == 0 ? 1.0 : 0.0), Number(1.0)});
    const auto prepared = prepare(scene);
    if (!prepared) return;
    SceneSpace space(prepared->geometry, {true, 0});
    std::vector<std::uint32_t> parts;
    for (std::uint32_t i = 0; i < prepared->parts.size(); ++i) {
      if (seed % 4 != 3 || i % 3 != 1) parts.push_back(i);
    }
    for (const Roots roots : {Roots::kChosen, Roots::kFed, Roots::kOutside}) {
      SCOPED_TRACE("roots " + std::to_string(static_cast<int>(roots)));
      const RationalBsp bsp = rational_bsp(space, *prepared, parts, seed, roots);
      expect_tiled(*prepared, bsp, parts);
      expect_in_place(*prepared, bsp);
      expect_coplanar_together(*prepared, bsp);
      pieces_ += bsp.pieces.size();
      parts_ += parts.size();
      check_order(space, *prepared, bsp);
    }
  }

  /// From every point and directional light of the scene.
  void check_order(SceneSpace& space, const PreparedScene& prepared, const RationalBsp& bsp) {
    for (const PreparedLight& light : prepared.lights) {
      if (light.has_area()) continue;
      const RationalLight exact(light.point);
      const LightSpace light_space(space, light.point, {true, 0});
      std::vector<std::uint32_t> order = front_to_back(bsp.nodes, [&](PlaneId plane) {
        const Sign side = light_space.light_side(plane);
        EXPECT_EQ(static_cast<int>(side), exact.side_of(support_plane(prepared, plane)));
        if (side == Sign::kZero) ++lights_in_planes_;
        return side;
      });
      std::vector<std::uint32_t> sorted = order;
      std::sort(sorted.begin(), sorted.end());
      for (std::uint32_t i = 0; i < bsp.nodes.size(); ++i) ASSERT_EQ(sorted.at(i), i);
      EXPECT_EQ(wrong_pairs(bsp, order, exact), 0u) << "light " << light.light;
      std::reverse(order.begin(), order.end());
      wrong_if_reversed_ += wrong_pairs(bsp, order, exact);
    }
  }

  void check_family(const std::string& name, std::uint64_t scenes) {
    for (std::uint64_t seed = 0; seed < scenes; ++seed) {
      SCOPED_TRACE(name + " seed " + std::to_string(seed));
      check(fuzz::family_by_name(name).make(seed), seed);
      if (this->HasFatalFailure() || this->HasNonfatalFailure()) return;
    }
  }
  void check_soup(fuzz::Soup soup, std::uint64_t scenes) {
    for (std::uint64_t seed = 0; seed < scenes; ++seed) {
      SCOPED_TRACE("soup seed " + std::to_string(seed));
      Random random(seed);
      check(fuzz::make_soup(soup, false, random), seed);
      if (this->HasFatalFailure() || this->HasNonfatalFailure()) return;
    }
  }
  void check_generated(const std::string& name, std::int64_t n, std::uint64_t scenes) {
    for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
      for (const std::int64_t light : {0, 1}) {
        SCOPED_TRACE(name + " seed " + std::to_string(seed));
        check(generate(name, {{"n", n}, {"light", light}}, seed).value(), seed);
        if (this->HasFatalFailure() || this->HasNonfatalFailure()) return;
      }
    }
  }

  void TearDown() override {
    // What was checked could have been wrong: there were splits, and the order turned round hides.
    EXPECT_GT(wrong_if_reversed_, 0u);
    RecordProperty("parts", std::to_string(parts_));
    RecordProperty("pieces", std::to_string(pieces_));
    RecordProperty("lights_in_planes", std::to_string(lights_in_planes_));
    RecordProperty("wrong_if_reversed", std::to_string(wrong_if_reversed_));
  }

  std::uint64_t parts_ = 0, pieces_ = 0, lights_in_planes_ = 0, wrong_if_reversed_ = 0;
};

TYPED_TEST_SUITE_P(SceneBspOrder);

TYPED_TEST_P(SceneBspOrder, Soups) {
  this->check_soup(fuzz::Soup::kUniform, 30);
  this->check_soup(fuzz::Soup::kClustered, 20);
  this->check_soup(fuzz::Soup::kMixedSizes, 20);
  this->check_family("Generic", 10);
  this->check_family("Decimals", 15);
  EXPECT_GT(this->pieces_, this->parts_);
}
TYPED_TEST_P(SceneBspOrder, Lattices) {
  this->check_soup(fuzz::Soup::kLattice, 40);
  this->check_family("Lattice", 60);
  this->check_family("Grazing", 20);
  EXPECT_GT(this->pieces_, this->parts_);
  EXPECT_GT(this->lights_in_planes_, 0u);
}
TYPED_TEST_P(SceneBspOrder, CrossingPolygons) {
  this->check_family("Crossing", 10);
  this->check_family("CrossingSticks", 10);
  EXPECT_GT(this->pieces_, this->parts_);
}
TYPED_TEST_P(SceneBspOrder, CoplanarPolygons) {
  this->check_family("CoplanarTiles", 40);
  this->check_family("TouchingBoxes", 10);
  this->check_family("NestedBoxes", 10);
  EXPECT_GT(this->lights_in_planes_, 0u);
}
TYPED_TEST_P(SceneBspOrder, Pinwheels) {
  this->check_generated("pinwheel", 2, 2);
  EXPECT_GT(this->pieces_, this->parts_);
}

REGISTER_TYPED_TEST_SUITE_P(SceneBspOrder, Soups, Lattices, CrossingPolygons, CoplanarPolygons,
                            Pinwheels);

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_ALGORITHMS_SCENE_BSP_ORDER_TEST_H
