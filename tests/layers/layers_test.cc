// SPDX-License-Identifier: GPL-3.0-or-later
// The layers: kernel <- scene <- result <- algorithms <- (report, fuzz, comparison, cli, python,
// bench),
// scene <- suns <- report, and oracle <- result; and in each component the order of its rooms.
// Reads the includes of every source of every component. The oracle shares no predicate, no
// splitting and no tree with what it judges: of the kernel it may use the four headers that hold no
// arithmetic.
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

/// What each component may include of others: whole components, or single headers.
const std::map<std::string, std::set<std::string>>& allowed_includes() {
  static const std::map<std::string, std::set<std::string>> kAllowed = {
      {"kernel", {"kernel"}},
      {"scene", {"kernel", "scene"}},
      {"result", {"scene", "result", "kernel/sign.h", "kernel/error.h", "kernel/geometry.h"}},
      {"algorithms", {"kernel", "scene", "result", "algorithms"}},
      {"suns", {"scene", "suns", "kernel/error.h"}},
      {"oracle",
       {"scene", "result", "oracle", "kernel/sign.h", "kernel/orientation.h", "kernel/error.h",
        "kernel/geometry.h"}},
      {"report", {"kernel", "scene", "result", "algorithms", "suns", "oracle", "report"}},
      {"fuzz", {"kernel", "scene", "result", "algorithms", "oracle", "report", "fuzz"}},
      {"comparison",
       {"kernel", "scene", "result", "algorithms", "suns", "oracle", "report", "fuzz",
        "comparison"}},
      {"cli",
       {"kernel", "scene", "result", "algorithms", "suns", "oracle", "report", "fuzz", "comparison",
        "cli"}},
      {"python", {"kernel", "scene", "result", "algorithms", "suns", "oracle", "report", "python"}},
      {"bench",
       {"kernel", "scene", "result", "algorithms", "oracle", "report", "fuzz", "comparison",
        "bench"}},
  };
  return kAllowed;
}

/// The rooms of a component, each after those that it may include. Every room may also include the
/// headers that the component installs, which include one another only.
struct Room {
  std::string name;
  std::set<std::string> may_include;
};
const std::map<std::string, std::vector<Room>>& rooms() {
  static const std::map<std::string, std::vector<Room>> kRooms = {
      {"kernel",
       {{"signs", {}},
        {"numbers", {"signs"}},
        {"concept", {"signs", "numbers"}},
        {"coordinate", {"signs", "concept"}},
        {"cgal", {"signs", "concept"}},
        {"implicit", {"signs", "numbers", "concept"}},
        {"watched", {"signs", "concept", "implicit"}}}},
      {"scene",
       {{"base", {}},
        {"model", {"base"}},
        {"geometry", {"base"}},
        {"prepare", {"base", "geometry"}},
        {"intent", {"base", "geometry"}},
        {"repair", {"base", "geometry", "intent"}},
        {"json", {"base"}},
        {"files", {"base", "json", "model"}},
        {"building", {"base", "json", "model", "files"}},
        {"radiance", {"base", "json", "model", "files"}},
        {"triangles", {"base", "json", "model", "files"}},
        {"cityjson", {"base", "json", "model", "files"}},
        {"energyplus", {"base", "json", "model", "files"}},
        {"generate", {"base"}}}},
      {"algorithms",
       {{"partition", {}},
        {"facing_chain", {"partition"}},
        {"ridge_edges", {"facing_chain"}},
        {"hidden_lines", {"partition", "facing_chain"}},
        {"scene_bsp", {"partition"}},
        {"lights", {"partition", "scene_bsp"}},
        {"svbsp", {"partition", "scene_bsp", "lights"}},
        {"svbsp_full", {"partition", "lights", "svbsp"}},
        {"basic", {"partition", "scene_bsp", "lights"}},
        {"tiling", {"partition", "lights", "basic"}},
        {"two_pass", {"partition"}},
        {"blots", {"partition", "two_pass"}},
        {"sectors", {"partition", "two_pass", "blots"}},
        {"contour", {"partition", "two_pass", "blots", "sectors"}},
        {"shadow_volumes", {"partition"}},
        {"area_contour", {"partition", "shadow_volumes"}},
        {"volume_trees", {"partition", "scene_bsp", "shadow_volumes"}},
        {"pixels", {"partition"}},
        {"zbuffer", {"partition", "pixels"}},
        {"shadow_polygons", {"partition", "pixels"}},
        {"scan_out", {"partition", "pixels"}},
        {"angular_table", {"facing_chain", "ridge_edges", "partition", "pixels"}},
        {"illumination", {"partition"}},
        {"shading_mesh", {"partition", "shadow_volumes"}},
        {"run",
         {"partition", "scene_bsp", "svbsp", "svbsp_full", "tiling", "sectors", "contour", "pixels",
          "zbuffer", "shadow_polygons", "scan_out", "angular_table", "shadow_volumes",
          "area_contour", "volume_trees", "illumination", "shading_mesh"}}}},
      {"oracle",
       {{"geometry", {}},
        {"visibility", {"geometry"}},
        {"answer", {"geometry", "visibility"}},
        {"judge", {"geometry", "visibility", "answer"}},
        {"image", {"visibility", "judge"}}}},
      {"suns",
       {{"calendar", {}},
        {"place", {}},
        {"position", {"calendar", "place"}},
        {"year", {"calendar", "place", "position"}}}},
      {"report",
       {{"text", {}},
        {"sides", {}},
        {"json", {"sides", "text"}},
        {"shares", {"json", "sides", "text"}},
        {"year", {"json", "shares", "sides", "text"}},
        {"facts", {"json", "sides", "text"}},
        {"certificate", {"facts", "json", "text"}},
        {"pixels", {"json", "text"}},
        {"meshes", {"json", "text"}},
        {"exports", {"certificate", "json", "meshes", "sides", "text"}},
        {"junit", {"text"}},
        {"page", {"json", "text"}},
        {"pictures", {"meshes", "text"}},
        {"loops", {"facts", "json", "pictures", "text"}},
        {"lines", {"json", "pictures", "text"}}}},
      {"fuzz",
       {{"text", {}},
        {"scene", {}},
        {"kinds", {"scene"}},
        {"moves", {"scene"}},
        {"generate", {"kinds", "moves", "scene"}},
        {"process", {}},
        {"mistakes", {}},
        {"check", {"mistakes", "moves", "process"}},
        {"workers", {"check", "generate", "process"}},
        {"campaign", {"check", "generate", "workers"}},
        {"shrink", {"check", "scene"}},
        {"corpus", {"check", "process", "text"}},
        {"findings", {"check", "corpus", "process", "scene", "shrink"}},
        {"zoo", {"check", "findings", "generate", "mistakes"}}}},
      {"cli", {{"common", {}}, {"commands", {"common"}}}},
      {"python", {{"binding", {}}}},
  };
  return kRooms;
}

