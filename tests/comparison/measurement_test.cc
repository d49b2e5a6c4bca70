// SPDX-License-Identifier: GPL-3.0-or-later
// One run: its text forms, and what it tells.
#include "comparison/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "comparison/run_measurement.h"

namespace gnomon::comparison {
namespace {

using testing::HasSubstr;

RunRequest request(const std::string& system, const std::string& kernel) {
  RunRequest asked;
  asked.scene = "city";
  asked.size = 60;
  asked.system = system;
  asked.kernel = kernel;
  asked.repeat = 1;
  asked.certify_up_to = 100;
  return asked;
}

TEST(Measurement, TextFormsReadBack) {
  RunRequest asked = request("tiling:tiles=8", "double+thin");
  asked.seed = 18446744073709551615u;
  asked.lights = LightsAsked::kArea;
  EXPECT_EQ(*parse_request(request_text(asked)), asked);
  asked.size.reset();
  asked.thickness = 0;
  asked.change = "axes yzx";
  EXPECT_EQ(*parse_request(request_text(asked)), asked);

  Measurement measured;
  measured.end = RunEnd::kCrashed;
  measured.why = "signal 11 \"and\nmore\"";
  measured.polygons = 5;
  measured.seconds = 0.1;
  measured.runs = 3;
  measured.checksum = "0123456789abcdef";
  measured.work[Counter::kTests] = 7;
  EXPECT_EQ(*parse_measurement(measurement_text(measured)), measured);
  measured.difference = Difference{3, 1e-16, "light sun, polygon \"a\" (front)"};
  measured.judgement =
      Judgement{"failed", false, true, 1e-9, "misclassified", "too much", 2e-9, 0.25, 100.5, 7, 8};
  EXPECT_EQ(*parse_measurement(measurement_text(measured)), measured);
  EXPECT_EQ(measurement_text(measured).find('\n'), std::string::npos);

  EXPECT_FALSE(parse_request("{}"));
  EXPECT_FALSE(parse_measurement("{\"end\": \"measured\"}"));
  EXPECT_FALSE(parse_measurement("nonsense"));
}

TEST(Measurement, TellsMoreAndMore) {
  std::vector<Measurement> told;
  const Measurement last =
      measure(request("tiling", "plane"), [&](const Measurement& more) { told.push_back(more); });
  ASSERT_EQ(told.size(), 2u);
  EXPECT_TRUE(told[0].timed());
  EXPECT_EQ(told[0].checksum, "");
  EXPECT_EQ(told[1].checksum, last.checksum);
  EXPECT_FALSE(told[1].judgement);
  ASSERT_TRUE(last.judgement);
  EXPECT_EQ(last.judgement->verdict, "identical");
  EXPECT_TRUE(last.judgement->confirms);
  EXPECT_EQ(last.judgement->wrong, 0);
  EXPECT_EQ(last.polygons, 56u);
  EXPECT_GT(last.fragments, 56u);
  EXPECT_GT(last.work[Counter::kTests], 0u);
}

TEST(Measurement, EverySystemGivesOneAnswerOnEveryExactKernel) {
  const std::string answer = measure(request("svbsp", "plane")).checksum;
  RunRequest crossing = request("two-pass", "rational");
  crossing.scene = "lattice:n=24";
  EXPECT_TRUE(measure(crossing).judgement->confirms);
  for (const char* system : {"sectors", "svbsp", "receiver", "merged", "basic", "tiling:tiles=16",
                             "svbsp-full", "two-pass", "two-pass:cells=off"}) {
    for (const char* kernel : {"plane", "rational", "epeck"}) {
      const Measurement measured = measure(request(system, kernel));
      EXPECT_EQ(measured.end, RunEnd::kMeasured) << measured.why;
      EXPECT_EQ(measured.checksum, answer) << system << ' ' << kernel;
    }
  }
  EXPECT_NE(measure(request("svbsp", "float")).checksum, answer);
}

TEST(Measurement, LargerScenesAreNotJudged) {
  RunRequest asked = request("basic", "double");
  asked.certify_up_to = 55;
  const Measurement measured = measure(asked);
  EXPECT_EQ(measured.end, RunEnd::kMeasured);
  EXPECT_FALSE(measured.judgement);
  EXPECT_NE(measured.checksum, "");
}

TEST(Measurement, WhatCannotBeRunIsRefused) {
  RunRequest area = request("basic", "double");
  area.scene = "city:area=1";
  area.lights = LightsAsked::kArea;
  EXPECT_THAT(measure(area).why, HasSubstr("takes no area lights"));
  area.system = "merged";
  EXPECT_EQ(measure(area).end, RunEnd::kMeasured);
  EXPECT_EQ(measure(request("magic", "double")).end, RunEnd::kRefused);
  EXPECT_EQ(measure(request("basic", "magic")).end, RunEnd::kRefused);
}

}  // namespace
}  // namespace gnomon::comparison
