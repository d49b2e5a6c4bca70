// SPDX-License-Identifier: GPL-3.0-or-later
// Components of shapes whose answer is known: solids that touch, fins, sheets, cavities, and
// surfaces that are convex along every edge and yet not convex.
#include "gnomon/algorithms/components.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fuzz/generate/scene_pen.h"
#include "gnomon/scene/generate.h"

namespace gnomon {
namespace {

using fuzz::ScenePen;
using fuzz::Triple;
using testing::ElementsAre;

/// By component: its number of parts, and "convex", "closed" or what is open.
std::vector<std::string> told(const Scene& scene) {
  const PreparedScene prepared = prepare(scene).value();
  std::vector<std::string> result;
  for (const Component& component : find_components(prepared)) {
    result.push_back(std::to_string(component.parts.size()) + ' ' +
                     (component.is_convex ? "convex"
                      : component.is_closed
                          ? "closed"
                          : unpaired_edge_text(scene, prepared, component.unpaired)));
  }
  return result;
}

ScenePen& add_bipyramid(ScenePen& pen, const std::vector<Triple>& ring, std::int64_t height) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Triple& from = ring[i];
    const Triple& to = ring[(i + 1) % ring.size()];
    pen.polygon({from, to, {0, 0, height}}).polygon({to, from, {0, 0, -height}});
  }
  return pen;
}

TEST(Components, BoxIsConvexAndRoomIsClosed) {
  EXPECT_THAT(told(ScenePen().box({0, 0, 0}, {2, 3, 4}).take()), ElementsAre("6 convex"));
  EXPECT_THAT(told(ScenePen().box({0, 0, 0}, {2, 3, 4}, true).take()), ElementsAre("6 closed"));
}

TEST(Components, NamesAnEdgeWithoutPartner) {
  EXPECT_THAT(told(ScenePen().polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 2}}).take()),
              ElementsAre("1 edge (0,0,0)-(1,0,0) of polygon 0 has no partner"));
  Scene open = ScenePen(-1).box({0, 0, 0}, {1, 1, 1}).take();
  open.polygons.pop_back();
  const std::vector<std::string> parts = told(open);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_THAT(parts[0], testing::MatchesRegex("5 edge \\(.*0.5.*\\)-\\(.*\\) of polygon . has no "
                                              "partner"));
}

TEST(Components, FaceThatLooksTheWrongWayOpensThem) {
  Scene scene = ScenePen().box({0, 0, 0}, {1, 1, 1}).take();
  std::ranges::reverse(scene.polygons[2].loop);
  const std::vector<std::string> parts = told(scene);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_THAT(parts[0], testing::StartsWith("6 edge "));
}

TEST(Components, SolidsThatTouchFallApart) {
  // Along a face, along an edge, in a vertex, and with one in the other along an edge.
  EXPECT_THAT(told(ScenePen().box({0, 0, 0}, {1, 1, 1}).box({1, 0, 0}, {2, 1, 1}).take()),
              ElementsAre("6 convex", "6 convex"));
  EXPECT_THAT(told(ScenePen().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 0}, {2, 2, 1}).take()),
              ElementsAre("6 convex", "6 convex"));
  EXPECT_THAT(told(ScenePen().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 1}, {2, 2, 2}).take()),
              ElementsAre("6 convex", "6 convex"));
  EXPECT_THAT(told(ScenePen().box({0, 0, 0}, {1, 1, 1}).box({0, 0, 0}, {1, 1, 1}).take()),
              ElementsAre("6 convex", "6 convex"));
  // Four around one edge.
  EXPECT_THAT(told(ScenePen()
                       .box({0, 0, 0}, {1, 1, 1})
                       .box({1, 0, 0}, {2, 1, 1})
                       .box({0, 1, 0}, {1, 2, 1})
                       .box({1, 1, 0}, {2, 2, 1})
                       .take()),
              ElementsAre("6 convex", "6 convex", "6 convex", "6 convex"));
}

TEST(Components, SolidWithinASolidAlongAnEdgeIsItsOwn) {
  // A wedge that leans into the box along the box's edge x = y = 0, and its ends on the box's.
  EXPECT_THAT(told(ScenePen()
                       .box({0, 0, 0}, {4, 4, 4})
                       .polygon({{0, 0, 0}, {2, 1, 0}, {2, 1, 4}, {0, 0, 4}})
                       .polygon({{1, 2, 0}, {0, 0, 0}, {0, 0, 4}, {1, 2, 4}})
                       .polygon({{2, 1, 0}, {1, 2, 0}, {1, 2, 4}, {2, 1, 4}})
                       .polygon({{0, 0, 0}, {1, 2, 0}, {2, 1, 0}})
                       .polygon({{0, 0, 4}, {2, 1, 4}, {1, 2, 4}})
                       .take()),
              ElementsAre("6 convex", "5 convex"));
}

TEST(Components, FinOpensNoBox) {
  const std::vector<std::string> parts =
      told(ScenePen()
               .box({0, 0, 0}, {1, 1, 1})
               .polygon({{1, 1, 0}, {2, 2, 0}, {2, 2, 1}, {1, 1, 1}})
               .take());
  EXPECT_THAT(parts, ElementsAre("6 convex", testing::StartsWith("1 edge ")));
}