/// Headers through which a user enters the algorithms; the rooms behind them include the data that
/// they speak of, never the doors.
const std::set<std::string>& doors() {
  static const std::set<std::string> kDoors = {"gnomon/algorithms/shadows.h",
                                               "gnomon/algorithms/explain.h"};
  return kDoors;
}

/// Headers that are CGAL's types under a kernel's name, in their own room; no installed header may
/// include them or CGAL, so that only sources which ask for these types need CGAL and its
/// -frounding-math.
bool names_cgal(const std::string& header) {
  return header.starts_with("CGAL/") || header.starts_with("kernel/cgal/");
}

/// "component/room/" of a header or source that is in a room, else "".
std::string room_of(const std::string& path) {
  const std::size_t first = path.find('/');
  const std::size_t second = path.find('/', first + 1);
  if (second == std::string::npos || path.find("/include/") != std::string::npos) return "";
  return path.substr(first + 1, second - first - 1);
}

/// Whether `room` of `component` may include `other` of it.
bool room_may_include(const std::string& component, const std::string& room,
                      const std::string& other) {
  const auto found = rooms().find(component);
  if (found == rooms().end() || room.empty() || room == other) return true;
  const auto own = std::ranges::find(found->second, room, &Room::name);
  return own != found->second.end() && own->may_include.contains(other);
}

