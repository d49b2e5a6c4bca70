// SPDX-License-Identifier: GPL-3.0-or-later
// Files: which format is read, what cannot be read, and that a file is written as a whole or not at
// all.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "gnomon/scene/write.h"
#include "scene/base/output_file.h"
#include "scene_testing.h"
#include "tests/support/test_directory.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string kOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

class Files : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return directory_.path() / name; }
  fs::path put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  static std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static Error error_of_file(const fs::path& file) {
    auto result = read_scene(file);
    EXPECT_FALSE(result);
    return result ? Error() : result.error();
  }

  const test::TestDirectory directory_;
};

/// In UTF-16 with a byte order mark. `text` is ASCII.
std::string in_utf16(const std::string& text, bool is_big_endian) {
  std::string bytes = is_big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) {
    if (is_big_endian) bytes += '\0';
    bytes += c;
    if (!is_big_endian) bytes += '\0';
  }
  return bytes;
}

/// As Revit writes gbXML, and spreadsheets text.
TEST_F(Files, TextsInUtf16AreRead) {
  const std::string long_obj = std::string(200'000, '#') + "\n" + kObj;  // of several chunks
  for (const bool is_big_endian : {false, true}) {
    for (const auto& [name, text] : {std::pair("wide", kObj), std::pair("long.obj", long_obj),
                                     std::pair("wide.json", full_json())}) {
      const auto result = read_scene(put(name, in_utf16(text, is_big_endian)));
      ASSERT_TRUE(result) << to_string(result.error());
      expect_same_geometry(result->scene, scene_of(text, name));
    }
    // Places are those of the text.
    const Error error =
        error_of_file(put("wide.obj", in_utf16("v 0 0 0\nv 1 x 0\n", is_big_endian)));
    EXPECT_THAT(to_string(error), HasSubstr("wide.obj:2:5: 'x' is not a number"));
  }
  // All lengths of UTF-8, and a character of two units.
  const std::string names = std::string("o a\xC3\xA9\xE2\x82\xAC\xF0\x9D\x84\x9E\n") + kObj;
  std::string wide = in_utf16("o a", false);
  wide +=
      std::string("\xE9\x00\xAC\x20\x34\xD8\x1E\xDD", 8) + in_utf16("\n" + kObj, false).substr(2);
  const auto result = read_scene(put("names.obj", wide));
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(result->scene.polygons[0].id, scene_of(names, "names.obj").polygons[0].id);
}

TEST_F(Files, BrokenUtf16IsAnErrorWithItsPlace) {
  const std::string good = in_utf16("v 0 0 0\nv 1", false);
  for (const std::string& bad :
       {std::string("\x34\xD8"), std::string("\x34\xD8\x61\x00", 4), std::string("\x1E\xDD"),
        std::string("\x61"), std::string("\x34\xD8\x1E")}) {
    EXPECT_THAT(to_string(error_of_file(put("bad.obj", good + bad))),
                HasSubstr("bad.obj:2:4: this is half of a character of UTF-16"));
  }
  // Neither is UTF-16 without a mark, nor UTF-32.
  for (const std::string& other :
       {in_utf16(kObj, true).substr(2), in_utf16(kObj, false).substr(2),
        std::string("\xFF\xFE\0\0v\0\0\0", 8), std::string("\0\0\xFE\xFF\0\0\0v", 8)}) {
    EXPECT_THAT(to_string(error_of_file(put("other.obj", other))),
                HasSubstr("expected a file in UTF-8, or in UTF-16 with a byte order mark"));
  }
  EXPECT_THAT(to_string(error_of_file(put("empty.obj", "\xFF\xFE"))),
              HasSubstr("the file is empty"));
}

TEST_F(Files, FormatByExtensionThenByContent) {
  for (const char* name : {"a.obj", "a.OBJ", "a", "a.txt"}) {
    EXPECT_TRUE(read_scene(put(name, kObj))) << name;
  }
  for (const char* name : {"a.off", "a.Off", "b", "b.txt"}) {
    EXPECT_TRUE(read_scene(put(name, kOff))) << name;
  }
  EXPECT_TRUE(read_scene(put("full", full_json())));
  EXPECT_TRUE(read_scene(put("full.txt", "\xEF\xBB\xBF\n" + full_json())));
  const Scene scene = scene_of(kObj, "m.obj");
  for (const auto format : {SceneFormat::kPlyAscii, SceneFormat::kPlyBinary}) {
    EXPECT_TRUE(read_scene(put("ply", scene_to_text(scene, format)->text)));
    EXPECT_TRUE(read_scene(put("m.ply", scene_to_text(scene, format)->text)));
  }
  // The extension decides where it says something, an option above all.
  EXPECT_FALSE(read_scene(put("wrong.off", kObj)));
  ReadOptions options;
  options.format = SceneFormat::kObj;
  EXPECT_TRUE(read_scene(put("right.off", kObj), options));
  EXPECT_EQ(error_of_file(put("letter.txt", "Dear reader,\n")).what,
            "neither the name nor the content tells the format");
}

TEST_F(Files, StandardInputIsJson) {
  EXPECT_TRUE(parse_scene(full_json(), "<stdin>", {}));
  EXPECT_FALSE(parse_scene(kObj, "<stdin>", {}));
  EXPECT_EQ(scene_of(R"({"format": "gnomon-scene", "version": 1, "vertices": [], "polygons": []})",
                     "<stdin>")
                .name,
            "");
}

TEST_F(Files, ThatCannotBeRead) {
  EXPECT_EQ(to_string(error_of_file(path("absent.json"))),
            path("absent.json").string() + ": cannot open: No such file or directory");
  EXPECT_EQ(error_of_file(directory_.path()).what, "is a directory");
  EXPECT_EQ(error_of_file("").code, ErrorCode::kFile);
  for (const char* name : {"a.json", "a.obj", "a.off", "a.ply", "a"}) {
    EXPECT_EQ(error_of_file(put(name, "")).what, "the file is empty");
  }
  const fs::path secret = put("secret.obj", kObj);
  fs::permissions(secret, fs::perms::none);
  if (::geteuid() != 0) {
    EXPECT_EQ(error_of_file(secret).code, ErrorCode::kFile);
  }
  EXPECT_EQ(error_of_file("/dev/null").what, "the file is empty");
  // Endless, and found out at once.
  EXPECT_EQ(error_of_file("/dev/zero").code, ErrorCode::kSyntax);
}

TEST_F(Files, WrittenAsAWhole) {
  const Scene scene = scene_of(kObj, "m.obj");
  ASSERT_TRUE(write_scene(scene, path("out.json"), SceneFormat::kJson));
  auto back = read_scene(path("out.json"));
  ASSERT_TRUE(back);
  expect_same_scene(back->scene, scene);
  EXPECT_EQ(directory_.count(), 1u);
  {
    auto file = OutputFile::open(path("out.json"));
    ASSERT_TRUE(file);
    ASSERT_TRUE(file->write("half of"));
    EXPECT_EQ(directory_.count(), 2u);
    EXPECT_EQ(content(path("out.json")), scene_to_text(scene, SceneFormat::kJson)->text);
  }
  // Not committed: all is as it was.
  EXPECT_EQ(directory_.count(), 1u);
  EXPECT_EQ(content(path("out.json")), scene_to_text(scene, SceneFormat::kJson)->text);
  ASSERT_TRUE(write_file(path("out.json"), "new"));
  EXPECT_EQ(content(path("out.json")), "new");
  EXPECT_EQ(directory_.count(), 1u);
}

TEST_F(Files, KeepTheirModeAndTheirLinks) {
  put("real", "old");
  fs::permissions(path("real"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real", path("link"));
  ASSERT_TRUE(write_file(path("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_EQ(content(path("real")), "new");
  EXPECT_EQ(fs::status(path("real")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Files, ThatCannotBeWritten) {
  EXPECT_EQ(write_file(path("absent/out"), "x").error().code, ErrorCode::kFile);
  EXPECT_THAT(to_string(write_file(directory_.path(), "x").error()), HasSubstr("Is a directory"));
  EXPECT_EQ(write_file("", "x").error().code, ErrorCode::kFile);
  if (fs::exists("/dev/full")) {
    EXPECT_THAT(to_string(write_file("/dev/full", "x").error()), HasSubstr("No space left"));
  }
  EXPECT_TRUE(write_file("/dev/null", "x"));
  EXPECT_EQ(directory_.count(), 0u);
}

}  // namespace
}  // namespace gnomon
