// SPDX-License-Identifier: GPL-3.0-or-later
// Area lights on the command line: classes in files, algorithms, lists by class, several lights
// together, pictures and facts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Arguments = std::vector<std::string>;

std::string example(const std::string& name) { return GNOMON_EXAMPLES "/" + name + ".json"; }

rapidjson::Document parsed(const std::string& text) {
  rapidjson::Document document;
  document.Parse(text.c_str());
  EXPECT_FALSE(document.HasParseError()) << text.substr(0, 200);
  return document;
}

/// gnomon with these arguments, which must succeed without a word.
std::string run(const Arguments& arguments) {
  const RunResult done = run_gnomon(arguments);
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.err, "");
  return done.out;
}

void expect_refused(const Arguments& arguments, const std::vector<std::string>& words) {
  const RunResult done = run_gnomon(arguments);
  EXPECT_EQ(done.status, 2) << done.err;
  EXPECT_EQ(done.out, "");
  EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
  for (const std::string& word : words) EXPECT_THAT(done.err, HasSubstr(word));
}

/// The classes that the fragments of a result have.
std::set<std::string> classes_of(const std::string& result) {
  std::set<std::string> classes;
  const rapidjson::Document document = parsed(result);
  for (const auto& light : document["lights"].GetArray()) {
    for (const auto& polygon : light["polygons"].GetArray()) {
      for (const auto& fragment : polygon["fragments"].GetArray()) {
        classes.insert(fragment["class"].GetString());
      }
    }
  }
  return classes;
}

TEST(AreaLights, FractionsAreThoseWorkedOutByHand) {
  const rapidjson::Document document =
      parsed(run({"shadows", example("figure-4f"), "--exact-fractions"}));
  EXPECT_STREQ(document["algorithm"].GetString(), "receiver");
  const auto& light = document["lights"][0];
  EXPECT_STREQ(light["id"].GetString(), "panel");
  EXPECT_STREQ(light["umbra"].GetString(), "per-caster");
  const auto& floor = light["polygons"][0];
  EXPECT_STREQ(floor["lit"]["fraction"].GetString(), "19/224");
  EXPECT_STREQ(floor["penumbra"]["fraction"].GetString(), "7/16");
  EXPECT_STREQ(floor["umbra"]["fraction"].GetString(), "107/224");
  EXPECT_FALSE(floor.HasMember("shadow"));
  // Polygon 3 is cut by the penumbra and by the umbra of polygon 1.
  const auto& third = light["polygons"][3];
  EXPECT_STREQ(third["lit"]["fraction"].GetString(), "5/13");
  EXPECT_STREQ(third["penumbra"]["fraction"].GetString(), "6/13");
  EXPECT_STREQ(third["umbra"]["fraction"].GetString(), "2/13");
}

TEST(AreaLights, ExamplesAreWhatGeneratePrintsAndIdentical) {
  const std::map<std::string, Arguments> scenes{
      {"plates1", {"plates1"}},
      {"room1992", {"room1992"}},
      {"room1992-two", {"room1992", "--param", "lights=2"}},
      {"room1992-simple", {"room1992", "--param", "lights=2", "--param", "playpen=0"}},
      {"figure-4f", {"figure-4f"}},
      {"figure-6", {"figure-6"}},
      {"panel-contacts", {"panel-contacts"}}};
  for (const auto& [name, parameters] : scenes) {
    SCOPED_TRACE(name);
    Arguments arguments{"generate"};
    arguments.insert(arguments.end(), parameters.begin(), parameters.end());
    EXPECT_EQ(run(arguments), read_text(example(name)));
    const std::string table = run({"certify", example(name), "--kernel", "plane", "--strict"});
    EXPECT_THAT(table, AllOf(HasSubstr("identical"), HasSubstr("by receiver")));
  }
}

