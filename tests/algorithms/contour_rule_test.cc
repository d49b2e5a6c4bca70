// SPDX-License-Identifier: GPL-3.0-or-later
// The rule of contours (docs/contour.md), clause by clause: for each clause the smallest scene that
// comes out wrong without it, on every exact kernel, under a sun from straight above and under what
// changes no share of it (turned, moved, sheared together with its sun, in another order), and
// under lamps, where the answer is that of sectors.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "exact_check.h"
#include "fuzz/generate/scene_pen.h"

namespace gnomon::test {
namespace {

using fuzz::ScenePen;
using fuzz::Triple;
using fuzz::operator+;

struct Sheet {
  std::vector<Triple> loop;  // counter-clockwise seen from above
  mpq_class lit;             // under a sun straight above
  bool casts = true;
};

/// [x0, x1] x [y0, y1] at a height.
Sheet square(int x0, int x1, int y0, int y1, int z, mpq_class lit, bool casts = true) {
  return {{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, std::move(lit), casts};
}

struct Clause {
  std::string name;
  std::vector<Sheet> sheets;

  friend void PrintTo(const Clause& clause, std::ostream* out) { *out << clause.name; }
};

std::vector<Clause> clauses() {
  const auto share = [](int p, int q) { return mpq_class(p, q); };
  return {
      // Two steps of a stair: the upper one's edge is above the lower one's own.
      {"ItsOwnEdgeOnTheLine", {square(0, 1, 0, 1, 1, 1), square(1, 2, 0, 1, 0, 1)}},
      // A ramp that stands on the ground with one edge.
      {"SlopeAtEqualDepth",
       {square(0, 3, 0, 3, 0, share(8, 9)), {{{1, 1, 0}, {2, 1, 1}, {2, 2, 1}, {1, 2, 0}}, 1}}},
      // A ramp that comes out of the ground in its middle.
      {"Crease",
       {square(0, 3, 0, 3, 0, share(17, 18)),
        {{{1, 1, -1}, {2, 1, 1}, {2, 2, 1}, {1, 2, -1}}, share(1, 2)}}},
      // Glass between the roof and the ground.
      {"WhatCastsNothing",
       {square(1, 2, 1, 2, 2, 1), square(0, 3, 0, 3, 1, share(8, 9), false),
        square(0, 3, 0, 3, 0, share(8, 9))}},
      // Two sheets of one plane under a third.
      {"AllOfThePlaneBehind",
       {square(1, 2, 1, 2, 2, 1), square(0, 3, 0, 3, 0, share(8, 9)),
        square(0, 3, 0, 4, 0, share(11, 12))}},
      // One roof, twice.
      {"OneOfSeveralThatCoincide",
       {square(1, 2, 1, 2, 1, 1), square(1, 2, 1, 2, 1, 1), square(0, 3, 0, 3, 0, share(8, 9))}},
      // A slope over the edge of a floor that goes on as a slope under it.
      {"ContactWhereTwoMeet",
       {{{{0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}}, 1},
        {{{1, 0, 0}, {2, 0, -1}, {2, 1, -1}, {1, 1, 0}}, 0},
        square(0, 2, 0, 1, 0, share(1, 2))}},
  };
}

/// A map of space that changes no share: x -> rows * x + move.
struct Map {
  std::string name;
  std::array<Triple, 3> rows;
  Triple move{};

  Triple linear(const Triple& x) const {
    Triple result{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) result[i] += rows[i][k] * x[k];
    }
    return result;
  }
  Triple at(const Triple& x) const { return linear(x) + move; }
};

/// All of them keep the orientation.
std::vector<Map> maps() {
  return {{"as it is", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
          {"a quarter turn", {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}},
          {"half a turn", {{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}},
          {"on its side", {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}},
          {"upside down", {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}},
          {"turned by 3-4-5", {{{3, -4, 0}, {4, 3, 0}, {0, 0, 5}}}},
          {"turned by thirds", {{{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}}}},
          {"moved far", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1'000'003, -777'777, 123'457}},
          {"turned and moved", {{{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}}}, {-99'991, 31'337, 4'242}},
          {"sheared", {{{1, 0, 1}, {0, 1, 2}, {0, 0, 1}}}},
          {"sheared flat", {{{7, 1, 3}, {0, 5, -4}, {0, 0, 1}}}},
          {"sheared and turned", {{{0, -1, -3}, {1, 0, 2}, {1, 0, 3}}}}};
}

/// The sheets in the order named, each from another corner of its loop on.
ScenePen drawn(const Clause& clause, const Map& map, const std::vector<std::size_t>& order,
               std::size_t turn = 0, bool two_sided = false, int exponent = 0) {
  ScenePen pen(exponent);
  pen.two_sided(two_sided);
  for (const std::size_t i : order) {
    std::vector<Triple> loop;
    for (const Triple& corner : clause.sheets[i].loop) loop.push_back(map.at(corner));
    std::ranges::rotate(loop, loop.begin() + static_cast<std::ptrdiff_t>(turn % loop.size()));
    pen.casts(clause.sheets[i].casts).polygon(loop);
  }
  return pen;
}

std::vector<std::size_t> usual_order(const Clause& clause) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < clause.sheets.size(); ++i) order.push_back(i);
  return order;
}

class ContourRule : public testing::TestWithParam<Clause> {
 protected:
  /// The shares by contours are those of the clause, and of sectors.
  void expect_shares(ScenePen pen, const std::vector<std::size_t>& order) const {
    const auto scene = Case::make(pen.take());
    ASSERT_TRUE(scene);
    ASSERT_EQ(check_contour(*scene), "") << text_of(scene->scene());
    for (const KernelId kernel : kExactKernels) {
      ShadowOptions options = options_for(kernel);
      options.method.point = MethodId::kContour;
      const std::vector<mpq_class> found = lit_fractions(*scene, options);
      ASSERT_EQ(found.size(), order.size());
      for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(found[i], GetParam().sheets[order[i]].lit)
            << kernel_info(kernel).name << ", sheet " << order[i];
      }
    }
  }
};

TEST_P(ContourRule, UnderASun) {
  const std::vector<std::size_t> order = usual_order(GetParam());
  for (const Map& map : maps()) {
    SCOPED_TRACE(map.name);
    expect_shares(drawn(GetParam(), map, order).sun(map.linear({0, 0, 1})), order);
    if (HasFatalFailure()) return;
  }
}

TEST_P(ContourRule, InAnyOrderAndFromAnyCorner) {
  std::vector<std::size_t> order = usual_order(GetParam());
  const Map map = maps()[6];
  do {
    for (std::size_t turn = 0; turn < 4; ++turn) {
      expect_shares(drawn(GetParam(), map, order, turn).sun(map.linear({0, 0, 1})), order);
      if (HasFatalFailure()) return;
    }
  } while (std::ranges::next_permutation(order).found);
}

TEST_P(ContourRule, OfTwoSidedSheetsAtAnyScale) {
  const std::vector<std::size_t> order = usual_order(GetParam());
  for (const int exponent : {-400, -30, 0, 40, 400}) {
    SCOPED_TRACE(exponent);
    ScenePen pen = drawn(GetParam(), maps()[0], order, 1, true, exponent);
    expect_shares(pen.sun({0, 0, 1}), order);
    if (HasFatalFailure()) return;
  }
}

/// On lines and planes of the sheets, beside them, near and far.
TEST_P(ContourRule, UnderLamps) {
  const std::vector<std::size_t> order = usual_order(GetParam());
  for (const bool two_sided : {false, true}) {
    for (const Map& map : {maps()[0], maps()[6]}) {
      ScenePen pen = drawn(GetParam(), map, order, 0, two_sided);
      for (const std::int64_t x : {0, 1, 2, 5}) {
        for (const std::int64_t y : {0, 1, 3}) {
          for (const std::int64_t z : {3, 5, 1000}) pen.lamp(map.at({x, y, z}));
        }
      }
      // Between the sheets, and in their planes.
      for (const Triple& place : std::vector<Triple>{{1, 1, 1}, {2, 1, 1}, {0, 0, 0}, {4, 1, 0}}) {
        pen.lamp(map.at(place));
      }
      const auto scene = Case::make(pen.take());
      ASSERT_TRUE(scene);
      ASSERT_EQ(check_contour(*scene), "") << map.name << '\n' << text_of(scene->scene());
    }
  }
}

/// A lamp so far away that shares are those of the sun but for a hair.
TEST_P(ContourRule, UnderAFarLamp) {
  const std::vector<std::size_t> order = usual_order(GetParam());
  ScenePen pen = drawn(GetParam(), maps()[0], order);
  const auto scene = Case::make(pen.lamp({1, 1, 1'000'000'000}).take());
  ASSERT_TRUE(scene);
  ASSERT_EQ(check_contour(*scene), "");
  ShadowOptions options = options_for(KernelId::kPlane);
  options.method.point = MethodId::kContour;
  const std::vector<mpq_class> found = lit_fractions(*scene, options);
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_NEAR(found[i].get_d(), GetParam().sheets[i].lit.get_d(), 1e-7) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Clauses, ContourRule, testing::ValuesIn(clauses()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace gnomon::test
