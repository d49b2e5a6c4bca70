// SPDX-License-Identifier: GPL-3.0-or-later
// shadows --illuminate: what is written, what is printed, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

using Arguments = std::vector<std::string>;

constexpr const char* kTable = R"({"format": "gnomon-scene", "version": 1, "name": "table",
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[2,1,1],[2,2,1],[1,2,1]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "top", "loop": [4,5,6,7]}],
  "lights": [{"id": "bulb", "type": "point", "position": [1.5,1.5,3], "intensity": 2},
             {"id": "sun", "type": "directional", "to_light": [1,0,2]}]})";

class Illuminate : public testing::Test {
 protected:
  void SetUp() override { write_text(scene_, kTable); }

  RunResult run(const Arguments& options) const {
    Arguments arguments{"shadows", scene_};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_gnomon(arguments);
  }
  void expect_refused(const Arguments& options, const std::string& words) const {
    const RunResult done = run(options);
    EXPECT_EQ(done.status, 2) << done.err;
    EXPECT_EQ(done.out, "");
    EXPECT_THAT(done.err, AllOf(StartsWith("gnomon: "), HasSubstr(words), EndsWith("\n")));
    EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
  }

  TestDirectory directory_;
  std::string scene_ = directory_.file("table.json");
};

TEST_F(Illuminate, WritesAMeshBesideTheResult) {
  // Two lights together need the pipeline, which is of svbsp.
  const std::string plain = run({"--algorithm", "svbsp"}).out;
  for (const char* name : {"mesh.ply", "mesh.gltf", "mesh.glb"}) {
    const std::string mesh = directory_.file(name);
    const RunResult done = run({"--illuminate", "--grid", "1,0.5", "--mesh", mesh});
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    EXPECT_EQ(done.out, plain) << "illumination changes the classification's result";
    const std::string text = read_text(mesh);
    EXPECT_THAT(text, testing::AnyOf(StartsWith("ply\n"), StartsWith("{"), StartsWith("glTF")));
  }
  rapidjson::Document document;
  document.Parse(read_text(directory_.file("mesh.gltf")).c_str());
  ASSERT_FALSE(document.HasParseError());
  EXPECT_STREQ(document["scenes"][0]["name"].GetString(), "table");
  // The mesh is a scene that other commands read.
  const RunResult info = run_gnomon({"info", directory_.file("mesh.ply")});
  EXPECT_EQ(info.status, 0) << info.err;
}

TEST_F(Illuminate, TheMeshDoesNotDependOnThreads) {
  std::vector<std::string> texts;
  for (const char* jobs : {"1", "2"}) {
    const std::string mesh = directory_.file(std::string("mesh") + jobs + ".ply");
    const RunResult done =
        run({"--illuminate", "--adaptive", "0.05", "--jobs", jobs, "--mesh", mesh});
    EXPECT_EQ(done.status, 0) << done.err;
    texts.push_back(read_text(mesh));
  }
  EXPECT_EQ(texts[0], texts[1]);
}

TEST_F(Illuminate, ExposureAndTintChangeColoursAlone) {
  const auto mesh_with = [&](const Arguments& options) {
    const std::string mesh = directory_.file("mesh.ply");
    Arguments all{"--light", "bulb", "--illuminate", "--mesh", mesh};
    all.insert(all.end(), options.begin(), options.end());
    const RunResult done = run(all);
    EXPECT_EQ(done.status, 0) << done.err;
    return read_text(mesh);
  };
  const std::string plain = mesh_with({});
  EXPECT_NE(mesh_with({"--exposure", "3"}), plain);
  EXPECT_EQ(mesh_with({"--exposure", "3"}).size(), plain.size());
  EXPECT_NE(mesh_with({"--ambient", "0.5"}), plain);
  EXPECT_NE(mesh_with({"--tint"}), plain);
  EXPECT_GT(mesh_with({"--grid", "1"}).size(), plain.size());
  EXPECT_EQ(mesh_with({"--grid", "0"}), plain);
}

TEST_F(Illuminate, StatsPrintTheLineOfThePaper) {
  const RunResult done = run({"--illuminate", "--grid", "1", "--stats"});
  EXPECT_EQ(done.status, 0);
  EXPECT_THAT(done.err, HasSubstr("mesh: "));
  EXPECT_THAT(done.err, HasSubstr("; illuminated "));
  EXPECT_THAT(done.err, HasSubstr("light sun: vertices "));
}

