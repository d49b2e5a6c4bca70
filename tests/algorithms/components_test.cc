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

}  // namespace
}  // namespace gnomon
