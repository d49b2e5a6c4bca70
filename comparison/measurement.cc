// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/measurement.h"

#include <algorithm>
#include <array>
#include <utility>

#include "report/json/json_writer.h"
#include "scene/json/json_members.h"

namespace gnomon::comparison {

namespace {

using report::JsonLayout;

constexpr std::array<std::pair<RunEnd, std::string_view>, 7> kEnds = {
    {{RunEnd::kMeasured, "measured"},
     {RunEnd::kRefused, "refused"},
     {RunEnd::kLimit, "limit"},
     {RunEnd::kTime, "time limit"},
     {RunEnd::kMemory, "memory limit"},
     {RunEnd::kCrashed, "crashed"},
     {RunEnd::kNotRun, "not run"}}};

constexpr std::array<const char*, 8> kStages = {"by_identity",  "by_filter",   "by_64_bits",
                                                "by_128_bits",  "by_256_bits", "by_512_bits",
                                                "by_1024_bits", "by_gmp"};

std::optional<RunEnd> end_by_name(std::string_view name) {
  for (const auto& [end, own] : kEnds) {
    if (own == name) return end;
  }
  return std::nullopt;
}

/// `write` fills the object; the text has no line break.
template <class Write>
std::string inline_object(const Write& write) {
  report::StringSink sink;
  {
    report::JsonWriter json(sink);
    json.begin_object(JsonLayout::kInline);
    write(json);
    json.end_object();
  }
  return sink.text();
}

Judgement read_judgement(JsonMembers& members) {
  Judgement judgement;
  members.read("verdict", judgement.verdict);
  members.read("confirms", judgement.confirms);
  members.read("by_points", judgement.by_points);
  members.read("wrong", judgement.wrong);
  members.read("worst_share", judgement.worst_share);
  members.read("width", judgement.width);
  members.read("diagonal", judgement.diagonal);
  members.read("invented", judgement.invented);
  members.read("lost", judgement.lost);
  members.read("breaks", judgement.breaks);
  members.read("reason", judgement.reason);
  return judgement;
}

}  // namespace

std::string_view name_of(RunEnd end) {
  return std::ranges::find(kEnds, end, &std::pair<RunEnd, std::string_view>::first)->second;
}

std::string request_text(const RunRequest& request) {
  return inline_object([&](report::JsonWriter& json) {
    json.member("scene", request.scene);
    json.member("size", request.size.value_or(0));
    json.member("seed", request.seed);
    json.member("system", request.system);
    json.member("kernel", request.kernel);
    json.member("area", request.lights == LightsAsked::kArea);
    json.member("has_thickness", request.thickness.has_value());
    json.member("thickness", request.thickness.value_or(0));
    json.member("change", request.change);
    json.member("points", request.points);
    json.member("stages", request.stages);
    json.member("repeat", request.repeat);
    json.member("certify_up_to", request.certify_up_to);
  });
}

Expected<RunRequest> parse_request(std::string_view text) {
  const auto document = parse_json_object(text, {});
  if (!document) return tl::unexpected(document.error());
  JsonMembers members(*document, {}, {}, "a request of a comparison");
  RunRequest request;
  std::uint64_t size = 0;
  bool area = false, has_thickness = false;
  double thickness = 0;
  members.read("scene", request.scene);
  members.read("size", size);
  members.read("seed", request.seed);
  members.read("system", request.system);
  members.read("kernel", request.kernel);
  members.read("area", area);
  members.read("has_thickness", has_thickness);
  members.read("thickness", thickness);
  members.read("change", request.change);
  members.read("points", request.points);
  members.read("stages", request.stages);
  members.read("repeat", request.repeat);
  members.read("certify_up_to", request.certify_up_to);
  if (members.error()) return tl::unexpected(*members.error());
  if (size > 0) request.size = size;
  if (has_thickness) request.thickness = thickness;
  request.lights = area ? LightsAsked::kArea : LightsAsked::kPoint;
  return request;
}

std::string measurement_text(const Measurement& measurement) {
  return inline_object([&](report::JsonWriter& json) {
    json.member("end", name_of(measurement.end));
    json.member("why", measurement.why);
    json.member("polygons", measurement.polygons);
    json.member("parts", measurement.parts);
    json.member("lights", measurement.lights);
    json.member("position_bits", measurement.position_bits);
    json.member("direction_bits", measurement.direction_bits);
    json.member("fragments", measurement.fragments);
    json.member("nodes", measurement.nodes);
    json.member("seconds", measurement.seconds);
    json.member("runs", measurement.runs);
    json.member("peak_bytes", measurement.peak_bytes);
    json.member("checksum", measurement.checksum);
    json.member("exact", measurement.exact);
    json.key("work");
    json.begin_object(JsonLayout::kInline);
    for (const CounterInfo& info : counter_infos()) {
      json.member(info.name, measurement.work[info.counter]);
    }
    json.end_object();
    for (std::size_t i = 0; i < kStages.size(); ++i) {
      json.member(kStages[i], measurement.decided_by[i]);
    }
    json.member("changed", measurement.difference.has_value());
    if (measurement.difference) {
      json.member("sides", measurement.difference->sides);
      json.member("differs", measurement.difference->worst_share);
      json.member("where", measurement.difference->worst);
    }
    json.member("judged", measurement.judgement.has_value());
    if (!measurement.judgement) return;
    const Judgement& judgement = *measurement.judgement;
    json.member("verdict", judgement.verdict);
    json.member("confirms", judgement.confirms);
    json.member("by_points", judgement.by_points);
    json.member("wrong", judgement.wrong);
    json.member("worst_share", judgement.worst_share);
    json.member("width", judgement.width);
    json.member("diagonal", judgement.diagonal);
    json.member("invented", judgement.invented);
    json.member("lost", judgement.lost);
    json.member("breaks", judgement.breaks);
    json.member("reason", judgement.reason);
  });
}

Expected<Measurement> parse_measurement(std::string_view text) {
  const auto document = parse_json_object(text, {});
  if (!document) return tl::unexpected(document.error());
  JsonMembers members(*document, {}, {}, "a measurement of a comparison");
  Measurement measurement;
  std::string end;
  bool judged = false, changed = false;
  members.read("end", end);
  members.read("why", measurement.why);
  members.read("polygons", measurement.polygons);
  members.read("parts", measurement.parts);
  members.read("lights", measurement.lights);
  members.read("position_bits", measurement.position_bits);
  members.read("direction_bits", measurement.direction_bits);
  members.read("fragments", measurement.fragments);
  members.read("nodes", measurement.nodes);
  members.read("seconds", measurement.seconds);
  members.read("runs", measurement.runs);
  members.read("peak_bytes", measurement.peak_bytes);
  members.read("checksum", measurement.checksum);
  members.read("exact", measurement.exact);
  JsonMembers work = members.object("work");
  for (const CounterInfo& info : counter_infos()) {
    work.read(std::string(info.name).c_str(), measurement.work[info.counter]);
  }
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    members.read(kStages[i], measurement.decided_by[i]);
  }
  members.read("changed", changed);
  if (changed) {
    Difference& difference = measurement.difference.emplace();
    members.read("sides", difference.sides);
    members.read("differs", difference.worst_share);
    members.read("where", difference.worst);
  }
  members.read("judged", judged);
  if (judged) measurement.judgement = read_judgement(members);
  const auto known = end_by_name(end);
  if (known) {
    measurement.end = *known;
  } else {
    members.reject("end");
  }
  if (members.error()) return tl::unexpected(*members.error());
  if (work.error()) return tl::unexpected(*work.error());
  return measurement;
}

}  // namespace gnomon::comparison
