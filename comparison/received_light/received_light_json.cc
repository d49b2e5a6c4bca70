// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/received_light/received_light.h"
#include "gnomon/result/classes.h"
#include "report/json/json_writer.h"

namespace gnomon::comparison {

namespace {

using report::JsonLayout;
using report::JsonWriter;

void write_illumination(JsonWriter& json, const char* key, const Illumination& illumination) {
  json.key(key);
  json.begin_object(JsonLayout::kInline);
  json.member("value", illumination.value);
  json.member("error_bound", illumination.error_bound);
  json.end_object();
}

void write_point(JsonWriter& json, const PointSight& point) {
  json.begin_object();
  json.key("point");
  json.begin_array(JsonLayout::kInline);
  for (const Number& coordinate : point.position) json.value(coordinate.to_text());
  json.end_array();
  json.member("sees", name_of(point.sight));
  json.member("in_front", point.in_front.get_str());
  json.member("visible", point.visible.get_str());
  json.member("visible_share", point.visible.get_d());
  write_illumination(json, "received", point.received);
  write_illumination(json, "without_casters", point.unobstructed);
  json.end_object();
}

void write_kernel(JsonWriter& json, const ReceivedLightReport& report,
                  const KernelReceipt& kernel) {
  json.begin_object();
  json.member("kernel", kernel.kernel);
  json.member("algorithm", kernel.algorithm);
  json.member("exact", kernel.exact);
  json.member("failed", kernel.failed(report.tolerance) || kernel.differs);
  if (!kernel.error.empty()) json.member("error", kernel.error);
  json.member("points", kernel.points);
  json.member("wrong", kernel.wrong);
  json.member("share_off", kernel.share_off);
  json.member("received_off", kernel.received_off);
  json.member("relative_off", kernel.relative_off);
  if (kernel.points > 0) json.member("worst_point", kernel.worst);
  json.end_object();
}

}  // namespace

std::string received_light_json(const ReceivedLightReport& report) {
  report::StringSink sink;
  JsonWriter json(sink);
  const Scene& scene = *report.scene;
  json.begin_object();
  json.member("format", "gnomon-received-light");
  json.member("version", 1);
  json.member("scene", scene.name.empty() ? scene.file : scene.name);
  json.member("light", scene.lights[report.receiver.light].id);
  json.member("polygon", scene.polygons[report.receiver.polygon].id);
  json.member("side", name_of(report.receiver.side));
  json.member("tolerance", report.tolerance);
  if (report.interrupted) json.member("interrupted", true);
  json.key("points");
  json.begin_array();
  for (const PointSight& point : report.points) write_point(json, point);
  json.end_array();
  json.key("kernels");
  json.begin_array();
  for (const KernelReceipt& kernel : report.kernels) write_kernel(json, report, kernel);
  json.end_array();
  json.end_object();
  json.finish();
  return sink.text();
}

}  // namespace gnomon::comparison
