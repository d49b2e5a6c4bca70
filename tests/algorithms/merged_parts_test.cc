// SPDX-License-Identifier: GPL-3.0-or-later
// The parts that the merged algorithm is made of, on the kernel `rational`: polyhedra whose pieces
// have exactly the volume of the whole, and trees that say IN exactly where one of the volumes is,
// which the test computes from the definition with rational numbers of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algorithms/volume_trees/balanced_prefix.h"
#include "algorithms/volume_trees/bounding_box.h"
#include "algorithms/volume_trees/volume_tree.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/scene/prepare.h"
#include "kernel/coordinate/coordinate_volume_space.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using namespace fuzz;  // families and pens

using Space = CoordinateVolumeSpace<mpq_class>;
using SceneSpace = Space::SceneSpace;
using Vertex = Space::Vertex;
using Point = std::array<mpq_class, 3>;

Point minus(const Point& a, const Point& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
mpq_class determinant(const Point& a, const Point& b, const Point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// A plane by three points, in front of which orientation is positive.
struct TestPlane {
  Point a, b, c;
  bool flipped = false;
  int side(const Point& p) const {
    const int sign = sgn(determinant(minus(b, a), minus(c, a), minus(p, a)));
    return flipped ? -sign : sign;
  }
};

/// Random triangles and quadrangles of a small grid, so that much of it is degenerate.
struct Soup {
  Scene scene;
  PreparedScene prepared;
};
Soup make_soup(std::uint64_t seed, unsigned polygons, std::int64_t size, bool lamp = false) {
  Random random(seed);
  ScenePen pen;
  if (lamp) {  // part 0 shines down on part 1, the floor, from above
    const std::int64_t up = 2 * size, third = (size + 2) / 3;
    pen.polygon({{third, third, up}, {third, 2 * third, up}, {2 * third, 2 * third, up}});
    pen.polygon(
        {{-size, -size, 0}, {2 * size, -size, 0}, {2 * size, 2 * size, 0}, {-size, 2 * size, 0}});
  }
  const auto point = [&]() -> Triple {
    return {random.between(0, size), random.between(0, size), random.between(0, size)};
  };
  for (unsigned i = 0; i < polygons;) {
    const Triple a = point(), b = point(), c = point();
    if (is_zero(cross(b - a, c - a))) continue;
    if (random.chance(1, 3)) {
      pen.polygon({a, b, c});
    } else {  // a parallelogram is always planar and convex
      pen.polygon({a, b, b + (c - a), c});
    }
    ++i;
  }
  Soup soup{pen.take(), {}};
  soup.prepared = prepare(soup.scene).value();
  return soup;
}

LoopView<Vertex> load(const Space& space, const PreparedScene& scene, std::uint32_t index,
                      LoopStore<Vertex>& store) {
  const Part& part = scene.parts[index];
  LoopRange range{store.size(), part.count, index};
  for (std::uint32_t i = 0; i < part.count; ++i) {
    const PlaneRef edge = scene.edges(part)[i];
    store.push(space.input_vertex(scene.loop(part)[i]),
               space.edges().of_edge(edge.index(), edge.flipped()));
  }
  return store.view(range, part.plane);
}

mpq_class volume_of(const Space& space, const Polyhedron<Vertex>& polyhedron) {
  mpq_class six = 0;
  if (polyhedron.empty()) return six;
  const Point origin = space.exact_position(polyhedron.corner(polyhedron.faces[0], 0));
  for (const PolyhedronFace& face : polyhedron.faces) {
    const Point a = minus(space.exact_position(polyhedron.corner(face, 0)), origin);
    for (std::uint32_t i = 1; i + 1 < face.count; ++i) {
      six += determinant(a, minus(space.exact_position(polyhedron.corner(face, i)), origin),
                         minus(space.exact_position(polyhedron.corner(face, i + 1)), origin));
    }
  }
  return six / 6;
}

/// Every edge is on two faces, in opposite directions, each of which names the other; every corner
/// is on the planes that name it; no vertex is outside any face.
std::string check(Space& space, const Polyhedron<Vertex>& polyhedron) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<PlaneRef, PlaneRef>> edges;
  for (const PolyhedronFace& face : polyhedron.faces) {
    if (face.count < 3) return "a face with fewer than three corners";
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const FaceCorner& here = polyhedron.loop(face)[i];
      const FaceCorner& there = polyhedron.loop(face)[i + 1 == face.count ? 0 : i + 1];
      if (!edges.emplace(std::pair(here.vertex, there.vertex), std::pair(face.plane, here.edge))
               .second) {
        return "an edge twice in one direction";
      }
      const auto corner = polyhedron.corner(face, i);
      const Corner<Vertex> lone{{}, corner.vertex, {}, 0xffffffffu};
      for (const PlaneRef plane : {face.plane, corner.before, corner.after}) {
        if (space.side_of_plane(plane, lone) != Side::kOn) return "a corner off its planes";
      }
      for (const PolyhedronFace& other : polyhedron.faces) {
        if (space.side_of_plane(other.plane, lone) == Side::kBack) return "not convex";
      }
    }
  }
  for (const auto& [ends, planes] : edges) {
    const auto twin = edges.find({ends.second, ends.first});
    if (twin == edges.end()) return "an edge without a second face";
    if (twin->second.first != planes.second || twin->second.second != planes.first) {
      return "faces that do not name each other";
    }
  }
  const auto v = static_cast<std::ptrdiff_t>(polyhedron.vertices.size()),
             f = static_cast<std::ptrdiff_t>(polyhedron.faces.size());
  if (v - static_cast<std::ptrdiff_t>(edges.size() / 2) + f != 2) return "Euler";
  return "";
}

