// SPDX-License-Identifier: GPL-3.0-or-later
// What people report: scenes that mean something else than they say, and files that are almost
// good. cases/ holds scenes of the kind of public reports.
#include <gmock/gmock.h>

#include <algorithm>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::string case_file(const std::string& name) { return GNOMON_CASES "/" + name; }

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

class Intent : public testing::Test {
 protected:
  RunResult shadows(const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"shadows", file, "--exact-fractions"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_gnomon(arguments);
  }
  /// The lit fraction of a polygon's front, as the result has it.
  static std::string lit(const RunResult& result, const std::string& polygon) {
    const std::size_t at = result.out.find("\"id\": \"" + polygon + "\", \"side\"");
    const std::string key = "\"lit\": {\"fraction\": \"";
    const std::size_t begin = result.out.find(key, at);
    if (at == std::string::npos || begin == std::string::npos) return result.out;
    const std::size_t end = result.out.find('"', begin + key.size());
    return result.out.substr(begin + key.size(), end - begin - key.size());
  }
  std::string repaired(const std::string& name, const std::vector<std::string>& options) {
    const std::string file = directory_.file("repaired-" + name + ".json");
    std::vector<std::string> arguments{"convert", case_file(name), file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    last_ = run_gnomon(arguments);
    EXPECT_EQ(last_.status, 0) << last_.err;
    return file;
  }

  TestDirectory directory_;
  RunResult last_;
};

TEST_F(Intent, AWindowBehindItsWall) {
  const RunResult said = shadows(case_file("window-behind-wall.json"));
  EXPECT_EQ(lit(said, "window"), "0");
  EXPECT_EQ(lines(said.err), 1u) << said.err;
  EXPECT_THAT(said.err,
              AllOf(StartsWith("gnomon: warning: "), HasSubstr("window 1e-07 behind wall")));
  const RunResult info = run_gnomon({"info", case_file("window-behind-wall.json")});
  EXPECT_THAT(info.out, HasSubstr("window 1e-07 behind wall, angle 0 degrees, overlap 10"));
  const RunResult certified =
      run_gnomon({"certify", case_file("window-behind-wall.json"), "--kernel", "plane"});
  EXPECT_THAT(certified.err, HasSubstr("window 1e-07 behind wall"));

  const RunResult meant = shadows(repaired("window-behind-wall.json", {"--snap", "1e-6"}));
  EXPECT_EQ(lit(meant, "window"), "1");
  EXPECT_EQ(lit(meant, "wall"), "1");
  EXPECT_EQ(meant.err, "");
  EXPECT_THAT(last_.err, HasSubstr("by 1e-07 at most"));
  // Too fine for it.
  const RunResult kept = shadows(repaired("window-behind-wall.json", {"--snap", "1e-8"}));
  EXPECT_EQ(lit(kept, "window"), "0");
}

TEST_F(Intent, AWindowBecomesAHole) {
  const std::string file = repaired("window-behind-wall.json", {"--snap", "1e-6", "--parent"});
  EXPECT_THAT(last_.err, HasSubstr("window in wall"));
  const std::string text = read_text(file);
  EXPECT_THAT(text,
              AllOf(HasSubstr("\"holes\": [[4, 5, 6, 7]]"), HasSubstr("\"changes\""),
                    HasSubstr("gnomon convert --snap"), HasSubstr("gnomon convert --parent")));
  EXPECT_EQ(lit(shadows(file), "window"), "1");
}

TEST_F(Intent, ASkylightUnderABentRoof) {
  const RunResult said = shadows(case_file("skylight-under-roof.json"));
  EXPECT_EQ(lit(said, "skylight"), "3/208");
  EXPECT_THAT(said.err, AllOf(HasSubstr("skylight"), HasSubstr("bent by rounding (roof")));
  const RunResult meant = shadows(repaired("skylight-under-roof.json", {"--snap", "1e-9"}));
  EXPECT_EQ(lit(meant, "skylight"), "1");
  EXPECT_EQ(lit(meant, "roof"), "1");
  EXPECT_EQ(meant.err, "");
}

TEST_F(Intent, AShadeInsideOut) {
  const RunResult said = shadows(case_file("inside-out.obj"), {"--sun=0,0,1"});
  EXPECT_EQ(lit(said, "ground/0"), "1");
  EXPECT_THAT(said.err,
              HasSubstr("1 polygon looks away from every light and casts nothing (shade/0)"));
  const RunResult meant = shadows(case_file("inside-out.obj"), {"--sun=0,0,1", "--two-sided"});
  EXPECT_EQ(lit(meant, "ground/0"), "3/4");
  EXPECT_EQ(meant.err, "");
  const std::string file = repaired("inside-out.obj", {"--two-sided", "--sun=0,0,1"});
  EXPECT_EQ(lit(shadows(file), "ground/0"), "3/4");
}

TEST_F(Intent, ALampInsideASolid) {
  const RunResult said = shadows(case_file("godot118534-lamp-inside.json"));
  EXPECT_EQ(lit(said, "floor"), "1");
  EXPECT_THAT(said.err, HasSubstr("lamp shines through a closed component that looks outwards"));
  const RunResult meant = shadows(repaired("godot118534-lamp-inside.json", {"--orient"}));
  EXPECT_EQ(lit(meant, "floor"), "0");
  EXPECT_EQ(lit(meant, "box-top"), "1");
  EXPECT_EQ(meant.err, "");
}

TEST_F(Intent, AFaceThatCrossesItself) {
  const RunResult refused = shadows(case_file("bad-face.obj"), {"--sun=0,0,1"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err,
              AllOf(HasSubstr("bad-face.obj:19:1: polygon 'bad/0': the loop crosses itself"),
                    Not(HasSubstr("/polygons"))));
  const RunResult skipped = shadows(case_file("bad-face.obj"), {"--sun=0,0,1", "--skip-bad"});
  EXPECT_EQ(skipped.status, 0);
  EXPECT_EQ(lit(skipped, "ground/0"), "3/4");
  EXPECT_THAT(skipped.err,
              HasSubstr("1 of 3 polygons left out: bad/0 in line 19 (the loop crosses"));
}

TEST_F(Intent, AFaceOverSeveralLines) {
  const RunResult info = run_gnomon({"info", case_file("split-face.off")});
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("2 polygons"));
}

TEST_F(Intent, HolesWithoutArea) {
  EXPECT_THAT(shadows(case_file("hole-equals-wall.json")).out,
              HasSubstr(R"({"id": "p", "detail": ")"));
  for (const char* name : {"hair-on-border.json", "hole-two-vertices.json"}) {
    const RunResult result = shadows(case_file(name));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "") << name;
  }
  EXPECT_THAT(run_gnomon({"info", case_file("hole-two-vertices.json")}).out,
              HasSubstr("hole 0 has no area and is dropped"));
}

TEST_F(Intent, AFarScene) {
  const std::string file = directory_.file("far.json");
  write_text(file, R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[5000000, 0, 0], [5000001, 0, 0], [5000000, 1, 0]], "polygons": [{"loop": [0, 1, 2]}]})");
  EXPECT_THAT(shadows(file, {"--sun=0,0,1"}).err, HasSubstr("coordinates up to 5e+06"));
}

