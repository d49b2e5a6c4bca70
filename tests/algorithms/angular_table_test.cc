// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of an angular table, judged one by one: spans are the union of the facing polygons, and
// the paper's pairs are the signed sum, on solids, frames and ramps; and that mistakes of pairing
// would be seen.
#include "algorithms/angular_table/angular_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/angular_table/row_order.h"
#include "fuzz/generate/generator.h"
#include "gnomon/algorithms/facing_sides.h"
#include "gnomon/scene/camera.h"
#include "gnomon/scene/generate.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using Interval = std::pair<mpq_class, mpq_class>;
using Intervals = std::vector<Interval>;

/// Sorted and united where they overlap or touch.
Intervals united(Intervals intervals) {
  std::ranges::sort(intervals);
  Intervals result;
  for (const Interval& one : intervals) {
    if (!result.empty() && one.first <= result.back().second) {
      result.back().second = std::max(result.back().second, one.second);
    } else {
      result.push_back(one);
    }
  }
  return result;
}

/// A scene, one of its lights, and a frame that is not square to anything.
struct Rows {
  Rows(const Scene& scene, std::uint32_t light, std::uint64_t seed)
      : prepared(prepare(scene).value()) {
    Random random(seed);
    const auto vector = [&] {
      return std::array<std::int32_t, 3>{static_cast<std::int32_t>(random.between(-9, 9)),
                                         static_cast<std::int32_t>(random.between(-9, 9)),
                                         static_cast<std::int32_t>(random.between(-9, 9))};
    };
    // Solids are below their lights.
    frame.forward = {0, 0, -9};
    do {
      frame.right = vector();
      frame.up = vector();
    } while (frame.right[0] * frame.up[1] == frame.right[1] * frame.up[0]);
    if (seed % 3 == 0) frame.right = {9, 0, 0}, frame.up = {0, 9, 0};
    frame.width = frame.height = 8;
    point = &prepared.lights[light].point;
    signs = signs_at_light(prepared, *point);
    objects = table_objects(prepared);
    chart = charts_of(frame, *point, Hemisphere::kOne).front();
  }

  bool is_ahead() const {
    return std::ranges::all_of(prepared.parts, [&](const Part& part) {
      return std::ranges::all_of(prepared.loop(part),
                                 [&](VertexId v) { return chart.of(place(v))[2] > 0; });
    });
  }
  DirectionVector place(VertexId v) const {
    const GridPositions& grid = prepared.geometry.grid;
    return {grid.at(v, 0), grid.at(v, 1), grid.at(v, 2)};
  }
  AngularTable table(Pairing pairing, const Rules& rules = {}) const {
    MethodOptionValues options;
    options.rows = 23;
    options.pairing = pairing;
    options.depth = TableDepth::kFacing;
    return AngularTable(TableTask{prepared, objects, signs, options, rules}, chart);
  }
  /// By object, of its facing polygons where the row crosses them: what is true.
  std::map<std::uint32_t, Intervals> facing_in_row(const mpq_class& t) const {
    std::map<std::uint32_t, Intervals> result;
    const std::vector<Side> facing = facing_sides(prepared, signs);
    for (std::uint32_t o = 0; o < objects.size(); ++o) {
      for (const std::uint32_t p : objects[o].component.parts) {
        const Part& part = prepared.parts[p];
        if (!part.casts || facing[p] == Side::kOn) continue;
        Intervals found;
        const auto loop = prepared.loop(part);
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const DirectionVector a = chart.of(place(loop[i]));
          const DirectionVector b = chart.of(place(loop[(i + 1) % loop.size()]));
          const mpq_class over_a = a[1] - t * a[2], over_b = b[1] - t * b[2];
          if ((over_a > 0) == (over_b > 0)) continue;
          const mpq_class f = over_a / (over_a - over_b);
          const mpq_class s = (a[0] + f * (b[0] - a[0])) / (a[2] + f * (b[2] - a[2]));
          found.emplace_back(s, s);
        }
        if (found.empty()) continue;
        const auto [low, high] = std::ranges::minmax(found);
        result[o].emplace_back(low.first, high.first);
      }
    }
    for (auto& [object, intervals] : result) intervals = united(std::move(intervals));
    return result;
  }
  static std::map<std::uint32_t, Intervals> spans_in_row(const AngularTable& table,
                                                         std::uint32_t k) {
    const RowOrder order(table.mesh(), table.rows().middle(k));
    std::map<std::uint32_t, Intervals> result;
    for (const TableInterval& span : table.spans().row(k)) {
      result[span.owner].emplace_back(order.exact(span.begin), order.exact(span.end));
    }
    for (auto& [object, intervals] : result) intervals = united(std::move(intervals));
    return result;
  }

  PreparedScene prepared;
  ImageFrame frame;
  const LightPoint* point = nullptr;
  std::vector<Sign> signs;
  std::vector<TableObject> objects;
  TableChart chart;
};

