// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon systems, and the counters of `shadows --stats`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "gnomon/algorithms/method.h"
#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Systems, ListsEveryRowOfTheTableOfMethods) {
  const RunResult done = run_gnomon({"systems"});
  EXPECT_EQ(done.status, 0) << done.err;
  for (const Method& method : methods()) {
    EXPECT_THAT("\n" + done.out, HasSubstr("\n" + std::string(method.name) + "\n"));
    EXPECT_THAT(done.out, HasSubstr(std::string(method.source).substr(0, 18)));
  }
}

TEST(Systems, TellsOneInFull) {
  const RunResult done = run_gnomon({"systems", "tiling"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(
      done.out,
      AllOf(HasSubstr("Slater 1992, section 5"), HasSubstr("tiles=128"), HasSubstr("1..1024"),
            HasSubstr("cover=partition"), HasSubstr("partition|overlay"), HasSubstr("prune=on"),
            HasSubstr("tile writes"), HasSubstr("entries made in tiles"),
            HasSubstr("point, directional"), HasSubstr("object space"), HasSubstr("overlay")));
  EXPECT_THAT(done.out, Not(HasSubstr("svbsp")));
  const RunResult bare = run_gnomon({"systems", "pieces"});
  EXPECT_THAT(bare.out, AllOf(HasSubstr("options: none"), HasSubstr("counts: nothing")));
  const RunResult contour = run_gnomon({"systems", "contour"});
  EXPECT_THAT(contour.out, AllOf(HasSubstr("classes and shares alone"), Not(HasSubstr("witness"))));
}

TEST(Systems, AnUnknownNameIsToldThoseThereAre) {
  const RunResult done = run_gnomon({"systems", "magic"});
  EXPECT_EQ(done.status, 2);
  EXPECT_EQ(done.out, "");
  for (const Method& method : methods()) EXPECT_THAT(done.err, HasSubstr(method.name));
}

TEST(Systems, JsonHasTheWholeTable) {
  const RunResult done = run_gnomon({"systems", "--json", "-"});
  EXPECT_EQ(done.status, 0) << done.err;
  rapidjson::Document document;
  document.Parse(done.out.c_str());
  ASSERT_FALSE(document.HasParseError()) << done.out.substr(0, 200);
  EXPECT_STREQ(document["format"].GetString(), "gnomon-systems");
  std::vector<Method> all(methods().begin(), methods().end());
  std::ranges::copy(methods(Domain::kImageSpace), std::back_inserter(all));
  ASSERT_EQ(document["systems"].Size(), all.size());
  for (rapidjson::SizeType i = 0; i < document["systems"].Size(); ++i) {
    const auto& listed = document["systems"][i];
    const Method& method = all[i];
    EXPECT_EQ(listed["name"].GetString(), method.name);
    EXPECT_EQ(listed["options"].Size(), method.options.size());
    EXPECT_EQ(listed["counters"].Size(), method.counters.size());
    EXPECT_EQ(listed["can"].Size(), abilities(method).size());
    EXPECT_EQ(listed["fragments"].GetBool(), method.makes_fragments);
  }
}

/// The lines of --stats that tell of work; an indented line goes on.
class WorkOfStats : public testing::Test {
 protected:
  static std::string work(const std::vector<std::string>& options, std::string scene) {
    std::vector<std::string> words{"shadows", std::move(scene), "--stats"};
    words.insert(words.end(), options.begin(), options.end());
    const RunResult done = run_gnomon(words);
    EXPECT_EQ(done.status, 0) << done.err;
    std::string text;
    bool inside = false;
    std::size_t begin = 0;
    for (std::size_t end; (end = done.err.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
      const std::string line = done.err.substr(begin, end - begin);
      inside = line.starts_with("  work: ") || (inside && line.starts_with("    "));
      if (inside) text += line + '\n';
    }
    return text;
  }
  std::string scene(const std::string& name, const std::string& parameter) {
    std::string file = directory_.file(name + ".json");
    EXPECT_EQ(run_gnomon({"generate", name, "--param", parameter, "-o", file}).status, 0);
    return file;
  }

  TestDirectory directory_;
};

TEST_F(WorkOfStats, NamesTheCountersOfTheMethod) {
  const std::string city = scene("city", "n=20");
  EXPECT_THAT(work({"--algorithm", "basic"}, city),
              AllOf(HasSubstr("volumes "), HasSubstr("tests "), Not(HasSubstr("tile"))));
  // A share is told as a decimal.
  const std::string tiling = work({"--algorithm", "tiling:tiles=16"}, city);
  EXPECT_TRUE(std::regex_search(tiling, std::regex("mean p 0\\.[0-9]+"))) << tiling;
  EXPECT_THAT(work({"--algorithm", "svbsp"}, city),
              AllOf(HasSubstr("nodes "), HasSubstr("depth "), HasSubstr("tree bytes ")));
  EXPECT_THAT(work({"--algorithm", "two-pass"}, city), HasSubstr("longest list "));
  EXPECT_THAT(work({"--algorithm", "sectors"}, city), HasSubstr("cell cuts "));
  // One line for each light.
  const std::string room = directory_.file("room.json");
  ASSERT_EQ(run_gnomon({"generate", "room", "-o", room}).status, 0);
  const std::string both = work({"--algorithm", "svbsp-full"}, room);
  EXPECT_EQ(both.find("  work: "), 0u);
  EXPECT_NE(both.find("  work: ", 1), std::string::npos);
  // So does the pipeline of several lights.
  EXPECT_EQ(work({"--algorithm", "svbsp", "--combined"}, room).find("  work: "), 0u);
}

TEST_F(WorkOfStats, CountsAreTheSameOnEveryExactKernelAndAnyNumberOfThreads) {
  const std::vector<std::string> scenes = {scene("city", "n=60"), scene("lattice", "n=24"),
                                           scene("coplanar-tiles", "n=30"),
                                           scene("touching-boxes", "n=12")};
  for (const Method& method : methods()) {
    if (method.counters.empty() || !method.lights.point) continue;
    // Numbers with bounds cut otherwise than rationals: the counts are told, and promised to no
    // one.
    if (!method.makes_fragments) continue;
    const std::string name(method.name);
    for (const std::string& file : scenes) {
      const std::string plane = work({"--algorithm", name, "--jobs", "1"}, file);
      EXPECT_THAT(plane, HasSubstr("work: ")) << name;
      EXPECT_EQ(work({"--algorithm", name, "--jobs", "4"}, file), plane) << name << ' ' << file;
      // What boxes decide there depends on how well a kernel knows the corners that cuts have made.
      if (method.id == MethodId::kBlots) continue;
      for (const std::string kernel : {"rational", "epeck"}) {
        EXPECT_EQ(work({"--algorithm", name, "--kernel", kernel}, file), plane)
            << name << ' ' << kernel << ' ' << file;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
