// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "report/certificate/certificate.h"
#include "report/certificate/decisions.h"
#include "report/certificate/wrong_share.h"
#include "report/json/area_json.h"
#include "report/json/json_writer.h"

namespace gnomon::report {

namespace {

constexpr double kLeast = 0x1p-960;  // below it bounds of a double are no longer close
constexpr int kFacingDigits = 13;    // that are sure

void write_enclosure(JsonWriter& json, std::string_view name, const oracle::Enclosure& enclosure) {
  json.key(name);
  json.begin_array(JsonLayout::kInline);
  json.value(enclosure.lower);
  json.value(enclosure.upper);
  json.end_array();
}

/// Bounds of an area, and as text beside them where doubles do not tell it. `relative`: the same in
/// shares of the square over the scene's box.
void write_area_bounds(JsonWriter& json, const std::string& name, const oracle::Enclosure& area,
                       const oracle::Enclosure& relative, const WrongShare& scale) {
  constexpr double kUnsure = 0x1p-44;  // of the shares
  write_enclosure(json, name, area);
  if (relative.is_zero() || (std::isfinite(area.upper) && area.upper > kLeast)) return;
  json.key(name + "_decimal");
  json.begin_array(JsonLayout::kInline);
  json.value(decimal_text(mpq_class(relative.lower * (1 - kUnsure)) * scale.unit()));
  json.value(decimal_text(mpq_class(relative.upper * (1 + kUnsure)) * scale.unit()));
  json.end_array();
}

/// `polygon`: the area of all of it, in shares of the square over the scene's box.
void write_share(JsonWriter& json, std::string_view name, const oracle::AreaShare& share,
                 double polygon, const WrongShare& scale) {
  json.key(name);
  json.begin_object(JsonLayout::kInline);
  json.member("zero", share.zero);
  if (share.exact) json.member("exact", share.exact->get_str());
  write_enclosure(json, "fraction", share.fraction);
  write_area_bounds(json, "area", share.area,
                    {share.fraction.lower * polygon, share.fraction.upper * polygon}, scale);
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

using ShareOf = oracle::AreaShare oracle::PolygonComparison::*;

/// The sum of such shares of all sides, in shares of the square over the scene's box. What is true
/// is counted once, however often it is told: of the first block alone.
oracle::Enclosure relative_total(const oracle::Report& report,
                                 std::initializer_list<ShareOf> shares, bool first_block,
                                 const WrongShare& scale) {
  oracle::Enclosure sum{0, 0};
  for (const oracle::LightComparison& light : report.lights) {
    if (first_block && light.block != report.lights.front().block) continue;
    for (const oracle::PolygonComparison& side : light.polygons) {
      const double area = scale.area_of(side.polygon);
      for (const ShareOf share : shares) {
        sum.lower += (side.*share).fraction.lower * area;
        sum.upper += (side.*share).fraction.upper * area;
      }
    }
  }
  return sum;
}

void write_total_areas(JsonWriter& json, const oracle::Report& report, bool area_lights,
                       const WrongShare& scale) {
  using Polygon = oracle::PolygonComparison;
  const oracle::ComparisonTotals& totals = report.totals;
  const auto write = [&](const char* name, const oracle::Enclosure& area,
                         std::initializer_list<ShareOf> shares, bool true_one) {
    write_area_bounds(json, name, oracle::not_negative(area),
                      relative_total(report, shares, true_one, scale), scale);
  };
  write("area", totals.area, {&Polygon::lit, &Polygon::shadow, &Polygon::penumbra, &Polygon::umbra},
        true);
  write("lit", totals.lit, {&Polygon::lit}, true);
  write("shadow", totals.shadow, {&Polygon::shadow}, true);
  if (area_lights) {
    write("penumbra", totals.penumbra, {&Polygon::penumbra}, true);
    write("umbra", totals.umbra, {&Polygon::umbra}, true);
    write("missing_umbra", totals.missing_umbra, {&Polygon::missing_umbra}, false);
  }
  write("misclassified", totals.misclassified, {&Polygon::misclassified}, false);
  write("uncovered", totals.uncovered, {&Polygon::uncovered}, false);
  write("overlapping", totals.overlapping, {&Polygon::overlapping}, false);
  write("outside", totals.outside, {&Polygon::outside}, false);
  write("ill_conditioned", totals.ill_conditioned, {&Polygon::ill_conditioned}, false);
  write("rounding", totals.rounding, {&Polygon::rounding}, false);
}

/// `area_lights`: there are some.
void write_totals(JsonWriter& json, const oracle::Report& report, const WrongShare& scale,
                  bool area_lights) {
  const oracle::ComparisonTotals& totals = report.totals;
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
  json.member("wrong_share", scale.of(report));
  json.member("by_borders", totals.by_borders);
  write_total_areas(json, report, area_lights, scale);
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
void write_wrong_polygons(JsonWriter& json, const Scene& scene, const oracle::Report& report,
                          const WrongShare& scale) {
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
      const double area = scale.area_of(polygon.polygon);
      const auto write = [&](std::string_view name, const oracle::AreaShare& share) {
        write_share(json, name, share, area, scale);
      };
      write("lit", polygon.lit);
      if (is_area(light.id)) {
        write("penumbra", polygon.penumbra);
        write("umbra", polygon.umbra);
        write("missing_umbra", polygon.missing_umbra);
      } else {
        write("shadow", polygon.shadow);
      }
      write("misclassified", polygon.misclassified);
      write("uncovered", polygon.uncovered);
      write("overlapping", polygon.overlapping);
      write("outside", polygon.outside);
      write("ill_conditioned", polygon.ill_conditioned);
      write("rounding", polygon.rounding);
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

void write_run(JsonWriter& json, const NamedScene& named, const WrongShare& scale,
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
    write_totals(json, report, scale, has_area_light(scene));
    write_wrong_polygons(json, scene, report, scale);
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
  const WrongShare scale(certificate);
  json.member("facing_area", certificate.facing_area);
  if (scale.facing() > 0 && !tells(certificate.facing_area)) {
    json.member("facing_area_decimal",
                decimal_text(mpq_class(scale.facing()) * scale.unit(), kFacingDigits));
  }
  write_texts(json, "scene_findings", certificate.scene_findings);
  if (certificate.interrupted) json.member("interrupted", true);
  json.key("runs");
  json.begin_array();
  for (const JudgedRun& run : certificate.runs)
    write_run(json, {&scene, certificate.prepared}, scale, run, times);
  json.end_array();
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
