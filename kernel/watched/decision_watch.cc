// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/watched/decision_watch.h"

#include <cmath>

namespace gnomon {

thread_local DecisionWatch* DecisionWatch::current_ = nullptr;

std::string_view name_of(Predicate predicate) {
  static constexpr std::array<std::string_view, kPredicateCount> kNames = {
      "facing", "scene BSP", "shadow plane", "cut",         "depth",
      "border", "volume",    "support",      "three points"};
  return kNames[static_cast<std::size_t>(predicate)];
}

// Numbers of b bits are 2^(1 - b) of themselves apart.
double size_in_ulps(const Geometry& geometry, const ExactPlane<mpz_class>& plane,
                    const std::array<mpq_class, 3>& point, int digits) {
  mpq_class offset = geometry.step * plane.d, value, most;
  for (int k = 0; k < 3; ++k) offset += geometry.origin[k] * plane.n[k];
  for (int k = 0; k < 3; ++k) {
    const mpq_class term = point[k] * plane.n[k];
    value += term;
    if (abs(term) > most) most = abs(term);
  }
  value -= offset;
  if (abs(offset) > most) most = abs(offset);
  if (sgn(most) == 0) return 0;
  const mpq_class share = abs(value) / most;
  return std::ldexp(share.get_d(), digits - 1);
}

DifferingDecision* DecisionWatch::differ(Predicate predicate, std::uint64_t question, bool flipped,
                                         Side exact, Side tested) {
  if (predicate == Predicate::kSceneBsp && runs_ > 1) return nullptr;
  const auto [place, is_new] = by_question_.try_emplace(question, differing_.size());
  if (!is_new) {
    ++differing_[place->second].times;
    return nullptr;
  }
  if (only_first_) {
    if (!differing_.empty()) return nullptr;
    stop_ = true;
  }
  DifferingDecision& decision = differing_.emplace_back();
  decision.predicate = predicate;
  if (predicate != Predicate::kSceneBsp) decision.light = light_;
  decision.tested = tested;
  decision.exact = exact;
  decision.decisions = counted_ - 1;
  decision.times = 1;
  decision.question = question;
  decision.flip = flipped ? opposite(tested) : tested;
  return &decision;
}

}  // namespace gnomon
