// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/extremes_text.h"

#include <algorithm>
#include <numeric>

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

constexpr std::size_t kWidthOfMap = 140;

const Row& row_at(const ExtremeCurve& curve, int step) {
  const auto at = std::ranges::find(curve.steps, step) - curve.steps.begin();
  return *curve.rows[static_cast<std::size_t>(at)];
}

std::string share_text(const Row& row) {
  const auto error = error_of(row.measurement);
  if (!error) return "-";
  return *error == 0 ? "0" : rounded(*error, 2);
}

/// The greatest error of the steps that are right.
std::string worst_while_right(const ExtremeCurve& curve) {
  double worst = 0;
  for (const Row* row : curve.rows) {
    if (failure_of(*row).empty()) worst = std::max(worst, error_of(row->measurement).value_or(0));
  }
  return worst == 0 ? "0" : rounded(worst, 2);
}

/// Steps that are right after the first that is not.
std::size_t right_again(const ExtremeCurve& curve) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < curve.steps.size(); ++i) {
    count += curve.first_failure && curve.steps[i] > *curve.first_failure &&
             failure_of(*curve.rows[i]).empty();
  }
  return count;
}

/// How many of the decisions went to integers, and the widest of these, at the last step.
std::string decided_text(const ExtremeCurve& curve) {
  static constexpr const char* kNames[] = {"64", "128", "256", "512", "1024", "GMP"};
  const DecidedBy& by = curve.rows.back()->measurement.decided_by;
  const std::uint64_t all = std::accumulate(by.begin(), by.end(), std::uint64_t{0});
  if (all == 0) return "";
  const std::uint64_t exact = std::accumulate(by.begin() + 2, by.end(), std::uint64_t{0});
  std::string widest = "none";
  for (std::size_t i = 2; i < by.size(); ++i) {
    if (by[i] > 0) widest = kNames[i - 2];
  }
  return report::percent(static_cast<double>(exact) / static_cast<double>(all)) + ", widest " +
         widest;
}

std::string time_text(const ExtremeCurve& curve) {
  constexpr double kMilli = 1000;
  const Measurement &first = curve.rows.front()->measurement,
                    &last = curve.rows.back()->measurement;
  if (!first.timed() || !last.timed()) return "-";
  return rounded(first.seconds * kMilli, 2) + " to " + rounded(last.seconds * kMilli, 2);
}

std::string curve_text(const ExtremeCurve& curve) {
  std::string text = "worst share by step:";
  for (std::size_t i = 0; i < curve.steps.size(); ++i) {
    text += ' ' + std::to_string(curve.steps[i]) + ": " + share_text(*curve.rows[i]);
    const std::string failure = failure_of(*curve.rows[i]);
    if (!failure.empty()) text += " (" + failure + ')';
    if (i + 1 < curve.steps.size()) text += ',';
  }
  return text;
}

}  // namespace

std::string extremes_text(const Extremes& extremes, bool curves) {
  std::string text;
  const std::vector<ExtremeCurve>& all = extremes.curves;
  for (std::size_t begin = 0; begin < all.size();) {
    std::size_t end = begin;
    while (end < all.size() && all[end].axis == all[begin].axis) ++end;
    const ExtremeAxis& axis = *all[begin].axis;
    text += std::string(axis.name) + ": " + std::string(axis.summary) + ' ' +
            std::string(axis.value) + ", k from " + std::to_string(all[begin].steps.front()) +
            " to " + std::to_string(all[begin].steps.back()) + '\n';
    report::TextTable table({{"system"},
                             {"kernel"},
                             {"thickness", Align::kRight},
                             {"fails at k", Align::kRight},
                             {"how"},
                             {"worst share", Align::kRight},
                             {"before", Align::kRight},
                             {"right again", Align::kRight},
                             {"ms"},
                             {"by integers"}});
    for (; begin < end; ++begin) {
      const ExtremeCurve& curve = all[begin];
      const bool fails = curve.first_failure.has_value();
      table.add_row({curve.system, curve.kernel, curve.thickness ? shortest(*curve.thickness) : "-",
                     fails ? std::to_string(*curve.first_failure) : "never",
                     fails ? failure_of(row_at(curve, *curve.first_failure)) : "",
                     fails ? share_text(row_at(curve, *curve.first_failure)) : "",
                     worst_while_right(curve), fails ? grouped(right_again(curve)) : "",
                     time_text(curve), decided_text(curve)});
      if (curves) table.add_note(curve_text(curve));
    }
    text += table.to_string(kWidthOfMap) + '\n';
  }
  for (const std::string& contradiction : extremes.runs.contradictions) {
    text += report::wrapped("a bug of ours: " + contradiction, kWidthOfMap, 0, 2);
  }
  if (extremes.runs.interrupted) text += "Interrupted: what was not reached is missing.\n";
  return text;
}

