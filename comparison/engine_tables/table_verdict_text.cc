// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "comparison/engine_tables/table_verdict.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::comparison {

namespace {

using report::Align;
using report::grouped;
using report::rounded;
using report::TextTable;

constexpr std::size_t kExamples = 3;

std::string plural(std::uint64_t count, const std::string& one) {
  return grouped(count) + ' ' + one + (count == 1 ? "" : "s");
}

std::string line(const std::string& text) { return report::wrapped(text, TextTable::kWidth, 0, 2); }

std::string examples(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kExamples); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return text + (names.size() > kExamples ? ", ..." : "");
}

std::string suns_text(const TableVerdict& verdict) {
  const std::string up = "; up in " + plural(verdict.suns_up, "row");
  if (!verdict.suns) return "suns: those of the table" + up;
  const suns::YearOptions& suns = *verdict.suns;
  constexpr std::array<const char*, 3> kPlaces{"start", "middle", "end"};
  return fmt::format(
      "suns: {}{}{} at {},{} (UTC{:+g}), at the {} of each step{}", suns::name_of(suns.model),
      suns.average_days > 1 ? fmt::format(" of {} days", suns.average_days) : "",
      suns.refraction ? " with refraction" : "", rounded(suns.place.latitude, 8),
      rounded(suns.place.longitude, 8), static_cast<double>(suns.place.zone.count()) / 60,
      kPlaces[static_cast<std::size_t>(suns.sun_at)], up);
}

std::string tolerance_text(const TableVerdict& verdict) {
  if (verdict.tolerance) return rounded(*verdict.tolerance, 3) + " of each surface";
  return "half a unit of the last digit written, of up to " +
         plural(static_cast<std::uint64_t>(verdict.decimals), "decimal") +
         (verdict.doubles ? ", and 1e-9 since they are all of a double's" : "");
}

std::string exact_text(const TableWitness& witness) {
  constexpr std::size_t kLongest = 24;
  std::string text = rounded(witness.value.truth, 15);
  if (witness.truth && witness.truth->exact) {
    const std::string exact = witness.truth->exact->get_str();
    if (exact.size() <= kLongest && exact.find('/') != std::string::npos) text += " = " + exact;
  }
  return text;
}

std::string cause_text(const TableWitness& witness) {
  if (!witness.is_day) return "the sun is down";
  if (!witness.truth) return "";
  if (!witness.truth->faces) return "it faces away from the sun";
  const std::vector<CasterShare>& casters = witness.truth->casters;
  if (casters.empty()) return "no caster reaches it";
  std::string text = "shaded by ";
  for (std::size_t i = 0; i < std::min(casters.size(), kExamples); ++i) {
    text += (i == 0 ? "" : ", ") + casters[i].polygon + " (" + rounded(casters[i].share, 3) + ")";
  }
  if (casters.size() > kExamples) {
    text += " and " + grouped(casters.size() - kExamples) + " more";
  }
  return text;
}

std::string witness_text(const TableVerdict& verdict, const TableWitness& witness) {
  std::string text = fmt::format("{}, {}, ", verdict.surfaces[witness.surface].name, witness.time);
  if (witness.is_day) {
    text += fmt::format("sun ({}, {}, {}): ", rounded(1e-6 * witness.sun[0], 7),
                        rounded(1e-6 * witness.sun[1], 7), rounded(1e-6 * witness.sun[2], 7));
  } else {
    text += "night: ";
  }
  text += "found " + text_of(witness.value.found) + ", true " + exact_text(witness);
  const std::string cause = cause_text(witness);
  if (!cause.empty()) text += "; " + cause;
  if (witness.value.kind == WrongKind::kRange) text += "; no share is outside 0 to 1";
  return text;
}

std::string verdict_row(const TableVerdict& verdict) {
  TextTable table({{"candidate"},
                   {"verdict"},
                   {"values", Align::kRight},
                   {"wrong", Align::kRight},
                   {"value", Align::kRight},
                   {"night", Align::kRight},
                   {"range", Align::kRight},
                   {"most off", Align::kRight}});
  const double most = verdict.worst.empty() ? 0 : verdict.worst.front().value.off;
  const char* word = verdict.interrupted ? "interrupted"
                     : verdict.failed()  ? "failed"
                                         : "shares agree";
  table.add_row({verdict.file, word, grouped(verdict.values), grouped(verdict.wrong.all()),
                 grouped(verdict.wrong.value), grouped(verdict.wrong.night),
                 grouped(verdict.wrong.range), std::isfinite(most) ? rounded(most, 3) : "nan"});
  for (const TableWitness& witness : verdict.worst) {
    table.add_note((&witness == verdict.worst.data() ? "worst: " : "") +
                   witness_text(verdict, witness));
  }
  return table.to_string();
}