TEST(AreaLights, AReceiverInAPlaneOfTheUmbraIsInIt) {
  // The mat ends at the wall, so that its umbra has a plane in common with it: what is under the
  // mat sees nothing of the light. Of the wall, 1 by 10, that is the lowest tenth.
  const TestDirectory directory;
  const std::string scene = directory.file("mat.json");
  write_text(scene, R"({"format": "gnomon-scene", "version": 1, "name": "mat",
 "vertices": [[0,0,0],[0,0,10],[1,0,10],[1,0,0], [-20,0,1],[20,0,1],[20,20,1],[-20,20,1]],
 "polygons": [{"id": "wall", "loop": [0,1,2,3]}, {"id": "mat", "loop": [4,5,6,7]}],
 "lights": [{"id": "panel", "type": "area", "loop": [[0,-2,12],[0,4,12],[2,4,12],[2,-2,12]]}]})");
  const rapidjson::Document document = parsed(run({"shadows", scene, "--exact-fractions"}));
  const auto& wall = document["lights"][0]["polygons"][0];
  EXPECT_STREQ(wall["umbra"]["fraction"].GetString(), "1/10");
  EXPECT_STREQ(wall["lit"]["fraction"].GetString(), "9/10");
  EXPECT_THAT(run({"certify", scene, "--kernel", "plane", "--strict"}), HasSubstr("identical"));
}

TEST(AreaLights, ListsByClass) {
  const std::string scene = example("plates1");
  EXPECT_EQ(classes_of(run({"shadows", scene, "--fragments"})),
            (std::set<std::string>{"lit", "penumbra", "umbra"}));
  EXPECT_EQ(classes_of(run({"shadows", scene, "--fragments", "--penumbra-only"})),
            (std::set<std::string>{"penumbra"}));
  EXPECT_EQ(classes_of(run({"shadows", scene, "--fragments", "--umbra-only"})),
            (std::set<std::string>{"umbra"}));
  EXPECT_EQ(classes_of(run({"shadows", scene, "--fragments", "--shadow-only"})),
            (std::set<std::string>{"penumbra", "umbra"}));
  EXPECT_EQ(classes_of(run({"shadows", scene, "--fragments", "--lit-only"})),
            (std::set<std::string>{"lit"}));
  expect_refused({"shadows", scene, "--lit-only", "--umbra-only"}, {"--lit-only", "--umbra-only"});
  expect_refused({"shadows", scene, "--umbra-only", "--penumbra-only"}, {"--penumbra-only"});
}

TEST(AreaLights, WitnessesAndReasons) {
  const rapidjson::Document document =
      parsed(run({"shadows", example("room1992"), "--fragments", "--exact-loops"}));
  std::set<std::string> reasons;
  for (const auto& polygon : document["lights"][0]["polygons"].GetArray()) {
    for (const auto& fragment : polygon["fragments"].GetArray()) {
      const std::string shade = fragment["class"].GetString();
      if (fragment.HasMember("reason")) reasons.insert(fragment["reason"].GetString());
      EXPECT_EQ(shade == "lit", !fragment.HasMember("caster") && !fragment.HasMember("reason"))
          << shade;
      EXPECT_TRUE(fragment.HasMember("exact_loop"));
    }
  }
  EXPECT_TRUE(reasons.contains("behind-light"));
}

