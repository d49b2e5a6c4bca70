// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "comparison/samples/sample_verdict.h"
#include "gnomon/result/classes.h"
#include "gnomon/scene/rational_text.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::comparison {

namespace {

using oracle::JudgedSample;
using oracle::SampleOutcome;
using report::Align;
using report::grouped;
using report::rounded;
using report::TextTable;

std::string plural(std::uint64_t count, const std::string& one) {
  return grouped(count) + ' ' + one + (count == 1 ? "" : "s");
}

std::string line(const std::string& text) { return report::wrapped(text, TextTable::kWidth, 0, 2); }

std::string tolerance_text(const SampleVerdict& verdict) {
  std::string text = "width " + rounded(verdict.width, 3);
  if (verdict.clearance > 0) text += ", clearance " + rounded(verdict.clearance, 3);
  if (!verdict.has_area_lights) return text;
  text += "; shares of area lights: ";
  if (verdict.tolerance) return text + "within " + rounded(*verdict.tolerance, 3);
  if (verdict.decimals == 0) return text + "0 and 1 mean none and all of the light";
  return text + "half a unit of the last digit written, of up to " +
         plural(static_cast<std::uint64_t>(verdict.decimals), "decimal") +
         (verdict.doubles ? ", and 1e-9 since they are all of a double's" : "");
}

std::string places_text(const SampleVerdict& verdict) {
  const SamplePlaces& places = verdict.places;
  std::string text;
  if (places.moved == 0) {
    text = "every sample lies exactly on its polygon\n";
  } else {
    text =
        line(fmt::format("{} not exactly on the polygon and taken to its nearest point, the "
                         "farthest by {} (line {})",
                         places.moved == 1 ? "1 sample is" : grouped(places.moved) + " samples are",
                         rounded(places.farthest, 3), places.farthest_line));
  }
  if (places.found == 0) return text;
  return text +
         line(plural(places.found, "sample") + " without a polygon: the nearest was taken; " +
              (places.several == 0 ? "never was there more than one that faces the light"
                                   : plural(places.several, "sample") +
                                         " may belong to several that face the light"));
}

std::string found_text(const SampleMiss& miss) {
  return miss.row.sample.visible ? text_of(miss.row.visible)
                                 : report::shortest(miss.row.visible.value);
}

std::string cause_text(const SampleMiss& miss, const Scene& scene, const PreparedScene& prepared) {
  const JudgedSample& judged = miss.judged;
  std::string text;
  if (miss.cause.caster) {
    const std::string& caster = scene.polygons[prepared.parts[*miss.cause.caster].polygon].id;
    text = judged.touches      ? "; it touches " + caster
           : judged.truth == 1 ? "; the nearest shadow is that of " + caster
           : judged.truth == 0 ? "; hidden by " + caster
                               : "; most is hidden by " + caster;
  } else if (judged.truth == 1) {
    text = "; no caster is in between";
  } else if (judged.truth == 0) {
    text = "; no light comes to this side";
  }
  if (judged.from_border && *judged.from_border > 0 && std::isfinite(*judged.from_border)) {
    text += ", at least " + rounded(*judged.from_border, 3) + " from a border";
  }
  if (miss.cause.clearance) text += ", clearance " + rounded(*miss.cause.clearance, 3);
  if (judged.outcome == SampleOutcome::kNearBorder) text += "; within the width of a border";
  if (judged.outcome == SampleOutcome::kIllConditioned) text += "; ill-conditioned";
  if (judged.moved > 0) text += "; " + rounded(judged.moved, 3) + " off its polygon";
  return text;
}

std::string miss_text(const SampleMiss& miss, const Scene& scene, const PreparedScene& prepared) {
  const RationalPoint& point = miss.row.sample.point;
  std::string polygon = scene.polygons[miss.judged.polygon].id;
  if (miss.row.sample.side) polygon += std::string("#") + gnomon::name_of(*miss.row.sample.side);
  std::string text = fmt::format("line {}: {} at ({}, {}, {}) on {}: found {}, ", miss.row.line,
                                 scene.lights[miss.row.sample.light].id,
                                 rounded(point[0].get_d(), 9), rounded(point[1].get_d(), 9),
                                 rounded(point[2].get_d(), 9), polygon, found_text(miss));
  text += "true " + text_for_people(miss.judged.truth);
  if (miss.judged.out_of_range) text += "; no light shows such a share";
  return text + cause_text(miss, scene, prepared);
}

std::string verdict_row(const SampleVerdict& verdict, const Scene& scene,
                        const PreparedScene& prepared) {
  const bool ill = verdict.clearance > 0;
  std::vector<report::Column> columns{{"candidate"},
                                      {"verdict"},
                                      {"samples", Align::kRight},
                                      {"right", Align::kRight},
                                      {"wrong", Align::kRight},
                                      {"too light", Align::kRight},
                                      {"too dark", Align::kRight},
                                      {"near", Align::kRight},
                                      {"on border", Align::kRight},
                                      {"ambiguous", Align::kRight}};
  if (ill) columns.push_back({"ill-cond.", Align::kRight});
  TextTable table(std::move(columns));
  const char* word = verdict.interrupted ? "interrupted"
                     : verdict.failed()  ? "failed"
                                         : "samples agree";
  const SampleCounts& counts = verdict.counts;
  std::vector<std::string> cells{verdict.file,
                                 word,
                                 grouped(counts.all()),
                                 grouped(counts[SampleOutcome::kRight]),
                                 grouped(counts.wrong()),
                                 grouped(counts.too_light),
                                 grouped(counts.too_dark),
                                 grouped(counts[SampleOutcome::kNearBorder]),
                                 grouped(counts[SampleOutcome::kOnBorder]),
                                 grouped(counts[SampleOutcome::kAmbiguous])};
  if (ill) cells.push_back(grouped(counts[SampleOutcome::kIllConditioned]));
  table.add_row(std::move(cells));
  for (const SampleMiss& miss : verdict.misses) {
    table.add_note((&miss == verdict.misses.data() ? "worst: " : "") +
                   miss_text(miss, scene, prepared));
  }
  return table.to_string();
}

/// Those with wrong samples, most first.
std::string counts_text(const char* title, const std::vector<CountsOf>& all) {
  std::vector<const CountsOf*> wrong;
  for (const CountsOf& own : all) {
    if (own.counts.wrong() > 0) wrong.push_back(&own);
  }
  if (wrong.empty()) return {};
  std::ranges::stable_sort(wrong, std::greater<>(),
                           [](const CountsOf* own) { return own->counts.wrong(); });
  TextTable table({{title},
                   {"samples", Align::kRight},
                   {"wrong", Align::kRight},
                   {"too light", Align::kRight},
                   {"too dark", Align::kRight}});
  constexpr std::size_t kMost = 10;
  for (std::size_t i = 0; i < std::min(wrong.size(), kMost); ++i) {
    const SampleCounts& counts = wrong[i]->counts;
    table.add_row({wrong[i]->id, grouped(counts.all()), grouped(counts.wrong()),
                   grouped(counts.too_light), grouped(counts.too_dark)});
  }
  if (wrong.size() > kMost) {
    table.add_note("and " + plural(wrong.size() - kMost, title) + " more");
  }
  return '\n' + table.to_string();
}

std::string hint_text(const SampleVerdict& verdict) {
  constexpr std::uint64_t kRare = 10;
  if (verdict.far_dark * kRare <= verdict.counts.wrong()) return {};
  return line("hint: " + plural(verdict.far_dark, "sample") +
              (verdict.far_dark == 1 ? " was" : " were") +
              " seen dark far from every shadow: a ray that starts on a polygon may meet that "
              "polygon again, unless it starts a little off it");
}

}  // namespace

