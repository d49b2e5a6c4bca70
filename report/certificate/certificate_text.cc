// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "report/certificate/certificate.h"
#include "report/certificate/decisions.h"
#include "report/certificate/wrong_share.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::report {

namespace {

std::string joined(const std::vector<std::string>& words, std::size_t most = 6) {
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < most; ++i) {
    if (i > 0) text += ", ";
    text += words[i];
  }
  if (words.size() > most) text += " and " + std::to_string(words.size() - most) + " more";
  return text;
}

/// Columns of characters that all kernels' names, verdicts and numbers need side by side.
constexpr std::size_t kTableWidth = 110;

std::string plural(std::uint64_t count, const std::string& one) {
  return grouped(count) + ' ' + one + (count == 1 ? "" : "s");
}

/// An upper bound for people; exact zero is "0".
std::string bound(double upper) {
  if (!std::isfinite(upper)) return "?";  // beyond the range of doubles
  return upper == 0 ? "0" : rounded(upper, 3);
}

std::string ratio(double value) {
  return (value < 100 ? rounded(value, 2) : grouped(static_cast<std::uint64_t>(value))) + "x";
}

std::string policy(const JudgedRun& run) {
  if (run.foreign) return "foreign";
  if (run.exact) return "exact";
  if (run.exact_decisions) return "points";
  return "thick " + rounded(run.thickness, 2);
}

/// CPU time of the kernel `double` without identity, the measure of all others.
std::optional<double> reference_time(const std::vector<JudgedRun>& runs) {
  for (const JudgedRun& run : runs) {
    if (run.kernel == "double" && run.error.empty() && run.cpu_seconds > 0) return run.cpu_seconds;
  }
  return std::nullopt;
}

/// Each once, in the order of the runs.
std::vector<std::string> algorithms_of(const std::vector<JudgedRun>& runs) {
  std::vector<std::string> algorithms;
  for (const JudgedRun& run : runs) {
    if (run.algorithm.empty() || std::ranges::count(algorithms, run.algorithm) > 0) continue;
    algorithms.push_back(run.algorithm);
  }
  return algorithms;
}

std::vector<std::string> row(const JudgedRun& run, const WrongShare& wrong_share,
                             std::optional<double> reference) {
  std::string time = "-";
  if (!run.foreign && run.error.empty()) {
    time = reference             ? ratio(run.cpu_seconds / *reference)
           : run.cpu_seconds < 1 ? rounded(1000 * run.cpu_seconds, 3) + " ms"
                                 : rounded(run.cpu_seconds, 3) + " s";
  }
  const std::string& name = run.foreign ? run.name : run.kernel;
  if (!run.report) {
    return {name, policy(run), run.gave_up ? "gave up" : "no result", "-", "-", "-", "-",
            "-",  time};
  }
  const oracle::Report& report = *run.report;
  const oracle::ComparisonTotals& totals = report.totals;
  std::string verdict = name_of(report.verdict);
  if (report.interrupted) verdict = "interrupted";
  if (report.by_points) {
    return {name,    policy(run),
            verdict, grouped(report.points_wrong) + "/" + grouped(report.points_checked),
            "-",     grouped(totals.wrong_polygons),
            "-",     grouped(run.fragments),
            time};
  }
  return {name,
          policy(run),
          verdict,
          bound(wrong_share.of(report)),
          bound(totals.worst_share()),
          grouped(totals.wrong_polygons) + "/" + grouped(totals.polygons),
          bound(totals.width.upper),
          grouped(run.fragments),
          time};
}