/// The violations of one file, given by its path in the project and its text; one line each.
std::vector<std::string> violations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const std::string component = path.substr(0, path.find('/'));
  const auto& allowed = allowed_includes().at(component);
  const bool is_public = path.starts_with(component + "/include/");
  const std::string room = room_of(path);

  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (!std::regex_search(line, match, kInclude)) continue;
    const std::string header = match[2];
    const auto complain = [&](const std::string& what) {
      found.push_back(path + ":" + std::to_string(number) + ": " + what);
    };
    if (header.find("..") != std::string::npos) complain(header + " leaves its folder");
    if (is_public && names_cgal(header)) {
      complain(header + " belongs in a source, not in a public header");
    }
    if (header.starts_with("gnomon/")) {
      const std::string name = header.substr(std::string("gnomon/").size());
      if (!allowed.contains(name.substr(0, name.find('/'))) && !allowed.contains(name)) {
        complain(component + " must not include " + header);
      }
      if (component == "algorithms" && !room.empty() && room != "run" && doors().contains(header) &&
          !path.ends_with("/" + header.substr(header.rfind('/') + 1))) {
        complain(room + " must not include the front door " + header);
      }
      continue;
    }
    const std::string other = header.substr(0, header.find('/'));
    if (!allowed_includes().contains(other)) continue;
    if (is_public) {
      complain(header + " is in a room, and not installed with this header");
    } else if (other != component && !allowed.contains(other)) {
      complain(component + " must not include " + header);
    } else if (component == "oracle" && other != component) {
      complain("oracle must not include " + header);
    } else if (other == component && !room_may_include(component, room, room_of(header))) {
      complain(component + "/" + room + " must not include " + header);
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

TEST(Layers, TheTableOfRoomsHasNoCircle) {
  for (const auto& [component, own] : rooms()) {
    std::set<std::string> before;
    for (const Room& room : own) {
      for (const std::string& other : room.may_include) {
        EXPECT_TRUE(before.contains(other)) << component << '/' << room.name << " -> " << other;
      }
      before.insert(room.name);
    }
  }
}

TEST(Layers, EveryRoomOfTheTableIsThere) {
  for (const auto& [component, own] : rooms()) {
    for (const Room& room : own) {
      EXPECT_TRUE(std::filesystem::is_directory(std::filesystem::path(GNOMON_SOURCE_DIR) /
                                                component / room.name))
          << component << '/' << room.name;
    }
  }
}

TEST(Layers, SeesAViolationOfEachRule) {
  EXPECT_THAT(violations("kernel/room/a.cc", "\n#include \"gnomon/scene/scene.h\"\n"),
              ElementsAre("kernel/room/a.cc:2: kernel must not include gnomon/scene/scene.h"));
  EXPECT_THAT(violations("scene/room/a.cc", "#  include <gnomon/algorithms/shadows.h>\n"),
              ElementsAre(HasSubstr("scene must not include")));
  EXPECT_THAT(violations("algorithms/room/a.cc", "#include \"gnomon/oracle/verdict.h\""),
              ElementsAre(HasSubstr("algorithms must not include")));
  EXPECT_THAT(violations("oracle/room/a.cc", "#include \"gnomon/algorithms/shadow_result.h\""),
              ElementsAre(HasSubstr("oracle must not include")));
  EXPECT_THAT(violations("oracle/room/a.cc", "#include \"gnomon/kernel/plane_kernel.h\""),
              ElementsAre(HasSubstr("oracle must not include")));
  EXPECT_THAT(violations("result/a.cc", "#include \"gnomon/oracle/verdict.h\""),
              ElementsAre(HasSubstr("result must not include")));
  EXPECT_THAT(violations("report/room/a.cc", "#include \"gnomon/cli/command.h\""),
              ElementsAre(HasSubstr("report must not include")));
  EXPECT_THAT(violations("oracle/room/a.cc", "#include \"../../kernel/room/a.h\""),
              ElementsAre(HasSubstr("leaves its folder")));
  EXPECT_THAT(violations("oracle/include/gnomon/oracle/a.h", "#include <CGAL/Gmpq.h>"),
              ElementsAre(HasSubstr("not in a public header")));
  EXPECT_THAT(
      violations("algorithms/include/gnomon/algorithms/a.h", "#include \"kernel/signs/ball.h\""),
      ElementsAre(HasSubstr("not installed with this header")));
  EXPECT_THAT(violations("scene/files/a.cc", "#include \"oracle/geometry/chart.h\""),
              ElementsAre(HasSubstr("scene must not include")));
  EXPECT_THAT(violations("oracle/judge/a.cc", "#include \"scene/base/text_file.h\""),
              ElementsAre(HasSubstr("oracle must not include")));
  EXPECT_THAT(violations("algorithms/sectors/a.h", "#include \"algorithms/svbsp/svbsp.h\""),
              ElementsAre("algorithms/sectors/a.h:1: algorithms/sectors must not include "
                          "algorithms/svbsp/svbsp.h"));
  EXPECT_THAT(violations("algorithms/sectors/a.h", "#include \"gnomon/algorithms/shadows.h\""),
              ElementsAre(HasSubstr("sectors must not include the front door")));
  EXPECT_THAT(violations("algorithms/attic/a.h", "#include \"algorithms/partition/split.h\""),
              ElementsAre(HasSubstr("algorithms/attic must not include")));
}

TEST(Layers, LetsPassWhatIsAllowed) {
  EXPECT_THAT(violations("oracle/room/a.cc",
                         "#include <CGAL/Gmpq.h>\n#include \"gnomon/kernel/sign.h\"\n"
                         "#include \"gnomon/scene/prepare.h\"\n#include \"own.h\"\n"),
              IsEmpty());
  EXPECT_THAT(violations("kernel/room/a.cc", "// includes \"gnomon/scene/scene.h\" in words"),
              IsEmpty());
}

TEST(Layers, SeesAViolationInAMadeUpTree) {
  namespace fs = std::filesystem;
  const fs::path root = fs::path(testing::TempDir()) / "gnomon_layers_made_up";
  fs::remove_all(root);
  fs::create_directories(root / "oracle" / "room");
  std::ofstream(root / "oracle" / "room" / "bad.cc") << "#include \"gnomon/algorithms/bsp.h\"\n";
  const Walk result = walk(root);
  fs::remove_all(root);
  EXPECT_THAT(result.violations,
              ElementsAre("oracle/room/bad.cc:1: oracle must not include gnomon/algorithms/bsp.h"));
}

}  // namespace
