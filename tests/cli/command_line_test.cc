// SPDX-License-Identifier: GPL-3.0-or-later
// What other programs rely on: exit statuses, one clear line for each error, stable output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <csignal>
#include <sstream>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A square over a floor, a lamp above both: the floor is 3/4 lit.
constexpr const char* kTable = R"({"format": "gnomon-scene", "version": 1, "name": "table",
 "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0], [1,1,1],[2,1,1],[2,2,1],[1,2,1]],
 "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "quad", "loop": [4,5,6,7]}],
 "lights": [{"id": "bulb", "type": "point", "position": [1,1,2]}]})";

/// Lines of standard error; an error must be just one.
std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// Every run of white space as one blank: words, wherever the lines were broken.
std::string unwrapped(const std::string& text) {
  std::istringstream stream(text);
  std::string result;
  for (std::string word; stream >> word;) result += word + ' ';
  return result;
}

class CommandLine : public testing::Test {
 protected:
  void SetUp() override { write_text(table_, kTable); }
  void expect_one_line_error(const RunResult& result, int status, const std::string& words) {
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_THAT(result.err, AllOf(StartsWith("gnomon: "), HasSubstr(words), EndsWith("\n")));
    EXPECT_EQ(lines(result.err), 1u) << result.err;
    EXPECT_EQ(result.out, "");
  }

  TestDirectory directory_;
  const std::string table_ = directory_.file("table.json");
};

TEST_F(CommandLine, VersionAndHelp) {
  EXPECT_THAT(run_gnomon({"--version"}).out, StartsWith("gnomon "));
  const RunResult all = run_gnomon({"--help-all"});
  EXPECT_EQ(all.status, 0);
  for (const std::string command :
       {"certify", "shadows", "verify", "render", "info", "generate", "convert", "shrink"}) {
    EXPECT_THAT(all.out, HasSubstr(command));
    const RunResult help = run_gnomon({command, "--help"});
    EXPECT_EQ(help.status, 0) << command;
    EXPECT_THAT(help.out, HasSubstr("Example")) << command;
    EXPECT_THAT(help.out, HasSubstr("gnomon " + command)) << command;
    EXPECT_EQ(help.err, "") << command;
  }
}

TEST_F(CommandLine, WrongUsageIsStatusTwoAndOneLine) {
  expect_one_line_error(run_gnomon({"nonsense"}), 2, "gnomon --help");
  expect_one_line_error(run_gnomon({"nosuch"}), 2, "gnomon --help");
  expect_one_line_error(run_gnomon({"shadows"}), 2, "SCENE");
  expect_one_line_error(run_gnomon({"shadows", table_, "--nonsense"}), 2, "--nonsense");
  expect_one_line_error(run_gnomon({"shadows", table_, "--kernel", "triple"}), 2, "longdouble");
  expect_one_line_error(run_gnomon({"shadows", table_, "--algorithm", "magic"}), 2, "svbsp");
  expect_one_line_error(run_gnomon({"shadows", table_, "--thickness", "nan"}), 2, "nan");
  expect_one_line_error(run_gnomon({"shadows", table_, "--thickness=-1"}), 2, "-1");
  expect_one_line_error(run_gnomon({"shadows", table_, "--kernel", "double", "--exact-fractions"}),
                        2, "rounds");
  expect_one_line_error(run_gnomon({"shadows", table_, "--light", "moon"}), 2, "bulb");
  expect_one_line_error(run_gnomon({"shadows", table_, "--point=1,2"}), 2, "--point");
  expect_one_line_error(run_gnomon({"shadows", table_, "--sun=0,0,0"}), 2, "--sun");
  expect_one_line_error(run_gnomon({"info", table_, "--numbers", "roman"}), 2, "roman");
  expect_one_line_error(run_gnomon({"generate", "nothing-of-the-kind"}), 2, "--list");
  expect_one_line_error(run_gnomon({"generate", "room", "--param", "size"}), 2, "NAME=");
  expect_one_line_error(run_gnomon({"generate", "mix+twist"}), 2, "no move 'twist'");
  expect_one_line_error(run_gnomon({"generate", "mix", "--param", "n=4"}), 2, "--seed alone");
  expect_one_line_error(run_gnomon({"convert", table_, directory_.file("table.xyz")}), 2, ".json");
  expect_one_line_error(run_gnomon({"render", table_, "--eye", "1,2"}), 2, "--eye");
}

