// SPDX-License-Identifier: GPL-3.0-or-later
// Points with what was seen there, judged by gnomon certify.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A floor under a square, whose shadow under the lamp is [-2, 2]^2; from the panel, the way from
/// (x, 0) with 0 <= x <= 1 passes the square to where the panel is (1 - x) / 2 less of it.
constexpr const char* kYard = R"({ "format": "gnomon-scene", "version": 1, "name": "yard",
  "vertices": [[-4,-4,0],[4,-4,0],[4,4,0],[-4,4,0],[-1,-1,2],[1,-1,2],[1,1,2],[-1,1,2]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "square", "loop": [4,5,6,7]}],
  "lights": [{"id": "lamp", "type": "point", "position": [0,0,4]},
             {"id": "panel", "type": "area", "loop": [[1,-1,4],[1,1,4],[3,1,4],[3,-1,4]]}] })";

class Samples : public testing::Test {
 protected:
  void SetUp() override { write_text(scene_, kYard); }
  RunResult certify(const std::string& rows, std::vector<std::string> options = {},
                    const std::string& head = "light,x,y,z,visible,polygon\n") const {
    write_text(file_, head + rows);
    options.insert(options.begin(), {"certify", scene_, "--samples", file_});
    return run_gnomon(options);
  }

  TestDirectory directory_;
  const std::string scene_ = directory_.file("yard.json");
  const std::string file_ = directory_.file("rays.csv");
};

TEST_F(Samples, ThatAreRightAgree) {
  const std::string rows =
      "lamp,0,0,0,0,floor\nlamp,3,0,0,1,floor\nlamp,2,0,0,1,floor\nlamp,0,0,2,1.0,square\n"
      "panel,3,3,0,1,floor\npanel,0,0,0,0.5,floor\n";
  const RunResult run = certify(rows, {"--json", directory_.file("verdict.json")});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(
      run.out,
      AllOf(HasSubstr("6 samples of 2 lights on 2 polygons"), HasSubstr("samples agree"),
            HasSubstr("every sample lies exactly on its polygon"), HasSubstr("of up to 1 decimal"),
            HasSubstr("Samples agree with the exact ones: ")));
  EXPECT_THAT(read_text(directory_.file("verdict.json")),
              AllOf(HasSubstr(R"("format": "gnomon-certificate")"),
                    HasSubstr(R"("verdict": "samples agree")"), HasSubstr(R"("told_samples": 6)"),
                    HasSubstr(R"("samples": {"all": 6, "right": 5, "on_border": 1, )")));
  // The same as a candidate, and whatever the number of threads.
  EXPECT_EQ(run_gnomon({"certify", scene_, "--candidate", file_}).out, run.out);
  EXPECT_EQ(run_gnomon({"certify", scene_, "--samples", file_, "-j", "1"}).out, run.out);
  // Through a pipe.
  RunOptions piped;
  piped.input = read_text(file_);
  const RunResult from_pipe = run_gnomon({"certify", scene_, "--samples", "-"}, piped);
  EXPECT_EQ(from_pipe.status, 0) << from_pipe.err;
  EXPECT_THAT(from_pipe.out, HasSubstr("6 samples of 2 lights"));
}

TEST_F(Samples, OneWrongIsFoundAndNamed) {
  const RunResult run = certify("lamp,0,0,0,0,floor\nlamp,1.5,0.25,0,1,floor\nlamp,3,0,0,0,floor\n",
                                {"--json", directory_.file("verdict.json")});
  EXPECT_EQ(run.status, 1) << run.out << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("failed"),
                    HasSubstr("line 3: lamp at (1.5, 0.25, 0) on floor: found 1, true 0; "
                              "hidden by square, at least 0.5 from a"),
                    HasSubstr("border, clearance 0.5"),
                    HasSubstr("worst: line 4: lamp at (3, 0, 0) on floor: found 0, true 1; "
                              "the nearest shadow is that of"),
                    HasSubstr("hint: 1 sample was seen dark far from every shadow"),
                    HasSubstr("Failed: ")));
  EXPECT_THAT(read_text(directory_.file("verdict.json")),
              AllOf(HasSubstr(R"("verdict": "failed")"),
                    HasSubstr(R"("reason": "2 of 3 samples are wrong")"),
                    HasSubstr(R"("caster": "square")"), HasSubstr(R"("from_border": 0.5)"),
                    HasSubstr(R"("within_width": false)"), HasSubstr(R"("too_light": 1)"),
                    HasSubstr(R"("too_dark": 1)")));
  const RunResult few = certify("lamp,0,0,0,1,floor\nlamp,1,0,0,1,floor\n", {"--misses", "1"});
  EXPECT_THAT(few.out, AllOf(HasSubstr("line 2: "), Not(HasSubstr("line 3: "))));
}

