// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/check.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "fuzz/check/border_check.h"
#include "fuzz/check/cause.h"
#include "fuzz/check/judged_scene.h"
#include "fuzz/check/pictures.h"
#include "fuzz/mistakes/compute.h"
#include "fuzz/moves/metamorphic.h"
#include "fuzz/process/command.h"
#include "fuzz/process/order_to_end.h"
#include "gnomon/oracle/prepared_check.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/oracle/witness_check.h"
#include "gnomon/result/read_claims.h"
#include "gnomon/scene/digest.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/rational_text.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "report/json/result_json.h"
#include "scene/base/text_hash.h"

namespace gnomon::fuzz {

namespace {

bool same_light(const Light& a, const Light& b) {
  return a.id == b.id && a.type == b.type && a.position == b.position && a.loop == b.loop &&
         a.intensity == b.intensity;
}

std::string scene_difference(const Scene& a, const Scene& b) {
  if (a.numbers != b.numbers) return "the meaning of numbers";
  if (a.vertices != b.vertices) return "vertices";
  if (a.polygons.size() != b.polygons.size()) return "the number of polygons";
  for (std::size_t i = 0; i < a.polygons.size(); ++i) {
    const Polygon &p = a.polygons[i], &q = b.polygons[i];
    if (p.id != q.id || p.loop != q.loop || p.holes != q.holes || p.casts != q.casts ||
        a.is_two_sided(p) != b.is_two_sided(q)) {
      return "polygon " + p.id;
    }
  }
  if (a.lights.size() != b.lights.size()) return "the number of lights";
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    if (!same_light(a.lights[i], b.lights[i])) return "light " + a.lights[i].id;
  }
  return {};
}

std::string fragment_difference(const ClaimedPolygon& a, const ClaimedPolygon& b) {
  if (a.lit_fraction != b.lit_fraction || a.penumbra_fraction != b.penumbra_fraction ||
      a.umbra_fraction != b.umbra_fraction) {
    return "fractions";
  }
  if (a.fragments.size() != b.fragments.size()) return "the number of fragments";
  for (std::size_t i = 0; i < a.fragments.size(); ++i) {
    const ClaimedFragment &f = a.fragments[i], &g = b.fragments[i];
    if (f.state != g.state || f.caster != g.caster || f.casters != g.casters || f.loop != g.loop) {
      return "fragment " + std::to_string(i);
    }
  }
  return {};
}

/// A scene's file for a foreign program, gone with this object.
class TemporaryScene {
 public:
  explicit TemporaryScene(const std::string& text) {
    std::string name = (std::filesystem::temp_directory_path() / "gnomon-XXXXXX.json").string();
    const int descriptor = ::mkstemps(name.data(), 5);
    if (descriptor < 0) throw std::runtime_error("no temporary file: " + name);
    path_ = std::move(name);
    std::FILE* file = ::fdopen(descriptor, "wb");
    const bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if (std::fclose(file) != 0 || !whole) {
      std::filesystem::remove(path_);
      throw std::runtime_error("cannot write " + path_);
    }
  }
  TemporaryScene(const TemporaryScene&) = delete;
  TemporaryScene& operator=(const TemporaryScene&) = delete;
  ~TemporaryScene() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

class SceneCheck {
 public:
  SceneCheck(const Scene& scene, const CheckOptions& options) : scene_(scene), options_(options) {}

  CaseReport run() {
    report_.polygons = static_cast<std::uint32_t>(scene_.polygons.size());
    report_.lights = static_cast<std::uint32_t>(scene_.lights.size());
    report_.area_lights = static_cast<std::uint64_t>(
        std::ranges::count_if(scene_.lights, [](const Light& light) { return light.has_area(); }));
    guarded("prepare", "preparation", [&] { check_preparation(); });
    if (!prepared_ || scene_.lights.empty()) return std::move(report_);
    judged_.emplace(scene_, *prepared_);
    for (const Subject& subject : options_.subjects) {
      const std::string name = name_of(subject);
      report_.subjects.push_back(name);
      guarded(name, "subject " + name, [&] { check_subject(subject, name); });
    }
    if (first_exact_ != nullptr && wanted(Property::kMetamorphic)) {
      const std::string name = name_of(*first_exact_);
      guarded(name, "relation", [&] { check_a_relation(name); });
    }
    return std::move(report_);
  }