TEST(Polyhedron, TheBoxIsOne) {
  const Soup soup = make_soup(1, 4, 8);
  SceneSpace scene_space(soup.prepared.geometry, {});
  Space space(scene_space, {});
  const auto box = make_box(space, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(check(space, box), "");
  mpq_class side =
      soup.prepared.geometry.step * mpq_class(mpz_class(1) << soup.prepared.geometry.grid.bits());
  EXPECT_EQ(volume_of(space, box), side * side * side);
}

TEST(Polyhedron, PiecesHaveTheVolumeOfTheWhole) {
  std::uint64_t splits = 0, touching = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Soup soup = make_soup(seed, 6, seed % 3 == 0 ? 3 : 9);
    SceneSpace scene_space(soup.prepared.geometry, {});
    Space space(scene_space, {});
    PolyhedronSplitter<Space> splitter;
    Random random(seed);
    std::vector<Polyhedron<Vertex>> pieces{make_box(space, {0, 0, 0}, {1, 1, 1})};
    const mpq_class whole = volume_of(space, pieces.front());
    const auto& geometry = soup.prepared.geometry;
    for (int round = 0; round < 5; ++round) {
      const auto vertex = [&] {
        return space.input_vertex(static_cast<VertexId>(random.below(geometry.positions.size())));
      };
      const Vertex a = vertex(), b = vertex(), c = vertex();
      const PlaneRef plane = space.add_plane({{}, a, {}, 0xffffffffu}, {{}, b, {}, 0xffffffffu},
                                             {{}, c, {}, 0xffffffffu});
      if (!plane.valid()) continue;
      std::vector<Polyhedron<Vertex>> next;
      for (Polyhedron<Vertex>& piece : pieces) {
        if (splitter.decide(space, plane, piece) != Placement::kSpanning) {
          next.push_back(std::move(piece));
          continue;
        }
        ++splits;
        for (const Vertex& v : piece.vertices) {
          touching += space.side_of_plane(plane, {{}, v, {}, 0xffffffffu}) == Side::kOn;
        }
        Polyhedron<Vertex> front, back;
        splitter.decide(space, plane, piece);
        splitter.split(space, plane, piece, front, back);
        ASSERT_EQ(check(space, front), "") << seed;
        ASSERT_EQ(check(space, back), "") << seed;
        ASSERT_GT(volume_of(space, front), 0);
        ASSERT_GT(volume_of(space, back), 0);
        ASSERT_EQ(volume_of(space, front) + volume_of(space, back), volume_of(space, piece));
        next.push_back(std::move(front));
        next.push_back(std::move(back));
      }
      pieces = std::move(next);
    }
    mpq_class sum = 0;
    for (const auto& piece : pieces) sum += volume_of(space, piece);
    EXPECT_EQ(sum, whole);
    EXPECT_EQ(splitter.findings(), 0u);
  }
  EXPECT_GT(splits, 1000u);
  EXPECT_GT(touching, 200u);
}

