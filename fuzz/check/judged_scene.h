// SPDX-License-Identifier: GPL-3.0-or-later
// One scene with what every judge of a subject needs: the prepared parts, the oracle's exact answer
// and the scene's size; and the act itself, written once: a subject classifies the scene, its
// result becomes claims, the oracle judges them, and what any of that throws becomes a value.
#ifndef GNOMON_FUZZ_CHECK_JUDGED_SCENE_H
#define GNOMON_FUZZ_CHECK_JUDGED_SCENE_H

#include <exception>
#include <new>
#include <optional>
#include <string>

#include "fuzz/mistakes/mistake.h"
#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/oracle/exact_answer.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/sides/polygon_sides.h"

namespace gnomon::fuzz {

/// What a step threw.
struct Thrown {
  bool out_of_memory = false;
  std::string what;
};

/// Runs a step of a subject, of the oracle, or of both; what the step throws comes back as a value.
template <class Step>
std::optional<Thrown> thrown_by(const Step& step) {
  try {
    step();
  } catch (const std::bad_alloc& error) {
    return Thrown{true, error.what()};
  } catch (const std::exception& error) {
    return Thrown{false, error.what()};
  }
  return std::nullopt;
}

/// A result, the sides of its polygons, and what it claims of them. The sides point into the
/// result, so that both move together and are never copied.
struct Classified {
  ShadowResult result;
  report::SidesByLight sides;
  Claims claims;

  Classified() = default;
  Classified(Classified&&) = default;
  Classified& operator=(Classified&&) = default;
};

/// What the whole act came to: a refusal, or something classified that the oracle has judged, or
/// has refused to judge.
struct Judged {
  std::optional<Error> refused;  // by the subject: that of compute_shadows()
  std::optional<Classified> classified;
  std::optional<Error> unjudged;  // by the oracle: that of certify()
  std::optional<oracle::Report> report;
};

class JudgedScene {
 public:
  /// Keeps references to both.
  JudgedScene(const Scene& scene, const PreparedScene& prepared);
  JudgedScene(const JudgedScene&) = delete;
  JudgedScene& operator=(const JudgedScene&) = delete;

  const Scene& scene() const { return scene_; }
  const PreparedScene& prepared() const { return prepared_; }
  const oracle::ExactAnswer& answer() const { return answer_; }
  /// Of the box of all vertices of parts, scene units.
  double diagonal() const { return diagonal_; }

  /// The result as claims. Exact fractions are claimed if `options`, which the result was computed
  /// with, ask for them.
  Classified claim(ShadowResult result, const ShadowOptions& options, std::string name) const;
  /// With a mistake of the zoo if one is named. Errors: those of compute_shadows().
  Expected<Classified> classify(const ShadowOptions& options, std::string name,
                                Mistake mistake = Mistake::kNone) const;
  /// Claims against the exact answer, on one thread. Errors: those of certify().
  Expected<oracle::Report> judge(const Claims& claims, oracle::CertifyOptions options) const;
  Judged classify_and_judge(const ShadowOptions& options, std::string name,
                            const oracle::CertifyOptions& certify_options,
                            Mistake mistake = Mistake::kNone) const;

 private:
  const Scene& scene_;
  const PreparedScene& prepared_;
  oracle::ExactAnswer answer_;
  double diagonal_;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_JUDGED_SCENE_H