 private:
  template <class Step>
  void guarded(const std::string& subject, const std::string& stage, const Step& step) {
    tell(stage);
    const std::optional<Thrown> thrown = thrown_by(step);
    if (!thrown) return;
    if (thrown->out_of_memory) {
      add({Property::kBudget, subject, "memory", {}, {}, stage + ": out of memory"});
    } else {
      add({Property::kCrash, subject, "exception", {}, {}, stage + ": " + thrown->what});
    }
  }

  void tell(std::string_view stage) const {
    if (options_.stage) options_.stage(stage);
  }
  bool is_left_out(Property property) const {
    return property == Property::kClaims || property == Property::kRoundTrip ||
           property == Property::kWritten || property == Property::kBorders ||
           property == Property::kTogether ||
           (property == Property::kMetamorphic && (options_.seed >> 48) % 2 != 0);
  }
  bool wanted(Property property) const {
    if (options_.properties.empty()) return !(options_.brief && is_left_out(property));
    // Of those that somebody named, only the relation is left to every other scene.
    if (options_.brief && property == Property::kMetamorphic && is_left_out(property)) return false;
    return std::ranges::find(options_.properties, property) != options_.properties.end();
  }
  void add(Failure failure) {
    if (failure.property == Property::kCrash || wanted(failure.property)) {
      report_.failures.push_back(std::move(failure));
    }
  }
  void add_error(const Error& error, const std::string& subject) {
    const bool limit = error.code == ErrorCode::kLimit;
    add({limit ? Property::kBudget : Property::kRefusal,
         subject,
         limit ? "fragments" : "refused",
         {},
         {},
         to_string(error)});
  }

  void check_preparation() {
    if (wanted(Property::kRoundTrip)) check_scene_text();
    Expected<PreparedScene> prepared = prepare(scene_);
    if (!prepared) return add_error(prepared.error(), "prepare");
    prepared_ = std::move(*prepared);
    if (!wanted(Property::kPreparation)) return;
    for (const oracle::PreparedFinding& finding : oracle::check_prepared(scene_, *prepared_, 1)) {
      add({Property::kPreparation, "prepare", "wrong part", {}, finding.polygon, finding.text});
    }
  }

  void check_scene_text() {
    const Expected<WrittenScene> written = scene_to_text(scene_, SceneFormat::kJson);
    // A scene made by rule may hold numbers that a file of doubles cannot.
    if (!written) return;
    const Expected<ReadResult> read = parse_scene(written->text, "scene.json");
    if (!read) {
      const bool limit = read.error().code == ErrorCode::kLimit;
      add({limit ? Property::kBudget : Property::kRoundTrip,
           "scene",
           limit ? "memory" : "refused",
           {},
           {},
           to_string(read.error())});
      return;
    }
    const std::string difference = scene_difference(scene_, read->scene);
    if (!difference.empty()) {
      add({Property::kRoundTrip, "scene", "changed", {}, {}, difference + " read back otherwise"});
    }
  }