std::string sample_verdict_text(const SampleVerdict& verdict, const Scene& scene,
                                const PreparedScene& prepared) {
  std::string text = line("scene " + verdict.scene + ": " + plural(verdict.polygons, "polygon") +
                          ", " + plural(verdict.parts, "part") + ", numbers as " +
                          (verdict.numbers == NumberMeaning::kDecimal ? "decimals" : "doubles"));
  text += line(fmt::format(
      "samples {}: {} of {} on {}", verdict.file, plural(verdict.samples, "sample"),
      plural(verdict.lights.size(), "light"), plural(verdict.polygon_counts.size(), "polygon")));
  if (verdict.left_out > 0) {
    text += line(plural(verdict.left_out, "sample") + " of other lights left out");
  }
  if (!verdict.passed_over.empty()) {
    text += "columns passed over:";
    for (const std::string& name : verdict.passed_over) text += ' ' + name;
    text += '\n';
  }
  text += line(tolerance_text(verdict)) + places_text(verdict) + '\n';
  text += verdict_row(verdict, scene, prepared);
  if (verdict.lights.size() > 1) text += counts_text("light", verdict.lights);
  text += counts_text("polygon", verdict.polygon_counts) + '\n';
  if (verdict.interrupted) {
    text += fmt::format("Interrupted: {} of {} were judged.\n", grouped(verdict.judged()),
                        plural(verdict.samples, "sample"));
  } else if (verdict.failed()) {
    text += hint_text(verdict) + "Failed: " + verdict.file + ".\n";
  } else {
    text += "Samples agree with the exact ones: " + verdict.file + ".\n";
  }
  return text;
}

}  // namespace gnomon::comparison
