// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon pixels and gnomon certify on pictures: what is written is judged, and errors name their
// place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class PixelsCommand : public testing::Test {
 protected:
  void SetUp() override {
    scene_ = directory_.file("table-chair.json");
    ASSERT_EQ(run_gnomon({"generate", "table-chair", "-o", scene_}).status, 0);
  }
  static std::string text_of(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  RunResult pixels(std::vector<std::string> options) {
    std::vector<std::string> words{"pixels",  scene_, "--eye",    "21,-17,19",
                                   "--width", "32",   "--height", "24"};
    words.insert(words.end(), options.begin(), options.end());
    return run_gnomon(words);
  }

  TestDirectory directory_;
  std::string scene_;
};

TEST_F(PixelsCommand, WritesWhatCertifyFindsRight) {
  const std::string file = directory_.file("p.json");
  const RunResult done = pixels({"-o", file, "--stats"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.err, AllOf(HasSubstr("camera: eye 21,-17,19, right "), HasSubstr("depth tests"),
                              HasSubstr("exact stage")));
  rapidjson::Document document;
  document.Parse(text_of(file).c_str());
  ASSERT_FALSE(document.HasParseError());
  EXPECT_STREQ(document["format"].GetString(), "gnomon-pixels");
  EXPECT_EQ(document["rows"].Size(), 24u);
  const RunResult judged = run_gnomon({"certify", scene_, "--pixels", file});
  EXPECT_EQ(judged.status, 0) << judged.err;
  EXPECT_THAT(judged.out, AllOf(HasSubstr("identical"), HasSubstr("32 x 24 samples")));
}

// One sample of a file is changed: it is found, and named.
TEST_F(PixelsCommand, AWrongSampleIsNamed) {
  const std::string file = directory_.file("p.json");
  ASSERT_EQ(pixels({"-o", file}).status, 0);
  std::string text = text_of(file);
  // The first run of a row that sees something lit by the only light.
  const std::size_t at = text.find(", 1]");
  ASSERT_NE(at, std::string::npos);
  text[at + 2] = '0';
  std::ofstream(file) << text;
  const RunResult judged = run_gnomon({"certify", scene_, "--pixels", file, "--json", "-"});
  EXPECT_EQ(judged.status, 1) << judged.err;
  rapidjson::Document document;
  document.Parse(judged.out.c_str());
  ASSERT_FALSE(document.HasParseError()) << judged.out;
  const auto& picture = document["pictures"][0];
  EXPECT_STREQ(picture["verdict"].GetString(), "failed");
  EXPECT_GT(picture["wrong"].GetInt(), 0);
  EXPECT_FALSE(picture["worst"]["found_lit"].GetBool());
  EXPECT_THAT(picture["worst"]["text"].GetString(), HasSubstr("found shadow, true lit"));
}

TEST_F(PixelsCommand, WritesPng) {
  const std::string file = directory_.file("p.png");
  EXPECT_EQ(pixels({"-o", file}).status, 0);
  EXPECT_THAT(text_of(file), StartsWith("\x89PNG\r\n"));
}

TEST_F(PixelsCommand, OtherMethodsWriteTheSameSamples) {
  const auto rows = [&](const std::string& algorithm, const std::string& kernel) {
    const RunResult done = pixels({"--algorithm", algorithm, "--kernel", kernel});
    EXPECT_EQ(done.status, 0) << done.err;
    return done.out.substr(done.out.find("\"camera\""));
  };
  const std::string reference = rows("zbuffer", "plane");
  for (const char* algorithm : {"zbuffer:order=far", "sectors", "svbsp", "basic:cover=overlay"}) {
    EXPECT_EQ(rows(algorithm, "plane"), reference) << algorithm;
  }
  EXPECT_EQ(rows("zbuffer", "rational"), reference);
}

TEST_F(PixelsCommand, CertifyJudgesOurOwnPictures) {
  const RunResult judged =
      run_gnomon({"certify", scene_, "--eye", "21,-17,19", "--columns", "24", "--rows", "24",
                  "--algorithm", "all", "--kernel", "plane", "--kernel", "double"});
  EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
  EXPECT_THAT(judged.out,
              AllOf(HasSubstr("plane/zbuffer"), HasSubstr("double/svbsp"), HasSubstr("identical")));
}

// What few rows get wrong is excused, of a run as of a file, unless --strict; linear distances are
// no bug of an exact kernel.
TEST_F(PixelsCommand, WhatRowsGetWrongIsToldApart) {
  const std::string solid = directory_.file("solid.json"), file = directory_.file("p.json");
  ASSERT_EQ(run_gnomon({"generate", "closed", "--param", "kind=polycube", "-o", solid}).status, 0);
  const std::vector<std::string> camera{"--eye",     "60,-90,110", "--look-at", "0,0,0",
                                        "--columns", "96",         "--rows",    "96"};
  const auto certified = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"certify", solid};
    words.insert(words.end(), more.begin(), more.end());
    return run_gnomon(words);
  };
  const auto by_camera = [&](const std::string& method, std::vector<std::string> more = {}) {
    std::vector<std::string> words = camera;
    words.insert(words.end(), {"--kernel", "plane", "--algorithm", method});
    words.insert(words.end(), more.begin(), more.end());
    return certified(words);
  };
  const std::string rows = "ridge-edges:rows=12,hemisphere=cube";
  const RunResult excused = by_camera(rows);
  EXPECT_EQ(excused.status, 0) << excused.out << excused.err;
  EXPECT_THAT(excused.out, AllOf(HasSubstr("within tolerance"), HasSubstr("within half a row")));
  const RunResult strict = by_camera(rows, {"--strict"});
  EXPECT_EQ(strict.status, 1) << strict.out << strict.err;
  EXPECT_THAT(strict.out, HasSubstr("failed"));
  ASSERT_EQ(run_gnomon({"pixels", solid, "--eye", "60,-90,110", "--look-at", "0,0,0", "--width",
                        "96", "--height", "96", "--algorithm", rows, "-o", file})
                .status,
            0);
  EXPECT_EQ(certified({"--pixels", file}).status, 0);
  EXPECT_EQ(certified({"--pixels", file, "--strict"}).status, 1);
  const RunResult linear = by_camera("ridge-edges:interpolate=linear");
  EXPECT_LE(linear.status, 1) << linear.out << linear.err;
}

TEST_F(PixelsCommand, ErrorsSayWhatIsExpected) {
  EXPECT_THAT(pixels({"-o", directory_.file("p.gif")}).err, HasSubstr(".png or .json"));
  EXPECT_THAT(pixels({"--algorithm", "contour"}).err, HasSubstr("one of: zbuffer"));
  EXPECT_THAT(pixels({"--algorithm", "zbuffer:order=up"}).err, HasSubstr("near|file|far"));
  EXPECT_THAT(pixels({"--eye", "1,2"}).err, HasSubstr("--eye"));
  EXPECT_EQ(run_gnomon({"shadows", scene_, "--algorithm", "zbuffer"}).status, 2);
  EXPECT_THAT(run_gnomon({"shadows", scene_, "--algorithm", "zbuffer"}).err,
              HasSubstr("gnomon pixels"));
  const RunResult missing = run_gnomon({"certify", scene_, "--pixels", "nowhere.json"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("nowhere.json"));
  EXPECT_EQ(run_gnomon({"certify", scene_, "--pixels", scene_}).status, 2);
}

}  // namespace
}  // namespace gnomon::test