TEST_F(Samples, WidthClearanceAndStrict) {
  const std::string row = "lamp,1.999,0,0,1,floor\n";
  EXPECT_EQ(certify(row).status, 1);
  const RunResult wide = certify(row, {"--width", "0.002"});
  EXPECT_EQ(wide.status, 0) << wide.out;
  EXPECT_THAT(wide.out, HasSubstr("within the width of a border"));
  EXPECT_EQ(certify(row, {"--width", "0.0005"}).status, 1);
  const RunResult cleared = certify(row, {"--clearance", "0.01"});
  EXPECT_EQ(cleared.status, 0) << cleared.out;
  EXPECT_THAT(cleared.out, AllOf(HasSubstr("ill-cond."), HasSubstr("ill-conditioned")));
  EXPECT_EQ(certify(row, {"--width", "0.002", "--strict"}).status, 1);
}

TEST_F(Samples, SharesOfAreaLightsByDigitsOrTolerance) {
  // 5/8 of the panel is seen from (0.25, 0).
  const auto status = [&](const std::string& share, const std::vector<std::string>& options = {}) {
    return certify("panel,0.25,0,0," + share + ",floor\n", options).status;
  };
  EXPECT_EQ(status("0.625"), 0);
  EXPECT_EQ(status("0.63"), 0);
  EXPECT_EQ(status("0.6"), 0);
  EXPECT_EQ(status("0.624"), 1);
  EXPECT_EQ(status("0.62"), 0);  // half of a hundredth off
  EXPECT_EQ(status("0.5"), 1);
  EXPECT_EQ(status("0.5", {"--tolerance", "0.2"}), 0);
  EXPECT_EQ(status("0.5", {"--tolerance", "1e300", "--width", "1e300"}), 0);
  EXPECT_EQ(status("0.624", {"--tolerance", "0.0005"}), 1);
  EXPECT_EQ(status("0.625000001", {"--strict"}), 1);
  EXPECT_EQ(status("0.625", {"--strict"}), 0);
  // 0 and 1 are as precise as the rest; where there is nothing else, they mean none and all.
  EXPECT_EQ(certify("panel,0,0,0,0.5,floor\npanel,0.25,0,0,1,floor\n").status, 1);
  EXPECT_EQ(status("1"), 1);
  EXPECT_EQ(status("1.5"), 1);
  EXPECT_EQ(status("nan"), 1);
  const RunResult run = certify("panel,0.25,0,0,0.9,floor\n");
  EXPECT_THAT(run.out, HasSubstr("found 0.9, true 5/8; most is hidden by square"));
}

TEST_F(Samples, MovedAndWithoutAPolygon) {
  const RunResult run =
      certify("lamp,0,0,1e-3,0\nlamp,3,3,-0.25,1\nlamp,3,-4,0,1\n", {}, "light,x,y,z,visible\n");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("2 samples are not exactly on the polygon and taken to its "
                                       "nearest point, the farthest by 0.25 (line"),
                             HasSubstr("3 samples without a polygon: the nearest was taken")));
}

