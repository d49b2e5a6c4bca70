// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/certify_report.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "cli/common/interrupt.h"
#include "gnomon/algorithms/painters_order.h"
#include "report/facts/scene_facts.h"
#include "report/json/result_json.h"
#include "report/page/scene_view.h"
#include "report/pictures/picture.h"
#include "report/sides/claims_of.h"

namespace gnomon::cli {

namespace {

const ClaimedLight* find_light(const Claims& candidate, const std::string& id) {
  const auto found = std::ranges::find(candidate.lights, id, &ClaimedLight::id);
  return found == candidate.lights.end() ? nullptr : &*found;
}

/// The widest region of error of every wrong polygon of one light, widest first.
std::vector<report::Mark> worst_places(const oracle::Report& report, const std::string& light) {
  constexpr std::size_t kMost = 3;
  std::vector<const oracle::Witness*> witnesses;
  for (const oracle::LightComparison& comparison : report.lights) {
    if (comparison.id != light) continue;
    for (const oracle::PolygonComparison& polygon : comparison.polygons) {
      if (!polygon.worst.empty()) witnesses.push_back(&polygon.worst.front().witness);
    }
  }
  std::ranges::stable_sort(witnesses, std::greater<>(),
                           [](const oracle::Witness* witness) { return witness->width.upper; });
  std::vector<report::Mark> marks;
  for (const oracle::Witness* witness : witnesses) {
    if (marks.size() == kMost) break;
    marks.push_back({witness->nearest, std::to_string(marks.size() + 1)});
  }
  return marks;
}

class Pictures {
 public:
  Pictures(const LoadedScene& loaded, Report& report) : loaded_(loaded), report_(report) {
    options_.camera = report::default_camera(loaded.prepared);
    options_.width = 640;
    options_.height = 520;
    pieces_ = back_to_front(loaded.prepared, options_.camera.eye);
  }

  void add(const std::string& file, const Claims& exact, const report::JudgedRun& run,
           const Claims& candidate) {
    const oracle::Report& report = *run.report;
    const std::string light = light_to_show(report);
    const ClaimedLight* truth = find_light(exact, light);
    if (truth == nullptr) return;
    std::vector<report::Panel> panels;
    const std::uint32_t index = light_index(light);
    panels.push_back({index, "exact answer", truth, nullptr, {}});
    const ClaimedLight* shown = find_light(candidate, light);
    if (shown != nullptr && !shown->shares_alone) {
      panels.push_back({index, run.name + ": " + name_of(report.verdict), shown, truth,
                        worst_places(report, light)});
    }
    add_panels(file, light, panels);
  }

  void add_exact(const std::string& file, const Claims& exact) {
    if (exact.lights.empty()) return;
    const std::string& light = exact.lights.front().id;
    add_panels(file, light,
               {{light_index(light), "exact answer", &exact.lights.front(), nullptr, {}}});
  }

 private:
  void add_panels(const std::string& file, const std::string& light,
                  const std::vector<report::Panel>& panels) {
    options_.title = loaded_.scene.name + ", light " + light;
    auto picture = std::make_shared<report::SvgPicture>(
        report::paint_scene(loaded_.scene, loaded_.prepared, pieces_, panels, options_));
    report_.files.push_back({file, [picture](report::TextSink& sink) { picture->write(sink); }});
  }

  std::uint32_t light_index(const std::string& id) const {
    std::uint32_t index = 0;
    while (loaded_.scene.lights[loaded_.prepared.lights[index].light].id != id) ++index;
    return index;
  }

  /// The light of the worst place, else the first.
  std::string light_to_show(const oracle::Report& report) const {
    if (report.worst && !report.worst->light.empty()) {
      for (const Light& light : loaded_.scene.lights) {
        if (light.id == report.worst->light) return light.id;
      }
    }
    return loaded_.scene.lights[loaded_.lights.front()].id;
  }