void add_notes(const JudgedRun& run, const NamedScene& named, TextTable& table) {
  if (!run.error.empty()) {
    table.add_note(run.error);
    return;
  }
  const oracle::Report& report = *run.report;
  if (report.oracle_fault) {
    table.add_note("the oracle contradicts itself here: a bug of this program, please report it");
  }
  if (report.verdict == oracle::Verdict::kFailed) {
    if (report.worst) table.add_note("worst: " + place_in_words(*report.worst));
    if (!report.excess.empty()) table.add_note("too much: " + report.excess);
    const bool place_says_it =
        report.worst && report.problems.empty() && report.reason == report.worst->text;
    if (!report.reason.empty() && !place_says_it) table.add_note("why: " + report.reason);
    const oracle::ComparisonTotals& totals = report.totals;
    std::string counts;
    const auto add = [&](std::uint64_t count, const std::string& what) {
      if (count > 0) counts += (counts.empty() ? "" : ", ") + plural(count, what);
    };
    add(totals.regions, "region");
    if (!counts.empty()) counts += " of error";
    add(totals.invented, "invented region");
    add(totals.lost, "lost region");
    add(totals.ill_conditioned_regions, "ill-conditioned region");
    if (totals.rounding_regions > 0) {
      counts +=
          (counts.empty() ? "" : ", ") + grouped(totals.rounding_regions) + " by rounding alone";
    }
    add(totals.self_crossing, "self-crossing loop");
    add(run.dropped_slivers, "loop");
    if (run.dropped_slivers > 0) counts += " vanished in rounding";
    if (totals.off_plane.upper > 0) {
      counts += (counts.empty() ? "" : ", ") + std::string("vertices up to ") +
                bound(totals.off_plane.upper) + " off their plane";
    }
    if (!counts.empty()) table.add_note(counts);
  }
  if (!run.per_caster_umbra && report.totals.missing_umbra.upper > 0) {
    table.add_note(
        "umbra called penumbra (a cost, no error): " + bound(report.totals.missing_umbra.upper) +
        " of " + bound(report.totals.umbra.upper) + " scene units squared");
  }
  constexpr std::size_t kMostProblems = 5;
  for (std::size_t i = 0; i < report.problems.size() && i < kMostProblems; ++i) {
    table.add_note(report.problems[i]);
  }
  if (report.problems.size() > kMostProblems) {
    table.add_note("and " + plural(report.problems.size() - kMostProblems, "problem") + " more");
  }
  for (const std::string& note : report.notes) table.add_note(note);
  if (report.verdict != oracle::Verdict::kFailed &&
      report.totals.worst_share() > report.tolerance) {
    // What of it is wrong besides is within tolerance.
    const bool moved = report.totals.ill_conditioned_regions > 0;
    std::string why;
    if (report.totals.rounding_regions > 0 || !moved) why = "doubles' own rounding explains";
    if (moved) {
      why += (why.empty() ? "" : " or ") + std::string("moving one vertex by less than ") +
             rounded(report.clearance, 3) + " undoes";
    }
    table.add_note("the worst share is what " + why + ", which is excused (--strict)");
  }
  if (report.totals.by_borders > 0) {
    table.add_note("of " + plural(report.totals.by_borders, "polygon side") +
                   " error is bounded by borders, not measured (--measure)");
  }
  if (!run.explanation.empty()) {
    const bool none_differs = run.decisions && !run.decisions->first;
    table.add_note((none_differs     ? std::string()
                    : !run.decisions ? "no differing decision was found: "
                                     : "first differing decision: ") +
                   run.explanation);
  }
  if (run.decisions) {
    for (std::string& note : decisions_text(*run.decisions, run.kernel, named)) {
      table.add_note(std::move(note));
    }
  }
}

/// Whole sentences below the table.
std::string conclusion(const Certificate& certificate) {
  std::vector<std::string> identical, tolerated, agreeing, failed, uncounted, wrong_exact;
  for (const JudgedRun& run : certificate.runs) {
    if (run.report && run.report->interrupted) continue;
    if (run.failed()) {
      (run.counts ? failed : uncounted).push_back(run.name);
    } else if (run.report->verdict == oracle::Verdict::kIdentical) {
      identical.push_back(run.name);
    } else if (run.report->verdict == oracle::Verdict::kSharesAgree) {
      agreeing.push_back(run.name);
    } else {
      tolerated.push_back(run.name);
    }
    if (run.exact && !(run.report && run.report->confirms_exact())) wrong_exact.push_back(run.name);
  }
  std::string text;
  if (!identical.empty()) text += "Identical to the exact answer: " + joined(identical, 20) + ". ";
  if (!tolerated.empty()) text += "Within tolerance: " + joined(tolerated, 20) + ". ";
  if (!agreeing.empty()) {
    text += "Shares agree with the exact ones: " + joined(agreeing, 20) + ". ";
  }
  if (!failed.empty()) text += "Failed: " + joined(failed, 20) + ". ";
  if (!uncounted.empty()) {
    text += "Failed, and not counted because nobody asked for it by --kernel: " +
            joined(uncounted, 20) + ". ";
  }
  if (!wrong_exact.empty()) {
    text += "Exact kernels that disagree with the oracle: " + joined(wrong_exact, 20) +
            ". This is a bug of this program; please report it with the scene. ";
  }
  if (certificate.interrupted) text += "Interrupted: not everything was judged. ";
  return text.empty() ? text : wrapped(text, TextTable::kWidth, 0, 0);
}

}  // namespace

