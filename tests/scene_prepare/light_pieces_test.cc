// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces of an area light as lights of their own: on a finer grid, and nothing else moves.
#include "gnomon/scene/light_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "builder.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using Point = std::array<mpq_class, 3>;

class Pieces : public testing::Test {
 protected:
  Pieces() {
    builder_.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}})
        .point_light({1, 2, 3})
        .area_light({{0, 0, 4}, {0, 1, 4}, {1, 1, 4}, {1, 0, 4}})
        .sun({0, 0, 1});
    prepared_ = builder_.prepare().value();
  }

  /// Of the panel, which faces down: from one x to another.
  static LightPiece piece(const std::string& id, const mpq_class& x0, const mpq_class& x1) {
    return {id, "light1", {{x0, 0, 4}, {x0, 1, 4}, {x1, 1, 4}, {x1, 0, 4}}};
  }
  Expected<SceneWithPieces> cut(const std::vector<LightPiece>& pieces) {
    return with_light_pieces(builder_.scene(), prepared_, pieces);
  }
  std::string refusal(const LightPiece& piece) {
    const auto found = cut({piece});
    return found ? "no error" : to_string(found.error());
  }

  Builder builder_;
  PreparedScene prepared_;
};

TEST_F(Pieces, AreLightsOnAFinerGrid) {
  const mpq_class third(1, 3);
  const auto found = cut({piece("light1/0", 0, third), piece("light1/1", third, 1)});
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_THAT(found->gaps, IsEmpty());
  ASSERT_EQ(found->scene.lights.size(), 4u);
  EXPECT_EQ(found->scene.lights[1].id, "light1/0");
  EXPECT_EQ(found->scene.lights[3].id, "light2");
  EXPECT_EQ(found->source, (std::vector<std::uint32_t>{0, 1, 1, 2}));
  const Geometry &fine = found->prepared.geometry, &coarse = prepared_.geometry;
  const auto in_scene = [](const Geometry& geometry, const std::array<mpz_class, 3>& grid) {
    Point point;
    for (std::size_t k = 0; k < 3; ++k) point[k] = geometry.origin[k] + geometry.step * grid[k];
    return point;
  };
  EXPECT_EQ(fine.step * 3, coarse.step);
  for (VertexId vertex = 0; vertex < coarse.grid.size(); ++vertex) {
    const auto at = [&](const Geometry& geometry) {
      return in_scene(geometry, {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1),
                                 geometry.grid.at(vertex, 2)});
    };
    EXPECT_EQ(at(fine), at(coarse));
  }
  EXPECT_EQ(in_scene(fine, found->prepared.lights[0].point.grid), (Point{1, 2, 3}));
  EXPECT_EQ(in_scene(fine, found->prepared.lights[1].area_loop[2]), (Point{third, 1, 4}));
  EXPECT_EQ(found->prepared.lights[3].point.grid, prepared_.lights[2].point.grid);
}

TEST_F(Pieces, GapsAndOverlapsAreTold) {
  const mpq_class third(1, 3), half(1, 2);
  EXPECT_THAT(cut({piece("a", 0, third), piece("b", half, 1)})->gaps,
              testing::ElementsAre("the pieces of light 'light1' do not add up to it"));
  EXPECT_THAT(cut({piece("a", 0, half), piece("b", third, mpq_class(5, 6))})->gaps,
              testing::ElementsAre("pieces of light 'light1' overlap"));
}

TEST_F(Pieces, WhatIsNoPieceIsRefused) {
  LightPiece bad = piece("a", 0, 1);
  bad.of = "light0";
  EXPECT_THAT(refusal(bad), HasSubstr("piece 'a': the scene has no area light 'light0'"));
  bad = piece("a", 0, 1);
  bad.loop[2][2] += mpq_class(1, 7);
  EXPECT_THAT(refusal(bad), HasSubstr("not in the plane of 'light1'"));
  EXPECT_THAT(refusal(piece("a", 0, 2)), HasSubstr("it leaves 'light1'"));
  EXPECT_THAT(refusal(piece("a", 1, 0)), HasSubstr("it faces away"));
  EXPECT_THAT(refusal(piece("a", 1, 1)), HasSubstr("it has no area"));
}

}  // namespace
}  // namespace gnomon::test
