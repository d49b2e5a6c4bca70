// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/certify_report.h"

#include <algorithm>
#include <system_error>

#include "cli/common/interrupt.h"
#include "cli/common/output.h"
#include "gnomon/algorithms/painters_order.h"
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

std::string file_name_part(std::string name) {
  std::ranges::replace_if(
      name,
      [](char c) {
        return (c < '0' || c > '9') && (c < 'a' || c > 'z') && (c < 'A' || c > 'Z') && c != '+' &&
               c != '-' && c != '.' && c != '_';
      },
      '_');
  return name;
}

class Pictures {
 public:
  Pictures(const std::filesystem::path& directory, const LoadedScene& loaded)
      : directory_(directory), loaded_(loaded) {
    options_.camera = report::default_camera(loaded.prepared);
    options_.width = 640;
    options_.height = 520;
    pieces_ = back_to_front(loaded.prepared, options_.camera.eye);
  }

  Expected<void> write(const std::string& file, const Claims& exact, const report::JudgedRun& run,
                       const Claims& candidate) {
    const oracle::Report& report = *run.report;
    const std::string light = light_to_show(report);
    const ClaimedLight* truth = find_light(exact, light);
    if (truth == nullptr) return {};
    std::vector<report::Panel> panels;
    const std::uint32_t index = light_index(light);
    panels.push_back({index, "exact answer", truth, nullptr, {}});
    const ClaimedLight* shown = find_light(candidate, light);
    if (shown != nullptr && !shown->shares_alone) {
      panels.push_back({index, run.name + ": " + name_of(report.verdict), shown, truth,
                        worst_places(report, light)});
    }
    return write_panels(file, light, panels);
  }

  Expected<void> write_exact(const std::string& file, const Claims& exact) {
    if (exact.lights.empty()) return {};
    const std::string& light = exact.lights.front().id;
    return write_panels(file, light,
                        {{light_index(light), "exact answer", &exact.lights.front(), nullptr, {}}});
  }

 private:
  Expected<void> write_panels(const std::string& file, const std::string& light,
                              const std::vector<report::Panel>& panels) {
    options_.title = loaded_.scene.name + ", light " + light;
    auto output = Output::open(directory_ / file);
    if (!output) return tl::unexpected(output.error());
    report::paint_scene(loaded_.scene, loaded_.prepared, pieces_, panels, options_).write(*output);
    return output->finish();
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

  const std::filesystem::path& directory_;
  const LoadedScene& loaded_;
  report::PictureOptions options_;
  std::vector<OrderedPiece> pieces_;
};

}  // namespace

Expected<Claims> exact_fragments(const LoadedScene& loaded, const AlgorithmChoice& algorithm) {
  ShadowOptions options;
  algorithm.apply(options.method);
  options.lights = loaded.lights;
  options.output.points = true;
  options.control.interrupted = &interrupted();
  const auto result = compute_shadows(loaded.prepared, options);
  if (!result) return tl::unexpected(result.error());
  return report::claims_of(loaded.scene, loaded.prepared, *result, "exact", false);
}

Expected<void> write_certificate_report(const std::filesystem::path& directory,
                                        const LoadedScene& loaded,
                                        const report::Certificate& certificate,
                                        const std::vector<Claims>& candidates, bool times) {
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  if (failed) {
    ErrorPlace where;
    where.file = directory.string();
    return fail(ErrorCode::kFile, "cannot make the directory: " + failed.message(), {}, where);
  }
  if (auto done = write_output(directory / "table.txt", report::certificate_text(certificate));
      !done) {
    return done;
  }
  auto json = Output::open(directory / "verdict.json");
  if (!json) return tl::unexpected(json.error());
  report::write_certificate_json(*json, certificate, times);
  if (auto done = json->finish(); !done) return done;
  if (certificate.interrupted) return {};

  const auto exact = exact_fragments(loaded);
  if (!exact) return tl::unexpected(exact.error());
  Pictures pictures(directory, loaded);
  // The run that is furthest off gives the main picture.
  const report::JudgedRun* worst = nullptr;
  const Claims* worst_candidate = nullptr;
  std::size_t next = 0;
  for (const report::JudgedRun& run : certificate.runs) {
    if (!run.report) continue;
    const Claims& candidate = candidates[next++];
    if (run.report->verdict == oracle::Verdict::kIdentical) continue;
    if (run.report->verdict == oracle::Verdict::kFailed) {
      const auto done =
          pictures.write("scene-" + file_name_part(run.name) + ".svg", *exact, run, candidate);
      if (!done) return done;
    }
    const auto off = [](const report::JudgedRun& judged) {
      return judged.report->totals.misclassified.upper + judged.report->totals.uncovered.upper;
    };
    if (worst == nullptr || off(run) > off(*worst)) {
      worst = &run;
      worst_candidate = &candidate;
    }
  }
  if (worst == nullptr) return pictures.write_exact("scene.svg", *exact);
  return pictures.write("scene.svg", *exact, *worst, *worst_candidate);
}

}  // namespace gnomon::cli