TEST_F(Samples, OfSomeLightsAlone) {
  const std::string rows = "lamp,0,0,0,1,floor\npanel,3,3,0,1,floor\n";
  EXPECT_EQ(certify(rows).status, 1);
  const RunResult run = certify(rows, {"--light", "panel"});
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_THAT(run.out, HasSubstr("1 sample of other lights left out"));
  EXPECT_EQ(certify("lamp,0,0,0,1,floor\n", {"--light", "panel"}).status, 2);
}

TEST_F(Samples, WrongFilesAndOptionsAreErrors) {
  const auto error = [&](const std::string& rows, const std::vector<std::string>& options = {}) {
    const RunResult run = certify(rows, options);
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  EXPECT_THAT(error(""),
              HasSubstr("rays.csv:2:1: a file without samples; expected a row a sample"));
  EXPECT_THAT(error("moon,0,0,0,1,floor\n"), HasSubstr("rays.csv:2:1: 'moon' is no light"));
  // Told before anything is judged, however far down.
  std::string many;
  for (int i = 0; i < 20000; ++i) many += "lamp,0,0,0,0,floor\n";
  EXPECT_THAT(error(many + "lamp,0,0,x,0,floor\n"), HasSubstr("rays.csv:20002:10: 'x' "));
  EXPECT_THAT(error("lamp,0,0,0,0,floor\n", {"--kernel", "double"}),
              HasSubstr("--kernel does not go with samples"));
  EXPECT_THAT(error("lamp,0,0,0,0,floor\n", {"--candidate", scene_}),
              HasSubstr("samples and other candidates are not judged together"));
  const RunResult absent = run_gnomon({"certify", scene_, "--samples", directory_.file("no.csv")});
  EXPECT_EQ(absent.status, 2);
  EXPECT_THAT(run_gnomon({"certify", "-", "--samples", "-"}).err,
              HasSubstr("standard input is to be read twice"));
  const RunResult alone = run_gnomon({"certify", scene_, "--misses", "3"});
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.err, HasSubstr("--misses is of samples alone"));
}

TEST_F(Samples, MutatedFilesAreErrorsOrVerdicts) {
  const std::string text =
      "light,x,y,z,visible,polygon\r\nlamp,0.5,-1e-3,0,0,floor\r\n\"panel\",0.25,0,0,0.63,"
      "square\r\n";
  const std::string bytes = ",\"\n#-e.9\xff";
  std::uint64_t state = 1;
  for (int i = 0; i < 120; ++i) {
    std::string mutated = text;
    for (int k = 0; k < 2; ++k) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const std::size_t at = (state >> 33) % mutated.size();
      const char byte = bytes[(state >> 20) % bytes.size()];
      if (state >> 63 != 0) {
        mutated[at] = byte;
      } else if ((state >> 62 & 1) != 0) {
        mutated.erase(at, 1);
      } else {
        mutated.insert(at, 1, byte);
      }
    }
    write_text(file_, mutated);
    const RunResult run = run_gnomon({"certify", scene_, "--samples", file_});
    EXPECT_THAT(run.status, testing::AnyOf(0, 1, 2)) << mutated << run.err;
    if (run.status == 2) {
      EXPECT_THAT(run.err, HasSubstr("rays.csv:")) << mutated;
    }
  }
}

TEST_F(Samples, InterruptedTellsWhatWasJudged) {
  const std::string city = directory_.file("city.json");
  ASSERT_EQ(
      run_gnomon({"generate", "city", "--param", "n=60", "--param", "area=1", "-o", city}).status,
      0);
  std::string rows = "light,x,y,z,visible\n";
  for (int i = 0; i < 60000; ++i) {
    rows += "panel," + std::to_string(i % 190) + '.' + std::to_string(i % 97) + ',' +
            std::to_string(i % 187) + ",0,0.5\n";
  }
  write_text(file_, rows);
  RunOptions options;
  options.signal = SIGINT;
  options.signal_after = 0.7;
  const RunResult run =
      run_gnomon({"certify", city, "--samples", file_, "--tolerance", "1", "-j", "1"}, options);
  EXPECT_EQ(run.status, 130) << run.out << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("interrupted"), HasSubstr("of 60,000 samples were judged.")));
}

}  // namespace
}  // namespace gnomon::test