  void check_subject(const Subject& subject, const std::string& name) {
    if (subject.foreign()) return check_foreign(subject, name);
    if (makes_pictures(subject)) return check_pictures(subject, name);
    ShadowOptions options = shadow_options(subject);
    options.limits.fragments = options_.max_fragments;
    options.output.points = subject.exact() && wanted(Property::kWritten);
    Expected<ShadowResult> result = compute_shadows(*prepared_, options, subject.mistake);
    if (!result) return add_error(result.error(), name);
    if (report_.fragments == 0) {
      for (const LightResult& light : result->lights) report_.fragments += light.fragment_total;
    }
    const bool is_first = subject.exact() && first_exact_ == nullptr;
    const bool fragments = method_info(subject.algorithm).makes_fragments &&
                           method_info(subject.area_algorithm).makes_fragments;
    if (!fragments && subject.exact()) check_bounds(*result, options, name, subject.mistake);
    if (is_first) {
      first_exact_ = &subject;
      digest(*result);
    } else if (subject.exact() && wanted(Property::kAgreement)) {
      compare_with_first(*result, name);
      if (options_.brief) return;
    }
    Classified classified = judged_->claim(std::move(*result), options, name);
    judge(subject, classified.claims, name);
    if (!subject.kernel.exact() && subject.mistake == Mistake::kNone &&
        wanted(Property::kMetamorphic)) {
      check_written_otherwise(options, name);
    }
    // A file without fragments is no result that could be read back.
    if (is_first && fragments && wanted(Property::kRoundTrip)) check_result_text(classified, name);
    if (subject.exact() && fragments && wanted(Property::kWritten)) {
      check_written_doubles(classified, name);
    }
    if (!subject.exact() && fragments && wanted(Property::kBorders)) {
      check_borders(classified, name);
    }
    if (wanted(Property::kTogether) && combines(subject, scene_)) {
      check_together(subject, std::move(options), name);
    }
    if (is_first) first_ = std::move(classified.result);
  }

  /// All lights at once, judged one after another (Claims::combined).
  void check_together(const Subject& subject, ShadowOptions options, const std::string& name) {
    tell("lights together by " + name);
    options.output.combined = true;
    Expected<ShadowResult> result = compute_shadows(*prepared_, options, subject.mistake);
    // More fragments than each light has alone are no finding.
    if (!result && result.error().code == ErrorCode::kLimit) return;
    if (!result) return add_error(result.error(), name);
    Classified classified = judged_->claim(std::move(*result), options, name);
    classified.claims.lights.clear();  // by themselves they have been judged
    if (!classified.claims.combined) classified.claims.combined.emplace();
    judge_regions(subject, classified.claims, name, Property::kTogether);
  }

  void check_pictures(const Subject& subject, const std::string& name) {
    if (!wanted(Property::kOracle)) return;
    const auto wrong = wrong_picture(scene_, *prepared_, subject, subject.mistake);
    if (!wrong) return add_error(wrong.error(), name);
    if (!*wrong) return;
    const oracle::WrongSample worst = (*wrong)->report.worst.value_or(oracle::WrongSample{});
    const std::string light = worst.light ? scene_.lights[*worst.light].id : "";
    const std::string polygon =
        worst.seen == PixelClaims::kNothing ? "" : scene_.polygons[worst.seen].id;
    add({Property::kOracle, name, (*wrong)->disagreement(), light, polygon,
         (*wrong)->text(scene_)});
  }

