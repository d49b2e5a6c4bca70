// SPDX-License-Identifier: GPL-3.0-or-later
// The layers: kernel <- scene <- result <- algorithms <- (report, fuzz, cli, bench), and oracle <-
// result. Reads the includes of every source of every component. The oracle shares no predicate, no
// splitting and no tree with what it judges: of the kernel it may use the four headers that hold no
// arithmetic, and so may the words that both speak (result).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What each component may include: whole components, or single headers.
const std::map<std::string, std::set<std::string>>& allowed_includes() {
  static const std::map<std::string, std::set<std::string>> kAllowed = {
      {"kernel", {"kernel"}},
      {"scene", {"kernel", "scene"}},
      {"result",
       {"scene", "result", "kernel/sign.h", "kernel/orientation.h", "kernel/error.h",
        "kernel/geometry.h"}},
      {"algorithms", {"kernel", "scene", "result", "algorithms"}},
      {"oracle",
       {"scene", "result", "oracle", "kernel/sign.h", "kernel/orientation.h", "kernel/error.h",
        "kernel/geometry.h"}},
      {"report", {"kernel", "scene", "result", "algorithms", "oracle", "report"}},
      {"fuzz", {"kernel", "scene", "result", "algorithms", "oracle", "report", "fuzz"}},
      {"cli", {"kernel", "scene", "result", "algorithms", "oracle", "report", "fuzz", "cli"}},
      {"bench", {"kernel", "scene", "result", "algorithms", "oracle", "report", "fuzz", "bench"}},
  };
  return kAllowed;
}

/// Headers that are CGAL's types under a kernel's name; no other header may include them or CGAL,
/// so that only sources which ask for these types need CGAL and its -frounding-math.
const std::set<std::string>& cgal_headers() {
  static const std::set<std::string> kHeaders = {"gnomon/kernel/epeck_space.h",
                                                 "gnomon/kernel/epeck_volume_space.h"};
  return kHeaders;
}

/// The violations of one file, given by its path in the project and its text; one line each.
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const std::string component = path.substr(0, path.find('/'));
  const auto& allowed = allowed_includes().at(component);
  const std::string public_folder = component + "/include/";
  const bool is_public = path.starts_with(public_folder);
  const std::string public_name = is_public ? path.substr(public_folder.size()) : "";

  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (!std::regex_search(line, match, kInclude)) continue;
    const std::string header = match[2];
    const std::string place = path + ":" + std::to_string(number) + ": ";
    if (header.find("..") != std::string::npos) {
      found.push_back(place + header + " leaves its folder");
    }
    const bool names_cgal = header.starts_with("CGAL/") || cgal_headers().contains(header);
    if (is_public && names_cgal && !cgal_headers().contains(public_name)) {
      found.push_back(place + header + " belongs in a source, not in a public header");
    }
    // An installed header is included as "gnomon/kernel/sign.h", one of a room as
    // "kernel/signs/ball.h".
    const bool installed = header.starts_with("gnomon/");
    const std::string name = installed ? header.substr(std::string("gnomon/").size()) : header;
    const std::string owner = name.substr(0, name.find('/'));
    if (!installed && !allowed_includes().contains(owner)) continue;
    if (!allowed.contains(owner) && !(installed && allowed.contains(name))) {
      found.push_back(place + component + " must not include " + header);
    }
  }
  return found;
}

struct Walk {
  std::vector<std::string> violations;
  std::map<std::string, int> files;  // per component
};

/// Every header and source of every component under `root`.
Walk walk(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  Walk result;
  for (const auto& [component, allowed] : allowed_includes()) {
    if (!fs::is_directory(root / component)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / component)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || (extension != ".h" && extension != ".cc")) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      const std::string path = fs::relative(entry.path(), root).generic_string();
      ++result.files[component];
      std::ranges::copy(violations(path, text), std::back_inserter(result.violations));
    }
  }
  return result;
}

TEST(Layers, EveryIncludeStaysBelowItsOwnLayer) {
  const Walk result = walk(GNOMON_SOURCE_DIR);
  EXPECT_THAT(result.violations, IsEmpty());
  // A walk that read nothing would hold any rule.
  for (const char* component : {"kernel", "scene", "result", "algorithms", "oracle"}) {
    EXPECT_GT(result.files.contains(component) ? result.files.at(component) : 0, 0) << component;
  }
}

TEST(Layers, SeesAViolationOfEachRule) {
  EXPECT_THAT(violations("kernel/src/a.cc", "\n#include \"gnomon/scene/scene.h\"\n"),
              ElementsAre("kernel/src/a.cc:2: kernel must not include gnomon/scene/scene.h"));
  EXPECT_THAT(violations("scene/src/a.cc", "#  include <gnomon/algorithms/shadows.h>\n"),
              ElementsAre(HasSubstr("scene must not include")));
  EXPECT_THAT(violations("algorithms/src/a.cc", "#include \"gnomon/oracle/verdict.h\""),
              ElementsAre(HasSubstr("algorithms must not include")));
  EXPECT_THAT(violations("oracle/src/a.cc", "#include \"gnomon/algorithms/shadow_result.h\""),
              ElementsAre(HasSubstr("oracle must not include")));
  EXPECT_THAT(violations("oracle/src/a.cc", "#include \"gnomon/kernel/plane_kernel.h\""),
              ElementsAre(HasSubstr("oracle must not include")));
  EXPECT_THAT(violations("oracle/src/a.cc", "#include \"kernel/signs/ball.h\""),
              ElementsAre(HasSubstr("oracle must not include")));
  EXPECT_THAT(violations("result/a.cc", "#include \"gnomon/oracle/verdict.h\""),
              ElementsAre(HasSubstr("result must not include")));
  EXPECT_THAT(violations("report/src/a.cc", "#include \"gnomon/cli/command.h\""),
              ElementsAre(HasSubstr("report must not include")));
  EXPECT_THAT(violations("oracle/src/a.cc", "#include \"../../kernel/src/a.h\""),
              ElementsAre(HasSubstr("leaves its folder")));
  EXPECT_THAT(violations("oracle/include/gnomon/oracle/a.h", "#include <CGAL/Gmpq.h>"),
              ElementsAre(HasSubstr("not in a public header")));
  EXPECT_THAT(violations("algorithms/include/gnomon/algorithms/a.h",
                         "#include \"gnomon/kernel/epeck_space.h\""),
              ElementsAre(HasSubstr("not in a public header")));
}

TEST(Layers, LetsPassWhatIsAllowed) {
  EXPECT_THAT(violations("oracle/src/a.cc",
                         "#include <CGAL/Gmpq.h>\n#include \"gnomon/kernel/sign.h\"\n"
                         "#include \"gnomon/scene/prepare.h\"\n#include \"own.h\"\n"),
              IsEmpty());
  EXPECT_THAT(violations("kernel/src/a.cc", "// includes \"gnomon/scene/scene.h\" in words"),
              IsEmpty());
}

TEST(Layers, SeesAViolationInAMadeUpTree) {
  namespace fs = std::filesystem;
  const fs::path root = fs::path(testing::TempDir()) / "gnomon_layers_made_up";
  fs::remove_all(root);
  fs::create_directories(root / "oracle" / "src");
  std::ofstream(root / "oracle" / "src" / "bad.cc") << "#include \"gnomon/algorithms/bsp.h\"\n";
  const Walk result = walk(root);
  fs::remove_all(root);
  EXPECT_THAT(result.violations,
              ElementsAre("oracle/src/bad.cc:1: oracle must not include gnomon/algorithms/bsp.h"));
}

}  // namespace
