// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "report/certificate/certificate.h"
#include "report/certificate/decisions.h"
#include "report/certificate/wrong_share.h"
#include "report/json/json_writer.h"

namespace gnomon::report {

namespace {

void write_enclosure(JsonWriter& json, std::string_view name, const oracle::Enclosure& enclosure) {
  json.key(name);
  json.begin_array(JsonLayout::kInline);
  json.value(enclosure.lower);
  json.value(enclosure.upper);
  json.end_array();
}

void write_share(JsonWriter& json, std::string_view name, const oracle::AreaShare& share) {
  json.key(name);
  json.begin_object(JsonLayout::kInline);
  json.member("zero", share.zero);
  if (share.exact) json.member("exact", share.exact->get_str());
  write_enclosure(json, "fraction", share.fraction);
  write_enclosure(json, "area", share.area);
  json.end_object();
}

void write_texts(JsonWriter& json, std::string_view name, const std::vector<std::string>& texts) {
  json.key(name);
  json.begin_array();
  for (const std::string& text : texts) json.value(text);
  json.end_array();
}

void write_witness(JsonWriter& json, const oracle::Witness& witness) {
  json.begin_object();
  if (witness.block != Block::kLights) json.member("block", name_of(witness.block));
  json.member("light", witness.light);
  json.member("polygon", witness.polygon);
  json.member("side", name_of(witness.side));
  json.member("error", name_of(witness.kind));
  if (witness.kind != oracle::ErrorKind::kNone && !witness.is_of_side()) {
    json.key("point");
    json.begin_array(JsonLayout::kInline);
    for (double coordinate : witness.nearest) json.value(coordinate);
    json.end_array();
    json.key("exact_point");
    json.begin_array(JsonLayout::kInline);
    for (const mpq_class& coordinate : witness.point) json.value(coordinate.get_str());
    json.end_array();
    json.key("found");
    witness.found ? json.value(name_of(*witness.found)) : json.null();
    json.key("true");
    witness.truth ? json.value(name_of(*witness.truth)) : json.null();
    if (!witness.caster.empty()) json.member("caster", witness.caster);
    write_enclosure(json, "width", witness.width);
    json.key("clearance");
    witness.clearance ? json.value(*witness.clearance) : json.null();
  }
  if (!witness.text.empty()) json.member("text", witness.text);
  json.end_object();
}

/// `areas`: there are area lights.
void write_totals(JsonWriter& json, const oracle::ComparisonTotals& totals, double wrong_share,
                  bool areas) {
  json.key("totals");
  json.begin_object();
  json.member("polygons", totals.polygons);
  json.member("wrong_polygons", totals.wrong_polygons);
  json.member("fragments", totals.fragments);
  json.member("regions", totals.regions);
  json.member("ill_conditioned_regions", totals.ill_conditioned_regions);
  json.member("rounding_regions", totals.rounding_regions);
  json.member("invented", totals.invented);
  json.member("lost", totals.lost);
  json.member("t_vertices", totals.t_vertices);
  json.member("self_crossing", totals.self_crossing);
  json.member("worst_misclassified", totals.worst_misclassified);
  json.member("worst_uncovered", totals.worst_uncovered);
  json.member("worst_overlapping", totals.worst_overlapping);
  json.member("worst_outside", totals.worst_outside);
  json.member("worst_share", totals.worst_share());
  json.member("wrong_share", wrong_share);
  json.member("by_borders", totals.by_borders);
  write_enclosure(json, "area", totals.area);
  write_enclosure(json, "lit", totals.lit);
  write_enclosure(json, "shadow", totals.shadow);
  if (areas) {
    write_enclosure(json, "penumbra", totals.penumbra);
    write_enclosure(json, "umbra", totals.umbra);
    write_enclosure(json, "missing_umbra", totals.missing_umbra);
  }
  write_enclosure(json, "misclassified", totals.misclassified);
  write_enclosure(json, "uncovered", totals.uncovered);
  write_enclosure(json, "overlapping", totals.overlapping);
  write_enclosure(json, "outside", totals.outside);
  write_enclosure(json, "ill_conditioned", totals.ill_conditioned);
  write_enclosure(json, "rounding", totals.rounding);
  json.member("rounding_radius", totals.rounding_radius);
  write_enclosure(json, "width", totals.width);
  write_enclosure(json, "off_plane", totals.off_plane);
  json.end_object();
}

bool has_area_light(const Scene& scene) {
  return std::ranges::any_of(scene.lights, [](const Light& light) { return light.has_area(); });
}

bool is_wrong(const oracle::PolygonComparison& polygon) {
  return polygon.regions > 0 || polygon.off_plane.upper > 0 || polygon.self_crossing > 0 ||
         polygon.inconsistent;
}

/// The polygon sides that are not exactly right; all others are.
void write_wrong_polygons(JsonWriter& json, const Scene& scene, const oracle::Report& report) {
  const auto is_area = [&](const std::string& id) {
    return std::ranges::any_of(
        scene.lights, [&](const Light& light) { return light.id == id && light.has_area(); });
  };
  json.key("wrong");
  json.begin_array();
  for (const oracle::LightComparison& light : report.lights) {
    for (const oracle::PolygonComparison& polygon : light.polygons) {
      if (!is_wrong(polygon)) continue;
      json.begin_object();
      if (light.block != Block::kLights) json.member("block", name_of(light.block));
      json.member("light", light.id);
      json.member("polygon", polygon.polygon);
      json.member("side", name_of(polygon.side));
      json.member("fragments", polygon.fragments);
      json.member("regions", polygon.regions);
      json.member("invented", polygon.invented);
      json.member("lost", polygon.lost);
      json.member("t_vertices", polygon.t_vertices);
      json.member("self_crossing", polygon.self_crossing);
      if (polygon.inconsistent) json.member("inconsistent", true);
      write_share(json, "lit", polygon.lit);
      if (is_area(light.id)) {
        write_share(json, "penumbra", polygon.penumbra);
        write_share(json, "umbra", polygon.umbra);
        write_share(json, "missing_umbra", polygon.missing_umbra);
      } else {
        write_share(json, "shadow", polygon.shadow);
      }
      write_share(json, "misclassified", polygon.misclassified);
      write_share(json, "uncovered", polygon.uncovered);
      write_share(json, "overlapping", polygon.overlapping);
      write_share(json, "outside", polygon.outside);
      write_share(json, "ill_conditioned", polygon.ill_conditioned);
      write_share(json, "rounding", polygon.rounding);
      write_enclosure(json, "width", polygon.width);
      write_enclosure(json, "off_plane", polygon.off_plane);
      if (!polygon.worst.empty()) {
        json.key("worst");
        write_witness(json, polygon.worst.front().witness);
      }
      if (polygon.worst.size() > 1) {
        json.key("others");
        json.begin_array();
        for (std::size_t i = 1; i < polygon.worst.size(); ++i) {
          write_witness(json, polygon.worst[i].witness);
        }
        json.end_array();
      }
      json.end_object();
    }
  }
  json.end_array();
}

void write_run(JsonWriter& json, const NamedScene& named, const WrongShare& wrong_share,
               const JudgedRun& run, bool times) {
  const Scene& scene = *named.scene;
  json.begin_object();
  if (run.foreign) {
    json.member("candidate", run.name);
  } else {
    json.member("kernel", run.kernel);
    json.member("algorithm", run.algorithm);
    json.member("exact", run.exact);
    json.member("identity", run.identity);
    json.member("thickness", run.thickness);
    json.member("vanished_loops", run.dropped_slivers);
  }
  json.member("fragments", run.fragments);
  if (times && !run.foreign) json.member("cpu_seconds", run.cpu_seconds);
  if (!run.error.empty()) json.member("error", run.error);
  if (run.report) {
    const oracle::Report& report = *run.report;
    json.member("verdict", name_of(report.verdict));
    if (!run.counts) json.member("counts", false);
    json.member("reason", report.reason);
    if (!report.excess.empty()) json.member("excess", report.excess);
    json.member("tolerance", report.tolerance);
    if (report.told_shares > 0) {
      json.member("told_shares", report.told_shares);
      json.key("share_tolerance");
      report.share_tolerance ? json.value(*report.share_tolerance) : json.value("digits");
    }
    json.member("width", report.width);
    json.member("clearance", report.clearance);
    json.member("diagonal", report.diagonal);
    if (report.oracle_fault) json.member("oracle_fault", true);
    if (report.interrupted) json.member("interrupted", true);
    if (report.by_points) {
      json.key("points");
      json.begin_object(JsonLayout::kInline);
      json.member("checked", report.points_checked);
      json.member("wrong", report.points_wrong);
      json.member("on_boundary", report.points_on_boundary);
      json.member("pairs", report.pairs);
      json.member("most_pairs", report.most_pairs);
      json.end_object();
    }
    json.key("worst");
    if (report.worst) {
      write_witness(json, *report.worst);
    } else {
      json.null();
    }
    write_texts(json, "problems", report.problems);
    write_texts(json, "notes", report.notes);
    write_totals(json, report.totals, wrong_share.of(report), has_area_light(scene));
    write_wrong_polygons(json, scene, report);
  }
  if (!run.explanation.empty()) json.member("first_difference", run.explanation);
  if (run.decisions) {
    json.key("decisions");
    write_decisions(json, *run.decisions, run.kernel, named);
  }
  json.end_object();
}

}  // namespace

void write_certificate_json(TextSink& sink, const Certificate& certificate, bool times) {
  JsonWriter json(sink);
  const Scene& scene = *certificate.scene;
  json.begin_object();
  json.member("format", "gnomon-certificate");
  json.member("version", 1);
  json.member("scene", scene.name);
  json.member("geometry", certificate.geometry_digest);
  json.member("numbers", scene.numbers == NumberMeaning::kDecimal ? "decimal" : "double");
  json.member("polygons", scene.polygons.size());
  json.member("parts", certificate.prepared->parts.size());
  write_texts(json, "lights", certificate.lights);
  json.member("facing_area", certificate.facing_area);
  write_texts(json, "scene_findings", certificate.scene_findings);
  if (certificate.interrupted) json.member("interrupted", true);
  const WrongShare wrong_share(certificate);
  json.key("runs");
  json.begin_array();
  for (const JudgedRun& run : certificate.runs)
    write_run(json, {&scene, certificate.prepared}, wrong_share, run, times);
  json.end_array();
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
