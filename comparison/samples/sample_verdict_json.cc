// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "comparison/samples/sample_verdict.h"
#include "comparison/verdicts_json.h"
#include "gnomon/result/classes.h"
#include "report/json/json_writer.h"

namespace gnomon::comparison {

namespace {

using oracle::SampleOutcome;
using report::JsonLayout;
using report::JsonWriter;

void write_counts(JsonWriter& json, const SampleCounts& counts) {
  json.key("samples");
  json.begin_object(JsonLayout::kInline);
  json.member("all", counts.all());
  for (std::size_t i = 0; i < oracle::kSampleOutcomes; ++i) {
    std::string key = oracle::name_of(static_cast<SampleOutcome>(i));
    std::ranges::replace(key, '-', '_');
    json.member(key, counts.of[i]);
  }
  json.member("too_light", counts.too_light);
  json.member("too_dark", counts.too_dark);
  json.member("out_of_range", counts.out_of_range());
  json.end_object();
}

void write_point(JsonWriter& json, const char* key, const RationalPoint& point) {
  json.key(key);
  json.begin_array(JsonLayout::kInline);
  for (const mpq_class& coordinate : point) json.value(coordinate.get_d());
  json.end_array();
}

void write_places(JsonWriter& json, const SampleVerdict& verdict) {
  const SamplePlaces& places = verdict.places;
  json.key("places");
  json.begin_object(JsonLayout::kInline);
  json.member("moved", places.moved);
  json.member("farthest", places.farthest);
  json.member("farthest_line", places.farthest_line);
  json.member("without_polygon", places.found);
  json.member("of_several", places.several);
  json.end_object();
}

void write_miss(JsonWriter& json, const SampleMiss& miss, const Scene& scene,
                const PreparedScene& prepared) {
  const oracle::JudgedSample& judged = miss.judged;
  json.begin_object();
  json.member("line", miss.row.line);
  json.member("outcome", oracle::name_of(judged.outcome));
  json.member("light", scene.lights[miss.row.sample.light].id);
  json.member("polygon", scene.polygons[judged.polygon].id);
  if (miss.row.sample.side) json.member("side", gnomon::name_of(*miss.row.sample.side));
  write_point(json, "point", miss.row.sample.point);
  if (judged.moved > 0) {
    write_point(json, "place", judged.place);
    json.member("moved", judged.moved);
  }
  json.member("found", miss.row.visible.value);
  json.member("true", judged.truth.get_d());
  constexpr std::size_t kLongest = 200;
  if (const std::string exact = judged.truth.get_str(); exact.size() <= kLongest) {
    json.member("exact", exact);
  }
  json.member("off", judged.off);
  json.member("allowed", miss.row.sample.allowed);
  if (judged.out_of_range) json.member("out_of_range", true);
  if (miss.cause.caster) {
    json.member("caster", scene.polygons[prepared.parts[*miss.cause.caster].polygon].id);
  }
  if (judged.from_border) json.member("from_border", *judged.from_border);
  json.member("within_width", judged.outcome == SampleOutcome::kNearBorder);
  if (miss.cause.clearance) json.member("clearance", *miss.cause.clearance);
  json.end_object();
}

void write_all(JsonWriter& json, const char* key, const char* name,
               const std::vector<CountsOf>& all) {
  json.key(key);
  json.begin_array();
  for (const CountsOf& own : all) {
    json.begin_object(JsonLayout::kInline);
    json.member(name, own.id);
    write_counts(json, own.counts);
    json.end_object();
  }
  json.end_array();
}

void write_run(JsonWriter& json, const SampleVerdict& verdict, const Scene& scene,
               const PreparedScene& prepared) {
  json.begin_object();
  json.member("candidate", verdict.file);
  json.member("verdict", verdict.failed() ? "failed" : "samples agree");
  json.member("reason", verdict.failed() ? fmt::format("{} of {} samples are wrong",
                                                       verdict.counts.wrong(), verdict.judged())
                                         : std::string());
  json.member("told_samples", verdict.samples);
  if (verdict.left_out > 0) json.member("left_out", verdict.left_out);
  json.member("width", verdict.width);
  json.member("clearance", verdict.clearance);
  json.key("share_tolerance");
  verdict.tolerance ? json.value(*verdict.tolerance) : json.value("digits");
  if (verdict.interrupted) json.member("interrupted", true);
  json.key("passed_over");
  json.begin_array(JsonLayout::kInline);
  for (const std::string& name : verdict.passed_over) json.value(name);
  json.end_array();
  write_counts(json, verdict.counts);
  write_places(json, verdict);
  json.key("misses");
  json.begin_array();
  for (const SampleMiss& miss : verdict.misses) write_miss(json, miss, scene, prepared);
  json.end_array();
  write_all(json, "lights", "light", verdict.lights);
  write_all(json, "polygons", "polygon", verdict.polygon_counts);
  json.end_object();
}

}  // namespace

void write_sample_verdicts_json(report::TextSink& sink, const std::vector<SampleVerdict>& verdicts,
                                const Scene& scene, const PreparedScene& prepared) {
  write_verdicts_json(sink, verdicts, [&](JsonWriter& json, const SampleVerdict& verdict) {
    write_run(json, verdict, scene, prepared);
  });
}

}  // namespace gnomon::comparison
