// SPDX-License-Identifier: GPL-3.0-or-later
#include "verdicts.h"

#include <fmt/format.h>
#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>

#include <algorithm>
#include <cmath>

#include "table.h"

namespace gnomon::bench {
namespace {

std::string with_unit(double value, Unit unit) {
  if (std::isnan(value)) return "-";
  switch (unit) {
    case Unit::kRatio:
      return short_number(value) + "x";
    case Unit::kSeconds:
      return short_number(value) + " s";
    case Unit::kExponent:
      return fmt::format("n^{:.2f}", value);
    case Unit::kGigabytes:
      return short_number(value) + " GB";
    case Unit::kShare:
      return fmt::format("{:.1f} %", 100 * value);
  }
  return {};
}

const char* name_of(Unit unit) {
  switch (unit) {
    case Unit::kRatio:
      return "ratio";
    case Unit::kSeconds:
      return "seconds";
    case Unit::kExponent:
      return "exponent";
    case Unit::kGigabytes:
      return "gigabytes";
    case Unit::kShare:
      return "share";
  }
  return "";
}

bool met(double value, const Target& target) {
  return target.at_least ? value >= target.limit : value <= target.limit;
}

/// Differences count for exponents, factors for everything else.
std::string verdict(double value, const Target& target) {
  if (std::isnan(value)) return "not measured";
  if (met(value, target)) return "met";
  if (target.unit == Unit::kExponent) return fmt::format("missed by {:.2f}", value - target.limit);
  return fmt::format("missed by {:.2f}x",
                     target.at_least ? target.limit / value : value / target.limit);
}

using Writer = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

void write_number_or_null(Writer& writer, double value) {
  if (std::isfinite(value)) {
    writer.Double(value);
  } else {
    writer.Null();
  }
}

}  // namespace

Target at_least(double ratio) { return {fmt::format("at least {}x", ratio), ratio, true}; }

Target at_most(double limit, Unit unit) {
  switch (unit) {
    case Unit::kRatio:
      return {fmt::format("at most {}x", limit), limit, false, unit};
    case Unit::kSeconds:
      return {fmt::format("at most {} s", limit), limit, false, unit};
    case Unit::kExponent:
      return {fmt::format("at most n^{}", limit), limit, false, unit};
    case Unit::kGigabytes:
      return {fmt::format("at most {} GB", limit), limit, false, unit};
    case Unit::kShare:
      return {fmt::format("at most {} %", 100 * limit), limit, false, unit};
  }
  return {};
}

void Verdicts::add(const std::string& work, const std::string& scene, const Target& target,
                   const std::vector<double>& measured, const std::string& note) {
  rows_.push_back({work, scene, target, measured, note});
}

void Verdicts::print() const {
  std::vector<std::string> header = {"work", "scene", "target"};
  header.insert(header.end(), columns_.begin(), columns_.end());
  header.emplace_back("verdict");
  const bool notes = std::ranges::any_of(rows_, [](const Row& row) { return !row.note.empty(); });
  if (notes) header.emplace_back("from");
  Table table(std::move(header));
  for (const Row& row : rows_) {
    std::vector<std::string> cells = {row.work, row.scene, row.target.text};
    for (const double value : row.measured) cells.push_back(with_unit(value, row.target.unit));
    cells.push_back(verdict(row.measured[judged_], row.target));
    if (notes) cells.push_back(row.note);
    table.add(std::move(cells));
  }
  fmt::print("\n{}\n", title_);
  table.print();
}

std::string Verdicts::json() const {
  rapidjson::StringBuffer buffer;
  Writer writer(buffer);
  const auto text = [&writer](const char* key, const std::string& value) {
    writer.Key(key);
    writer.String(value.c_str());
  };
  writer.SetIndent(' ', 1);
  writer.StartArray();
  for (const Row& row : rows_) {
    writer.StartObject();
    text("work", row.work);
    text("scene", row.scene);
    text("target", row.target.text);
    writer.Key("limit");
    writer.Double(row.target.limit);
    writer.Key("at_least");
    writer.Bool(row.target.at_least);
    text("unit", name_of(row.target.unit));
    writer.Key("measured");
    writer.StartObject();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      writer.Key(columns_[i].c_str());
      write_number_or_null(writer, row.measured[i]);
    }
    writer.EndObject();
    writer.Key("met");
    const double judged = row.measured[judged_];
    if (std::isnan(judged)) {
      writer.Null();
    } else {
      writer.Bool(met(judged, row.target));
    }
    text("note", row.note);
    writer.EndObject();
  }
  writer.EndArray();
  return buffer.GetString();
}

}  // namespace gnomon::bench