std::string place_in_words(const oracle::Witness& witness) {
  std::string text =
      witness.block == Block::kLights ? "" : std::string(name_of(witness.block)) + ", ";
  text += "light " + witness.light + ", polygon " + witness.polygon + " (" + name_of(witness.side) +
          ")";
  if (witness.kind == oracle::ErrorKind::kNone) return text;
  if (witness.is_of_side()) return text + ": " + witness.text;
  text += ", at (" + rounded(witness.nearest[0], 9) + ", " + rounded(witness.nearest[1], 9) + ", " +
          rounded(witness.nearest[2], 9) + "): found " +
          (witness.found ? name_of(*witness.found) : "nothing") + ", true " +
          (witness.truth ? name_of(*witness.truth) : "outside the polygon");
  if (witness.caster == witness.polygon) {
    text += ", by another part of it";
  } else if (!witness.caster.empty()) {
    text += ", by caster " + witness.caster;
  }
  if (witness.width.upper > 0) text += "; " + bound(witness.width.upper) + " wide";
  if (witness.clearance) {
    text += "; moving one vertex by " + bound(*witness.clearance) + " would change it";
  }
  return text;
}

std::string certificate_text(const Certificate& certificate) {
  const WrongShare wrong_share(certificate);
  const Scene& scene = *certificate.scene;
  std::string text;
  const std::vector<std::string> algorithms = algorithms_of(certificate.runs);
  text += wrapped("scene " + (scene.name.empty() ? scene.file : scene.name) + ": " +
                      plural(scene.polygons.size(), "polygon") + ", " +
                      plural(certificate.prepared->parts.size(), "part") + ", numbers as " +
                      (scene.numbers == NumberMeaning::kDecimal ? "decimals" : "doubles") +
                      "; lights: " + joined(certificate.lights) +
                      (algorithms.empty() ? "" : "; by " + joined(algorithms)),
                  TextTable::kWidth, 0, 2);
  for (const std::string& finding : certificate.scene_findings) {
    text += wrapped("the prepared scene is wrong, a bug of this program: " + finding,
                    TextTable::kWidth, 0, 2);
  }
  for (const JudgedRun& run : certificate.runs) {
    if (!run.report) continue;
    const oracle::Report& report = *run.report;
    if (report.told_shares > 0) {
      text += wrapped(
          "tolerance of shares told alone: " +
              (report.share_tolerance ? rounded(*report.share_tolerance, 3) + " of each polygon"
                                      : "half a unit of the last digit written"),
          TextTable::kWidth, 0, 2);
      if (report.totals.fragments == 0) continue;
    }
    text += wrapped(
        "tolerance " + rounded(report.tolerance, 3) + " of each polygon, width " +
            rounded(report.width, 3) + " (scene diagonal " + rounded(report.diagonal, 6) + ")" +
            (report.clearance > 0 ? ", clearance " + rounded(report.clearance, 3) : "") +
            (report.by_points ? "; above " + grouped(report.most_pairs) +
                                    " pairs of parts exact points are compared, not areas"
                              : ""),
        TextTable::kWidth, 0, 2);
    break;
  }
  text += '\n';

  bool by_points = false;
  for (const JudgedRun& run : certificate.runs) {
    by_points = by_points || (run.report && run.report->by_points);
  }
  const std::vector<Column> columns = {{"kernel"},
                                       {"policy"},
                                       {"verdict"},
                                       {by_points ? "wrong points" : "wrong area", Align::kRight},
                                       {"worst share", Align::kRight},
                                       {"polygons", Align::kRight},
                                       {"width", Align::kRight},
                                       {"fragments", Align::kRight},
                                       {"time", Align::kRight}};
  const std::optional<double> reference = reference_time(certificate.runs);
  // Foreign results stand with the first algorithm.
  for (std::size_t i = 0; i < certificate.runs.size();) {
    TextTable table(columns);
    std::string algorithm;
    for (; i < certificate.runs.size(); ++i) {
      const JudgedRun& run = certificate.runs[i];
      if (algorithm.empty()) algorithm = run.algorithm;
      if (run.algorithm != algorithm) break;
      table.add_row(row(run, wrong_share, reference));
      add_notes(run, {certificate.scene, certificate.prepared}, table);
    }
    if (algorithms.size() > 1) text += "by " + algorithm + ":\n";
    text += table.to_string(kTableWidth);
    if (i < certificate.runs.size()) text += '\n';
  }
  const std::string end = conclusion(certificate);
  if (!end.empty()) text += '\n' + end;
  return text;
}

}  // namespace gnomon::report
