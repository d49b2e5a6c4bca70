// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "comparison/engine_tables/table_verdict.h"
#include "comparison/verdicts_json.h"
#include "report/json/json_writer.h"
#include "report/text/csv_field.h"
#include "report/text/number_text.h"

namespace gnomon::comparison {

namespace {

using report::JsonLayout;
using report::JsonWriter;

void write_names(JsonWriter& json, const char* key, const std::vector<std::string>& names) {
  json.key(key);
  json.begin_array();
  for (const std::string& name : names) json.value(name);
  json.end_array();
}

void write_counts(JsonWriter& json, const WrongCounts& wrong) {
  json.key("wrong");
  json.begin_object(JsonLayout::kInline);
  json.member("all", wrong.all());
  json.member("value", wrong.value);
  json.member("night", wrong.night);
  json.member("range", wrong.range);
  json.end_object();
}

void write_hours(JsonWriter& json, const SunSum& hours) {
  json.member("hours_found", hours.found);
  json.member("hours_true", hours.truth);
  json.member("difference", hours.difference());
}

void write_suns(JsonWriter& json, const TableVerdict& verdict) {
  json.key("suns");
  json.begin_object(JsonLayout::kInline);
  json.member("of", verdict.suns ? "place" : "table");
  if (verdict.suns) {
    const suns::YearOptions& suns = *verdict.suns;
    constexpr std::array<const char*, 3> kPlaces{"start", "middle", "end"};
    json.member("model", suns::name_of(suns.model));
    json.member("latitude", suns.place.latitude);
    json.member("longitude", suns.place.longitude);
    json.member("zone_minutes", suns.place.zone.count());
    json.member("sun_at", kPlaces[static_cast<std::size_t>(suns.sun_at)]);
    json.member("average_days", suns.average_days);
    json.member("refraction", suns.refraction);
    json.member("north", suns.north);
  }
  json.member("rows_up", verdict.suns_up);
  json.end_object();
}

void write_table(JsonWriter& json, const TableVerdict& verdict) {
  json.key("table");
  json.begin_object(JsonLayout::kInline);
  json.member("form", verdict.form == TableForm::kEnergyPlus ? "surface-name" : "suns");
  json.member("rows", verdict.rows);
  json.member("judged_rows", verdict.judged_rows);
  json.member("first", verdict.first);
  json.member("last", verdict.last);
  json.member("step_minutes", verdict.step.count());
  json.member("columns", verdict.columns);
  json.member("decimals", verdict.decimals);
  json.end_object();
}

void write_witness(JsonWriter& json, const TableVerdict& verdict, const TableWitness& witness) {
  const JudgedSurface& surface = verdict.surfaces[witness.surface];
  json.begin_object();
  json.member("polygon", surface.polygon);
  json.member("side", gnomon::name_of(surface.side));
  if (surface.gross) json.member("gross", true);
  json.member("error", name_of(witness.value.kind));
  json.member("time", witness.time);
  json.member("sun_time", witness.sun_time);
  json.key("sun");
  json.begin_array(JsonLayout::kInline);
  for (const std::int32_t component : witness.sun) json.value(component / 1e6);
  json.end_array();
  json.member("found", witness.value.found.value);
  json.member("found_text", text_of(witness.value.found));
  json.member("true", witness.value.truth);
  if (witness.truth && witness.truth->exact) {
    json.member("exact", witness.truth->exact->get_str());
  }
  json.member("off", witness.value.off);
  json.member("allowed", witness.value.allowed);
  if (witness.truth) {
    json.member("faces", witness.truth->faces);
    json.key("casters");
    json.begin_array();
    constexpr std::size_t kMost = 3;
    for (std::size_t i = 0; i < std::min(kMost, witness.truth->casters.size()); ++i) {
      json.begin_object(JsonLayout::kInline);
      json.member("polygon", witness.truth->casters[i].polygon);
      json.member("share", witness.truth->casters[i].share);
      json.end_object();
    }
    json.end_array();
  }
  json.end_object();
}

void write_surfaces(JsonWriter& json, const TableVerdict& verdict) {
  json.key("surfaces");
  json.begin_array();
  for (const JudgedSurface& surface : verdict.surfaces) {
    json.begin_object(JsonLayout::kInline);
    json.member("polygon", surface.polygon);
    json.member("side", gnomon::name_of(surface.side));
    if (surface.gross) json.member("gross", true);
    write_counts(json, surface.wrong);
    write_hours(json, surface.hours);
    json.end_object();
  }
  json.end_array();
}

void write_run(JsonWriter& json, const TableVerdict& verdict) {
  json.begin_object();
  json.member("candidate", verdict.file);
  json.member("verdict", verdict.failed() ? "failed" : "shares agree");
  json.member("reason", verdict.failed() ? fmt::format("{} of {} values are wrong",
                                                       verdict.wrong.all(), verdict.values)
                                         : std::string());
  json.member("told_shares", verdict.values);
  json.key("share_tolerance");
  verdict.tolerance ? json.value(*verdict.tolerance) : json.value("digits");
  if (verdict.oracle_fault) json.member("oracle_fault", true);
  if (verdict.interrupted) json.member("interrupted", true);
  write_table(json, verdict);
  write_suns(json, verdict);
  write_names(json, "unknown_columns", verdict.unknown);
  write_names(json, "untold_sides", verdict.untold);
  write_counts(json, verdict.wrong);
  json.key("worst");
  json.begin_array();
  for (const TableWitness& witness : verdict.worst) write_witness(json, verdict, witness);
  json.end_array();
  write_surfaces(json, verdict);
  json.end_object();
}

}  // namespace

void write_table_verdicts_json(report::TextSink& sink, const std::vector<TableVerdict>& verdicts) {
  write_verdicts_json(sink, verdicts, write_run);
}

std::string table_verdicts_csv(const std::vector<TableVerdict>& verdicts) {
  std::string text;
  report::append_csv_line(text, {"table", "surface", "polygon", "side", "wrong", "wrong_at_night",
                                 "out_of_range", "hours_found", "hours_true"});
  for (const TableVerdict& verdict : verdicts) {
    for (const JudgedSurface& surface : verdict.surfaces) {
      report::append_csv_line(
          text, {verdict.file, surface.name, surface.polygon, gnomon::name_of(surface.side),
                 std::to_string(surface.wrong.value), std::to_string(surface.wrong.night),
                 std::to_string(surface.wrong.range), report::shortest(surface.hours.found),
                 report::shortest(surface.hours.truth)});
    }
  }
  return text;
}

}  // namespace gnomon::comparison