TEST_F(Intent, AForeignFile) {
  const std::string file = directory_.file("model.json");
  write_text(file, "ISO-10303-21;\nHEADER;\n");
  const RunResult result = shadows(file);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("this is STEP"));
}

TEST_F(Intent, InfoTellsWhatIsClosedAndWhatTheContoursAre) {
  const std::string box = directory_.file("box.obj");
  write_text(box,
             "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n"
             "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
             "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 9 10 11\n");
  const RunResult said = run_gnomon({"info", box, "--sun=1,2,3"});
  EXPECT_THAT(said.out, HasSubstr("components      2; 1 closed, 1 of them convex; edge "
                                  "(5,0,0)-(6,0,0) of polygon 6 has no partner"));
  EXPECT_THAT(said.out, HasSubstr("9 contour edges in 2"));
  const RunResult json = run_gnomon({"info", box, "--sun=1,2,3", "--json", "-"});
  EXPECT_THAT(json.out, AllOf(HasSubstr("\"components\": 2"), HasSubstr("\"closed_components\": 1"),
                              HasSubstr("\"convex_components\": 1"),
                              HasSubstr("\"open_because\": \"edge (5,0,0)-(6,0,0) of polygon 6"),
                              HasSubstr("\"contour_edges\": 9, \"contour_loops\": 2, "
                                        "\"contour_share\": 0.6")));
}

}  // namespace
}  // namespace gnomon::test
