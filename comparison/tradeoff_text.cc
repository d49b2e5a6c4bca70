// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/tradeoff_text.h"

#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "gnomon/kernel/kernel_list.h"
#include "report/json/json_writer.h"
#include "report/text/csv_field.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::comparison {

namespace {

using report::Align;
using report::grouped;
using report::rounded;
using report::shortest;

constexpr std::size_t kWidthOfTradeoff = 150;

std::string scene_text(const TradeoffRow& row) {
  return row.request.scene + (row.request.lights == LightsAsked::kArea ? " (area lights)" : "");
}

/// Rows from `begin` on that differ in nothing but their thickness and time.
std::size_t end_of_equal_ones(std::span<const TradeoffRow> rows, std::size_t begin) {
  const auto is_equal = [&](const TradeoffRow& row) {
    RunRequest request = row.request;
    request.thickness = rows[begin].request.thickness;
    const Measurement &a = row.measurement, &b = rows[begin].measurement;
    return request == rows[begin].request && row.request.thickness && a.end == b.end &&
           a.why == b.why && a.timed() == b.timed() && a.fragments == b.fragments &&
           a.checksum == b.checksum && a.judgement == b.judgement;
  };
  std::size_t end = begin + 1;
  while (end < rows.size() && is_equal(rows[end])) ++end;
  return end;
}

std::string thickness_cell(std::span<const TradeoffRow> group) {
  const auto &first = group.front().request.thickness, &last = group.back().request.thickness;
  if (!first) return "-";
  return shortest(*first) + (group.size() > 1 ? " to " + shortest(*last) : "");
}

std::string verdict_cell(const TradeoffRow& row) {
  const Measurement& measurement = row.measurement;
  if (measurement.judgement) return measurement.judgement->verdict;
  if (measurement.end == RunEnd::kMeasured || measurement.timed()) return "not judged";
  return std::string(name_of(measurement.end));
}

std::string number_cell(double value) { return value == 0 ? "0" : rounded(value, 3); }

std::string time_cell(const Measurement& measurement) {
  constexpr double kMilli = 1000;
  return measurement.timed() ? rounded(measurement.seconds * kMilli, 3) : "-";
}

std::string memory_cell(const Measurement& measurement) {
  return measurement.timed() ? grouped(measurement.peak_bytes >> 20) : "-";
}

/// What breaks it, or why there is no more of it.
std::string remark(const TradeoffRow& row) {
  const Measurement& measurement = row.measurement;
  if (measurement.end != RunEnd::kMeasured) return measurement.why;
  if (measurement.judgement && !measurement.judgement->reason.empty()) {
    return measurement.judgement->breaks;
  }
  return measurement.judgement ? "" : measurement.why;
}

void add_ends(std::string& text, const Tradeoff& tradeoff) {
  for (const std::string& contradiction : tradeoff.contradictions) {
    text += report::wrapped("a bug of ours: " + contradiction, kWidthOfTradeoff, 0, 2);
  }
  if (tradeoff.interrupted) text += "Interrupted: what was not reached is missing.\n";
}

std::string range_text(const ThicknessVerdict& verdict) {
  if (verdict.judged == 0) return "not judged";
  if (verdict.right.empty()) return "none";
  std::string text;
  for (const ThicknessRange& range : verdict.right) {
    if (!text.empty()) text += ", ";
    text += shortest(range.from);
    if (range.to != range.from) text += " to " + shortest(range.to);
  }
  return text;
}

/// What all rows of a table have in common.
std::string heading(const TradeoffRow& row) {
  return scene_text(row) + ", " + grouped(row.polygons) + " polygons";
}

std::string scene_table(std::span<const TradeoffRow> rows, bool commands) {
  report::TextTable table({{""},
                           {"system"},
                           {"kernel"},
                           {"thickness", Align::kRight},
                           {"ms", Align::kRight},
                           {"MB", Align::kRight},
                           {"fragments", Align::kRight},
                           {"wrong", Align::kRight},
                           {"worst share", Align::kRight},
                           {"width", Align::kRight},
                           {"invented", Align::kRight},
                           {"lost", Align::kRight},
                           {"verdict"}});
  for (std::size_t i = 0; i < rows.size();) {
    const std::size_t end = end_of_equal_ones(rows, i);
    const std::span<const TradeoffRow> group = rows.subspan(i, end - i);
    i = end;
    // The one that is fastest stands for all.
    const TradeoffRow& row = *std::ranges::min_element(
        group, {}, [](const TradeoffRow& each) { return each.measurement.seconds; });
    const auto& judgement = row.measurement.judgement;
    table.add_row({std::ranges::any_of(group, &TradeoffRow::on_front) ? "*" : "",
                   row.request.system, row.request.kernel, thickness_cell(group),
                   time_cell(row.measurement), memory_cell(row.measurement),
                   row.measurement.timed() ? grouped(row.measurement.fragments) : "-",
                   judgement ? number_cell(judgement->wrong) : "-",
                   judgement ? number_cell(judgement->worst_share) : "-",
                   judgement ? number_cell(judgement->width) : "-",
                   judgement ? grouped(judgement->invented) : "-",
                   judgement ? grouped(judgement->lost) : "-", verdict_cell(row)});
    if (const std::string text = remark(row); !text.empty()) table.add_note(text);
    if (commands) table.add_note(row.command);
  }
  return table.to_string(kWidthOfTradeoff);
}

}  // namespace