TEST(Components, SheetOfTwoIsClosedAndNotConvex) {
  EXPECT_THAT(told(ScenePen()
                       .polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})
                       .polygon({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}})
                       .take()),
              ElementsAre("2 closed"));
}

TEST(Components, PentagramIsNotConvex) {
  ScenePen convex, star;
  add_bipyramid(convex, {{0, 10, 0}, {-9, 3, 0}, {-6, -8, 0}, {6, -8, 0}, {9, 3, 0}}, 10);
  EXPECT_THAT(told(convex.take()), ElementsAre("10 convex"));
  // Convex along every edge, and its surface winds around twice.
  add_bipyramid(star, {{0, 10, 0}, {-6, -8, 0}, {9, 3, 0}, {-9, 3, 0}, {6, -8, 0}}, 10);
  EXPECT_THAT(told(star.take()), ElementsAre("10 closed"));
}

TEST(Components, FacesInOnePlaneStayConvex) {
  // A box whose top is two rectangles and whose sides are cut there, too.
  Scene scene = ScenePen().box({0, 0, 0}, {2, 2, 2}).take();
  EXPECT_THAT(told(scene), ElementsAre("6 convex"));
  ScenePen cut;
  cut.polygon({{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}})
      .polygon({{0, 0, 2}, {2, 0, 2}, {2, 2, 2}})
      .polygon({{0, 0, 2}, {2, 2, 2}, {0, 2, 2}})
      .polygon({{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}})
      .polygon({{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {2, 0, 2}})
      .polygon({{2, 2, 0}, {0, 2, 0}, {0, 2, 2}, {2, 2, 2}})
      .polygon({{0, 2, 0}, {0, 0, 0}, {0, 0, 2}, {0, 2, 2}});
  EXPECT_THAT(told(cut.take()), ElementsAre("7 convex"));
}

TEST(Components, ConvexIsDecidedExactlyFarOut) {
  const std::int64_t far = std::int64_t{1} << 52;
  for (const std::int64_t lift : {-1, 0, 1}) {
    ScenePen pen;
    // A double pyramid over the square (+-far, +-far, 0), whose lower half is one corner moved.
    const Triple a{-far, -far, 0}, b{far, -far, 0}, c{far, far, lift}, d{-far, far, 0};
    const Triple low{0, 0, -far};
    pen.polygon({a, b, c}).polygon({a, c, d});
    pen.polygon({b, a, low}).polygon({c, b, low}).polygon({d, c, low}).polygon({a, d, low});
    EXPECT_THAT(told(pen.take()), ElementsAre(lift < 0 ? "6 closed" : "6 convex")) << lift;
  }
}

TEST(Components, ConvexIsDecidedExactlyInThinTetrahedra) {
  // Of three Fibonacci numbers in a row F(n-1) F(n+1) - F(n)^2 is 1 or -1 in turns: the fourth
  // vertex is a unit behind the first face or before it, where the terms are of a hundred bits.
  std::int64_t low = 308061521170129, middle = 498454011879264;  // F(71), F(72)
  for (const char* expected : {"4 convex", "4 closed", "4 convex", "4 closed"}) {
    const std::int64_t high = low + middle;
    const Triple a{0, 0, 0}, b{high, middle, 0}, c{0, 0, 1}, d{middle, low, 0};
    ScenePen pen;
    pen.polygon({a, b, c}).polygon({a, c, d}).polygon({a, d, b}).polygon({b, d, c});
    EXPECT_THAT(told(pen.take()), ElementsAre(expected));
    low = middle;
    middle = high;
  }
}

TEST(Components, OfACityAreOpenHousesAndTheGround) {
  const Scene scene = generate("city", {{"n", 5}}).value();
  const PreparedScene prepared = prepare(scene).value();
  const std::vector<Component> components = find_components(prepared);
  std::size_t parts = 0;
  for (const Component& component : components) {
    parts += component.parts.size();
    EXPECT_FALSE(component.is_closed);
  }
  EXPECT_EQ(components.size(), 6u);
  EXPECT_EQ(parts, prepared.parts.size());
}

// --- Convex shells ---

/// By shell: its numbers of parts, vertices, edges and missing faces.
std::vector<std::string> shells_of(const Scene& scene, std::uint32_t most = 100) {
  std::vector<std::string> result;
  for (const ConvexShell& shell : find_convex_shells(prepare(scene).value(), most)) {
    result.push_back(
        std::to_string(shell.parts.size()) + ' ' + std::to_string(shell.vertices.size()) + ' ' +
        std::to_string(shell.edges.size()) + ' ' + std::to_string(shell.missing.size()));
  }
  return result;
}

/// A box without those of its faces.
Scene box_without(std::vector<std::size_t> faces) {
  Scene scene = ScenePen().box({0, 0, 0}, {2, 3, 4}).take();
  std::ranges::sort(faces, std::greater());
  for (const std::size_t face : faces) {
    scene.polygons.erase(scene.polygons.begin() + static_cast<std::ptrdiff_t>(face));
  }
  return scene;
}

TEST(ConvexShells, OfABoxWithAndWithoutFaces) {
  EXPECT_THAT(shells_of(box_without({})), ElementsAre("6 8 12 0"));
  std::size_t two_missing = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_THAT(shells_of(box_without({i})), ElementsAre("5 8 12 1")) << i;
    for (std::size_t k = 0; k < i; ++k) {
      // Two faces that share an edge leave a border in no plane.
      const std::vector<std::string> told = shells_of(box_without({k, i}));
      if (told.empty()) continue;
      EXPECT_THAT(told, ElementsAre("4 8 12 2")) << k << ' ' << i;
      ++two_missing;
    }
  }
  EXPECT_EQ(two_missing, 3u);
}

