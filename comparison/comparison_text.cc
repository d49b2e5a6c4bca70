// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/comparison_text.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/method.h"
#include "gnomon/algorithms/method_options.h"
#include "report/json/json_writer.h"
#include "report/text/count_text.h"
#include "report/text/csv_field.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::comparison {

namespace {

using report::grouped;
using report::rounded;

constexpr std::size_t kWidth = 140;
constexpr std::size_t kShownOfChecksum = 8;

std::span<const Counter> counters_of(const Row& row) {
  const auto system = parse_method(row.request.system);
  return system ? method_info(system->id).counters : std::span<const Counter>{};
}

bool counts(const Row& row, Counter counter) {
  return std::ranges::find(counters_of(row), counter) != counters_of(row).end();
}

std::string verdict(const Row& row) {
  const Measurement& measurement = row.measurement;
  if (measurement.judgement) return measurement.judgement->verdict;
  if (measurement.end == RunEnd::kMeasured || measurement.timed()) return "-";
  return std::string(name_of(measurement.end));
}

std::string wrong(const Measurement& measurement) {
  if (!measurement.judgement) return "-";
  return measurement.judgement->wrong == 0 ? "0" : rounded(measurement.judgement->wrong, 3);
}

/// The one counter that says most of the work.
std::string headline(const Row& row) {
  if (!row.measurement.timed()) return "-";
  for (const Counter counter : {Counter::kTests, Counter::kNodes, Counter::kClips}) {
    if (!counts(row, counter)) continue;
    return grouped(row.measurement.work[counter]) + ' ' + std::string(counter_info(counter).name);
  }
  return grouped(row.measurement.nodes) + " cells";
}

std::string ratio_text(double ratio) {
  constexpr double kLarge = 100;
  return (ratio < kLarge ? rounded(ratio, 2) : grouped(static_cast<std::uint64_t>(ratio))) + "x";
}

std::optional<double> growth_at(const Comparison& comparison, std::size_t row) {
  const auto found = std::ranges::find(comparison.growth, row, &Growth::last);
  if (found == comparison.growth.end()) return std::nullopt;
  return found->exponent;
}

/// What breaks it, or why there is no more of it.
std::string remark(const Row& row) {
  const Measurement& measurement = row.measurement;
  std::string text;
  if (measurement.judgement && !measurement.judgement->breaks.empty() &&
      !measurement.judgement->reason.empty()) {
    text = measurement.judgement->breaks;
  }
  if (measurement.end != RunEnd::kMeasured) {
    text +=
        (text.empty() ? "" : "; ") + std::string(name_of(measurement.end)) + ": " + measurement.why;
  }
  return text;
}

std::vector<std::string> cells(const Comparison& comparison, std::size_t index) {
  const Row& row = comparison.rows[index];
  const Measurement& measurement = row.measurement;
  const bool timed = measurement.timed();
  const auto growth = growth_at(comparison, index);
  return {row.request.scene,
          grouped(row.polygons),
          row.request.system,
          row.request.kernel,
          verdict(row),
          wrong(measurement),
          timed ? grouped(measurement.fragments) : "-",
          headline(row),
          row.ratio ? ratio_text(*row.ratio) : "-",
          growth ? "n^" + rounded(*growth, 3) : "",
          measurement.checksum.empty() ? "-" : measurement.checksum.substr(0, kShownOfChecksum)};
}

void write_row(report::JsonWriter& json, const Comparison& comparison, std::size_t index,
               bool times) {
  using report::JsonLayout;
  const Row& row = comparison.rows[index];
  const Measurement& measurement = row.measurement;
  json.begin_object();
  json.member("scene", row.request.scene);
  json.key("size");
  row.request.size ? json.value(*row.request.size) : json.null();
  json.member("polygons", row.polygons);
  json.member("system", row.request.system);
  json.member("kernel", row.request.kernel);
  json.member("end", name_of(measurement.end));
  if (!measurement.why.empty()) json.member("why", measurement.why);
  if (measurement.judgement) {
    const Judgement& judgement = *measurement.judgement;
    json.member("verdict", judgement.verdict);
    json.member("by_points", judgement.by_points);
    json.member("wrong", judgement.wrong);
    json.member("breaks", judgement.breaks);
    json.member("reason", judgement.reason);
  }
  if (measurement.timed()) {
    json.member("lights", measurement.lights);
    json.member("parts", measurement.parts);
    json.member("fragments", measurement.fragments);
    json.member("nodes", measurement.nodes);
    json.key("work");
    json.begin_object(JsonLayout::kInline);
    for (const Counter counter : counters_of(row)) {
      const CounterInfo& info = counter_info(counter);
      json.key(info.name);
      if (info.denominator == 1) {
        json.value(measurement.work[counter]);
      } else {
        json.value(static_cast<double>(measurement.work[counter]) /
                   static_cast<double>(info.denominator));
      }
    }
    json.end_object();
  }
  if (!measurement.checksum.empty()) json.member("checksum", measurement.checksum);
  if (times && measurement.timed()) {
    json.member("cpu_seconds", measurement.seconds);
    json.member("runs", measurement.runs);
    json.member("peak_bytes", measurement.peak_bytes);
    json.key("ratio");
    row.ratio ? json.value(*row.ratio) : json.null();
  }
  json.member("command", row.command);
  json.end_object();
}

/// Counters that one of the rows has, in order.
std::vector<Counter> columns_of_work(const Comparison& comparison) {
  std::vector<Counter> columns;
  for (const CounterInfo& info : counter_infos()) {
    if (std::ranges::any_of(comparison.rows,
                            [&](const Row& row) { return counts(row, info.counter); })) {
      columns.push_back(info.counter);
    }
  }
  return columns;
}

std::string csv_name(std::string_view name) {
  std::string text(name);
  std::ranges::replace(text, ' ', '_');
  return text;
}

std::string count_or_nothing(const Row& row, Counter counter) {
  if (!row.measurement.timed() || !counts(row, counter)) return {};
  const CounterInfo& info = counter_info(counter);
  if (info.denominator == 1) return std::to_string(row.measurement.work[counter]);
  return report::count_text(info, row.measurement.work[counter]);
}

}  // namespace

