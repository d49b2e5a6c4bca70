// SPDX-License-Identifier: GPL-3.0-or-later
// Radiance: polygons and seams, lamps and sources, xform, what is left out, and where each kind of
// bad file goes wrong.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "gnomon/scene/prepare.h"
#include "scene_testing.h"
#include "shown_scene.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kGrey = "void plastic grey\n0\n0\n5 .5 .5 .5 0 0\n";

std::string polygon(const std::string& name, const std::string& numbers,
                    const std::string& modifier = "grey") {
  const auto words = std::count(numbers.begin(), numbers.end(), ' ') + 1;
  return modifier + " polygon " + name + "\n0\n0\n" + std::to_string(words) + " " + numbers + "\n";
}

TEST(Radiance, PolygonsHaveTwoSidesAndExactDecimals) {
  const ReadResult result =
      read_text("# a floor\n" + kGrey + polygon("floor", "0 0 0 .1 0 0 .1 1e-1 0") +
                    polygon("floor", "0 0 1 1 0 1 1 1 1") + "grey alias other grey\n" +
                    polygon("wall", "0 0 0 1 0 0 1 0 1", "other"),
                "a.rad");
  EXPECT_THAT(result.warnings, IsEmpty());
  const Scene& scene = result.scene;
  EXPECT_EQ(scene.numbers, NumberMeaning::kDecimal);
  EXPECT_TRUE(scene.two_sided);
  EXPECT_THAT(ids_of(scene), ElementsAre("floor", "floor/1", "wall"));
  EXPECT_EQ(loop_of(scene, "floor"), "(0, 0, 0) (0.1, 0, 0) (0.1, 0.1, 0)");
  EXPECT_THAT(scene.extra, HasSubstr(R"("grey":["floor","floor/1"],"other":["wall"])"));
}

TEST(Radiance, SeamsLeadToHoles) {
  // Around the outline, along a seam to a square hole, around it and back; and to a second one.
  const Scene scene =
      read_text(kGrey + polygon("w", "0 0 0 9 0 0 9 9 0 0 9 0 0 0 0 1 1 0 1 2 0 2 2 0 2 1 0 1 1 0"),
                "a.rad")
          .scene;
  ASSERT_EQ(scene.polygons[0].holes.size(), 1u);
  EXPECT_EQ(scene.polygons[0].loop.size(), 4u);
  EXPECT_EQ(scene.polygons[0].holes[0].size(), 4u);
  const Scene two = read_text(kGrey + polygon("w",
                                              "0 0 0 9 0 0 9 9 0 8 8 0 8 7 0 7 7 0 7 8 0 8 8 0 9 9 "
                                              "0 0 9 0 0 0 0 1 1 0 1 2 0 2 2 0 2 1 0 1 1 0"),
                              "a.rad")
                        .scene;
  ASSERT_EQ(two.polygons[0].holes.size(), 2u);
  EXPECT_EQ(two.polygons[0].loop.size(), 4u);
  // A hole in a chain of seams: outline, first hole, from there to the second.
  const Scene chain = read_text(kGrey + polygon("w",
                                                "0 0 0 9 0 0 9 9 0 0 9 0 0 0 0 1 1 0 1 2 0 2 2 0 "
                                                "5 5 0 5 6 0 6 6 0 6 5 0 5 5 0 2 2 0 2 1 0 1 1 0"),
                                "a.rad")
                          .scene;
  EXPECT_EQ(chain.polygons[0].holes.size(), 2u);
  // A hair there and back is gone; two islands stay one loop, which preparation cuts.
  const Scene hair =
      read_text(kGrey + polygon("w", "0 0 0 9 0 0 9 9 0 12 12 0 9 9 0 0 9 0"), "a.rad").scene;
  EXPECT_EQ(hair.polygons[0].loop.size(), 4u);
  EXPECT_THAT(hair.polygons[0].holes, IsEmpty());
  const Scene islands =
      read_text(
          kGrey + polygon("w", "0 0 0 9 0 0 9 9 0 12 12 0 15 12 0 15 15 0 12 12 0 9 9 0 0 9 0"),
          "a.rad")
          .scene;
  EXPECT_EQ(islands.polygons[0].loop.size(), 9u);
  const auto prepared = prepare(islands);
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  EXPECT_GE(prepared->parts.size(), 2u);
}