/// A volume from the definition: all planes through an edge of the one and a vertex of the other
/// that separate caster and light, and the back of the caster.
struct TestVolume {
  std::uint32_t caster = 0;
  std::vector<TestPlane> planes;  // inside in front
  std::vector<PlaneRef> refs;     // the same
  bool holds_inside(const Point& p) const {
    return std::all_of(planes.begin(), planes.end(),
                       [&](const TestPlane& plane) { return plane.side(p) > 0; });
  }
  bool holds(const Point& p) const {
    return std::all_of(planes.begin(), planes.end(),
                       [&](const TestPlane& plane) { return plane.side(p) >= 0; });
  }
};

class UnionScene {
 public:
  UnionScene(std::uint64_t seed, unsigned polygons, std::int64_t size)
      : soup_(make_soup(seed, polygons, size, seed % 4 != 0)),
        scene_space_(soup_.prepared.geometry, {}),
        space_(scene_space_, {}),
        box_(make_box(space_, {0, 0, 0}, {1, 1, 1})) {
    // Part 0 is the light.
    LoopStore<Vertex> store;
    const Part& light_part = scene().parts[0];
    const PlaneRef light_plane(light_part.plane, light_part.flipped);
    PolyhedronSplitter<Space> splitter;
    splitter.clip(space_, light_plane, false, box_);
    for (std::uint32_t i = 1; i < scene().parts.size(); ++i) {
      store.clear();
      load(space_, scene(), 0, store);
      load(space_, scene(), i, store);
      const LoopView<Vertex> light = store.view({0, scene().parts[0].count, 0}, light_part.plane);
      const LoopView<Vertex> caster =
          store.view({light.size(), scene().parts[i].count, i}, scene().parts[i].plane);
      add_volume(light, caster);
    }
  }

  const PreparedScene& scene() const { return soup_.prepared; }
  Space& space() { return space_; }
  const Polyhedron<Vertex>& box() const { return box_; }
  const std::vector<TestVolume>& volumes() const { return volumes_; }