std::vector<Scene> scenes() {
  std::vector<Scene> result;
  const GeneratorInfo& info = *generator_by_name("closed");
  const auto& parameters = info.parameters;
  const auto kinds = std::ranges::find(parameters, "kind", &GeneratorParameter::name)->words;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (const std::string& kind : kinds) {
      if (seed > 1 && kind != "polycube") continue;
      const std::int64_t value = parameter_value(info, "kind", kind).value();
      result.push_back(generate("closed", {{"kind", value}, {"n", 14}}, seed).value());
    }
  }
  for (const char* name : {"family-frames", "family-closed-boxes", "mix"}) {
    const auto generator = fuzz::Generator::parse(name).value();
    for (std::uint64_t seed = 0; seed < 40; ++seed) result.push_back(generator.make(seed).scene);
  }
  return result;
}

template <class Use>
std::uint64_t for_each_light(const Use& use) {
  std::uint64_t taken = 0, seed = 0;
  for (const Scene& scene : scenes()) {
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
      if (scene.lights[l].has_area()) continue;
      const Rows rows(scene, l, ++seed);
      if (!rows.is_ahead()) continue;
      ++taken;
      use(rows, scene.name);
      if (testing::Test::HasFailure()) return taken;
    }
  }
  return taken;
}

TEST(AngularTable, SpansAreTheUnionOfTheFacingPolygons) {
  std::uint64_t judged = 0, several = 0;
  const std::uint64_t tables = for_each_light([&](const Rows& rows, const std::string& name) {
    for (const Pairing pairing : {Pairing::kPeaks, Pairing::kSigned}) {
      const AngularTable table = rows.table(pairing);
      for (std::uint32_t k = 0; k < table.rows().count(); ++k) {
        const auto truth = rows.facing_in_row(table.rows().middle(k));
        ASSERT_EQ(Rows::spans_in_row(table, k), truth) << name << ", row " << k;
        ++judged;
        several +=
            std::ranges::any_of(truth, [](const auto& one) { return one.second.size() > 1; });
      }
    }
  });
  EXPECT_GT(tables, 40u);
  EXPECT_GT(judged, 2000u);
  EXPECT_GT(several, 50u) << "rows with holes";
}

/// Rows of which a mistake of pairing makes something else.
TEST(AngularTable, MistakesOfPairingAreSeenInRows) {
  for (const bool order : {true, false}) {
    Rules rules;
    (order ? rules.crossings_pair_by_arcs : rules.holes_have_a_direction) = false;
    std::uint64_t wrong = 0;
    for_each_light([&](const Rows& rows, const std::string&) {
      const AngularTable table = rows.table(Pairing::kPeaks, rules);
      for (std::uint32_t k = 0; k < table.rows().count(); ++k) {
        wrong += Rows::spans_in_row(table, k) != rows.facing_in_row(table.rows().middle(k));
      }
    });
    EXPECT_GT(wrong, 20u) << (order ? "in order" : "without direction");
  }
}

/// In each row every interval begins where or after the one before it does, and what reaches
/// farthest is known.
TEST(AngularTable, RowsAreSorted) {
  for_each_light([&](const Rows& rows, const std::string& name) {
    const AngularTable table = rows.table(Pairing::kPeaks);
    for (const IntervalRows* all : {&table.spans(), &table.stretches()}) {
      for (std::uint32_t k = 0; k < table.rows().count(); ++k) {
        const RowOrder order(table.mesh(), table.rows().middle(k));
        const auto row = all->row(k);
        for (std::size_t i = 0; i < row.size(); ++i) {
          EXPECT_LE(order.exact(row[i].begin), order.exact(row[i].end)) << name;
          if (i > 0) {
            EXPECT_LE(order.exact(row[i - 1].begin), order.exact(row[i].begin)) << name;
          }
          const mpq_class farthest = order.exact(row[all->reach(k)[i]].end);
          for (std::size_t j = 0; j <= i; ++j) {
            EXPECT_LE(order.exact(row[j].end), farthest) << name;
          }
        }
      }
    }
  });
}

/// Doubles decide where they say that they can.
TEST(AngularTable, NearPlacesAreWithinTheirError) {
  for_each_light([&](const Rows& rows, const std::string& name) {
    const AngularTable table = rows.table(Pairing::kPeaks);
    for (std::uint32_t k = 0; k < table.rows().count(); k += 5) {
      const RowOrder order(table.mesh(), table.rows().middle(k));
      for (const TableInterval& span : table.spans().row(k)) {
        const RowOrder::NearS near = order.near(span.begin);
        if (!(near.error < 1e300)) continue;
        EXPECT_LE(abs(order.exact(span.begin) - mpq_class(near.s)), mpq_class(near.error)) << name;
      }
    }
  });
}

}  // namespace
}  // namespace gnomon::test
