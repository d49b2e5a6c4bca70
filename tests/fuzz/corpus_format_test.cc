// SPDX-License-Identifier: GPL-3.0-or-later
// Fixtures as files: what is written reads back, and what is broken says where.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fuzz/corpus/corpus.h"
#include "gnomon/scene/read.h"
#include "solve.h"
#include "tests/support/test_directory.h"

namespace gnomon::fuzz {
namespace {

namespace fs = std::filesystem;

class CorpusFormat : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  /// The error of the folder that holds this file alone.
  std::string error_of(const std::string& name, const std::string& text) const {
    write(name, text);
    const auto read = read_corpus(folder_);
    fs::remove(folder_ / name);
    if (read) return "none";
    EXPECT_TRUE(read.error().where.file.starts_with(folder_.string()));
    return to_string(read.error()).substr(read.error().where.file.size() + 2);
  }

  const test::TestDirectory directory_;
  const fs::path folder_ = directory_.path();
};

Scene scene_of(const std::string& text) {
  auto read = parse_scene(text, "scene.json");
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? std::move(read->scene) : Scene{};
}

const std::string kTable = R"({ "format": "gnomon-scene", "version": 1, "name": "y_table",
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[3,1,1],[3,3,1],[1,3,1]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]},
               {"id": "top", "loop": [4,5,6,7], "two_sided": true}],
  "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]},
             {"id": "panel", "type": "area", "loop": [[1,1,2],[1,3,2],[3,3,2],[3,1,2]]}] })";

Expected<std::string> text_of(const Scene& scene, const FixtureNote& note) {
  return fixture_text(test::Case::make(scene)->judged(), note);
}

// One corner is lifted: two parts in two planes, lit differently.
const std::string kFold = R"({ "format": "gnomon-scene", "version": 1, "name": "y_fold",
  "vertices": [[0,0,0],[4,0,0],[4,4,1],[0,4,0],[2,-1,2],[5,-1,2],[5,1,2],[2,1,2]],
  "polygons": [{"id": "fold", "loop": [0,1,2,3]}, {"id": "top", "loop": [4,5,6,7]}],
  "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]}] })";

TEST_F(CorpusFormat, WhatIsWrittenReadsBack) {
  FixtureNote note{"A table \"over\" a floor.", "touching", "by hand", {}};
  const auto text = text_of(scene_of(kTable), note);
  ASSERT_TRUE(text) << to_string(text.error());
  EXPECT_EQ(*text, *text_of(scene_of(*text), note));  // stable
  write("touching/y_table.json", *text);
  note.inform = true;
  note.wrong = {"float", "double+thin"};
  write("i_table.json", *text_of(scene_of(kTable), note));
  write("y_fold.json", *text_of(scene_of(kFold), note = {"A fold.", "parts", {}, {}}));
  const auto corpus = read_corpus(folder_);
  ASSERT_TRUE(corpus) << to_string(corpus.error());
  ASSERT_EQ(corpus->size(), 3u);
  const Fixture &known = (*corpus)[0], &table = (*corpus)[1], &fold = (*corpus)[2];
  EXPECT_EQ(known.name, "i_table");
  EXPECT_EQ(known.wrong, (std::vector<std::string>{"double+thin", "float"}));
  EXPECT_EQ(table.name, "touching/y_table");
  EXPECT_EQ(table.shows, "A table \"over\" a floor.");
  EXPECT_EQ(table.kind, "touching");
  EXPECT_EQ(table.found, "by hand");
  EXPECT_EQ(table.expectation, Expectation::kAgree);
  ASSERT_EQ(table.fractions.size(), 2u);
  const RecordedSide& floor = table.fractions[0].sides[0];
  EXPECT_EQ(floor.polygon, "floor");
  EXPECT_EQ(*floor.shares[0].exact, mpq_class(3, 4));
  EXPECT_EQ(*floor.shares[1].exact, mpq_class(1, 4));
  EXPECT_TRUE(table.fractions[1].area);
  EXPECT_EQ(table.fractions[1].sides[0].shares.size(), 3u);
  for (const Fixture* fixture : {&table, &fold}) {
    const auto again = exact_answer_of(test::Case::make(fixture->scene)->judged());
    ASSERT_TRUE(again);
    EXPECT_EQ(difference(fixture->fractions, *again), "");
  }
  // The fold's areas are square roots; its parts are exact.
  const RecordedSide& side = fold.fractions[0].sides[0];
  EXPECT_FALSE(side.shares[0].exact);
  ASSERT_EQ(side.parts.size(), 2u);
  EXPECT_NE(side.parts[0][0], side.parts[1][0]);
}

