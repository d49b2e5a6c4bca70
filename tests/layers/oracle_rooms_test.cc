// SPDX-License-Identifier: GPL-3.0-or-later
// The rooms of the oracle: geometry <- visibility <- answer <- judge. No room includes a header of
// a room that stands behind it. An installed header belongs to the room of its source.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::array<const char*, 4> kRooms = {"geometry", "visibility", "answer", "judge"};
/// Installed headers without a source of their own.
constexpr std::array<std::pair<const char*, const char*>, 1> kHeadersAlone = {
    {{"area_share", "geometry"}}};

std::size_t rank_of(const std::string& room) {
  return static_cast<std::size_t>(std::ranges::find(kRooms, room) - kRooms.begin());
}

/// The rank of the room of a header, as it is included; none if the header is not the oracle's.
std::optional<std::size_t> rank_of_header(const fs::path& root, const std::string& header) {
  static const std::regex kPrivate("oracle/([a-z]+)/.*"), kInstalled("gnomon/oracle/(.*)\\.h");
  std::smatch match;
  if (std::regex_match(header, match, kPrivate)) return rank_of(match[1]);
  if (!std::regex_match(header, match, kInstalled)) return std::nullopt;
  for (const auto& [name, room] : kHeadersAlone) {
    if (match[1] == name) return rank_of(room);
  }
  for (const char* room : kRooms) {
    if (fs::exists(root / "oracle" / room / (match[1].str() + ".cc"))) return rank_of(room);
  }
  return kRooms.size();
}

/// Includes of one file that lead to a later room, or to none.
std::vector<std::string> wrong_includes(const fs::path& root, const std::string& path,
                                        std::size_t rank, const std::string& text) {
  static const std::regex kInclude(R"re(^#include "([^"]+)")re");
  std::vector<std::string> wrong;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_search(line, match, kInclude)) continue;
    const auto other = rank_of_header(root, match[1]);
    if (other && *other > rank) wrong.push_back(path + " includes " + match[1].str());
  }
  return wrong;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(OracleRooms, NoneIncludesALaterOne) {
  const fs::path root = GNOMON_SOURCE_DIR;
  std::vector<std::string> wrong;
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root / "oracle")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cc") continue;
    const std::string path = fs::relative(entry.path(), root).generic_string();
    const std::string header = path.starts_with("oracle/include/")
                                   ? path.substr(std::string("oracle/include/").size())
                                   : path;
    const auto rank = rank_of_header(root, header);
    ASSERT_TRUE(rank) << path;
    EXPECT_LT(*rank, kRooms.size()) << path << " is in no room";
    std::ranges::copy(wrong_includes(root, path, *rank, text_of(entry.path())),
                      std::back_inserter(wrong));
    ++files;
  }
  EXPECT_THAT(wrong, IsEmpty());
  EXPECT_GT(files, 30u);
}

TEST(OracleRooms, ALaterOneIsSeen) {
  const fs::path root = GNOMON_SOURCE_DIR;
  const std::string text =
      "#include \"gnomon/oracle/verdict.h\"\n#include \"oracle/geometry/chart.h\"\n";
  EXPECT_THAT(wrong_includes(root, "oracle/answer/a.cc", rank_of("answer"), text),
              ElementsAre("oracle/answer/a.cc includes gnomon/oracle/verdict.h"));
  EXPECT_THAT(wrong_includes(root, "oracle/judge/a.cc", rank_of("judge"), text), IsEmpty());
}

TEST(OracleRooms, EachSaysWhatItDecides) {
  for (const char* room : kRooms) {
    EXPECT_FALSE(text_of(fs::path(GNOMON_SOURCE_DIR) / "oracle" / room / "README.md").empty())
        << room;
  }
}

}  // namespace
