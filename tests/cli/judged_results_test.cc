// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever `shadows` writes, `certify` and `verify` judge: right as it is, wrong once it is
// tampered with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

std::string example(const std::string& name) { return GNOMON_EXAMPLES "/" + name + ".json"; }

class JudgedResults : public testing::Test {
 protected:
  std::string written(const std::string& scene, std::vector<std::string> options) {
    options.insert(options.begin(), {"shadows", example(scene), "--exact-fractions"});
    const RunResult done = run_gnomon(options);
    EXPECT_EQ(done.status, 0) << done.err;
    return done.out;
  }

  struct Verdicts {
    RunResult certify, verify;
  };
  Verdicts judge(const std::string& scene, const std::string& result) {
    const std::string file = (directory_.path() / "result.json").string();
    write_text(file, result);
    return {run_gnomon({"certify", example(scene), "--candidate", file}),
            run_gnomon({"verify", example(scene), file})};
  }

  void expect_right(const std::string& scene, const std::string& result) {
    const Verdicts found = judge(scene, result);
    EXPECT_EQ(found.certify.status, 0) << found.certify.out << found.certify.err;
    EXPECT_THAT(found.certify.out, HasSubstr("Identical to the exact answer"));
    EXPECT_EQ(found.verify.status, 0) << found.verify.out << found.verify.err;
    EXPECT_THAT(found.verify.out, HasSubstr("every claim"));
  }

  Verdicts expect_wrong(const std::string& scene, const std::string& result) {
    Verdicts found = judge(scene, result);
    EXPECT_EQ(found.certify.status, 1) << found.certify.out << found.certify.err;
    EXPECT_EQ(found.verify.status, 1) << found.verify.out << found.verify.err;
    return found;
  }

  TestDirectory directory_;
};

/// The first `from` after `start` becomes `to`.
std::string changed(std::string text, const std::string& start, const std::string& from,
                    const std::string& to) {
  const std::size_t place = text.find(from, text.find(start));
  EXPECT_NE(place, std::string::npos) << from;
  if (place != std::string::npos) text.replace(place, from.size(), to);
  return text;
}

TEST_F(JudgedResults, SeveralLightsTogether) {
  for (const std::string scene : {"touching", "panel-contacts"}) {
    const std::string result =
        written(scene, {"--combined", "--exact-loops", "--algorithm", "receiver"});
    expect_right(scene, result);
    const std::string light = scene == "touching" ? "lamp" : "panel";
    const std::string all = scene == "touching" ? R"(["lamp", "sun"])" : R"(["panel"])";
    const Verdicts found = expect_wrong(scene, changed(result, "\"combined\"", all, "[]"));
    EXPECT_THAT(found.certify.out, HasSubstr("combined, light " + light));
    EXPECT_THAT(found.verify.out, HasSubstr("combined, light " + light));
    const Verdicts unknown =
        expect_wrong(scene, changed(result, "\"combined\"", all, R"(["moon"])"));
    EXPECT_THAT(unknown.certify.out, HasSubstr("no light 'moon' in the scene"));
  }
}

TEST_F(JudgedResults, RoundedLoopsTogether) {
  const std::string file = (directory_.path() / "result.json").string();
  write_text(file, written("courtyard", {"--combined", "--fragments"}));
  const RunResult certified = run_gnomon({"certify", example("courtyard"), "--candidate", file});
  EXPECT_EQ(certified.status, 0) << certified.out;
  EXPECT_THAT(certified.out, HasSubstr("Within tolerance"));
  EXPECT_EQ(run_gnomon({"verify", example("courtyard"), file}).status, 0);
}

TEST_F(JudgedResults, KernelsOnSeveralLightsTogether) {
  const RunResult done = run_gnomon(
      {"certify", example("touching"), "--combined", "--kernel", "plane", "--kernel", "double"});
  EXPECT_EQ(done.status, 0) << done.out << done.err;
  EXPECT_THAT(done.out, HasSubstr("Identical to the exact answer: plane"));
  EXPECT_EQ(
      run_gnomon({"certify", example("touching"), "--combined", "--algorithm", "sectors"}).status,
      2);
}

TEST_F(JudgedResults, ListsOfSomeClassesAlone) {
  for (const std::string scene : {"touching", "panel-contacts"}) {
    for (const std::string option :
         {"--lit-only", "--shadow-only", "--penumbra-only", "--umbra-only"}) {
      SCOPED_TRACE(scene + option);
      const std::string result = written(scene, {option, "--exact-loops"});
      expect_right(scene, result);
    }
  }
  // Fewer or more than there is.
  expect_wrong("touching", changed(written("touching", {"--shadow-only", "--exact-loops"}), "",
                                   "\"background\": \"lit\"", "\"background\": \"shadow\""));
  expect_wrong("panel-contacts",
               changed(written("panel-contacts", {"--umbra-only", "--exact-loops"}), "",
                       "\"listed\": [\"umbra\"]", "\"listed\": [\"umbra\", \"penumbra\"]"));
}

TEST_F(JudgedResults, ShadowsPaintedOnShadows) {
  for (const std::string method : {"basic:cover=overlay", "tiling:tiles=4,cover=overlay"}) {
    const std::string result =
        written("touching", {"--combined", "--exact-loops", "--algorithm", method});
    EXPECT_THAT(result, HasSubstr("\"overlay\""));
    expect_right("touching", result);
    const RunResult own = run_gnomon({"certify", example("touching"), "--kernel", "plane",
                                      "--combined", "--strict", "--algorithm", method});
    EXPECT_EQ(own.status, 0) << own.out;
  }
}

// A mesh has a face a fragment; where a result has none, nothing would be lit.
TEST_F(JudgedResults, PaintedShadowsAreNotShaded) {
  const std::string mesh = (directory_.path() / "mesh.ply").string();
  for (const std::string method : {"basic:cover=overlay", "two-pass:cover=overlay"}) {
    const RunResult run =
        run_gnomon({"shadows", example("pinwheel"), "--algorithm", method, "--illuminate", "--mesh",
                    mesh, "-o", (directory_.path() / "result.json").string()});
    EXPECT_EQ(run.status, 2) << method;
    EXPECT_THAT(run.err, HasSubstr("cover=partition"));
  }
}

TEST_F(JudgedResults, PiecesOfALight) {
  const std::string result = written("panel-contacts", {"--pieces", "--exact-loops"});
  EXPECT_THAT(result, HasSubstr("\"piece_of\": \"panel\""));
  expect_right("panel-contacts", result);
  expect_wrong("panel-contacts",
               changed(result, "", "\"class\": \"penumbra\"", "\"class\": \"lit\""));
  // A piece of something else is no piece.
  const Verdicts found = judge(
      "panel-contacts", changed(result, "", "\"piece_of\": \"panel\"", "\"piece_of\": \"lamp\""));
  EXPECT_EQ(found.certify.status, 2);
  EXPECT_THAT(found.certify.err, HasSubstr("no area light 'lamp'"));
  EXPECT_EQ(found.verify.status, 1);
  EXPECT_THAT(found.verify.out, HasSubstr("no area light 'lamp'"));
}

}  // namespace
}  // namespace gnomon::test
