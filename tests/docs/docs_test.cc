// SPDX-License-Identifier: GPL-3.0-or-later
// The documentation names files that exist: every relative link and every path in the Markdown
// files of the project leads to a file or folder of the tree. CHANGELOG.md is left out, since it
// tells of files as they were called then.
#include <fnmatch.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// All files and folders of the project, by their paths from its root; builds and packages are left
/// out.
struct Tree {
  fs::path root;
  std::set<std::string> paths;

  explicit Tree(const fs::path& folder) : root(folder) {
    for (auto entry = fs::recursive_directory_iterator(root); entry != fs::end(entry); ++entry) {
      const std::string name = entry->path().filename().string();
      if (entry->is_directory() &&
          (name == "build" || name == "node_modules" || name == ".git" || name == ".cache")) {
        entry.disable_recursion_pending();
        continue;
      }
      paths.insert(fs::relative(entry->path(), root).generic_string());
    }
  }

  bool has(const std::string& path) const {
    if (path.find('*') == std::string::npos) return paths.contains(path);
    return std::ranges::any_of(paths, [&](const std::string& each) {
      return fnmatch(path.c_str(), each.c_str(), FNM_PATHNAME) == 0;
    });
  }
  std::string text(const std::string& path) const {
    std::ifstream file(root / path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// Whether the folder itself holds sources.
  bool has_sources(const std::string& folder) const {
    return has(folder + "/*.h") || has(folder + "/*.cc");
  }
};

/// `path` as seen from `folder`, from the root of the tree.
std::string from_root(const std::string& folder, const std::string& path) {
  return (fs::path(folder) / path).lexically_normal().generic_string();
}

/// The anchors of the headings of a Markdown text, as GitHub makes them.
std::set<std::string> anchors(const std::string& text) {
  std::set<std::string> found;
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) {
    const std::size_t start = line.find_first_not_of('#');
    if (start == 0 || start == std::string::npos || line[start] != ' ') continue;
    std::string anchor;
    for (const char c : line.substr(start + 1)) {
      if (c == ' ') anchor += '-';
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
    }
    found.insert(anchor);
  }
  return found;
}

/// Whether a link of a file in `folder` leads somewhere. Web addresses are not followed.
bool link_leads_somewhere(const Tree& tree, const std::string& file, const std::string& link) {
  if (link.find("://") != std::string::npos) return true;
  const std::size_t hash = link.find('#');
  const std::string path = link.substr(0, hash);
  const std::string folder = fs::path(file).parent_path().generic_string();
  std::string target = path.empty() ? file : from_root(folder, path);
  if (target.ends_with('/')) target.pop_back();
  if (!tree.has(target)) return false;
  return hash == std::string::npos || anchors(tree.text(target)).contains(link.substr(hash + 1));
}

/// Whether a word of code names a file or folder of the project: a path that begins with a folder
/// of its root, an installed header, or a path that ends as a source or a page does.
bool names_a_path(const Tree& tree, const std::string& word) {
  const std::size_t slash = word.find('/');
  if (slash == std::string::npos || slash == 0 || word.starts_with("build/")) return false;
  static const std::regex kSource(R"(.*\.(h|cc|cmake|md|py))");
  static const std::regex kFile(R"(.*(\.[a-z]+|/))");
  const std::string top = word.substr(0, slash);
  const bool in_the_tree = tree.has(top) || top == "gnomon";
  return std::regex_match(word, in_the_tree ? kFile : kSource);
}

/// Whether the path of a word of code exists. A name in capitals or in angle brackets stands for
/// any name, as in `tests/fuzzers/NAME.cc`.
bool path_exists(const Tree& tree, const std::string& word) {
  static const std::regex kAnyName("NAME|<[a-z]+>");
  std::string path = std::regex_replace(word, kAnyName, "*");
  if (path.ends_with('/')) path.pop_back();
  return tree.has(path.starts_with("gnomon/") ? "*/include/" + path : path);
}

/// The words of code of a line, without the punctuation around them.
std::vector<std::string> words_of_code(const std::string& line, bool in_block) {
  std::string code = in_block ? line : "";
  static const std::regex kSpan("`([^`]+)`");
  for (std::sregex_iterator span(line.begin(), line.end(), kSpan), end; !in_block && span != end;
       ++span) {
    code += span->str(1) + ' ';
  }
  std::istringstream stream(code);
  std::vector<std::string> words;
  constexpr std::string_view kAround = "\"'(),;:.";
  for (std::string word; stream >> word;) {
    const std::size_t first = word.find_first_not_of(kAround);
    if (first == std::string::npos) continue;
    words.push_back(word.substr(first, word.find_last_not_of(kAround) + 1 - first));
  }
  return words;
}

/// Whether a README of a room may call a file by this name: a file of the room, `scene/kinds.h` of
/// its component, an installed header of the component, or one of the component's tests.
bool known_in_room(const Tree& tree, const std::string& folder, const std::string& word) {
  const std::string component = folder.substr(0, folder.find('/'));
  return tree.has(folder + "/" + word) || tree.has(component + "/" + word) ||
         tree.has(component + "/include/gnomon/" + component + "/" + word) ||
         tree.has("tests/" + component + "*/" + word);
}

/// The links and paths of one Markdown file that lead nowhere, one line each. In a README beside
/// sources a bare name such as `split.h` is a file that the room knows.
std::vector<std::string> broken(const Tree& tree, const std::string& file,
                                const std::string& text) {
  static const std::regex kLink(R"(\]\(([^)\s]+)\))");
  static const std::regex kBareName(R"([a-z0-9_.*]+\.(h|cc))");
  const std::string folder = fs::path(file).parent_path().generic_string();
  const bool beside_sources = file.ends_with("/README.md") && tree.has_sources(folder);
  std::vector<std::string> found;
  std::istringstream lines(text);
  std::string line;
  bool in_block = false;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string place = file + ":" + std::to_string(number) + ": ";
    if (line.starts_with("```")) {
      in_block = !in_block;
      continue;
    }
    for (std::sregex_iterator link(line.begin(), line.end(), kLink), end; !in_block && link != end;
         ++link) {
      if (!link_leads_somewhere(tree, file, link->str(1))) {
        found.push_back(place + "link to " + link->str(1));
      }
    }
    for (const std::string& word : words_of_code(line, in_block)) {
      const bool is_here = beside_sources && std::regex_match(word, kBareName);
      if (!is_here && !names_a_path(tree, word)) continue;
      const bool exists = !is_here && path_exists(tree, word);
      if (!exists && !(beside_sources && known_in_room(tree, folder, word))) {
        found.push_back(place + word);
      }
    }
  }
  return found;
}

