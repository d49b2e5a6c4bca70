// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon shrink as a user runs it: what it prints, what it leaves, how it goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kRoom = std::string(GNOMON_EXAMPLES) + "/table-chair.json";

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t number = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++number;
  }
  return number;
}

TEST(Shrink, ASceneGetsSmallAndFailsStill) {
  const TestDirectory directory;
  const std::string small = directory.file("small.json");
  const RunResult run = run_gnomon({"shrink", kRoom, "--kernel", "float", "-o", small});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  // The case as it came stands before all else.
  EXPECT_THAT(run.out, StartsWith(kRoom + " fails: oracle:misclassified:float:"));
  EXPECT_THAT(run.out, AllOf(HasSubstr("65 polygons"), HasSubstr("locally minimal: no step")));
  const std::string text = read_text(small);
  EXPECT_LE(count(text, "\"loop\""), 3u) << text;
  EXPECT_THAT(text, HasSubstr("\"fails\": \"oracle:misclassified:float:"));
  EXPECT_EQ(run_gnomon({"certify", small, "--kernel", "float"}).status, 1);
  EXPECT_EQ(directory.count(), 1u);  // nothing half-written

  // The same again: it goes on from there, and stays.
  const RunResult again = run_gnomon({"shrink", kRoom, "--kernel", "float", "-o", small});
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.out, AllOf(HasSubstr("going on from"), HasSubstr("(0 accepted)")));
  EXPECT_EQ(read_text(small), text);
  // Another task does not.
  EXPECT_THAT(run_gnomon({"shrink", kRoom, "--kernel", "float+thin", "-o", small}).out,
              Not(HasSubstr("going on from")));
}

/// A roof that doubles bend by 9e-16, and a skylight all but in it.
const std::string kSkylight = R"({"format": "gnomon-scene", "version": 1, "name": "skylight",
 "numbers": "decimal",
 "vertices": [[-8,-4,3],[0,-4,3],[0,9,3.0000000000000009],[-8,9,3],
              [-6,5,3],[-2,5,3],[-2,8,3],[-6,8,3]],
 "polygons": [{"id": "roof", "loop": [0,1,2,3]}, {"id": "skylight", "loop": [4,5,6,7]}],
 "lights": [{"id": "sun", "type": "directional", "to_light": [1,2,3]}]})";

/// The numbers of a file's vertices.
std::vector<double> coordinates(const std::string& text) {
  rapidjson::Document scene;
  scene.Parse(text.c_str());
  std::vector<double> all;
  for (const auto& vertex : scene["vertices"].GetArray()) {
    for (const auto& coordinate : vertex.GetArray()) all.push_back(coordinate.GetDouble());
  }
  return all;
}

TEST(Shrink, ASkylightStaysOne) {
  const TestDirectory directory;
  const std::string scene = directory.file("skylight.json"), small = directory.file("small.json");
  write_text(scene, kSkylight);
  const RunResult run = run_gnomon({"shrink", scene, "--kernel", "double", "-o", small});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::string kind = "oracle:misclassified:double:near-coplanar";
  EXPECT_THAT(run.out, HasSubstr(" fails: " + kind));
  const std::string text = read_text(small);
  EXPECT_THAT(text, HasSubstr(kind));
  for (const double coordinate : coordinates(text)) {
    EXPECT_GE(coordinate, -8);
    EXPECT_LE(coordinate, 9);
  }
  // The smaller scene fails of the same cause.
  const RunResult again = run_gnomon({"shrink", small, "--kernel", "double"});
  EXPECT_THAT(again.err, HasSubstr(" fails: " + kind));
}

TEST(Shrink, TheRangeIsFreeIfAsked) {
  const TestDirectory directory;
  const std::string scene = directory.file("skylight.json"), small = directory.file("small.json");
  write_text(scene, kSkylight);
  const RunResult run =
      run_gnomon({"shrink", scene, "--kernel", "double", "--free-range", "-o", small});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::vector<double> all = coordinates(read_text(small));
  EXPECT_GT(*std::ranges::max_element(all), 9);
  EXPECT_THAT(read_text(small), HasSubstr(":near-coplanar"));
}

TEST(Shrink, WithoutAFileTheSceneIsStandardOutput) {
  const RunResult run = run_gnomon({"shrink", kRoom});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, StartsWith("{\"format\": \"gnomon-scene\""));
  EXPECT_THAT(run.err, AllOf(HasSubstr(" fails: "), HasSubstr("locally minimal")));
}

