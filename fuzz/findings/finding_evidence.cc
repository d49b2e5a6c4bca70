// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/findings/finding_evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "fuzz/check/judged_scene.h"
#include "fuzz/check/pictures.h"
#include "fuzz/corpus/corpus.h"
#include "fuzz/findings/finding_picture.h"
#include "fuzz/process/command.h"
#include "fuzz/shrink/still_fails.h"
#include "gnomon/algorithms/explain.h"
#include "gnomon/result/read_claims.h"

namespace gnomon::fuzz {

namespace {

const ClaimedLight* light_of(const Claims& candidate, const std::string& id) {
  const auto found = std::ranges::find(candidate.lights, id, &ClaimedLight::id);
  return found == candidate.lights.end() ? nullptr : &*found;
}

class EvidenceSearch {
 public:
  EvidenceSearch(const Finding& finding, const Scene& scene, const std::filesystem::path& file)
      : finding_(finding), scene_(scene), file_(file) {
    evidence_.failure = finding.failure;
    for (const Subject& subject : finding.check.subjects) {
      if (name_of(subject) == finding.failure.subject) subject_ = &subject;
    }
  }

  Evidence gather() {
    const Property property = finding_.failure.property;
    const bool too_much = property == Property::kCrash || property == Property::kBudget;
    // What took down a process must not take down this one.
    may_run_ = subject_ != nullptr && (subject_->foreign() || !too_much);
    if (may_run_ || (subject_ == nullptr && !too_much)) look_again();
    auto prepared = prepare(scene_);
    if (!prepared) {
      evidence_.no_candidate = "the scene cannot be prepared: " + to_string(prepared.error());
      evidence_.decision_note = "There is no run whose decisions could be compared.";
      evidence_.no_fixture = evidence_.no_candidate;
      return std::move(evidence_);
    }
    prepared_ = std::move(*prepared);
    judged_.emplace(scene_, prepared_);
    write_fixture();
    compute_exact();
    if (may_run_) {
      run_subject();
    } else if (subject_ == nullptr) {
      evidence_.no_candidate = "no kernel is at fault: " + finding_.failure.subject;
    } else {
      evidence_.no_candidate = fmt::format("{} gave no answer ({})", finding_.failure.subject,
                                           finding_.failure.disagreement);
    }
    if (candidate_) find_worst_place();
    choose_light();
    explain_decision();
    paint();
    return std::move(evidence_);
  }

 private:
  void look_again() {
    const CaseReport report = check_scene(finding_.scene, finding_.check);
    if (const Failure* failure = report.find(finding_.failure)) {
      evidence_.failure = *failure;
      evidence_.shown_again = true;
    }
  }

  void write_fixture() {
    FixtureNote note;
    note.shows = evidence_.failure.text;
    note.kind = "found";
    note.found = fmt::format(
        "{}, {}", finding_.failure.subject,
        finding_.generator.empty()
            ? std::string("a scene that was brought")
            : fmt::format("generator {}, seed {}", finding_.generator, finding_.case_seed));
    note.inform = subject_ != nullptr && !subject_->foreign() && !subject_->exact() &&
                  subject_->mistake == Mistake::kNone;
    if (note.inform) note.wrong = {finding_.failure.subject};
    const auto text = fixture_text(*judged_, note);
    if (text) {
      evidence_.fixture = *text;
    } else {
      evidence_.no_fixture = to_string(text.error());
    }
  }

  std::optional<Claims> run(const ShadowOptions& options, const std::string& name,
                            Mistake mistake = Mistake::kNone) {
    std::optional<Claims> claims;
    const auto thrown = thrown_by([&] {
      auto classified = judged_->classify(options, name, mistake);
      if (classified) {
        claims = std::move(classified->claims);
      } else {
        evidence_.no_candidate =
            fmt::format("{} gave no answer: {}", name, to_string(classified.error()));
      }
    });
    if (thrown) evidence_.no_candidate = fmt::format("{} gave no answer: {}", name, thrown->what);
    return claims;
  }

  void compute_exact() {
    // Where an exact kernel is at fault, another has to show what is right.
    const bool of_plane =
        subject_ != nullptr && subject_->exact() && subject_->kernel.kernel == KernelId::kPlane;
    Subject exact;
    exact.kernel.kernel = of_plane ? KernelId::kRational : KernelId::kPlane;
    ShadowOptions options = shadow_options(exact);
    options.output.exact_fractions = false;
    options.limits.fragments = finding_.check.max_fragments;
    exact_ = run(options, "exact");
    evidence_.no_candidate.clear();
  }

  void run_subject() {
    if (makes_pictures(*subject_)) {
      evidence_.no_candidate = "a method of pictures makes no fragments that could be shown";
      return;
    }
    if (!subject_->foreign()) {
      ShadowOptions options = shadow_options(*subject_);
      options.output.exact_fractions = false;
      options.limits.fragments = finding_.check.max_fragments;
      candidate_ = run(options, finding_.failure.subject, subject_->mistake);
      return;
    }
    CommandOptions options;
    options.arguments = {file_.string()};
    options.seconds = finding_.check.command_seconds;
    options.megabytes = finding_.check.command_megabytes;
    const auto result = run_command(subject_->command, options);
    if (!result || !result->succeeded()) {
      evidence_.no_candidate =
          fmt::format("the program gave no answer: {}",
                      result ? how_it_ended(*result) : to_string(result.error()));
      return;
    }
    evidence_.foreign_result = result->out;
    auto read = parse_claims(result->out, "result.json", scene_, SharesAlone::kTaken);
    if (read) {
      candidate_ = std::move(*read);
    } else {
      evidence_.no_candidate = "the answer cannot be read: " + to_string(read.error());
    }
  }