  /// A method without fragments finds bounds of shares in other numbers than exact shares: they
  /// must hold these, and be 1 or 0 where these are, and nowhere else.
  void check_bounds(const ShadowResult& exact, ShadowOptions options, const std::string& name,
                    Mistake mistake) {
    options.output.exact_fractions = options.output.exact_points = false;
    const Expected<ShadowResult> result = compute_shadows(*prepared_, options, mistake);
    if (!result) return add_error(result.error(), name);
    for (std::size_t l = 0; l < exact.lights.size(); ++l) {
      const LightResult& light = exact.lights[l];
      if (method_info(light.method).makes_fragments) continue;
      for (std::size_t i = 0; i < light.parts.size(); ++i) {
        const ExactFractions& own = light.exact_fractions[i];
        const LightResult& found = result->lights[l];
        if (!check_share(light, i, name, "lit", own.lit, found.parts[i].lit)) return;
        if (found.area_fractions.empty()) continue;
        const AreaFractions& area = found.area_fractions[i];
        if (!check_share(light, i, name, "penumbra", own.penumbra, area.penumbra) ||
            !check_share(light, i, name, "umbra", own.umbra, area.umbra)) {
          return;
        }
      }
    }
  }
  bool check_share(const LightResult& light, std::size_t side, const std::string& name,
                   const char* state, const mpq_class& exact, const Interval& bounds) {
    const bool holds = mpq_class(bounds.lower) <= exact && exact <= mpq_class(bounds.upper);
    const bool classes = (bounds.lower == 1) == (exact == 1) && (bounds.upper == 0) == (exact == 0);
    if (holds && classes) return true;
    add({Property::kOracle, name, holds ? "class" : "bounds",
         scene_.lights[prepared_->lights[light.light].light].id,
         scene_.polygons[prepared_->parts[light.parts[side].part].polygon].id,
         fmt::format("{} {} found in [{:.17g}, {:.17g}]", state, text_for_people(exact),
                     bounds.lower, bounds.upper)});
    return false;
  }

  /// By somebody else, which says nothing of the program: the signal that ends a job comes once.
  static bool was_told_to_end(const CommandResult& result) {
    return result.end == CommandEnd::kSignal && is_order_to_end(result.status);
  }

  void check_foreign(const Subject& subject, const std::string& name) {
    const Expected<WrittenScene> written = scene_to_text(scene_, SceneFormat::kJson);
    if (!written) return;
    const TemporaryScene file(written->text);
    CommandOptions options;
    options.arguments = {file.path()};
    options.seconds = options_.command_seconds;
    options.megabytes = options_.command_megabytes;
    Expected<CommandResult> result = run_command(subject.command, options);
    constexpr int kMostOrders = 3;
    for (int i = 0; i < kMostOrders && result && was_told_to_end(*result); ++i) {
      result = run_command(subject.command, options);
    }
    if (!result) return add_error(result.error(), name);
    const auto ended = [&](Property property, std::string disagreement) {
      add({property, name, std::move(disagreement), {}, {}, how_it_ended(*result)});
    };
    switch (result->end) {
      case CommandEnd::kExited:
        break;
      case CommandEnd::kSignal:
        return ended(Property::kCrash, fmt::format("signal {}", result->status));
      case CommandEnd::kTimeout:
        return ended(Property::kBudget, "time");
      case CommandEnd::kTooLong:
        return ended(Property::kBudget, "output");
      case CommandEnd::kNotFound:
        return ended(Property::kCrash, "not started");
    }
    // As our own program says that a scene is beyond a limit of its own: there is nothing to judge.
    constexpr int kDeclined = 3;
    if (result->status == kDeclined) {
      report_.subjects.back() += " (declined)";
      return;
    }
    if (result->status != 0) {
      return ended(Property::kRefusal, fmt::format("status {}", result->status));
    }
    const Expected<Claims> candidate =
        parse_claims(result->out, "result", scene_, SharesAlone::kTaken);
    if (!candidate) {
      return add({Property::kRoundTrip, name, "unreadable", {}, {}, to_string(candidate.error())});
    }
    judge(subject, *candidate, name);
  }

  /// By the oracle's exact regions. None if it did not judge.
  std::optional<oracle::ComparisonTotals> judge_regions(const Subject& subject,
                                                        const Claims& candidate,
                                                        const std::string& name,
                                                        Property property) {
    const bool must_be_exact = subject.exact() || options_.strict;
    tell("oracle on " + name);
    oracle::CertifyOptions options;
    options.tolerance = options_.tolerance;
    options.share_tolerance = options_.share_tolerance;
    options.width = options_.width;
    options.strict = must_be_exact;
    options.most_regions = 4;
    const Expected<oracle::Report> report = judged_->judge(candidate, options);
    if (!report) {
      add_error(report.error(), name);
      return std::nullopt;
    }
    if (report->oracle_fault) {
      add({Property::kSelf, name, "contradiction", {}, {}, report->reason});
    }
    const bool wrong = must_be_exact && report->told_shares == 0
                           ? report->verdict != oracle::Verdict::kIdentical
                           : report->verdict == oracle::Verdict::kFailed;
    if (wrong) add_verdict(*report, name, property);
    return report->totals;
  }