TEST(Shrink, AFindingIsAFolder) {
  const TestDirectory directory;
  const RunResult run = run_gnomon({"shrink", kRoom, "--kernel", "float", "--findings",
                                    directory.file("found"), "-o", directory.file("small.json")});
  EXPECT_EQ(run.status, 0) << run.err;
  const std::size_t at = run.out.find("finding: ");
  ASSERT_NE(at, std::string::npos) << run.out;
  std::string place = run.out.substr(at + 9);
  place.resize(place.find('\n'));
  EXPECT_THAT(read_text(place + "/README.md"), HasSubstr("gnomon replay oracle-"));
  EXPECT_EQ(run_gnomon({"certify", place + "/scene.json", "--kernel", "float"}).status, 1);
}

TEST(Shrink, FindingsOfACampaignReplay) {
  const TestDirectory directory;
  const std::vector<std::string> command = {"fuzz",
                                            "--generator",
                                            "soup-lattice",
                                            "--kernel",
                                            "float",
                                            "--count",
                                            "10",
                                            "--property",
                                            "oracle",
                                            "--keep",
                                            "2",
                                            "-j",
                                            "1",
                                            "--findings",
                                            directory.file("found"),
                                            "--db",
                                            directory.file("campaign.db")};
  const RunResult run = run_gnomon(command);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr(") fails: oracle:"), HasSubstr("locally minimal")));
  std::size_t folders = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory.file("found"))) {
    ++folders;
    const RunResult replay = run_gnomon({"replay", entry.path().string()});
    EXPECT_EQ(replay.status, 1) << replay.out << replay.err;
    EXPECT_THAT(replay.out, HasSubstr("oracle:"));
    EXPECT_THAT(read_text(entry.path() / "README.md"), HasSubstr("generator `soup-lattice`"));
  }
  EXPECT_GE(folders, 1u);
  // What is written is known.
  EXPECT_THAT(run_gnomon(command).err, Not(HasSubstr("fails: ")));
}

TEST(Shrink, AForeignProgramIsShrunkToo) {
  const TestDirectory directory;
  // Wrong only where there are two polygons or more.
  write_text(directory.file("solver.sh"),
             "n=$(grep -c '\"loop\"' \"$1\")\n"
             "[ \"$n\" -lt 2 ] || kill -SEGV $$\n"
             "exec \"" GNOMON_PROGRAM "\" shadows \"$1\" --fragments\n");
  const RunResult run =
      run_gnomon({"shrink", kRoom, "--candidate-command", "sh " + directory.file("solver.sh")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("no-crash:signal 11:command:sh "));
  EXPECT_EQ(count(run.out, "\"loop\""), 2u) << run.out;
}

TEST(Shrink, WhatDoesNotFailIsAnAnswer) {
  const RunResult run = run_gnomon({"shrink", kRoom, "--kernel", "plane"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr("nothing to shrink: it does not fail (plane)"));
  EXPECT_EQ(run_gnomon({"shrink", kRoom, "--kernel", "float", "--class", "no such"}).status, 0);
}

TEST(Shrink, StoppedItKeepsTheBestAndGoesOn) {
  const TestDirectory directory;
  const std::string large = directory.file("large.json"), small = directory.file("small.json");
  ASSERT_EQ(run_gnomon({"generate", "city", "--param", "n=40", "-o", large}).status, 0);
  RunOptions options;
  options.signal = SIGINT;
  options.signal_when = [&] { return std::filesystem::exists(small); };
  const std::vector<std::string> command = {"shrink", large, "--kernel", "float", "-o", small};
  RunResult run = run_gnomon(command, options);
  EXPECT_TRUE(run.status == 130 || run.status == 0) << run.status << run.err;
  run = run_gnomon({"shrink", large, "--kernel", "float", "--time", "0.1", "-o", small});
  EXPECT_EQ(run.status, 0) << run.err;
  run = run_gnomon(command);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("going on from"), HasSubstr("locally minimal: no step")));
  EXPECT_LE(count(read_text(small), "\"loop\""), 3u);
}

TEST(Shrink, BadUsageIsTold) {
  const RunResult property = run_gnomon({"shrink", kRoom, "--property", "beauty"});
  EXPECT_EQ(property.status, 2);
  EXPECT_THAT(property.err, HasSubstr("one of: no-crash, budget"));
  EXPECT_EQ(run_gnomon({"shrink", kRoom, "--kernel", "quad"}).status, 2);
  EXPECT_EQ(run_gnomon({"shrink", "no such file"}).status, 2);
  EXPECT_EQ(
      run_gnomon({"shrink", kRoom, "--kernel", "float", "-o", "/no/such/folder/x.json"}).status, 2);
}

}  // namespace
}  // namespace gnomon::test