TEST_F(CommandLine, BadFilesAreStatusTwoAndNameThePlace) {
  expect_one_line_error(run_gnomon({"info", directory_.file("absent.json")}), 2, "absent.json");
  expect_one_line_error(run_gnomon({"info", directory_.path().string()}), 2, "directory");
  write_text(directory_.file("empty.json"), "");
  expect_one_line_error(run_gnomon({"certify", directory_.file("empty.json")}), 2, "empty");
  write_text(directory_.file("broken.json"), std::string(kTable).substr(0, 100));
  expect_one_line_error(run_gnomon({"shadows", directory_.file("broken.json")}), 2,
                        "broken.json:2:");
  write_text(directory_.file("index.json"), R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[0,0,0],[4,0,0],[4,4,0]],
 "polygons": [{"loop": [0,1,7]}]})");
  expect_one_line_error(run_gnomon({"info", directory_.file("index.json")}), 2,
                        "/polygons/0/loop/2");
  expect_one_line_error(run_gnomon({"certify", table_, "--candidate", table_}), 2, "table.json");
  write_text(directory_.file("huge.json"), R"({"format": "gnomon-scene", "version": 1,
 "numbers": "decimal", "vertices": [[0,0,1e5000]], "polygons": []})");
  expect_one_line_error(run_gnomon({"info", directory_.file("huge.json")}), 3, "huge.json");
}

TEST_F(CommandLine, ShadowsGivesTheExactFractions) {
  const RunResult result = run_gnomon({"shadows", table_, "--exact-fractions", "--fragments"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  rapidjson::Document json;
  json.Parse(result.out.c_str());
  ASSERT_FALSE(json.HasParseError());
  EXPECT_STREQ(json["format"].GetString(), "gnomon-result");
  EXPECT_STREQ(json["kernel"].GetString(), "plane");
  const auto& floor = json["lights"][0]["polygons"][0];
  EXPECT_STREQ(floor["id"].GetString(), "floor");
  EXPECT_STREQ(floor["side"].GetString(), "front");
  EXPECT_EQ(floor["area"].GetDouble(), 16);
  EXPECT_STREQ(floor["lit"]["fraction"].GetString(), "3/4");
  EXPECT_STREQ(floor["shadow"]["fraction"].GetString(), "1/4");
  EXPECT_EQ(floor["shadow"]["area"].GetDouble(), 4);
  bool named = false;
  for (const auto& fragment : floor["fragments"].GetArray()) {
    const bool shadow = std::string(fragment["class"].GetString()) == "shadow";
    named = named || (shadow && std::string(fragment["caster"].GetString()) == "quad");
  }
  EXPECT_TRUE(named);
}

TEST_F(CommandLine, AreaLightsFromTheCommandLine) {
  const RunResult result = run_gnomon({"shadows", table_, "--area=1,1,3:1,2,3:2,2,3"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, AllOf(HasSubstr("\"area0\""), HasSubstr("\"penumbra\"")));
}

TEST_F(CommandLine, CertifyPassesAndFails) {
  const RunResult good =
      run_gnomon({"certify", table_, "--kernel", "exact", "--kernel", "rational"});
  EXPECT_EQ(good.status, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("identical"));

  const std::string result = directory_.file("result.json");
  ASSERT_EQ(run_gnomon({"shadows", table_, "--fragments", "-o", result}).status, 0);
  EXPECT_EQ(run_gnomon({"certify", table_, "--candidate", result}).status, 0);
  EXPECT_EQ(run_gnomon({"verify", table_, result}).status, 0);

  // A foreign result that has found no shadow at all.
  write_text(result, R"({"lights": [{"id": "bulb", "background": "lit", "polygons": [
    {"id": "floor", "fragments": []}, {"id": "quad", "fragments": []}]}]})");
  const RunResult bad = run_gnomon({"certify", table_, "--candidate", result});
  EXPECT_EQ(bad.status, 1) << bad.out << bad.err;
  EXPECT_THAT(unwrapped(bad.out), AllOf(HasSubstr("failed"), HasSubstr("polygon floor"),
                                        HasSubstr("true shadow, by caster quad")));
}