std::string tradeoff_text(const Tradeoff& tradeoff, bool commands) {
  std::string text;
  const std::vector<TradeoffRow>& rows = tradeoff.rows;
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin;
    while (end < rows.size() && heading(rows[end]) == heading(rows[begin])) ++end;
    text += heading(rows[begin]) + '\n';
    text += scene_table({rows.data() + begin, end - begin}, commands) + '\n';
    begin = end;
  }
  text += "* nothing on the same scene is as fast and as accurate, and better in one of the two\n";
  add_ends(text, tradeoff);
  return text;
}

std::string thickness_text(const Tradeoff& tradeoff) {
  const std::vector<ThicknessVerdict> verdicts = thickness_verdicts(tradeoff);
  report::TextTable table(
      {{"scene"}, {"system"}, {"kernel"}, {"tried", Align::kRight}, {"right with thickness"}});
  // Scores are of one kernel and method.
  std::map<std::string, std::vector<ThicknessVerdict>> groups;
  for (const ThicknessVerdict& verdict : verdicts) {
    table.add_row({verdict.scene + (verdict.lights == LightsAsked::kArea ? " (area lights)" : ""),
                   verdict.system, verdict.kernel, grouped(verdict.tried), range_text(verdict)});
    if (verdict.judged > 0) groups[verdict.kernel + '/' + verdict.system].push_back(verdict);
  }
  std::string text = table.to_string(kWidthOfTradeoff);
  for (const auto& [name, group] : groups) {
    std::string sentence = name + ": ";
    const std::vector<ThicknessScore> scores = thickness_scores(group);
    if (scores.empty()) {
      sentence += "no thickness is right for any of " + grouped(group.size()) + " scenes";
    } else {
      sentence += "best single thickness " + shortest(scores.front().thickness) + ", right for " +
                  grouped(scores.front().right) + " of " + grouped(group.size()) + " scenes";
      for (const ThicknessScore& score : scores) {
        if (score.thickness == kDefaultThickness || score.thickness == 0) {
          sentence += "; " + shortest(score.thickness) + " for " + grouped(score.right);
        }
      }
    }
    std::string none;
    std::size_t count = 0;
    for (const ThicknessVerdict& verdict : group) {
      if (!verdict.right.empty()) continue;
      ++count;
      none += (none.empty() ? "" : ", ") + verdict.scene;
    }
    if (count > 0) sentence += "; none is right for " + grouped(count) + ": " + none;
    text += report::wrapped(sentence, kWidthOfTradeoff, 0, 2);
  }
  add_ends(text, tradeoff);
  return text;
}

std::string invariance_text(const Tradeoff& tradeoff) {
  report::TextTable table({{"scene"},
                           {"system"},
                           {"kernel"},
                           {"change"},
                           {"sides that differ", Align::kRight},
                           {"by at most", Align::kRight},
                           {"most in"}});
  for (const TradeoffRow& row : tradeoff.rows) {
    if (row.request.change.empty()) continue;
    const auto& difference = row.measurement.difference;
    table.add_row({scene_text(row), row.request.system, row.request.kernel, row.request.change,
                   difference ? grouped(difference->sides) : "-",
                   difference ? number_cell(difference->worst_share)
                              : std::string(name_of(row.measurement.end)),
                   difference ? difference->worst : row.measurement.why});
  }
  std::string text = table.to_string(kWidthOfTradeoff);
  add_ends(text, tradeoff);
  return text;
}