TEST_F(CorpusFormat, DifferencesAreTold) {
  auto recorded = exact_answer_of(test::Case::make(scene_of(kTable))->judged());
  ASSERT_TRUE(recorded);
  auto other = *recorded;
  other[0].sides[0].shares[0].exact = mpq_class(1, 2);
  EXPECT_EQ(difference(*recorded, other),
            "light 'sun', polygon 'floor' (front): lit 1/2 instead of 3/4");
  other = *recorded;
  other[1].sides.pop_back();
  EXPECT_EQ(difference(*recorded, other),
            "light 'panel', polygon 'top' (front) is not listed in its place");
  other = *recorded;
  other.pop_back();
  EXPECT_EQ(difference(*recorded, other), "1 lights instead of 2");
}

TEST_F(CorpusFormat, BrokenFixturesSayWhere) {
  const std::string text = *text_of(scene_of(kTable), {"A table.", "touching", {}, {}});
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  EXPECT_EQ(error_of("y_a.json", text), "none");
  EXPECT_EQ(error_of("a.json", text),
            "a file whose name does not say what must hold; expected a name that begins with y_, "
            "i_ or n_");
  EXPECT_EQ(error_of("y_a.json", kTable),
            "\"extra\" is missing; expected what the scene shows (at /extra)");
  EXPECT_EQ(error_of("y_a.json", with("\"kind\"", "\"king\"")),
            "key \"kind\" is missing (at /extra)");
  EXPECT_EQ(error_of("y_a.json", with("\"3/4\"", "\"2/4\"")),
            "the fractions add up to 3/4; expected 1 (at /extra/fractions/sun/0)");
  EXPECT_EQ(error_of("y_a.json", with("\"3/4\"", "\"3/0\"")),
            "no fraction; expected a rational as text, or a number "
            "(at /extra/fractions/sun/0/lit)");
  EXPECT_EQ(error_of("y_a.json", with("\"panel\": [", "\"pane\": [")),
            "light 'panel' is missing or no list; expected a list of polygon sides "
            "(at /extra/fractions/panel)");
  EXPECT_EQ(error_of("i_a.json", text),
            "key \"wrong\" is missing; expected a list, perhaps empty (at /extra)");
  EXPECT_EQ(error_of("y_a.json", with("\"kind\"", "\"wrong\": [], \"kind\"")),
            "a y_ scene that some get wrong; expected an i_ scene (at /extra/wrong)");
  EXPECT_NE(error_of("y_a.json", text.substr(0, 100)), "none");
  EXPECT_NE(error_of("n_a.json", "{"), "none");  // nothing says with which error
}

TEST_F(CorpusFormat, RejectedFilesHaveTheirNoteBeside) {
  write("n_a.json", "{");
  write("n_a.json.expected.json",
        R"({"shows": "A brace.", "kind": "rejected", "error": "syntax", "line": 1, "column": 2})");
  const auto corpus = read_corpus(folder_);
  ASSERT_TRUE(corpus) << to_string(corpus.error());
  ASSERT_EQ(corpus->size(), 1u);
  const Fixture& brace = corpus->front();
  EXPECT_EQ(brace.expectation, Expectation::kReject);
  EXPECT_EQ(brace.error.code, ErrorCode::kSyntax);
  EXPECT_EQ(brace.error.where.line, 1u);
  EXPECT_EQ(brace.error.where.column, 2u);
  write("n_a.json.expected.json", R"({"shows": "A brace.", "kind": "x", "error": "sin"})");
  const auto unknown = read_corpus(folder_);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().where.pointer, "/error");
}

TEST_F(CorpusFormat, AnEmptyFolderIsAnError) {
  EXPECT_FALSE(read_corpus(folder_));
  EXPECT_FALSE(read_corpus(folder_ / "absent"));
}

TEST_F(CorpusFormat, ErrorCodesHaveNames) {
  for (int code = 0; code <= static_cast<int>(ErrorCode::kInterrupted); ++code) {
    const auto known = static_cast<ErrorCode>(code);
    EXPECT_EQ(error_code_by_name(error_code_name(known)), known);
  }
  EXPECT_FALSE(error_code_by_name("none"));
}

}  // namespace
}  // namespace gnomon::fuzz