std::string extreme_axes_text() {
  report::TextTable table({{"axis"}, {"what step k changes"}, {"to"}, {"k"}});
  for (const ExtremeAxis& axis : extreme_axes()) {
    table.add_row({std::string(axis.name), std::string(axis.summary), std::string(axis.value),
                   std::to_string(axis.first) + " to " + std::to_string(axis.last)});
  }
  return table.to_string(kWidthOfMap);
}

void write_extremes_json(report::TextSink& sink, const Extremes& extremes) {
  using report::JsonLayout;
  report::JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-extremes");
  json.member("version", 1);
  json.member("interrupted", extremes.runs.interrupted);
  json.key("contradictions");
  json.begin_array();
  for (const std::string& contradiction : extremes.runs.contradictions) json.value(contradiction);
  json.end_array();
  json.key("curves");
  json.begin_array();
  for (const ExtremeCurve& curve : extremes.curves) {
    json.begin_object();
    json.member("axis", curve.axis->name);
    json.member("value", curve.axis->value);
    json.member("system", curve.system);
    json.member("kernel", curve.kernel);
    json.key("thickness");
    curve.thickness ? json.value(*curve.thickness) : json.null();
    json.key("first_failure");
    curve.first_failure ? json.value(*curve.first_failure) : json.null();
    json.key("last_right");
    curve.last_right ? json.value(*curve.last_right) : json.null();
    json.key("steps");
    json.begin_array();
    for (std::size_t i = 0; i < curve.steps.size(); ++i) {
      const Measurement& measurement = curve.rows[i]->measurement;
      json.begin_object(JsonLayout::kInline);
      json.member("k", curve.steps[i]);
      json.member("failure", failure_of(*curve.rows[i]));
      json.key("worst_share");
      const auto error = error_of(measurement);
      error ? json.value(*error) : json.null();
      json.key("width");
      measurement.judgement ? json.value(measurement.judgement->width) : json.null();
      json.member("cpu_seconds", measurement.seconds);
      json.member("command", curve.rows[i]->command);
      json.end_object();
    }
    json.end_array();
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.finish();
}

std::string extremes_csv(const Extremes& extremes) {
  std::string text;
  report::append_csv_line(
      text, {"axis", "k", "system", "kernel", "thickness", "failure", "worst_share", "width",
             "invented", "lost", "cpu_seconds", "peak_bytes", "command"});
  for (const ExtremeCurve& curve : extremes.curves) {
    for (std::size_t i = 0; i < curve.steps.size(); ++i) {
      const Measurement& measurement = curve.rows[i]->measurement;
      const auto& judgement = measurement.judgement;
      const auto error = error_of(measurement);
      report::append_csv_line(
          text, {std::string(curve.axis->name), std::to_string(curve.steps[i]), curve.system,
                 curve.kernel, curve.thickness ? shortest(*curve.thickness) : "",
                 failure_of(*curve.rows[i]), error ? shortest(*error) : "",
                 judgement ? shortest(judgement->width) : "",
                 judgement ? std::to_string(judgement->invented) : "",
                 judgement ? std::to_string(judgement->lost) : "",
                 measurement.timed() ? shortest(measurement.seconds) : "",
                 measurement.timed() ? std::to_string(measurement.peak_bytes) : "",
                 curve.rows[i]->command});
    }
  }
  return text;
}

}  // namespace gnomon::comparison