  void judge(const Subject& subject, const Claims& candidate, const std::string& name) {
    const bool must_be_exact = subject.exact() || options_.strict;
    // How grave a false claim of a rounded result is, only the oracle can tell.
    const bool claims = !subject.foreign() && wanted(Property::kClaims);
    double share = 0, width = 0;
    if (wanted(Property::kOracle) || wanted(Property::kSelf) || (claims && !must_be_exact)) {
      const auto totals = judge_regions(subject, candidate, name, Property::kOracle);
      if (!totals) return;
      share = worst_share(*totals);
      width = totals->width.upper;
    }
    // Foreign results need not name casters, and have no claims then.
    if (!claims) return;
    ++report_.claims_checked;
    tell("claims of " + name);
    oracle::WitnessOptions options;
    options.tolerance = must_be_exact ? 0 : options_.tolerance;
    options.width = must_be_exact ? std::optional(0.0) : options_.width;
    options.strict = must_be_exact;
    options.most = 1;
    const oracle::WitnessReport checked =
        oracle::check_witnesses(scene_, *prepared_, candidate, options);
    for (const oracle::WitnessFinding& finding : checked.findings) {
      add({Property::kClaims, name, "false claim", finding.light, finding.polygon, finding.text,
           width, share, cause_of(scene_, *prepared_, finding.light, finding.polygon, {})});
    }
  }

  static double worst_share(const oracle::ComparisonTotals& totals) {
    return std::max({totals.worst_misclassified, totals.worst_uncovered, totals.worst_overlapping,
                     totals.worst_outside});
  }

  void add_verdict(const oracle::Report& report, const std::string& name, Property property) {
    Failure failure{property, name, "missing", {}, {}, report.reason};
    const oracle::ComparisonTotals& totals = report.totals;
    if (report.problems.empty()) failure.disagreement = "off-plane";
    if (report.worst && report.worst->kind != oracle::ErrorKind::kNone) {
      failure.disagreement = name_of(report.worst->kind);
      failure.light = report.worst->light;
      failure.polygon = report.worst->polygon;
      const std::string& place = report.worst->text;
      if (!place.empty() && place != report.reason) failure.text += "; " + place;
      failure.cause =
          cause_of(scene_, *prepared_, failure.light, failure.polygon, report.worst->caster);
    }
    for (const std::string& problem : report.problems) failure.text += "; " + problem;
    failure.width = totals.width.upper;
    failure.share = worst_share(totals);
    add(std::move(failure));
  }

  /// Over the texts of all exact fractions: equal answers have equal digests.
  void digest(const ShadowResult& result) {
    TextHash sum;
    const auto add = [&](const mpq_class& fraction) {
      constexpr unsigned char kEnd = 0xff;
      sum.add(fraction.get_str());
      sum.add(kEnd);
    };
    for (const LightResult& light : result.lights) {
      for (const ExactFractions& part : light.exact_fractions) {
        add(part.lit);
        add(part.shadow);
        if (light.area_fractions.empty()) continue;
        add(part.penumbra);
        add(part.umbra);
      }
    }
    report_.digest = fmt::format("{:016x}", sum.value());
  }