TEST_F(Illuminate, RefusesWhatDoesNotGoTogether) {
  expect_refused({"--mesh", "a.ply"}, "--illuminate");
  expect_refused({"--grid", "1"}, "--illuminate");
  expect_refused({"--illuminate"}, "--mesh FILE, or --stats");
  const std::string mesh = directory_.file("mesh.ply");
  expect_refused({"--illuminate", "--mesh", "a.obj"}, ".ply, .gltf or .glb");
  expect_refused({"--illuminate", "--mesh", mesh, "--grid", "x"}, "--grid 'x' is no length");
  expect_refused({"--illuminate", "--mesh", mesh, "--grid", "1,"}, "--grid '' is no length");
  expect_refused({"--illuminate", "--mesh", mesh, "--grid", "-1"}, "--grid '-1' is no length");
  expect_refused({"--illuminate", "--mesh", mesh, "--adaptive", "-1"}, "--adaptive");
  expect_refused({"--illuminate", "--mesh", mesh, "--ambient", "nan"}, "--ambient");
  expect_refused({"--illuminate", "--mesh", mesh, "--kernel", "double"}, "kernel double rounds");
  expect_refused({"--illuminate", "--mesh", mesh, "--algorithm", "sectors"},
                 "--illuminate with several lights needs svbsp, not sectors");
  EXPECT_FALSE(std::filesystem::exists(mesh));
}

TEST_F(Illuminate, RenderPaintsIt) {
  const std::string plain = run_gnomon({"render", scene_}).out;
  const RunResult done = run_gnomon({"render", scene_, "--illuminate", "--grid", "1"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("<svg"), HasSubstr("linearGradient"),
                              HasSubstr("lights: bulb, sun;")));
  EXPECT_THAT(plain, testing::Not(HasSubstr("linearGradient")));
  const RunResult both = run_gnomon({"render", scene_, "--illuminate", "--algorithm", "both"});
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, HasSubstr("--illuminate shows the exact answer"));
}

/// A panel over the table: lit, penumbra and umbra by every way to find them.
TEST_F(Illuminate, AreaLights) {
  std::string text = kTable;
  const std::string panel =
      R"({"id": "panel", "type": "area", "loop": [[1,1,3],[1,2,3],[2,2,3],[2,1,3]]}, )";
  text.insert(text.find("{\"id\": \"bulb\""), panel);
  write_text(scene_, text);
  const auto counts = [&](const Arguments& options) {
    Arguments all{"--illuminate", "--stats"};
    all.insert(all.end(), options.begin(), options.end());
    const RunResult done = run(all);
    EXPECT_EQ(done.status, 0) << done.err;
    const std::size_t at = done.err.find("light panel: vertices ");
    EXPECT_NE(at, std::string::npos) << done.err;
    return done.err.substr(at, done.err.find("; illumination ", at) - at);
  };
  EXPECT_EQ(counts({"--light", "panel"}).find(" 0 "), std::string::npos)
      << counts({"--light", "panel"});
  counts({"--light", "panel", "--algorithm", "merged"});
  counts({"--light", "panel", "--kernel", "rational", "--grid", "1"});
  counts({});
  counts({"--algorithm", "receiver"});
  const RunResult pieces = run({"--illuminate", "--stats", "--light", "panel", "--pieces"});
  EXPECT_EQ(pieces.status, 2);
  EXPECT_THAT(pieces.err, HasSubstr("whole lights"));
  const std::string mesh = directory_.file("mesh.glb");
  const RunResult all = run({"--illuminate", "--adaptive", "0.1", "--mesh", mesh});
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_THAT(read_text(mesh), StartsWith("glTF"));
}

TEST_F(Illuminate, AGridThatIsTooFineIsALimit) {
  const std::string mesh = directory_.file("mesh.ply");
  const RunResult done = run({"--illuminate", "--mesh", mesh, "--grid", "0.0001"});
  EXPECT_EQ(done.status, 3);
  EXPECT_THAT(done.err, HasSubstr("more than 4000000 faces"));
  EXPECT_FALSE(std::filesystem::exists(mesh));
}

TEST_F(Illuminate, AMeshThatCannotBeWrittenIsAnError) {
  const RunResult done =
      run({"--illuminate", "--mesh", directory_.file("no/such/directory/mesh.ply")});
  EXPECT_EQ(done.status, 2);
  EXPECT_THAT(done.err, HasSubstr("mesh.ply"));
}

}  // namespace
}  // namespace gnomon::test
