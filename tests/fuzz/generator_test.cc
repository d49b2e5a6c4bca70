// SPDX-License-Identifier: GPL-3.0-or-later
// Generators: the same seed gives the same scene, every scene can be prepared, every kind expected
// appears, and what a scene is said to hold is there.
#include "fuzz/generate/generator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "fuzz/kinds/kind_predicates.h"
#include "fuzz/moves/moves.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/write.h"
#include "scene/base/text_hash.h"

namespace gnomon::fuzz {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Generator generator(const std::string& text) {
  auto parsed = Generator::parse(text);
  EXPECT_TRUE(parsed) << text << ": " << (parsed ? "" : to_string(parsed.error()));
  return *parsed;
}

std::string text_of(const Scene& scene) {
  const auto written = scene_to_text(scene, SceneFormat::kJson);
  EXPECT_TRUE(written) << to_string(written.error());
  return written ? written->text : "";
}

class Mix : public testing::TestWithParam<const char*> {};

TEST_P(Mix, EveryExpectedKindAppearsAndIsThere) {
  const Generator made_by = generator(GetParam());
  std::set<std::uint16_t> seen;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const MadeScene made = made_by.make(seed);
    const auto prepared = prepare(made.scene);
    ASSERT_TRUE(prepared) << seed << " " << made.recipe << ": " << to_string(prepared.error());
    ASSERT_FALSE(prepared->parts.empty()) << seed;
    ASSERT_FALSE(prepared->lights.empty()) << seed;
    ASSERT_TRUE(std::ranges::is_sorted(made.kinds)) << seed;
    ASSERT_TRUE(scene_to_text(made.scene, SceneFormat::kJson)) << seed << " " << made.recipe;
    const KindChecker checker(made.scene);
    for (const std::uint16_t kind : made.kinds) {
      EXPECT_TRUE(checker.holds(static_cast<Kind>(kind)))
          << seed << " " << made.recipe << ": " << kinds()[kind].name << '\n'
          << text_of(made.scene);
    }
    if (seed < 1000) seen.insert(made.kinds.begin(), made.kinds.end());
  }
  for (const std::uint16_t kind : made_by.expected_kinds()) {
    EXPECT_TRUE(seen.contains(kind)) << kinds()[kind].name;
  }
}

TEST_P(Mix, ARecipeIsAGeneratorThatGivesTheSameScene) {
  const Generator made_by = generator(GetParam());
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const MadeScene made = made_by.make(seed);
    EXPECT_EQ(text_of(generator(made.recipe).make(seed).scene), text_of(made.scene))
        << seed << " " << made.recipe;
  }
}

INSTANTIATE_TEST_SUITE_P(Generator, Mix, testing::Values("mix", "area-mix", "family-small-lattice"),
                         [](const auto& test) {
                           const std::string name = test.param;
                           return name == "mix"        ? "Mix"
                                  : name == "area-mix" ? "AreaMix"
                                                       : "SmallLattice";
                         });

/// Of the texts of 300 scenes.
std::uint64_t digest_of(const Generator& made_by) {
  TextHash digest;
  for (std::uint64_t seed = 0; seed < 300; ++seed) digest.add(text_of(made_by.make(seed).scene));
  return digest.value();
}

/// A change of a generator changes what every seed in a database or a report means: it is to be
/// made on purpose, with new numbers here.
TEST(Generator, GivesTheSameScenesEverywhereAndAlways) {
  EXPECT_EQ(digest_of(generator("mix")), 9916677009930269630u);
  EXPECT_EQ(digest_of(generator("area-mix")), 2183438363570001596u);
}

TEST(Generator, SmallLatticesAreSmallAndOnTheirPoints) {
  const Generator made_by = generator("family-small-lattice");
  std::size_t only_receive = 0, mixed = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Scene scene = made_by.make(seed).scene;
    EXPECT_GE(scene.polygons.size(), 2u) << seed;
    EXPECT_LE(scene.polygons.size(), 16u) << seed;
    for (const Position& vertex : scene.vertices) {
      for (const Number& x : vertex) {
        EXPECT_TRUE(x.nearest() == 0 || x.nearest() == 1 || x.nearest() == 2) << seed;
      }
    }
    const auto is_two_sided = [](const Polygon& p) { return p.two_sided.value_or(false); };
    only_receive += std::ranges::any_of(scene.polygons, [](const Polygon& p) { return !p.casts; });
    mixed += std::ranges::any_of(scene.polygons, is_two_sided) &&
             !std::ranges::all_of(scene.polygons, is_two_sided);
  }
  EXPECT_GT(only_receive, 50u);
  EXPECT_GT(mixed, 30u);
}

TEST(Generator, CutsFilesAndLargeScenesDown) {
  const auto path = std::filesystem::path(testing::TempDir()) / "gnomon+city.json";
  std::ofstream(path) << text_of(*generate("table-chair"));
  for (const std::string prefix : {"", "area-"}) {
    const Generator from_file = generator(prefix + "file:" + path.string() + "+any");
    const Generator from_scene = generator(prefix + "scene:table-chair");
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      for (const Generator* made_by : {&from_file, &from_scene}) {
        const MadeScene made = made_by->make(seed);
        EXPECT_TRUE(prepare(made.scene)) << seed;
        EXPECT_LE(made.scene.polygons.size(), 20u) << seed;
        EXPECT_EQ(text_of(made_by->make(seed).scene), text_of(made.scene));
        const bool area = std::ranges::any_of(made.scene.lights,
                                              [](const Light& light) { return light.has_area(); });
        EXPECT_EQ(area, !prefix.empty()) << seed << " " << made.recipe;
      }
    }
    EXPECT_EQ(from_file.expected_kinds(), std::vector<std::uint16_t>{id_of(Kind::kFile)});
  }
  std::filesystem::remove(path);
}

TEST(Generator, UndoesMoves) {
  const Generator made_by = generator("soup-lattice+duplicate+light-at-vertex");
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MadeScene made = made_by.make(seed);
    const std::vector<Scene> fewer = made_by.with_fewer_moves(seed);
    ASSERT_EQ(fewer.size(), 3u);
    EXPECT_EQ(text_of(fewer[0]), text_of(generator("soup-lattice").make(seed).scene));
    EXPECT_EQ(text_of(fewer[1]), text_of(generator("soup-lattice+duplicate").make(seed).scene));
    EXPECT_EQ(fewer[2].polygons.size() + 1, made.scene.polygons.size());
  }
  EXPECT_THAT(generator("soup-lattice").with_fewer_moves(1), IsEmpty());
}

TEST(Generator, ErrorsNameWhatThereIs) {
  const auto message = [](const char* text) { return to_string(Generator::parse(text).error()); };
  EXPECT_THAT(message("soup"), HasSubstr("soup-lattice"));
  EXPECT_THAT(message("soup-lattice+twist"), HasSubstr("t-junction"));
  EXPECT_THAT(message("scene:nowhere"), HasSubstr("generate --list"));
  EXPECT_THAT(message("file:nowhere.json"), HasSubstr("nowhere.json"));
}

}  // namespace
}  // namespace gnomon::fuzz