/// Those with wrong values, most first.
std::string surfaces_text(const TableVerdict& verdict) {
  std::vector<const JudgedSurface*> wrong;
  for (const JudgedSurface& surface : verdict.surfaces) {
    if (surface.wrong.all() > 0) wrong.push_back(&surface);
  }
  if (wrong.empty()) return {};
  std::ranges::stable_sort(wrong, std::greater<>(),
                           [](const JudgedSurface* surface) { return surface->wrong.all(); });
  TextTable table({{"surface"},
                   {"wrong", Align::kRight},
                   {"value", Align::kRight},
                   {"night", Align::kRight},
                   {"range", Align::kRight},
                   {"hours found", Align::kRight},
                   {"hours true", Align::kRight}});
  constexpr std::size_t kMost = 10;
  for (std::size_t i = 0; i < std::min(wrong.size(), kMost); ++i) {
    const JudgedSurface& surface = *wrong[i];
    table.add_row({surface.name, grouped(surface.wrong.all()), grouped(surface.wrong.value),
                   grouped(surface.wrong.night), grouped(surface.wrong.range),
                   rounded(surface.hours.found, 7), rounded(surface.hours.truth, 7)});
  }
  if (wrong.size() > kMost) {
    table.add_note("and " + plural(wrong.size() - kMost, "surface") + " more");
  }
  return '\n' + table.to_string();
}

std::string sums_text(const TableVerdict& verdict) {
  const auto most = std::ranges::max_element(
      verdict.surfaces, {},
      [](const JudgedSurface& surface) { return surface.hours.difference(); });
  if (most == verdict.surfaces.end() || !(most->hours.difference() > 0)) {
    return "hours of sun: those of all surfaces are the true ones\n";
  }
  return line(fmt::format("hours of sun: {} differs most, {} found, {} true ({} of the greater)",
                          most->name, rounded(most->hours.found, 10),
                          rounded(most->hours.truth, 10), rounded(most->hours.difference(), 3)));
}

/// Whose sun it may have been, where so much is wrong that one wrong sun would explain it.
std::string hint_text(const TableVerdict& verdict) {
  constexpr std::uint64_t kFew = 10, kRare = 1000;
  if (!verdict.suns || verdict.wrong.value <= kFew ||
      verdict.wrong.value * kRare <= verdict.values) {
    return {};
  }
  if (verdict.suns->model != suns::SunModelId::kEnergyPlus) {
    return line(
        "hint: EnergyPlus has a sun of its own, --sun-model energyplus, by default with "
        "--average-days 20");
  }
  if (verdict.suns->average_days == 1) {
    return line("hint: by default EnergyPlus takes one sun for 20 days: --average-days 20");
  }
  return {};
}

}  // namespace

std::string table_verdict_text(const TableVerdict& verdict) {
  std::string text = line("scene " + verdict.scene + ": " + plural(verdict.polygons, "polygon") +
                          ", " + plural(verdict.parts, "part") + ", numbers as " +
                          (verdict.numbers == NumberMeaning::kDecimal ? "decimals" : "doubles"));
  text += line(fmt::format("table {}: {} of {} from {} to {}", verdict.file,
                           plural(verdict.rows, "row"),
                           plural(static_cast<std::uint64_t>(verdict.step.count()), "minute"),
                           verdict.first, verdict.last));
  text +=
      grouped(verdict.surfaces.size()) + " of " + plural(verdict.columns, "column") + " judged\n";
  text += line(suns_text(verdict));
  text += line("tolerance of shares told alone: " + tolerance_text(verdict));
  if (!verdict.unknown.empty()) {
    text += line(plural(verdict.unknown.size(), "column") +
                 " of the table that name no surface of the scene: " + examples(verdict.unknown));
  }
  if (!verdict.untold.empty()) {
    text += line(plural(verdict.untold.size(), "side") +
                 " of the scene that the table does not tell: " + examples(verdict.untold));
  }
  text += '\n' + verdict_row(verdict) + surfaces_text(verdict) + '\n' + sums_text(verdict);
  if (verdict.interrupted) {
    text += fmt::format("Interrupted: {} of {} were judged.\n", grouped(verdict.judged_rows),
                        plural(verdict.rows, "row"));
  } else if (verdict.failed()) {
    text += hint_text(verdict) + "Failed: " + verdict.file + ".\n";
  } else {
    text += "Shares agree with the exact ones: " + verdict.file + ".\n";
  }
  if (verdict.oracle_fault) {
    text += "The exact kernel and the oracle disagree: a bug of this program; please report it.\n";
  }
  return text;
}

}  // namespace gnomon::comparison