TEST(Radiance, LampsAndSources) {
  const ReadResult result = read_text(
      kGrey + "void light bright\n0\n0\n3 100 100 100\n" + "void glow sky\n0\n0\n4 1 1 1 0\n" +
          "void light dim\n0\n0\n3 1 1 1\nbright source sun\n0\n0\n4 1 -2 3 0.533\n" +
          "sky source dome\n0\n0\n4 0 0 1 180\n" +
          polygon("panel", "0 0 3 0 1 3 1 1 3 1 0 3", "dim") +
          polygon("shining", "5 0 0 6 0 0 6 1 0", "sky") + polygon("floor", "0 0 0 1 0 0 1 1 0"),
      "a.rad");
  const Scene& scene = result.scene;
  // What glows with a radius of 0 is only seen.
  EXPECT_THAT(ids_of(scene), ElementsAre("shining", "floor"));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_TRUE(scene.lights[0].is_directional());
  EXPECT_EQ(scene.lights[0].id, "sun");
  EXPECT_EQ(shown(scene.lights[0].position), "(1, -2, 3)");
  EXPECT_TRUE(scene.lights[1].has_area());
  EXPECT_EQ(shown(scene.lights[1].loop[1]), "(0, 1, 3)");
  EXPECT_THAT(result.warnings, ElementsAre(HasSubstr("1 source left out"),
                                           HasSubstr("1 source is taken as a direction")));
}

TEST(Radiance, WhatIsLeftOutIsToldOf) {
  const ReadResult result = read_text(kGrey +
                                          "void glass pane\n0\n0\n3 1 1 1\n!gensky 6 21 "
                                          "12\n!genbox grey b 1 1 1 | xform -t 1 0 0\n" +
                                          "grey sphere ball\n0\n0\n4 0 0 0 1\n" +
                                          polygon("g", "0 0 0 1 0 0 1 1 0", "pane") +
                                          polygon("u", "0 0 1 1 0 1 1 1 1", "elsewhere") +
                                          polygon("v", "0 0 2 1 0 2 1 1 2", "void"),
                                      "a.rad");
  EXPECT_THAT(ids_of(result.scene), ElementsAre("g", "u"));
  EXPECT_THAT(result.warnings,
              ElementsAre(HasSubstr("2 commands are not run (genbox, gensky)"),
                          HasSubstr("1 surface of type sphere left out"),
                          HasSubstr("1 polygon of glass"), HasSubstr("1 polygon has a modifier"),
                          HasSubstr("1 polygon of void or antimatter left out")));
}

class Xform : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) / "gnomon_radiance";
    std::filesystem::create_directories(folder_ / "parts");
    std::ofstream(folder_ / "parts" / "leaf.rad") << polygon("leaf", "0 0 0 1 0 0 1 2 0", "green");
    std::ofstream(folder_ / "twig.rad") << "!xform -n twig -t 10 0 0 parts/leaf.rad\n";
    std::ofstream(folder_ / "endless.rad") << "!xform endless.rad\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  Expected<ReadResult> read(const std::string& text) {
    const auto path = folder_ / "main.rad";
    std::ofstream(path) << kGrey << text;
    return read_scene(path);
  }
  std::string loop(const std::string& options) {
    const auto result = read("!xform " + options + " parts/leaf.rad\n");
    EXPECT_TRUE(result) << to_string(result.error());
    return result ? shown(result->scene, result->scene.polygons[0].loop) : "";
  }

  std::filesystem::path folder_;
};

TEST_F(Xform, IsCarriedOutExactly) {
  EXPECT_EQ(loop("-t .1 .2 .3"), "(0.1, 0.2, 0.3) (1.1, 0.2, 0.3) (1.1, 2.2, 0.3)");
  EXPECT_EQ(loop("-s .1 -t 1 0 0"), "(1, 0, 0) (1.1, 0, 0) (1.1, 0.2, 0)");
  EXPECT_EQ(loop("-t 1 0 0 -s 2"), "(2, 0, 0) (4, 0, 0) (4, 4, 0)");
  EXPECT_EQ(loop("-rz 90"), "(0, 0, 0) (0, 1, 0) (-2, 1, 0)");
  EXPECT_EQ(loop("-rx -90"), "(0, 0, 0) (1, 0, 0) (1, 0, -2)");
  EXPECT_EQ(loop("-ry 180"), "(0, 0, 0) (-1, 0, 0) (-1, 2, 0)");
  // Mirrored loops are reversed, so that the front stays the front.
  EXPECT_EQ(loop("-mx"), "(-1, 2, 0) (-1, 0, 0) (0, 0, 0)");
  EXPECT_EQ(loop("-i 3 -t 1 0 0"), "(3, 0, 0) (4, 0, 0) (4, 2, 0)");
}

TEST_F(Xform, OfOtherAnglesIsRoundedAndToldOf) {
  const auto result = read("!xform -rz 30 parts/leaf.rad\n");
  ASSERT_TRUE(result);
  EXPECT_EQ(shown(result->scene.vertices[1]), "(0.866025403784, 0.5, 0)");
  EXPECT_THAT(result->warnings, ElementsAre(HasSubstr("no file here defines"),
                                            HasSubstr("1 file is turned by angles")));
}

