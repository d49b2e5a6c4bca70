// SPDX-License-Identifier: LGPL-3.0-or-later
// Who watches the decisions of a run: a run that records every question to which a rounded kernel
// has another answer than the exact one, or a run in which some questions have their other answer.
//
// A question is known by what was made from what: the vertices, edges and support planes behind a
// plane and a vertex, never by the moment at which it is asked. So it is the same question in every
// run on a scene, all of its askings are flipped together, and a flipped run may ask others in
// between.
#ifndef GNOMON_KERNEL_WATCHED_DECISION_WATCH_H
#define GNOMON_KERNEL_WATCHED_DECISION_WATCH_H

#include <gmpxx.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gnomon/kernel/differing_decision.h"
#include "gnomon/kernel/orientation.h"
#include "kernel/implicit/exact_geometry.h"
#include "kernel/watched/rounded_spaces.h"

namespace gnomon {

// --- Names as hashes of 64 bits: two questions of a run share one once in 2^64 / n^2 runs. ---

constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
  return hash ^ hash >> 29;
}
constexpr std::uint64_t hash_of(const PlaneName& name) {
  std::uint64_t hash = mixed(name.rest, static_cast<std::uint64_t>(name.kind));
  for (const std::uint32_t part : name.of) hash = mixed(hash, part);
  return hash;
}

/// An exact plane on the grid and a point in scene units: |n . x - d| in units of the last place of
/// the largest term, in numbers of `digits` bits.
double size_in_ulps(const Geometry& geometry, const ExactPlane<mpz_class>& plane,
                    const std::array<mpq_class, 3>& point, int digits);

class DecisionWatch {
 public:
  /// Questions, and their answers in the planes' own orientation.
  using Flips = std::unordered_map<std::uint64_t, Side>;
  using MakeRounded = std::unique_ptr<RoundedScene> (*)(const Geometry&, const KernelOptions&);

  /// Records. `only_first`: and stops at the first decision that differs.
  DecisionWatch(MakeRounded make_rounded, bool only_first)
      : make_rounded_(make_rounded), only_first_(only_first) {}
  /// Flips.
  explicit DecisionWatch(Flips flips) : flips_(std::move(flips)) {}

  /// The watch of the runs of this thread: spaces find it when they are made, since what a method
  /// hands on to them are the policies that a user may choose.
  class Scope {
   public:
    explicit Scope(DecisionWatch& watch) { current_ = &watch; }
    ~Scope() { current_ = nullptr; }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
  };
  static DecisionWatch& current() { return *current_; }

  /// A run of one light begins. Questions of the scene BSP, which has no light, count once.
  void begin_light(std::uint32_t light) {
    ++runs_;
    light_ = light;
  }
  /// The run ends (kInterrupted) when `outside` is set, after so many decisions, or at the first
  /// that differs if that is all that is wanted.
  void stop_with(const std::atomic<bool>* outside, std::uint64_t most_decisions) {
    outside_ = outside;
    most_decisions_ = most_decisions;
  }
  const std::atomic<bool>& stop() const { return stop_; }

  std::unique_ptr<RoundedScene> make_rounded(const Geometry& geometry,
                                             const KernelOptions& options) const {
    return make_rounded_ != nullptr ? make_rounded_(geometry, options) : nullptr;
  }
  bool flips() const { return flips_.has_value(); }
  bool is_flipped(std::uint64_t question) const { return flips_ && flips_->contains(question); }

  std::uint64_t question(Predicate predicate, std::uint64_t plane, std::uint64_t corner) const {
    const std::uint64_t place = predicate == Predicate::kSceneBsp ? 0 : light_ + 1;
    return mixed(mixed(mixed(place, static_cast<std::uint64_t>(predicate)), plane), corner);
  }
  /// The answer that the run goes on with. `flipped`: it is for the opposite of the plane.
  /// `describe` fills names, positions and size of a question whose answers differ.
  template <class Describe>
  Side settle(Predicate predicate, std::uint64_t question, bool flipped, Side exact,
              std::optional<Side> tested, const Describe& describe) {
    count(predicate);
    if (flips_) {
      const auto flip = flips_->find(question);
      if (flip == flips_->end()) return exact;
      return flipped ? opposite(flip->second) : flip->second;
    }
    if (tested && *tested != exact) {
      if (DifferingDecision* decision = differ(predicate, question, flipped, exact, *tested)) {
        describe(*decision);
      }
    }
    return exact;
  }

  std::uint64_t decisions() const { return decisions_; }
  const std::array<std::uint64_t, kPredicateCount>& asked() const { return asked_; }
  /// In the order in which they were first asked.
  const std::vector<DifferingDecision>& differing() const { return differing_; }

 private:
  void count(Predicate predicate) {
    constexpr std::uint64_t kBetweenLooks = 1024;
    ++decisions_;
    if (predicate != Predicate::kSceneBsp || runs_ <= 1) {
      ++asked_[static_cast<std::size_t>(predicate)];
      ++counted_;
    }
    if (decisions_ % kBetweenLooks == 0 && (decisions_ > most_decisions_ || is_stopped())) {
      stop_ = true;
    }
  }
  bool is_stopped() const { return outside_ != nullptr && outside_->load(); }
  /// The record of a question that differs here first; else null.
  DifferingDecision* differ(Predicate predicate, std::uint64_t question, bool flipped, Side exact,
                            Side tested);

  static thread_local DecisionWatch* current_;

  MakeRounded make_rounded_ = nullptr;
  bool only_first_ = false;
  std::optional<Flips> flips_;
  std::uint32_t light_ = 0, runs_ = 0;
  const std::atomic<bool>* outside_ = nullptr;
  std::uint64_t most_decisions_ = ~std::uint64_t{0};
  std::atomic<bool> stop_{false};
  std::uint64_t decisions_ = 0, counted_ = 0;
  std::array<std::uint64_t, kPredicateCount> asked_{};
  std::vector<DifferingDecision> differing_;
  std::unordered_map<std::uint64_t, std::size_t> by_question_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_WATCHED_DECISION_WATCH_H