TEST(AreaLights, AlgorithmsAndWhatTheyAreRefusedFor) {
  const std::string scene = example("figure-6");
  const auto algorithm = [&](const Arguments& options) {
    Arguments arguments{"shadows", scene};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return std::string(parsed(run(arguments))["algorithm"].GetString());
  };
  EXPECT_EQ(algorithm({}), "contour");
  EXPECT_EQ(algorithm({"--fragments"}), "receiver");
  EXPECT_EQ(algorithm({"--exact-fractions"}), "receiver");
  EXPECT_EQ(algorithm({"--kernel", "rational"}), "receiver");
  EXPECT_EQ(algorithm({"--algorithm", "sectors"}), "receiver");
  EXPECT_EQ(algorithm({"--algorithm", "receiver"}), "receiver");
  EXPECT_EQ(algorithm({"--point=1,2,90"}), "contour");
  EXPECT_EQ(algorithm({"--point=1,2,90", "--fragments"}), "sectors+receiver");
  EXPECT_EQ(algorithm({"--point=1,2,90", "--algorithm", "svbsp"}), "svbsp+receiver");
  EXPECT_EQ(algorithm({"--point=1,2,90", "--algorithm", "receiver"}), "receiver");
  expect_refused({"shadows", scene, "--algorithm", "magic"}, {"receiver", "merged"});
  expect_refused({"shadows", scene, "--algorithm", "receiver", "--no-merge"},
                 {"--no-merge", "svbsp"});
  for (const char* other : {"receiver", "contour"}) {
    expect_refused({"shadows", scene, "--algorithm", other, "--pieces"}, {"--pieces", "merged"});
  }
  expect_refused({"shadows", scene, "--area=1,1,1:2,2"}, {"--area"});
  expect_refused({"shadows", scene, "--area=0,0,90:9,0,90:9,9,91:0,9,90"}, {"planar"});
  expect_refused({"shadows", scene, "--light", "lamp"}, {"lamp", "panel"});
}

TEST(AreaLights, PiecesHaveIdsOfTheirOwn) {
  const rapidjson::Document document = parsed(run({"shadows", example("room1992"), "--pieces"}));
  EXPECT_STREQ(document["algorithm"].GetString(), "pieces");
  ASSERT_GT(document["lights"].Size(), 1u);
  EXPECT_STREQ(document["lights"][0]["id"].GetString(), "panel/0");
  EXPECT_STREQ(document["lights"][1]["id"].GetString(), "panel/1");
  expect_refused({"shadows", example("plates1"), "--pieces", "--combined"}, {"pieces"});
  expect_refused({"shadows", example("plates1"), "--pieces", "--deep-umbra"}, {"--pieces"});
}

TEST(AreaLights, CombinedFragmentsNameTheLightsOfTheirPenumbra) {
  const rapidjson::Document document =
      parsed(run({"shadows", example("plates1"), "--point=10,10,90", "--combined", "--fragments"}));
  EXPECT_STREQ(document["algorithm"].GetString(), "svbsp+receiver");
  bool mixed = false, lit_by_both = false;
  for (const auto& polygon : document["combined"].GetArray()) {
    for (const auto& fragment : polygon["fragments"].GetArray()) {
      const auto lit = fragment["lit_by"].GetArray();
      const auto penumbra = fragment["penumbra_of"].GetArray();
      mixed = mixed || (lit.Size() == 1 && std::string(lit[0].GetString()) == "point0" &&
                        penumbra.Size() == 1 && std::string(penumbra[0].GetString()) == "panel");
      lit_by_both = lit_by_both || lit.Size() == 2;
    }
  }
  EXPECT_TRUE(mixed);
  EXPECT_TRUE(lit_by_both);
  // Without area lights the key is not there.
  const rapidjson::Document points = parsed(
      run({"shadows", example("plates1"), "--point=10,10,90", "--light", "point0", "--combined"}));
  EXPECT_FALSE(points["combined"][0]["fragments"][0].HasMember("penumbra_of"));
}