TEST(Docs, EveryLinkAndPathLeadsToAFileOfTheTree) {
  const Tree tree(GNOMON_SOURCE_DIR);
  std::vector<std::string> found;
  int files = 0;
  for (const std::string& path : tree.paths) {
    if (!path.ends_with(".md") || path == "CHANGELOG.md") continue;
    ++files;
    std::ranges::copy(broken(tree, path, tree.text(path)), std::back_inserter(found));
  }
  for (const std::string& place : found) ADD_FAILURE() << place;
  EXPECT_GE(files, 20);  // a walk that read nothing would find nothing
}

/// A tree with a few files, made for a test and removed after it.
class MadeUpDocs : public testing::Test {
 protected:
  MadeUpDocs() : root_(fs::path(testing::TempDir()) / test_name()) {
    fs::remove_all(root_);
    for (const char* path : {"docs/a.md", "algorithms/sectors/tree.h", "algorithms/sectors/cut.cc",
                             "algorithms/include/gnomon/algorithms/shadows.h"}) {
      fs::create_directories((root_ / path).parent_path());
      std::ofstream(root_ / path) << "# Some words: and `code`\n";
    }
  }
  ~MadeUpDocs() override { fs::remove_all(root_); }

  static std::string test_name() {
    return std::string("gnomon_docs_") +
           testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  std::vector<std::string> broken_in(const std::string& file, const std::string& text) const {
    return broken(Tree(root_), file, text);
  }

  fs::path root_;
};

TEST_F(MadeUpDocs, LinksAreSeenFromTheFileThatHasThem) {
  EXPECT_THAT(broken_in("docs/b.md", "[a](a.md), [x](../algorithms/sectors/tree.h), [w](http://w)"),
              IsEmpty());
  EXPECT_THAT(broken_in("docs/b.md", "\n[a](docs/a.md)"),
              ElementsAre("docs/b.md:2: link to docs/a.md"));
  EXPECT_THAT(broken_in("README.md", "[a](docs/a.md#some-words-and-code)"), IsEmpty());
  EXPECT_THAT(broken_in("README.md", "[a](docs/a.md#other-words)"), SizeIs(1));
}

TEST_F(MadeUpDocs, PathsAreSeenFromTheRoot) {
  EXPECT_THAT(broken_in("docs/b.md", "`algorithms/sectors/tree.h`, `algorithms/sectors/`"),
              IsEmpty());
  EXPECT_THAT(broken_in("docs/b.md", "`algorithms/*/*.cc`, `algorithms/NAME/tree.h`"), IsEmpty());
  EXPECT_THAT(broken_in("docs/b.md", "`gnomon/algorithms/shadows.h`"), IsEmpty());
  EXPECT_THAT(
      broken_in("docs/b.md", "`algorithms/src/tree.h`, `sectors/tree.h`, `docs/c/`"),
      ElementsAre(HasSubstr("src/tree.h"), HasSubstr("sectors/tree.h"), HasSubstr("docs/c/")));
  EXPECT_THAT(broken_in("docs/b.md", "`gnomon/algorithms/split.h`"), SizeIs(1));
  EXPECT_THAT(broken_in("docs/b.md", "```\nrun docs/a.md\nrun docs/c.md\n```\n"),
              ElementsAre("docs/b.md:3: docs/c.md"));
}

TEST_F(MadeUpDocs, WhatIsNoPathIsLeftAlone) {
  EXPECT_THAT(broken_in("docs/b.md", "`a/b`, `build/x.md`, `./mine`, `1/2`, docs/c.md, `tree.cc`"),
              IsEmpty());
}

TEST_F(MadeUpDocs, BareNamesInARoomAreItsFiles) {
  EXPECT_THAT(broken_in("algorithms/sectors/README.md", "`tree.h`, `*.cc`"), IsEmpty());
  EXPECT_THAT(broken_in("algorithms/sectors/README.md", "`trees.h`"), SizeIs(1));
}

}  // namespace