TEST(ConvexShells, MissingFacesLookOutwards) {
  const PreparedScene prepared = prepare(generate("city", {{"n", 4}}).value()).value();
  const std::vector<ConvexShell> shells = find_convex_shells(prepared, 100);
  ASSERT_EQ(shells.size(), 4u);
  for (const ConvexShell& shell : shells) {
    ASSERT_EQ(shell.missing.size(), 1u);
    const auto& positions = prepared.geometry.positions;
    const auto &a = positions[shell.missing[0].a], &b = positions[shell.missing[0].b],
               &c = positions[shell.missing[0].c];
    EXPECT_EQ(a[2], 0);
    EXPECT_EQ(b[2], 0);
    EXPECT_EQ(c[2], 0);
    EXPECT_LT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0);
  }
}

TEST(ConvexShells, EdgesRunWithTheirLeftParts) {
  const PreparedScene prepared = prepare(box_without({1})).value();
  const std::vector<ConvexShell> shells = find_convex_shells(prepared, 100);
  ASSERT_EQ(shells.size(), 1u);
  const auto has = [&](std::uint32_t place, VertexId from, VertexId to) {
    const auto loop = prepared.loop(prepared.parts[shells[0].parts[place]]);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] == from && loop[(i + 1) % loop.size()] == to) return true;
    }
    return false;
  };
  std::size_t missing = 0;
  for (const ShellEdge& edge : shells[0].edges) {
    EXPECT_TRUE(has(edge.left, edge.from, edge.to));
    if (edge.right == ShellEdge::kMissing) {
      ++missing;
    } else {
      EXPECT_TRUE(has(edge.right, edge.to, edge.from));
    }
  }
  EXPECT_EQ(missing, 4u);
}

TEST(ConvexShells, NoneOfWhatIsNotConvexOrFlatOrLarge) {
  EXPECT_THAT(shells_of(ScenePen().box({0, 0, 0}, {2, 3, 4}, true).take()), ElementsAre());
  EXPECT_THAT(shells_of(box_without({}), 5), ElementsAre());
  // A sheet of two coplanar squares, and an open fan of three that are not.
  EXPECT_THAT(shells_of(ScenePen()
                            .polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
                            .polygon({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}})
                            .take()),
              ElementsAre());
  EXPECT_THAT(shells_of(ScenePen()
                            .polygon({{0, 0, 0}, {4, 0, 0}, {2, 2, 3}})
                            .polygon({{4, 0, 0}, {4, 4, 0}, {2, 2, 3}})
                            .polygon({{4, 4, 0}, {0, 4, 1}, {2, 2, 3}})
                            .take()),
              ElementsAre());
  // A wedge of two faces has its missing ones in no common plane; a pyramid without its base has.
  ScenePen pyramid;
  const std::vector<Triple> ring = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    pyramid.polygon({ring[i], ring[(i + 1) % ring.size()], {2, 2, 3}});
  }
  EXPECT_THAT(shells_of(pyramid.take()), ElementsAre("4 5 8 1"));
  // Far coordinates, which need more than 128 bits.
  const std::int64_t far = std::int64_t{1} << 52;
  EXPECT_THAT(shells_of(ScenePen().box({0, 0, 0}, {far, far - 1, far - 3}).take()),
              ElementsAre("6 8 12 0"));
}

TEST(ConvexShells, ABoxWithASplitFaceAndTwoThatTouch) {
  Scene scene = box_without({0});
  EXPECT_THAT(shells_of(ScenePen().box({0, 0, 0}, {1, 1, 1}).box({1, 0, 0}, {2, 1, 1}).take()),
              ElementsAre("6 8 12 0", "6 8 12 0"));
  // The same polygon in two triangles: two faces of one plane.
  const Scene whole = box_without({});
  Polygon triangle = whole.polygons[0], other = whole.polygons[0];
  triangle.loop = {whole.polygons[0].loop[0], whole.polygons[0].loop[1], whole.polygons[0].loop[2]};
  other.loop = {whole.polygons[0].loop[0], whole.polygons[0].loop[2], whole.polygons[0].loop[3]};
  triangle.id = "one";
  other.id = "other";
  scene.polygons.push_back(triangle);
  scene.polygons.push_back(other);
  EXPECT_THAT(shells_of(scene), ElementsAre("7 8 13 0"));
}

}  // namespace
}  // namespace gnomon