TEST_F(CommandLine, VerifyFindsAFalseClaim) {
  const std::string result = directory_.file("result.json");
  ASSERT_EQ(
      run_gnomon({"shadows", table_, "--exact-loops", "--exact-fractions", "-o", result}).status,
      0);
  const RunResult good = run_gnomon({"verify", table_, result});
  EXPECT_EQ(good.status, 0) << good.out;
  std::string text = read_text(result);
  const std::size_t at = text.find("\"1/4\"");
  ASSERT_NE(at, std::string::npos);
  write_text(result, text.replace(at, 5, "\"1/5\""));
  const RunResult bad = run_gnomon({"verify", table_, result});
  EXPECT_EQ(bad.status, 1) << bad.out;
  EXPECT_THAT(bad.out, HasSubstr("floor"));
}

TEST_F(CommandLine, TheHumanTableFitsItsColumns) {
  const RunResult result =
      run_gnomon({"certify", std::string(GNOMON_EXAMPLES) + "/table-chair.json"});
  EXPECT_THAT(result.status, testing::AnyOf(0, 1)) << result.err;
  std::istringstream stream(result.out);
  for (std::string line; std::getline(stream, line);) EXPECT_LE(line.size(), 110u) << line;
  EXPECT_THAT(result.out, Not(HasSubstr("...")));  // nothing is cut short
  EXPECT_THAT(result.out, HasSubstr("worst share"));
}

TEST_F(CommandLine, JsonIsStableAndIndependentOfTheLocale) {
  const std::string first = directory_.file("1.json"), second = directory_.file("2.json");
  run_gnomon({"certify", table_, "--json", first});
  RunOptions german;
  german.environment = {"LC_ALL=de_DE.UTF-8", "LANG=de_DE.UTF-8"};
  run_gnomon({"certify", table_, "--json", second}, german);
  EXPECT_EQ(read_text(first), read_text(second));
  rapidjson::Document json;
  json.Parse(read_text(first).c_str());
  ASSERT_FALSE(json.HasParseError());
  EXPECT_STREQ(json["format"].GetString(), "gnomon-certificate");
  EXPECT_THAT(read_text(first), Not(HasSubstr("seconds")));
  run_gnomon({"certify", table_, "--json", second, "--times"});
  EXPECT_THAT(read_text(second), HasSubstr("cpu_seconds"));
  EXPECT_EQ(run_gnomon({"shadows", table_, "--fragments"}).out,
            run_gnomon({"shadows", table_, "--fragments"}, german).out);
}

TEST_F(CommandLine, ReportHasTableVerdictAndPictures) {
  const std::string report = directory_.file("report");
  run_gnomon({"certify", table_, "--report", report});
  EXPECT_THAT(read_text(report + "/table.txt"), HasSubstr("verdict"));
  EXPECT_THAT(read_text(report + "/verdict.json"), HasSubstr("gnomon-certificate"));
  EXPECT_THAT(read_text(report + "/scene.svg"), AllOf(StartsWith("<svg"), EndsWith("</svg>\n")));
}