  void find_worst_place() {
    oracle::CertifyOptions options;
    options.tolerance = finding_.check.tolerance;
    options.share_tolerance = finding_.check.share_tolerance;
    options.width = finding_.check.width;
    options.strict = finding_.check.strict || subject_->exact();
    options.most_regions = 1;
    const auto report = judged_->judge(*candidate_, options);
    if (report && report->worst && report->worst->kind != oracle::ErrorKind::kNone) {
      evidence_.witness = report->worst;
    }
  }

  void choose_light() {
    std::string wanted = evidence_.failure.light;
    if (wanted.empty() && evidence_.witness) wanted = evidence_.witness->light;
    if (prepared_.lights.empty()) return;
    light_ = 0;
    for (std::uint32_t i = 0; i < prepared_.lights.size(); ++i) {
      if (scene_.lights[prepared_.lights[i].light].id == wanted) light_ = i;
    }
    evidence_.light = scene_.lights[prepared_.lights[light_].light].id;
  }

  void explain_decision() {
    std::string& note = evidence_.decision_note;
    if (subject_ == nullptr) {
      note = "There is no run whose decisions could be compared.";
      return;
    }
    if (subject_->foreign()) {
      note =
          "A foreign program makes its decisions unseen; the place below is where its answer is "
          "wrong.";
      return;
    }
    if (subject_->mistake != Mistake::kNone) {
      for (const MistakeInfo& info : mistakes()) {
        if (info.mistake != subject_->mistake) continue;
        note = fmt::format("This variant is wrong on purpose ({}): {}. {} warns of it.", info.name,
                           info.sentence, info.source);
      }
      if (subject_->kernel.exact()) return;
    }
    if (subject_->kernel.exact()) {
      note =
          "An exact kernel is at fault, or the oracle: a bug of ours, and no matter of rounding.";
      return;
    }
    if (!may_run_) {
      note = "The subject ended without an answer; its decisions are not run again here.";
      return;
    }
    if (prepared_.lights.empty()) return;
    ShadowOptions options = shadow_options(*subject_);
    options.output.exact_fractions = false;
    options.lights = {light_};
    const bool has_area = prepared_.lights[light_].has_area();
    const MethodId own = has_area ? subject_->area_algorithm : subject_->algorithm;
    const bool is_followed = method_info(own).explains;
    if (!is_followed) (has_area ? options.method.area : options.method.point) = followed(has_area);
    const auto found = explain(prepared_, options, {.flips = 0, .only_first = true});
    if (!found) {
      note = "The decisions could not be compared: " + to_string(found.error());
      return;
    }
    if (!found->first) {
      note =
          "Every decision of the run agrees with the exact one: what is wrong is where the kernel "
          "puts "
          "the vertices that it makes.";
    } else {
      std::vector<std::string> lights;
      for (const Light& light : scene_.lights) lights.push_back(light.id);
      evidence_.decision = to_sentence(*found->first, prepared_, subject_->kernel.name(), lights);
    }
    if (!is_followed) {
      note += fmt::format(
          "{}The answer that failed is that of `{}`; decisions are those of `{}` on the same "
          "kernel, which asks it for all of them.",
          note.empty() ? "" : " ", method_info(own).name, method_info(followed(has_area)).name);
    }
  }

  /// In place of a method whose decisions cannot be followed.
  static MethodId followed(bool has_area) {
    return has_area ? MethodId::kReceiver : MethodId::kSvbsp;
  }

  void paint() {
    if (evidence_.light.empty()) return;
    std::optional<oracle::Witness> place = evidence_.witness;
    if (place && place->light != evidence_.light) place.reset();
    const FindingPicture picture(scene_, light_, place);
    const ClaimedLight* exact = exact_ ? light_of(*exact_, evidence_.light) : nullptr;
    const ClaimedLight* own = candidate_ ? light_of(*candidate_, evidence_.light) : nullptr;
    if (exact != nullptr) evidence_.exact_svg = picture.paint("exact", *exact, nullptr);
    if (own != nullptr) {
      evidence_.candidate_svg = picture.paint(finding_.failure.subject, *own, exact);
    } else if (candidate_) {
      evidence_.no_candidate = "the answer leaves this light out";
    }
  }

  const Finding& finding_;
  const Scene& scene_;
  const std::filesystem::path& file_;
  const Subject* subject_ = nullptr;
  bool may_run_ = false;
  PreparedScene prepared_;
  std::optional<JudgedScene> judged_;
  std::uint32_t light_ = 0;
  std::optional<Claims> exact_, candidate_;
  Evidence evidence_;
};

}  // namespace

Evidence gather_evidence(const Finding& finding, const Scene& scene,
                         const std::filesystem::path& scene_file) {
  return EvidenceSearch(finding, scene, scene_file).gather();
}

}  // namespace gnomon::fuzz
