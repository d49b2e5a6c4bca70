// SPDX-License-Identifier: GPL-3.0-or-later
// Which lines of a receiver are known to be one before integers are asked: those of planes through
// an edge of a caster that stands on it, and no others.
#include "algorithms/area_contour/lines_in_space.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

#include "algorithms/partition/import_export.h"
#include "algorithms/shadow_volumes/light_geometry.h"
#include "gnomon/scene/prepare.h"
#include "kernel/implicit/implicit_volume_space.h"

namespace gnomon::area_contour {
namespace {

using Space = ImplicitVolumeSpace<NoStats>;
using Place = std::array<int, 3>;

/// A floor, a wall of five corners that stands on it, and a panel above.
class LinesOnAFloor : public testing::Test {
 protected:
  LinesOnAFloor()
      : scene_(prepare(scene()).value()),
        geometry_(make_light_geometry(scene_)),
        scene_space_(geometry_.geometry, {}),
        space_(scene_space_, {}) {
    const LoopView<Space::Vertex> floor = part_loop(space_, scene_, 0, floor_);
    for (std::uint32_t i = 0; i < floor.size(); ++i) corners_.push_back(floor.corner(i));
    lines_.emplace(space_, floor, corners_, chart_, values_);
  }

  PlaneRef wall() const { return PlaneRef(scene_.parts[1].plane, false); }
  PlaneRef through(const Place& a, const Place& b, const Place& c) {
    const Space::Vertex p = vertex(a), q = vertex(b), r = vertex(c);
    return space_.add_plane(lone_corner(p), lone_corner(q), lone_corner(r));
  }
  bool are_known_same(PlaneRef a, PlaneRef b) {
    OutlineLine first, second;
    first.plane = a;
    second.plane = b;
    const bool same = lines_->is_known_same(first, second);
    EXPECT_EQ(lines_->is_known_same(second, first), same);
    return same;
  }

 private:
  static Position at(const Place& p) { return {Number(p[0]), Number(p[1]), Number(p[2])}; }
  static Scene scene() {
    Scene scene;
    for (const Place& p : {Place{0, 0, 0},
                           {9, 0, 0},
                           {9, 9, 0},
                           {0, 9, 0},  // the floor
                           {4, 3, 6},
                           {2, 3, 4},
                           {2, 3, 0},
                           {6, 3, 0},
                           {6, 3, 4}}) {
      scene.vertices.push_back(at(p));
    }
    scene.polygons.resize(2);
    scene.polygons[0].loop = {0, 1, 2, 3};
    scene.polygons[1].loop = {4, 5, 6, 7, 8};
    for (Polygon& polygon : scene.polygons)
      polygon.id = polygon.loop.size() == 4 ? "floor" : "wall";
    Light panel;
    panel.id = "panel";
    panel.type = LightType::kArea;
    for (const Place& p : {Place{3, 1, 8}, {3, 2, 8}, {5, 2, 8}, {5, 1, 8}}) {
      panel.loop.push_back(at(p));
    }
    scene.lights.push_back(panel);
    return scene;
  }
  Space::Vertex vertex(const Place& p) const {
    const auto& positions = geometry_.geometry.positions;
    for (VertexId v = 0; v < positions.size(); ++v) {
      if (positions[v] == std::array<double, 3>{1.0 * p[0], 1.0 * p[1], 1.0 * p[2]}) {
        return space_.input_vertex(v);
      }
    }
    ADD_FAILURE() << "no such vertex";
    return space_.input_vertex(0);
  }

  PreparedScene scene_;
  LightGeometry geometry_;
  Space::SceneSpace scene_space_;
  Space space_;
  LoopStore<Space::Vertex> floor_;
  std::vector<Corner<Space::Vertex>> corners_;
  ReceiverChart chart_;
  CornerValues values_;
  std::optional<LinesInSpace<Space>> lines_;
};

TEST_F(LinesOnAFloor, OfPlanesThroughAnEdgeOnItAreOne) {
  const PlaneRef first = through({2, 3, 0}, {6, 3, 0}, {3, 1, 8});
  const PlaneRef second = through({5, 2, 8}, {6, 3, 0}, {2, 3, 0});
  EXPECT_TRUE(are_known_same(wall(), first));
  EXPECT_TRUE(are_known_same(wall(), -first));
  EXPECT_TRUE(are_known_same(first, second));
}

TEST_F(LinesOnAFloor, OfOnePlaneAreOne) {
  const PlaneRef plane = through({4, 3, 6}, {2, 3, 4}, {3, 1, 8});
  EXPECT_TRUE(are_known_same(plane, -plane));
  EXPECT_TRUE(are_known_same(plane, through({3, 1, 8}, {4, 3, 6}, {2, 3, 4})));
}

/// They share a vertex of the floor, or an edge that is not on it.
TEST_F(LinesOnAFloor, OfOtherPlanesAreNot) {
  const PlaneRef side = through({2, 3, 0}, {2, 3, 4}, {3, 1, 8});
  EXPECT_FALSE(are_known_same(wall(), side));
  EXPECT_FALSE(are_known_same(side, through({2, 3, 0}, {6, 3, 0}, {3, 1, 8})));
  EXPECT_FALSE(are_known_same(wall(), through({4, 3, 6}, {2, 3, 4}, {3, 1, 8})));
  EXPECT_FALSE(are_known_same(through({4, 3, 6}, {2, 3, 4}, {3, 1, 8}),
                              through({4, 3, 6}, {2, 3, 4}, {5, 1, 8})));
}

}  // namespace
}  // namespace gnomon::area_contour