namespace {

void write_row(report::JsonWriter& json, const TradeoffRow& row) {
  const Measurement& measurement = row.measurement;
  json.begin_object();
  json.member("scene", row.request.scene);
  json.member("polygons", row.polygons);
  json.member("lights", row.request.lights == LightsAsked::kArea ? "area" : "point");
  json.member("system", row.request.system);
  json.member("kernel", row.request.kernel);
  json.key("thickness");
  row.request.thickness ? json.value(*row.request.thickness) : json.null();
  if (!row.request.change.empty()) json.member("change", row.request.change);
  json.member("end", name_of(measurement.end));
  if (!measurement.why.empty()) json.member("why", measurement.why);
  if (measurement.timed()) {
    json.member("cpu_seconds", measurement.seconds);
    json.member("runs", measurement.runs);
    json.member("peak_bytes", measurement.peak_bytes);
    json.member("fragments", measurement.fragments);
    json.member("checksum", measurement.checksum);
  }
  if (measurement.judgement) {
    const Judgement& judgement = *measurement.judgement;
    json.member("verdict", judgement.verdict);
    json.member("by_points", judgement.by_points);
    json.member("wrong", judgement.wrong);
    json.member("worst_share", judgement.worst_share);
    json.member("width", judgement.width);
    json.member("diagonal", judgement.diagonal);
    json.member("invented", judgement.invented);
    json.member("lost", judgement.lost);
    if (!judgement.breaks.empty()) json.member("breaks", judgement.breaks);
    if (!judgement.reason.empty()) json.member("reason", judgement.reason);
  }
  if (measurement.difference) {
    json.member("sides_that_differ", measurement.difference->sides);
    json.member("differ_by_at_most", measurement.difference->worst_share);
    json.member("most_in", measurement.difference->worst);
  }
  json.member("on_front", row.on_front);
  json.member("command", row.command);
  json.end_object();
}

}  // namespace

void write_tradeoff_json(report::TextSink& sink, const Tradeoff& tradeoff) {
  report::JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-tradeoff");
  json.member("version", 1);
  json.member("interrupted", tradeoff.interrupted);
  json.key("contradictions");
  json.begin_array();
  for (const std::string& contradiction : tradeoff.contradictions) json.value(contradiction);
  json.end_array();
  json.key("rows");
  json.begin_array();
  for (const TradeoffRow& row : tradeoff.rows) write_row(json, row);
  json.end_array();
  json.key("thickness");
  json.begin_array();
  for (const ThicknessVerdict& verdict : thickness_verdicts(tradeoff)) {
    json.begin_object();
    json.member("scene", verdict.scene);
    json.member("lights", verdict.lights == LightsAsked::kArea ? "area" : "point");
    json.member("system", verdict.system);
    json.member("kernel", verdict.kernel);
    json.member("tried", verdict.tried);
    json.member("judged", verdict.judged);
    json.key("right");
    json.begin_array();
    for (const ThicknessRange& range : verdict.right) {
      json.begin_array(report::JsonLayout::kInline);
      json.value(range.from);
      json.value(range.to);
      json.end_array();
    }
    json.end_array();
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.finish();
}

std::string tradeoff_csv(const Tradeoff& tradeoff) {
  std::string text;
  report::append_csv_line(text,
                          {"scene",      "polygons",  "lights",  "system", "kernel",
                           "thickness",  "change",    "end",     "why",    "cpu_seconds",
                           "peak_bytes", "fragments", "verdict", "wrong",  "worst_share",
                           "width",      "invented",  "lost",    "breaks", "sides_that_differ",
                           "differ_by",  "on_front",  "command"});
  for (const TradeoffRow& row : tradeoff.rows) {
    const Measurement& measurement = row.measurement;
    const auto& judgement = measurement.judgement;
    const auto& difference = measurement.difference;
    const bool timed = measurement.timed();
    report::append_csv_line(text, {row.request.scene,
                                   std::to_string(row.polygons),
                                   row.request.lights == LightsAsked::kArea ? "area" : "point",
                                   row.request.system,
                                   row.request.kernel,
                                   row.request.thickness ? shortest(*row.request.thickness) : "",
                                   row.request.change,
                                   std::string(name_of(measurement.end)),
                                   measurement.why,
                                   timed ? shortest(measurement.seconds) : "",
                                   timed ? std::to_string(measurement.peak_bytes) : "",
                                   timed ? std::to_string(measurement.fragments) : "",
                                   judgement ? judgement->verdict : "",
                                   judgement ? shortest(judgement->wrong) : "",
                                   judgement ? shortest(judgement->worst_share) : "",
                                   judgement ? shortest(judgement->width) : "",
                                   judgement ? std::to_string(judgement->invented) : "",
                                   judgement ? std::to_string(judgement->lost) : "",
                                   judgement ? judgement->breaks : "",
                                   difference ? std::to_string(difference->sides) : "",
                                   difference ? shortest(difference->worst_share) : "",
                                   row.on_front ? "1" : "0",
                                   row.command});
  }
  return text;
}

}  // namespace gnomon::comparison