  const LoadedScene& loaded_;
  Report& report_;
  report::PictureOptions options_;
  std::vector<OrderedPiece> pieces_;
};

/// A picture of the run that is furthest off, and one of every run that failed.
void add_pictures(Report& report, const LoadedScene& loaded, const report::Certificate& certificate,
                  const std::vector<Claims>& candidates, const Claims& exact) {
  // A painter's order and its cuts grow with the square of the parts.
  constexpr std::size_t kMostPainted = 3000;
  if (loaded.prepared.parts.size() > kMostPainted) {
    report.notes.emplace_back("The scene has too many polygons for pictures as SVG.");
    return;
  }
  Pictures pictures(loaded, report);
  const report::JudgedRun* worst = nullptr;
  const Claims* worst_candidate = nullptr;
  std::size_t next = 0;
  for (const report::JudgedRun& run : certificate.runs) {
    if (!run.report) continue;
    const Claims& candidate = candidates[next++];
    if (run.report->verdict == oracle::Verdict::kIdentical) continue;
    if (run.report->verdict == oracle::Verdict::kFailed) {
      pictures.add("scene-" + file_name_part(run.name) + ".svg", exact, run, candidate);
    }
    const auto off = [](const report::JudgedRun& judged) {
      return judged.report->totals.misclassified.upper + judged.report->totals.uncovered.upper;
    };
    if (worst == nullptr || off(run) > off(*worst)) {
      worst = &run;
      worst_candidate = &candidate;
    }
  }
  if (worst == nullptr) {
    pictures.add_exact("scene.svg", exact);
  } else {
    pictures.add("scene.svg", exact, *worst, *worst_candidate);
  }
}

/// The exact answer first, then what is not identical to it, worst first: where the page has not
/// room for all, it has what matters.
std::vector<report::ViewLayer> view_layers(const report::Certificate& certificate,
                                           const std::vector<Claims>& candidates,
                                           const Claims& exact) {
  std::vector<report::ViewLayer> layers;
  for (const ClaimedLight& light : exact.lights) layers.push_back({"exact", &light});
  struct Shown {
    const report::JudgedRun* run;
    const Claims* candidate;
  };
  std::vector<Shown> shown;
  std::size_t next = 0;
  for (const report::JudgedRun& run : certificate.runs) {
    if (!run.report) continue;
    const Claims& candidate = candidates[next++];
    if (run.report->verdict != oracle::Verdict::kIdentical) shown.push_back({&run, &candidate});
  }
  std::ranges::stable_sort(shown, std::ranges::greater(), [](const Shown& each) {
    return each.run->report->totals.worst_share();
  });
  for (const auto& [run, candidate] : shown) {
    for (const ClaimedLight& light : candidate->lights) layers.push_back({run->name, &light});
  }
  return layers;
}

report::JUnitCase junit_case_of(const report::JudgedRun& run, const std::string& scene) {
  using report::JUnitOutcome;
  report::JUnitCase one{"certify." + scene, run.name, JUnitOutcome::kPassed, {}, {}};
  if (!run.report) {
    one.outcome = JUnitOutcome::kError;
    one.message = run.error;
  } else if (run.failed() || (run.exact && !run.report->confirms_exact())) {
    one.outcome = JUnitOutcome::kFailed;
    one.message = run.report->reason;
    if (run.report->worst) one.text = report::place_in_words(*run.report->worst);
  } else if (run.report->interrupted) {
    one.outcome = JUnitOutcome::kSkipped;
    one.message = "interrupted";
  }
  if (one.outcome != JUnitOutcome::kPassed && !run.counts) {
    one.message = "it does not count: " + one.message;
    one.outcome = JUnitOutcome::kSkipped;
  }
  return one;
}

}  // namespace

Expected<ShadowResult> exact_result(const LoadedScene& loaded, const AlgorithmChoice& algorithm) {
  ShadowOptions options;
  algorithm.apply(options.method);
  options.lights = loaded.lights;
  options.output.points = true;
  options.control.interrupted = &interrupted();
  return compute_shadows(loaded.prepared, options);
}

Expected<Claims> exact_fragments(const LoadedScene& loaded, const AlgorithmChoice& algorithm) {
  const auto result = exact_result(loaded, algorithm);
  if (!result) return tl::unexpected(result.error());
  return report::claims_of(loaded.scene, loaded.prepared, *result, "exact", false);
}

Expected<void> write_certificate_report(const ReportOptions& options, const LoadedScene& loaded,
                                        const report::Certificate& certificate,
                                        const std::vector<Claims>& candidates, bool times) {
  const auto json = [&](bool with_times) {
    return [&certificate, with_times](report::TextSink& sink) {
      report::write_certificate_json(sink, certificate, with_times);
    };
  };
  Report report;
  report.command = "certify";
  report.scene = loaded.scene.name;
  for (const report::JudgedRun& run : certificate.runs) {
    report.cases.push_back(junit_case_of(run, loaded.scene.name));
  }
  for (const std::string& finding : certificate.scene_findings) {
    report.cases.push_back({"certify." + loaded.scene.name,
                            "preparation",
                            report::JUnitOutcome::kFailed,
                            finding,
                            {}});
  }
  if (options.directory.empty()) return write_report(options, report);
  report.files = {
      {"table.txt", [&](report::TextSink& sink) { sink.write(certificate_text(certificate)); }},
      {"verdict.json", json(times)},
      {"verdicts.csv",
       [&](report::TextSink& sink) { sink.write(report::certificate_csv(certificate)); }}};
  report.documents = {{"certificate", json(true)}};
  if (certificate.interrupted) {
    report.notes.emplace_back("The run was interrupted: what was not reached is missing.");
    return write_report(options, report);
  }
  const auto result = exact_result(loaded);
  if (!result) return tl::unexpected(result.error());
  const Claims exact = report::claims_of(loaded.scene, loaded.prepared, *result, "exact", false);
  add_pictures(report, loaded, certificate, candidates, exact);
  const auto layers = view_layers(certificate, candidates, exact);
  const auto facts = report::scene_facts(loaded.scene, loaded.prepared);
  report.documents.push_back({"scene", [&](report::TextSink& sink) {
                                report::write_facts_json(sink, loaded.scene, loaded.prepared,
                                                         facts);
                              }});
  report.documents.push_back({"result", [&](report::TextSink& sink) {
                                report::ResultJsonOptions shares;
                                shares.geometry_digest = certificate.geometry_digest;
                                report::write_result_json(sink, loaded.scene, loaded.prepared,
                                                          *result, shares);
                              }});
  report.documents.push_back({"view", [&](report::TextSink& sink) {
                                report::write_scene_view(sink, loaded.scene, loaded.prepared,
                                                         layers);
                              }});
  return write_report(options, report);
}

}  // namespace gnomon::cli