  void compare_with_first(const ShadowResult& result, const std::string& name) {
    const auto disagree = [&](std::string text, const LightResult* light = nullptr,
                              const PartResult* part = nullptr) {
      Failure failure{Property::kAgreement, name, "fractions", {}, {}, std::move(text)};
      if (light != nullptr) failure.light = scene_.lights[prepared_->lights[light->light].light].id;
      if (part != nullptr) {
        failure.polygon = scene_.polygons[prepared_->parts[part->part].polygon].id;
      }
      failure.text = name + " against " + name_of(*first_exact_) + ": " + failure.text;
      add(std::move(failure));
    };
    if (result.lights.size() != first_.lights.size()) return disagree("other lights");
    for (std::size_t l = 0; l < result.lights.size(); ++l) {
      const LightResult &one = first_.lights[l], &two = result.lights[l];
      if (one.parts.size() != two.parts.size()) return disagree("other sides are listed", &one);
      for (std::size_t i = 0; i < one.parts.size(); ++i) {
        const PartResult &p = one.parts[i], &q = two.parts[i];
        if (p.part != q.part || p.side != q.side || p.reason != q.reason) {
          return disagree("other sides, or for another reason", &one, &p);
        }
        const ExactFractions &a = one.exact_fractions[i], &b = two.exact_fractions[i];
        if (a.lit != b.lit || a.shadow != b.shadow) {
          return disagree(
              fmt::format("lit {} and {}", text_for_people(b.lit), text_for_people(a.lit)), &one,
              &p);
        }
        if (a.penumbra != b.penumbra || a.umbra != b.umbra) {
          return disagree(fmt::format("penumbra {} and {}", text_for_people(b.penumbra),
                                      text_for_people(a.penumbra)),
                          &one, &p);
        }
      }
    }
  }

  void check_result_text(const Classified& classified, const std::string& name) {
    const Claims& candidate = classified.claims;
    report::StringSink sink;
    report::ResultJsonOptions options;
    options.geometry_digest = "sha256:0";
    options.fragments = false;
    options.exact_fractions = options.exact_loops = true;
    options.sides = &classified.sides;
    report::write_result_json(sink, scene_, *prepared_, classified.result, options);
    const Expected<Claims> read = parse_claims(sink.text(), "result.json", scene_);
    const auto differ = [&](std::string text) {
      add({Property::kRoundTrip, name, "result", {}, {}, std::move(text)});
    };
    if (!read) return differ(to_string(read.error()));
    if (read->lights.size() != candidate.lights.size()) return differ("other lights read back");
    for (std::size_t l = 0; l < read->lights.size(); ++l) {
      const ClaimedLight &a = candidate.lights[l], &b = read->lights[l];
      if (a.polygons.size() != b.polygons.size()) return differ("other sides read back");
      for (std::size_t i = 0; i < a.polygons.size(); ++i) {
        const std::string difference = fragment_difference(a.polygons[i], b.polygons[i]);
        if (a.polygons[i].id == b.polygons[i].id && a.polygons[i].side == b.polygons[i].side &&
            difference.empty()) {
          continue;
        }
        return differ("light " + a.id + ", polygon " + a.polygons[i].id + ": " + difference +
                      " read back otherwise");
      }
    }
  }

  /// What a person does: a file of doubles, read by both judges, which excuse what rounding does to
  /// it and nothing else.
  void check_written_doubles(const Classified& classified, const std::string& name) {
    tell("doubles of " + name);
    report::StringSink sink;
    report::ResultJsonOptions options;
    options.geometry_digest = "sha256:0";
    options.fragments = options.exact_fractions = true;
    options.sides = &classified.sides;
    report::write_result_json(sink, scene_, *prepared_, classified.result, options);
    // Who made it is said before all that the judges read: most kernels write the same rest.
    const std::size_t rest = sink.text().find("\"dropped\"");
    std::string said = sink.text().substr(rest == std::string::npos ? 0 : rest);
    if (passed_texts_.contains(said)) return;
    const std::size_t failures = report_.failures.size();
    judge_written_doubles(sink.text(), name);
    if (report_.failures.size() == failures) passed_texts_.insert(std::move(said));
  }