TEST_F(CommandLine, RenderMakesAPicture) {
  const RunResult result = run_gnomon({"render", table_, "--eye=6,-5,4", "--look-at=2,2,0"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(StartsWith("<svg"), HasSubstr("in shadow"), EndsWith("</svg>\n")));
  // From inside, behind and on a polygon's plane there is still a picture.
  for (const std::string eye : {"--eye=1,1,0.5", "--eye=2,2,-3", "--eye=9,9,0"}) {
    EXPECT_EQ(run_gnomon({"render", table_, eye, "--look-at=2,2,0.1"}).status, 0) << eye;
  }
}

TEST_F(CommandLine, ConvertAndGenerateReadBack) {
  const std::string scene = directory_.file("room.json"), mesh = directory_.file("room.ply");
  ASSERT_EQ(run_gnomon({"generate", "room", "-o", scene}).status, 0);
  EXPECT_EQ(run_gnomon({"generate", "room"}).out, read_text(scene));
  const RunResult converted = run_gnomon({"convert", scene, mesh});
  EXPECT_EQ(converted.status, 0);
  EXPECT_THAT(converted.err, HasSubstr("light"));  // a mesh holds none, and the user is told
  EXPECT_EQ(run_gnomon({"info", mesh}).status, 0);
  EXPECT_THAT(run_gnomon({"generate", "--list"}).out, HasSubstr("room"));
  EXPECT_THAT(run_gnomon({"generate", "--list"}).out, HasSubstr("area-soup-lattice"));
  const std::string text = run_gnomon({"generate", "soup-lattice+duplicate", "--seed", "7"}).out;
  EXPECT_THAT(text, HasSubstr("\"soup-lattice+duplicate\""));
  EXPECT_NE(run_gnomon({"generate", "soup-lattice+duplicate", "--seed", "8"}).out, text);
}

TEST_F(CommandLine, StandardInputIsAScene) {
  RunOptions options;
  options.input = kTable;
  const RunResult result = run_gnomon({"info", "-"}, options);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("<stdin>"));
}

TEST_F(CommandLine, AClosedPipeEndsQuietly) {
  RunOptions options;
  options.close_pipe = true;
  const RunResult result = run_gnomon({"shadows", table_, "--fragments"}, options);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
}

TEST_F(CommandLine, AFullDiskIsStatusTwo) {
  RunOptions options;
  options.stdout_path = "/dev/full";
  const RunResult out = run_gnomon({"shadows", table_}, options);
  EXPECT_EQ(out.status, 2);
  EXPECT_THAT(out.err, HasSubstr("No space left"));
  expect_one_line_error(run_gnomon({"shadows", table_, "-o", "/dev/full"}), 2, "/dev/full");
  expect_one_line_error(run_gnomon({"shadows", table_, "-o", "/no/such/place.json"}), 2,
                        "/no/such/place.json");
}

TEST_F(CommandLine, AnInterruptLeavesNoPartialFile) {
  const std::string scene = directory_.file("city.json");
  ASSERT_EQ(run_gnomon({"generate", "city", "--param", "n=8000", "-o", scene}).status, 0);
  const std::size_t before = directory_.count();
  RunOptions options;
  options.signal = SIGINT;
  options.signal_after = 0.5;
  const RunResult result = run_gnomon({"shadows", scene, "--kernel", "rational", "--fragments",
                                       "-o", directory_.file("result.json")},
                                      options);
  EXPECT_EQ(result.status, 130) << result.err;
  EXPECT_EQ(directory_.count(), before);
}

TEST_F(CommandLine, ThereIsNoProgressBarInAPipe) {
  const std::string scene = directory_.file("city.json");
  ASSERT_EQ(run_gnomon({"generate", "city", "--param", "n=400", "-o", scene}).status, 0);
  EXPECT_EQ(run_gnomon({"shadows", scene, "--kernel", "rational"}).err, "");
}

}  // namespace
}  // namespace gnomon::test