 private:
  Point at(const LoopView<Vertex>& loop, std::uint32_t i) const {
    return space_.exact_position(loop.corner(i % loop.size()));
  }
  void add_volume(const LoopView<Vertex>& light, const LoopView<Vertex>& caster) {
    const TestPlane own{at(caster, 0), at(caster, 1), at(caster, 2), true};  // inside behind it
    // Only lights that are in front: no volume where the caster's plane cuts the light.
    bool in_front = false;
    for (std::uint32_t i = 0; i < light.size(); ++i) {
      const int side = own.side(at(light, i));
      if (side > 0) return;
      in_front |= side < 0;
    }
    if (!in_front) return;
    TestVolume volume;
    volume.caster = caster.part;
    const Part& part = scene().parts[caster.part];
    volume.planes.push_back(own);
    volume.refs.push_back(PlaneRef(part.plane, !part.flipped));
    add_planes(caster, light, light, caster, volume);
    add_planes(light, caster, light, caster, volume);
    volumes_.push_back(std::move(volume));
  }
  void add_planes(const LoopView<Vertex>& edges, const LoopView<Vertex>& vertices,
                  const LoopView<Vertex>& light, const LoopView<Vertex>& caster,
                  TestVolume& volume) {
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        TestPlane plane{at(edges, e), at(edges, e + 1), at(vertices, v)};
        int low = 0, high = 0, light_low = 0, light_high = 0;
        for (std::uint32_t i = 0; i < caster.size(); ++i) {
          low = std::min(low, plane.side(at(caster, i)));
          high = std::max(high, plane.side(at(caster, i)));
        }
        for (std::uint32_t i = 0; i < light.size(); ++i) {
          light_low = std::min(light_low, plane.side(at(light, i)));
          light_high = std::max(light_high, plane.side(at(light, i)));
        }
        // On one line, the caster's own plane, or not separating.
        if ((low < 0) == (high > 0)) continue;
        const int caster_side = low + high;
        if (caster_side * light_low > 0 || caster_side * light_high > 0) continue;
        const PlaneRef ref =
            space_.add_plane(edges.corner(e), edges.corner(edges.next(e)), vertices.corner(v));
        plane.flipped = caster_side < 0;
        volume.planes.push_back(plane);
        volume.refs.push_back(caster_side < 0 ? -ref : ref);
      }
    }
  }

  Soup soup_;
  SceneSpace scene_space_;
  Space space_;
  Polyhedron<Vertex> box_;
  std::vector<TestVolume> volumes_;
};

struct UnionCheck {
  unsigned in = 0, out = 0, wrong = 0;
};

UnionCheck check_union(UnionScene& scene, Random& random, const Rules& rules, bool prefix) {
  Space& space = scene.space();
  VolumeTree<Space> tree(rules);
  TreeGrower<Space> grower(space);
  CellFilter<Space> filter(space, true);
  if (prefix) {
    std::vector<Box> boxes;
    LoopStore<Vertex> store;
    for (std::uint32_t i = 0; i < scene.scene().parts.size(); ++i) {
      store.clear();
      const auto loop = load(space, scene.scene(), i, store);
      Box box{{2, 2, 2}, {-1, -1, -1}};
      for (std::uint32_t k = 0; k < loop.size(); ++k) {
        const auto position = space.position(loop.corner(k));
        for (std::size_t axis = 0; axis < 3; ++axis) {
          box.low[axis] = std::min(box.low[axis], position[axis].lower());
          box.high[axis] = std::max(box.high[axis], position[axis].upper());
        }
      }
      boxes.push_back(box);
    }
    tree.plant(space, plan_space_prefix(boxes, 2));
  }
  std::vector<std::uint32_t> order(scene.volumes().size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  random.shuffle(std::span(order));
  PolyhedronSplitter<Space> splitter;
  Polyhedron<Vertex> volume;
  for (const std::uint32_t i : order) {
    const TestVolume& from = scene.volumes()[i];
    cut_volume(space, scene.box(), from.refs, splitter, volume);
    EXPECT_EQ(volume.empty() ? "" : check(space, volume), "");
    EXPECT_TRUE(
        tree.insert(grower, volume, scene.scene().parts[from.caster].plane, from.caster, 1u << 20));
  }
  UnionCheck result;
  LoopStore<Vertex> store;
  CellOutput<Vertex> output;
  const Part& light_part = scene.scene().parts[0];
  const PlaneRef light_plane(light_part.plane, light_part.flipped);
  for (std::uint32_t i = 1; i < scene.scene().parts.size(); ++i) {
    store.clear();
    const auto light = load(space, scene.scene(), 0, store);
    const std::uint32_t light_count = light.size();
    load(space, scene.scene(), i, store);
    const Part& part = scene.scene().parts[i];
    const auto whole = store.view({light_count, part.count, i}, part.plane);
    const auto light_again = store.view({0, light_count, 0}, light_part.plane);
    // Receivers wholly in front of the light, with the light wholly in front.
    const PlaneRef front(part.plane, part.flipped);
    SplitRecord record;
    if (record.decide(space, light_plane, whole) != Placement::kFront) continue;
    if (record.decide(space, front, light_again) != Placement::kFront) continue;
    std::uint32_t before = 0;
    while (record.side(before) != Side::kFront) ++before;
    const auto corner = light_again.corner(before);
    output.clear();
    filter.filter(tree, whole, {front, &corner}, output);
    mpq_class area = 0;
    for (const CellLoop& cell : output.fragments) {
      const auto loop = output.loops.view(cell.loop, part.plane);
      Point centre{0, 0, 0};
      for (std::uint32_t k = 0; k < loop.size(); ++k) {
        const Point p = space.exact_position(loop.corner(k));
        for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] += p[axis];
      }
      for (mpq_class& x : centre) x /= loop.size();
      bool inside = false;
      for (const TestVolume& other : scene.volumes()) {
        if (other.caster != i && other.holds_inside(centre)) inside = true;
      }
      const bool says_in = cell.caster != Fragment::kNoCaster;
      if (says_in != inside) ++result.wrong;
      (inside ? result.in : result.out) += 1;
      if (!says_in) continue;
      const auto witness =
          std::find_if(scene.volumes().begin(), scene.volumes().end(),
                       [&](const TestVolume& v) { return v.caster == cell.caster; });
      if (witness == scene.volumes().end() || cell.caster == i) {
        ++result.wrong;
        continue;
      }
      for (std::uint32_t k = 0; k < loop.size(); ++k) {
        if (!witness->holds(space.exact_position(loop.corner(k)))) ++result.wrong;
      }
    }
  }
  EXPECT_EQ(grower.splitter.findings() + splitter.findings() + filter.vanished(), 0u);
  return result;
}