  /// Passing is all that is asked: what rounding excuses has no need of widths, areas and places.
  void judge_written_doubles(const std::string& text, const std::string& name) {
    const Expected<Claims> read = parse_claims(text, "result.json", scene_);
    if (!read) {
      return add({Property::kWritten, name, "unreadable", {}, {}, to_string(read.error())});
    }
    oracle::CertifyOptions quick;
    quick.measure_rounding = false;
    quick.exact_limit = quick.most_regions = 0;
    Expected<oracle::Report> report = judged_->judge(*read, quick);
    if (report && report->verdict == oracle::Verdict::kFailed) report = judged_->judge(*read, {});
    if (!report) return add_error(report.error(), name);
    if (report->verdict == oracle::Verdict::kFailed) {
      Failure failure{Property::kWritten, name, "certify", {}, {}, report->reason};
      failure.text += "; " + report->excess;
      if (report->worst) {
        failure.light = report->worst->light;
        failure.polygon = report->worst->polygon;
      }
      failure.width = report->totals.width.upper;
      failure.share = worst_share(report->totals);
      add(std::move(failure));
    }
    oracle::WitnessOptions witness_options;
    witness_options.most = 1;
    const oracle::WitnessReport checked =
        oracle::check_witnesses(scene_, *prepared_, *read, witness_options);
    for (const oracle::WitnessFinding& finding : checked.findings) {
      add({Property::kWritten, name, "verify", finding.light, finding.polygon, finding.text});
    }
  }

  void check_borders(const Classified& classified, const std::string& name) {
    tell("borders of " + name);
    auto found = border_contradiction(*judged_, classified.claims, options_.seed);
    if (!found) return add_error(found.error(), name);
    if (!*found) return;
    BorderContradiction& differs = **found;
    add({Property::kBorders, name, std::move(differs.kind), std::move(differs.light),
         std::move(differs.polygon), std::move(differs.text)});
  }

  /// Of a rounded kernel, which owes nothing but to depend on the scene alone.
  void check_written_otherwise(const ShadowOptions& options, const std::string& name) {
    // Then the order of the file is asked for.
    if (options.method.options.order == InsertionOrder::kFile) return;
    const auto broken = fuzz::check_written_otherwise(scene_, *prepared_, options, options_.seed);
    if (!broken) return add_error(broken.error(), name);
    if (!*broken) return;
    add({Property::kMetamorphic, name, "written otherwise", (*broken)->light, {}, (*broken)->text});
  }

  void check_a_relation(const std::string& name) {
    ShadowOptions options = shadow_options(*first_exact_);
    options.limits.fragments = options_.max_fragments;
    // Seeds of a campaign are well mixed; those of people are 1, 2, 3.
    const std::size_t relation = options_.seed % relations().size();
    const RelationInfo& info = relations()[relation];
    const auto broken = check_relation(relation, scene_, *prepared_, options, options_.seed);
    if (!broken) {
      if (broken.error().code == ErrorCode::kLimit) return;
      add({Property::kMetamorphic, name, std::string(info.id), {}, {}, to_string(broken.error())});
    } else if (*broken) {
      add({Property::kMetamorphic, name, std::string(info.id), (*broken)->light, (*broken)->polygon,
           std::string(info.meaning) + ": " + (*broken)->text});
    }
  }

  const Scene& scene_;
  const CheckOptions& options_;
  CaseReport report_;
  std::optional<PreparedScene> prepared_;
  std::optional<JudgedScene> judged_;
  const Subject* first_exact_ = nullptr;
  ShadowResult first_;
  std::set<std::string> passed_texts_;  // of results written as doubles
};

}  // namespace

CaseReport check_scene(const Scene& scene, const CheckOptions& options) {
  return SceneCheck(scene, options).run();
}

std::vector<Subject> exact_subjects() {
  std::vector<Subject> subjects;
  for (const std::string_view name :
       {"plane", "plane/svbsp", "plane/contour", "plane/receiver/merged", "rational", "epeck"}) {
    subjects.push_back(*parse_subject(name));
  }
  return subjects;
}

}  // namespace gnomon::fuzz