std::string comparison_text(const Comparison& comparison, const TableOptions& options) {
  using report::Align;
  report::TextTable table({{"scene"},
                           {"polygons", Align::kRight},
                           {"system"},
                           {"kernel"},
                           {"verdict"},
                           {"wrong", Align::kRight},
                           {"fragments", Align::kRight},
                           {"work", Align::kRight},
                           {"time", Align::kRight},
                           {"growth", Align::kRight},
                           {"answer"}});
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const Row& row = comparison.rows[i];
    table.add_row(cells(comparison, i));
    if (const std::string text = remark(row); !text.empty()) table.add_note(text);
    if (options.counters && row.measurement.timed()) {
      const std::string work = report::work_text(counters_of(row), row.measurement.work);
      if (!work.empty()) table.add_note(work);
    }
    if (options.commands) table.add_note(row.command);
  }
  std::string text = table.to_string(kWidth);
  for (const std::string& contradiction : comparison.contradictions) {
    text += report::wrapped("a bug of ours: " + contradiction, kWidth, 0, 2);
  }
  if (comparison.interrupted) text += "Interrupted: what was not reached is missing.\n";
  return text;
}

void write_comparison_json(report::TextSink& sink, const Comparison& comparison, bool times) {
  using report::JsonLayout;
  report::JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-comparison");
  json.member("version", 1);
  json.member("interrupted", comparison.interrupted);
  json.key("contradictions");
  json.begin_array();
  for (const std::string& contradiction : comparison.contradictions) json.value(contradiction);
  json.end_array();
  json.key("rows");
  json.begin_array();
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) write_row(json, comparison, i, times);
  json.end_array();
  if (times) {
    json.key("growth");
    json.begin_array();
    for (const Growth& growth : comparison.growth) {
      json.begin_object(JsonLayout::kInline);
      json.member("scene", growth.scene);
      json.member("system", growth.system);
      json.member("kernel", growth.kernel);
      json.member("exponent", growth.exponent);
      json.member("sizes", growth.sizes);
      json.end_object();
    }
    json.end_array();
  }
  json.end_object();
  json.finish();
}

std::string comparison_csv(const Comparison& comparison, bool times) {
  const std::vector<Counter> work = columns_of_work(comparison);
  std::vector<std::string> header = {"scene", "size",    "polygons", "system", "kernel",   "end",
                                     "why",   "verdict", "wrong",    "breaks", "fragments"};
  for (const Counter counter : work) header.push_back(csv_name(counter_info(counter).name));
  header.emplace_back("checksum");
  if (times) {
    for (const char* name : {"cpu_seconds", "runs", "peak_bytes", "ratio", "growth"}) {
      header.emplace_back(name);
    }
  }
  header.emplace_back("command");
  std::string text;
  report::append_csv_line(text, header);
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const Row& row = comparison.rows[i];
    const Measurement& measurement = row.measurement;
    const auto& judgement = measurement.judgement;
    const bool timed = measurement.timed();
    std::vector<std::string> line = {row.request.scene,
                                     row.request.size ? std::to_string(*row.request.size) : "",
                                     std::to_string(row.polygons),
                                     row.request.system,
                                     row.request.kernel,
                                     std::string(name_of(measurement.end)),
                                     measurement.why,
                                     judgement ? judgement->verdict : "",
                                     judgement ? report::shortest(judgement->wrong) : "",
                                     judgement ? judgement->breaks : "",
                                     timed ? std::to_string(measurement.fragments) : ""};
    for (const Counter counter : work) line.push_back(count_or_nothing(row, counter));
    line.push_back(measurement.checksum);
    if (times) {
      const auto growth = growth_at(comparison, i);
      line.push_back(timed ? report::shortest(measurement.seconds) : "");
      line.push_back(timed ? std::to_string(measurement.runs) : "");
      line.push_back(timed ? std::to_string(measurement.peak_bytes) : "");
      line.push_back(row.ratio ? report::shortest(*row.ratio) : "");
      line.push_back(growth ? report::shortest(*growth) : "");
    }
    line.push_back(row.command);
    report::append_csv_line(text, line);
  }
  return text;
}

}  // namespace gnomon::comparison
