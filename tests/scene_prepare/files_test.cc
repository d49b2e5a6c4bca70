// SPDX-License-Identifier: GPL-3.0-or-later
// Whole files: the examples, and real geometry where it is there.
#include <gtest/gtest.h>

#include <filesystem>

#include "builder.h"
#include "gnomon/scene/read.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& directory) {
  std::vector<fs::path> result;
  for (const auto& entry : fs::directory_iterator(directory)) {
    // Beside the scenes there are a page and programs.
    const fs::path extension = entry.path().extension();
    if (extension != ".md" && extension != ".py" && extension != ".cc")
      result.push_back(entry.path());
  }
  std::sort(result.begin(), result.end());
  return result;
}

void expect_sound(const fs::path& path, const ReadOptions& options = {}) {
  SCOPED_TRACE(path.filename().string());
  const auto read = read_scene(path, options);
  ASSERT_TRUE(read) << to_string(read.error());
  const auto prepared = prepare(read->scene);
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  EXPECT_EQ(first_flaw(*prepared, read->scene), "");
  std::set<std::uint32_t> bent;
  for (const PreparationNote& note : prepared->notes) {
    if (note.repair == Repair::kNotPlanar) bent.insert(note.polygon);
  }
  for (std::uint32_t p = 0; p < read->scene.polygons.size(); ++p) {
    // The parts' area vectors add up to the loop's, planar or not; holes off the plane have no
    // sign.
    if (bent.contains(p) && !read->scene.polygons[p].holes.empty()) continue;
    EXPECT_EQ(part_area_sum(*prepared, p), input_area(*prepared, read->scene, p)) << p;
  }
}

TEST(Examples, AllPrepare) {
  const auto files = files_in(GNOMON_EXAMPLES);
  EXPECT_GE(files.size(), 15u);
  for (const fs::path& path : files) expect_sound(path);
}

TEST(Examples, CourtyardLiesOnAMillimetreGridAsDecimalsOnly) {
  const fs::path path = fs::path(GNOMON_EXAMPLES) / "courtyard.json";
  const auto decimal = read_scene(path);
  ReadOptions as_doubles;
  as_doubles.numbers = NumberMeaning::kDouble;
  const auto doubles = read_scene(path, as_doubles);
  ASSERT_TRUE(decimal && doubles);
  const auto a = prepare(decimal->scene), b = prepare(doubles->scene);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->position_bits, 15u);
  EXPECT_GT(b->position_bits, 50u);
  EXPECT_TRUE(a->notes.empty());
  EXPECT_FALSE(b->notes.empty());
  EXPECT_GT(b->geometry.planes.size(), a->geometry.planes.size());
}

TEST(SharedScenes, AllPrepare) {
  const fs::path root = GNOMON_SHARED_SCENES;
  if (root.empty() || !fs::exists(root)) GTEST_SKIP() << "no further test scenes";
  for (const char* folder : {"json", "mesh"}) {
    for (const fs::path& path : files_in(root / folder)) {
      const std::string name = path.filename().string();
      if (name.starts_with("bad_") || name == "number_formats.obj") continue;  // not to be read
      expect_sound(path);
    }
  }
}

TEST(SharedScenes, KnownFacts) {
  const fs::path root = GNOMON_SHARED_SCENES;
  if (root.empty() || !fs::exists(root)) GTEST_SKIP() << "no further test scenes";
  const auto cornell = read_scene(root / "mesh" / "cornell_box.obj");
  ASSERT_TRUE(cornell);
  const auto prepared = prepare(cornell->scene);
  ASSERT_TRUE(prepared) << to_string(prepared.error());
  const bool left_wall =
      std::any_of(prepared->notes.begin(), prepared->notes.end(), [](const PreparationNote& note) {
        return note.repair == Repair::kNotPlanar && note.detail.starts_with("3.2 scene units off");
      });
  EXPECT_TRUE(left_wall);

  const auto apartment = read_scene(root / "json" / "apartment-midrise.json");
  ASSERT_TRUE(apartment);
  const auto parts = prepare(apartment->scene);
  ASSERT_TRUE(parts);
  std::vector<int> members(parts->geometry.planes.size());
  for (const Part& part : parts->parts) ++members[part.plane];
  const auto sharing = std::count_if(parts->parts.begin(), parts->parts.end(),
                                     [&](const Part& part) { return members[part.plane] > 1; });
  EXPECT_EQ(sharing, 177);
  EXPECT_EQ(parts->parts.size(), 177u);
}

}  // namespace
}  // namespace gnomon::test