TEST_F(Xform, FilesWithinFilesAndArrays) {
  const auto result =
      read("!xform -n tree -t 0 0 5 twig.rad\n!xform -a 2 -t 0 1 0 -a 2 -t 0 0 7 parts/leaf.rad\n");
  ASSERT_TRUE(result) << to_string(result.error());
  const Scene& scene = result->scene;
  EXPECT_THAT(ids_of(scene), ElementsAre("tree.twig.leaf", "leaf", "leaf/1", "leaf/2", "leaf/3"));
  EXPECT_EQ(shown(scene.vertices[scene.polygons[0].loop[0]]), "(10, 0, 5)");
  EXPECT_EQ(shown(scene.vertices[scene.polygons[2].loop[0]]), "(0, 0, 7)");
  EXPECT_EQ(shown(scene.vertices[scene.polygons[4].loop[0]]), "(0, 1, 7)");
}

TEST_F(Xform, ModifiersAreReplacedFromOutside) {
  const auto result = read(
      "void light bright\n0\n0\n3 1 1 1\n!xform -e -m grey parts/leaf.rad\n"
      "!xform -c -m bright -n lamp parts/leaf.rad\n");
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_THAT(result->warnings, IsEmpty());
  EXPECT_THAT(ids_of(result->scene), ElementsAre("leaf"));
  EXPECT_THAT(result->scene.extra, HasSubstr(R"("grey":["leaf"])"));
  ASSERT_EQ(result->scene.lights.size(), 1u);
  EXPECT_EQ(result->scene.lights[0].id, "lamp.leaf");
}

TEST_F(Xform, FilesThatCannotBeRead) {
  const auto error = [&](const std::string& text) {
    const auto result = read(text);
    return result ? "ok" : std::to_string(result.error().where.line) + ": " + result.error().what;
  };
  EXPECT_EQ(error("!xform -t 1 1 1 none.rad\n"), "5: there is no file 'none.rad' beside this one");
  EXPECT_EQ(error("!xform ../other.rad\n"), "5: '../other.rad' is outside of the file's folder");
  EXPECT_EQ(error("!xform /etc/passwd\n"), "5: '/etc/passwd' is outside of the file's folder");
  EXPECT_EQ(error("!xform -I parts/leaf.rad\n"), "5: the option '-I' of xform");
  EXPECT_EQ(error("!xform -t 1 b 3 parts/leaf.rad\n"), "5: 'b' is not a number");
  EXPECT_EQ(error("!xform -t 1 2 3\n"), "5: xform without a file");
  EXPECT_EQ(error("!xform endless.rad\n"), "1: files within files, too deep");
  EXPECT_THAT(error("!xform -a 100000 -t 1 0 0 -a 100000 -t 0 1 0 parts/leaf.rad\n"),
              HasSubstr("too many instances"));
}

TEST(Radiance, ErrorsNameTheirPlace) {
  const auto error = [](const std::string& text) { return error_of(kGrey + text, "a.rad"); };
  EXPECT_EQ(error("grey polygon w\n0\n0\n8 0 0 0 1 0 0 1 1\n"), "5:1: a polygon of 8 reals");
  EXPECT_EQ(error("grey polygon w\n0\n0\n9 0 0 0 1 0 0 1 x 0\n"), "8:17: 'x' is not a number");
  EXPECT_EQ(error("grey polygon w\n0\n0\n9 0 0 0 1 0 0 1 1\n"),
            "9:1: the file ends inside a primitive");
  EXPECT_EQ(error("grey polygon w\n0\nzero\n"), "7:1: 'zero' is no count");
  EXPECT_EQ(error("void light l\n0\n0\n3 1 1 1\nl source s\n0\n0\n4 0 0 0 1\n"),
            "9:1: the direction of a source is 0 0 0");
  ReadOptions options;
  options.skip_bad = true;
  const ReadResult result = read_text(
      kGrey + polygon("a", "0 0 0 1 0 0") + polygon("b", "0 0 0 1 0 0 1 1 0"), "a.rad", options);
  EXPECT_THAT(ids_of(result.scene), ElementsAre("b"));
  ASSERT_EQ(result.left_out.size(), 1u);
  EXPECT_EQ(result.left_out[0].id, "a");
}

TEST(Radiance, IsKnownByItsContent) {
  EXPECT_EQ(format_by_content(kGrey + polygon("w", "0 0 0 1 0 0 1 1 0")), SceneFormat::kRadiance);
  EXPECT_EQ(format_by_content("! an IDF\nVersion, 23.1;\n"), SceneFormat::kIdf);
}

}  // namespace
}  // namespace gnomon