TEST(VolumeTree, IsInWhereAVolumeIs) {
  UnionCheck all;
  for (std::uint64_t seed = 0; seed < 240; ++seed) {
    UnionScene scene(seed, 10, seed % 3 == 0 ? 4 : seed % 3 == 1 ? 12 : 1000);
    Random random(seed);
    const UnionCheck one = check_union(scene, random, Rules{}, seed % 2 == 0);
    EXPECT_EQ(one.wrong, 0u) << "seed " << seed;
    all.in += one.in;
    all.out += one.out;
  }
  EXPECT_GT(all.in, 300u);
  EXPECT_GT(all.out, 300u);
}

// 1992, fig. 6: volumes that cross each other, if the second is not continued behind the first.
TEST(VolumeTree, WrongUnionIsWrong) {
  Rules rules;
  rules.volumes_continue_behind_others = false;
  unsigned wrong = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    UnionScene scene(seed, 10, seed % 2 == 1 ? 12 : 1000);
    Random random(seed);
    wrong += check_union(scene, random, rules, false).wrong;
  }
  EXPECT_GT(wrong, 10u);
}

TEST(VolumeTreePrefix, SplitsAtShortValues) {
  Random random(5);
  std::vector<Box> boxes;
  for (int i = 0; i < 500; ++i) {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = std::ldexp(static_cast<double>(random.below(1000)), -10);
      box.high[k] = box.low[k] + std::ldexp(static_cast<double>(random.below(50)), -11);
    }
    boxes.push_back(box);
  }
  const SpacePrefix prefix = plan_space_prefix(boxes, 8);
  EXPECT_GT(prefix.nodes.size(), 40u);
  for (const SpacePrefix::Node& node : prefix.nodes) {
    EXPECT_GT(node.value, 0);
    EXPECT_LT(node.value, 1);
    const double scaled = std::ldexp(node.value, KdSplit::kBits);
    EXPECT_EQ(scaled, std::nearbyint(scaled));
  }
}

}  // namespace
}  // namespace gnomon::test