TEST(AreaLights, DeepUmbraIsEnclosed) {
  // Dark along x from -44 to 152/7, of a floor of 128: the gap of figure 4(f) is part of it.
  const rapidjson::Document document =
      parsed(run({"shadows", example("figure-4f"), "--deep-umbra", "--deep-umbra-tolerance", "0.01",
                  "--fragments"}));
  const auto& floor = document["lights"][0]["polygons"][0];
  const double deep = (44 + 152.0 / 7) / 128;
  EXPECT_LE(floor["deep_umbra"]["lower"].GetDouble(), deep);
  EXPECT_GE(floor["deep_umbra"]["upper"].GetDouble(), deep);
  EXPECT_LE(floor["deep_umbra"]["upper"].GetDouble(),
            floor["deep_umbra"]["lower"].GetDouble() + 0.02);
  EXPECT_FALSE(floor["fragments"][0].HasMember("exact_loop"));
  expect_refused({"shadows", example("figure-4f"), "--deep-umbra", "--kernel", "double"},
                 {"--deep-umbra", "double"});
  expect_refused({"shadows", example("figure-4f"), "--deep-umbra-tolerance", "0.1"},
                 {"--deep-umbra"});
  expect_refused({"shadows", example("figure-4f"), "--deep-umbra", "--algorithm", "contour"},
                 {"fragments"});
  // Of what is lit everywhere exactly nothing is dark.
  EXPECT_EQ(document["lights"][0]["polygons"][1]["deep_umbra"]["upper"].GetDouble(), 0);
}

TEST(AreaLights, CertificatesOfForeignResultsTellMissingUmbra) {
  const TestDirectory directory;
  const std::string own = directory.file("own.json"), foreign = directory.file("foreign.json");
  run({"shadows", example("figure-4f"), "--fragments", "-o", own});
  std::string text = read_text(own);
  // Another program that calls all umbra penumbra and does not say what its umbra is.
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
      text.replace(at, from.size(), to);
    }
  };
  replace("\"class\": \"umbra\"", "\"class\": \"penumbra\"");
  replace("\"umbra\": \"per-caster\",", "");
  write_text(foreign, text);
  const RunResult cost = run_gnomon({"certify", example("figure-4f"), "--candidate", foreign});
  EXPECT_EQ(cost.status, 0) << cost.out;
  EXPECT_THAT(cost.out, HasSubstr("umbra called penumbra"));
  // Penumbra called lit is an error.
  replace("\"class\": \"penumbra\"", "\"class\": \"lit\"");
  write_text(foreign, text);
  const RunResult error = run_gnomon({"certify", example("figure-4f"), "--candidate", foreign});
  EXPECT_EQ(error.status, 1) << error.out;
  EXPECT_THAT(error.out, AllOf(HasSubstr("failed"), HasSubstr("found lit")));
}

TEST(AreaLights, FactsAndPictures) {
  const std::string facts = run({"info", example("room1992-two")});
  EXPECT_THAT(facts,
              AllOf(HasSubstr("panel2: area, 4 corners"), HasSubstr("see it"), HasSubstr("planes"),
                    HasSubstr("behind it"), HasSubstr("area lights: predicate"),
                    HasSubstr("area lights, where planes of polygons cut them")));
  EXPECT_THAT(run({"info", example("figure-4f")}),
              AllOf(HasSubstr("area lights: predicate"), Not(HasSubstr("cut them")),
                    Not(HasSubstr("point lights: predicate"))));
  const rapidjson::Document document = parsed(run({"info", example("figure-6"), "--json", "-"}));
  const auto& light = document["lights"][0];
  EXPECT_EQ(light["facing"].GetInt(), 3);
  EXPECT_EQ(light["corners"].GetInt(), 3);
  EXPECT_EQ(light["cut_by_planes_of"].GetInt(), 0);
  EXPECT_EQ(light["reaching_behind"].GetInt(), 0);

  const std::string picture = run({"render", example("plates1")});
  EXPECT_THAT(picture, AllOf(HasSubstr("<svg"), HasSubstr("penumbra"), HasSubstr("umbra"),
                             Not(HasSubstr("in shadow"))));
  // Lights that are asked for stand side by side.
  const std::string two = run({"render", example("room1992-simple"), "--light", "panel2", "--light",
                               "panel", "--width", "200", "--height", "160"});
  EXPECT_THAT(two, AllOf(HasSubstr("light panel,"), HasSubstr("light panel2,"),
                         HasSubstr("lights: panel, panel2")));
}

}  // namespace
}  // namespace gnomon::test
