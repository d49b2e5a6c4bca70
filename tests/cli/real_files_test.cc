// SPDX-License-Identifier: GPL-3.0-or-later
// Files that other people's programs write, straight into the commands: an energy model with shares
// worked out by hand, a city model by groups and levels of detail, and what convert says is lost.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// A wall of 8 by 3 that looks south, a window of 2 by 1 in it, and an overhang of depth 1 on the
/// window's upper edge.
constexpr const char* kHouse =
    "Version, 23.1;\n"
    "GlobalGeometryRules, UpperLeftCorner, Counterclockwise, Relative;\n"
    "Zone, Hall, 0, 100, 200, 0;\n"
    "BuildingSurface:Detailed, South, Wall, C, Hall, , Outdoors, , SunExposed, WindExposed, , 4,\n"
    "  0,0,3, 0,0,0, 8,0,0, 8,0,3;\n"
    "BuildingSurface:Detailed, Base, Floor, C, Hall, , Ground, , NoSun, NoWind, , 4,\n"
    "  0,0,0, 0,9,0, 8,9,0, 8,0,0;\n"
    "Window, Pane, C, South, , 1, 1, 1, 2, 1;\n"
    "Shading:Overhang, Over, Pane, 0, 90, 0, 0, 1;\n";

constexpr const char* kCity = R"({"type": "CityJSON", "version": "2.0",
 "transform": {"scale": [0.01, 0.01, 0.01], "translate": [85000.5, 440000, 0]},
 "CityObjects": {
  "tower": {"type": "Building", "geometry": [
   {"type": "MultiSurface", "lod": "0", "boundaries": [[[0,1,2,3]]]},
   {"type": "Solid", "lod": "1.2", "boundaries": [[ [[0,3,2,1]], [[4,5,6,7]], [[0,1,5,4]],
     [[1,2,6,5]], [[2,3,7,6]], [[3,0,4,7]] ]],
    "semantics": {"surfaces": [{"type": "GroundSurface"}, {"type": "RoofSurface"},
      {"type": "WallSurface"}], "values": [[0,1,2,2,2,2]]}}]},
  "yard": {"type": "LandUse", "geometry": [
   {"type": "MultiSurface", "lod": "1", "boundaries": [[[8,9,10,11],[3,2,1,0]]]}]}},
 "vertices": [[0,0,0],[1000,0,0],[1000,1000,0],[0,1000,0],
  [0,0,2000],[1000,0,2000],[1000,1000,2000],[0,1000,2000],
  [-4000,-4000,0],[6000,-4000,0],[6000,6000,0],[-4000,6000,0]]})";

class RealFiles : public testing::Test {
 protected:
  std::string put(const std::string& name, const std::string& text) {
    write_text(directory_.file(name), text);
    return directory_.file(name);
  }
  /// The lit fraction of a polygon's front or a group, as the result has it.
  static std::string lit(const std::string& out, const std::string& id) {
    const std::size_t at = out.rfind("\"id\": \"" + id + "\", ");
    const std::string key = "\"lit\": {\"fraction\": \"";
    const std::size_t begin = out.find(key, at);
    if (at == std::string::npos || begin == std::string::npos) return out;
    const std::size_t end = out.find('"', begin + key.size());
    return out.substr(begin + key.size(), end - begin - key.size());
  }
  const TestDirectory directory_;
};

TEST_F(RealFiles, AnEnergyModelsShares) {
  const std::string house = put("house.idf", kHouse);
  const auto shadows = [&](const std::string& sun) {
    return run_gnomon({"shadows", house, "--exact-fractions", "--groups", "--sun=" + sun});
  };
  // The overhang's shadow is 1 deep: all of the window, and none of the wall around it.
  const RunResult noon = shadows("0,-1,1");
  EXPECT_EQ(noon.status, 0);
  EXPECT_EQ(lit(noon.out, "Pane"), "0");
  EXPECT_EQ(lit(noon.out, "South"), "1");
  EXPECT_THAT(noon.err, HasSubstr("1 interior surface left out"));
  EXPECT_EQ(lit(shadows("0,-2,1").out, "Pane"), "1/2");
  // A parallelogram from (1..3, z = 2) to (0..2, z = 1): 3/2 of it on the window, 1/2 beside it.
  const RunResult morning = shadows("1,-1,1");
  EXPECT_EQ(lit(morning.out, "Pane"), "1/4");
  EXPECT_EQ(lit(morning.out, "South"), "43/44");
  EXPECT_EQ(lit(morning.out, "Wall"), "43/44");
  EXPECT_EQ(lit(morning.out, "hall"), "11/12");  // 22 of 24
}

TEST_F(RealFiles, ACityModelsShares) {
  const std::string city = put("city.json", kCity);
  const RunResult result =
      run_gnomon({"shadows", city, "--exact-fractions", "--groups", "--sun=1,0,1"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.err, IsEmpty());
  // 20 m high: a shadow of 10 by 20 on a yard of 100 by 100 without 10 by 10.
  EXPECT_EQ(lit(result.out, "yard/0"), "97/99");
  EXPECT_EQ(lit(result.out, "RoofSurface"), "1");
  EXPECT_EQ(lit(result.out, "WallSurface"), "1/4");
  const RunResult flat = run_gnomon({"info", city, "--lod", "0"});
  EXPECT_THAT(flat.err, HasSubstr("1 city object has no geometry of level of detail 0: left out; "
                                  "in the file: 0, 1, 1.2"));
  EXPECT_THAT(flat.out, HasSubstr("1 polygons with 0 holes"));
  const RunResult not_a_city = run_gnomon({"info", put("house.idf", kHouse), "--lod", "2"});
  EXPECT_EQ(not_a_city.status, 2);
  EXPECT_THAT(not_a_city.err, HasSubstr("--lod is for CityJSON alone"));
}

TEST_F(RealFiles, ConvertSaysWhatIsLost) {
  const std::string city = put("city.json", kCity), house = put("house.idf", kHouse);
  const std::string again = directory_.file("city.city.json");
  const RunResult whole = run_gnomon({"convert", city, again});
  EXPECT_EQ(whole.status, 0);
  EXPECT_THAT(whole.err, IsEmpty());
  EXPECT_EQ(run_gnomon({"convert", city, "-"}).out, run_gnomon({"convert", again, "-"}).out);
  const RunResult lossy = run_gnomon({"convert", house, again});
  EXPECT_EQ(lossy.status, 0);
  EXPECT_THAT(lossy.err, AllOf(HasSubstr("3 polygons: the id becomes"),
                               HasSubstr("2 polygons with one side")));
  const RunResult refused = run_gnomon({"convert", city, directory_.file("x.idf")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("IDF is read and not written"));
  EXPECT_FALSE(std::filesystem::exists(directory_.file("x.idf")));
}

TEST_F(RealFiles, BadOnesAreOneLineAndNothingIsWritten) {
  const std::string out = directory_.file("out.json");
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>("cut.idf", std::string(kHouse).substr(0, 300)),
        std::pair<std::string, std::string>("cut.city.json", std::string(kCity).substr(0, 700)),
        std::pair<std::string, std::string>("none.epjson", "{}"),
        std::pair<std::string, std::string>("none.jsonl", "\n")}) {
    const RunResult result = run_gnomon({"shadows", put(name, text), "--sun=1,0,1", "-o", out});
    EXPECT_EQ(result.status, 2) << name;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, HasSubstr(name + ":")) << result.err;
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

}  // namespace
}  // namespace gnomon::test
