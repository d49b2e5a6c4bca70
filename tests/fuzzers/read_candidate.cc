// SPDX-License-Identifier: GPL-3.0-or-later
// A result file against a scene. Text that begins with a brace is read for a fixed scene of two
// polygons under a lamp and a panel; otherwise the first byte counts the bytes of a scene's code
// (gnomon/fuzz/scene_code.h) that follow, and then comes the file. What can be read is judged.
#include <array>
#include <memory>

#include "fuzz/generate/scene_code.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/oracle/witness_check.h"
#include "gnomon/result/read_claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "harness.h"

namespace {

using namespace gnomon;
using namespace gnomon::fuzzers;

constexpr const char* kScene = R"({"format": "gnomon-scene", "version": 1, "two_sided": true,
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[2,1,1],[2,2,1],[1,2,1]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "tile", "loop": [4,5,6,7]}],
  "lights": [{"id": "lamp", "type": "point", "position": [1,1,3]},
             {"id": "panel", "type": "area", "loop": [[1,1,3],[1,2,3],[2,2,3],[2,1,3]]}]})";

/// A scene with what the judges need; null if it cannot be prepared.
struct Judge {
  Scene scene;
  PreparedScene prepared;
};
std::unique_ptr<Judge> judge_of(Scene scene) {
  auto prepared = prepare(scene);
  if (!prepared) return nullptr;
  return std::make_unique<Judge>(Judge{std::move(scene), std::move(*prepared)});
}

const Judge& fixed_judge() {
  static const std::unique_ptr<Judge> kJudge =
      judge_of(parse_scene(kScene, "scene.json").value().scene);
  return *kJudge;
}

/// Small enough to be judged in no time.
bool is_small(const Claims& candidate) {
  std::size_t points = 0, bits = 0;
  for (const auto& light : candidate.lights) {
    for (const auto& polygon : light.polygons) {
      for (const auto& fragment : polygon.fragments) {
        points += fragment.loop.size();
        for (const auto& point : fragment.loop) {
          for (const mpq_class& x : point) {
            bits += mpz_sizeinbase(x.get_num_mpz_t(), 2) + mpz_sizeinbase(x.get_den_mpz_t(), 2);
          }
        }
      }
    }
  }
  return points <= 40 && bits <= 20'000;
}

void check_candidate(const Judge& judge, std::string_view text) {
  const auto candidate = parse_claims(text, "input.json", judge.scene);
  if (!candidate) {
    const Error& error = candidate.error();
    check_error(error, "input.json", text, error.code == ErrorCode::kSyntax);
    return;
  }
  if (!is_small(*candidate)) return;
  (void)oracle::check_witnesses(judge.scene, judge.prepared, *candidate);
  oracle::CertifyOptions options;
  options.threads = 1;
  options.clearance = 0.01;
  const auto report = oracle::certify(judge.scene, judge.prepared, *candidate, options);
  require(report.has_value(), "no report");
  require(!report->oracle_fault, "the oracle contradicts itself: " + report->reason);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  if (data[0] == '{' || data[0] == ' ' || data[0] == '\n') {
    check_candidate(fixed_judge(), text_of(data, size));
    return 0;
  }
  const std::size_t count = std::min<std::size_t>(data[0], size - 1);
  const auto judge =
      judge_of(fuzz::scene_from_code({data + 1, count}, {.vertices = 20, .polygons = 4}));
  if (judge) check_candidate(*judge, text_of(data + 1 + count, size - 1 - count));
  return 0;
}
