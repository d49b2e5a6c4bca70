// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/repair_options.h"

#include <vector>

#include "cli/common/messages.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/repair.h"
#include "report/json/json_writer.h"
#include "report/text/number_text.h"
#include "report/text/text_sink.h"

namespace gnomon::cli {

namespace {

std::string counted_as(std::size_t count, const char* one, const char* many) {
  return report::grouped(count) + " " + (count == 1 ? one : many);
}

/// "a, b, c and 5 more".
std::string examples(const std::vector<std::string>& ids) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < ids.size() && i < kMost; ++i) text += (i == 0 ? "" : ", ") + ids[i];
  if (ids.size() > kMost) text += " and " + report::grouped(ids.size() - kMost) + " more";
  return text;
}

void write_ids(report::JsonWriter& json, const char* key, const std::vector<std::string>& ids) {
  json.key(key);
  json.begin_array(report::JsonLayout::kInline);
  for (const std::string& id : ids) json.value(id);
  json.end_array();
}

/// One object in one line, as "extra" takes it.
template <class Members>
std::string change(const char* name, const Members& members) {
  report::StringSink sink;
  report::JsonWriter json(sink);
  json.begin_object(report::JsonLayout::kInline);
  json.member("by", std::string("gnomon convert ") + name);
  members(json);
  json.end_object();
  json.finish();
  std::string text = sink.text();
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

void tell(const std::string& target, const std::string& text) { say(target + ": " + text); }

Expected<void> snap(Scene& scene, const std::string& typed, const std::string& target) {
  const auto distance = Number::parse(typed, NumberMeaning::kDecimal);
  if (!distance || distance->sign() <= 0) {
    return fail(ErrorCode::kUsage, "--snap " + typed + ": no distance", "a number above 0");
  }
  const auto report = snap_scene(scene, distance->exact());
  if (!report) return tl::unexpected(report.error());
  tell(target, "snapped within " + typed + ": " +
                   counted_as(report->merged_vertices, "vertex became", "vertices became") +
                   " one with another, " + counted_as(report->planes, "plane was", "planes were") +
                   " made of several, " +
                   counted_as(report->moved_vertices, "vertex moved", "vertices moved") + ", by " +
                   report::shortest(report->largest_movement) + " at most; " +
                   counted_as(report->rounds, "round", "rounds"));
  if (report->became_decimal) {
    tell(target,
         "the numbers are decimals now, since doubles cannot hold all points of the planes");
  }
  if (!report->settled) warn(target + ": something still moves; another --snap goes on");
  if (!report->folding.empty()) {
    warn(target + ": " + counted_as(report->folding.size(), "polygon", "polygons") +
         " would fold and stayed as it was: " + examples(report->folding));
  }
  if (report->pairs_left + report->bent_left > 0) {
    warn(target + ": " + counted_as(report->pairs_left, "pair", "pairs") +
         " of polygons within that distance of one plane and " +
         counted_as(report->bent_left, "bent polygon", "bent polygons") +
         " stayed as they were: no decimal numbers keep the planes of what they share");
  }
  note_change(scene, change("--snap", [&](report::JsonWriter& json) {
                json.member("distance", typed);
                json.member("merged_vertices", report->merged_vertices);
                json.member("planes", report->planes);
                json.member("moved_vertices", report->moved_vertices);
                json.member("largest_movement", report->largest_movement);
                json.member("became_decimal", report->became_decimal);
                json.member("pairs_left", report->pairs_left);
                json.member("bent_left", report->bent_left);
                write_ids(json, "would_fold", report->folding);
              }));
  return {};
}

Expected<void> make_parents(Scene& scene, const std::string& target) {
  const auto report = make_holes_of_windows(scene);
  if (!report) return tl::unexpected(report.error());
  std::vector<std::string> pairs;
  for (std::size_t i = 0; i < report->windows.size(); ++i) {
    pairs.push_back(report->windows[i] + " in " + report->walls[i]);
  }
  tell(target, counted_as(pairs.size(), "polygon is", "polygons are") +
                   " a hole of the one around it" + (pairs.empty() ? "" : ": " + examples(pairs)));
  if (!report->left.empty()) {
    warn(target + ": " + counted_as(report->left.size(), "polygon", "polygons") +
         " in another's plane and box did not become a hole: " + examples(report->left));
  }
  note_change(scene, change("--parent", [&](report::JsonWriter& json) {
                write_ids(json, "windows", report->windows);
                write_ids(json, "walls", report->walls);
              }));
  return {};
}

Expected<void> orient(Scene& scene, const std::string& target) {
  const auto report = orient_closed(scene);
  if (!report) return tl::unexpected(report.error());
  tell(target, counted_as(report->components, "closed component", "closed components") + ", " +
                   report::grouped(report->inwards) + " of them around a light; " +
                   counted_as(report->reversed.size(), "polygon", "polygons") + " turned over" +
                   (report->reversed.empty() ? "" : ": " + examples(report->reversed)));
  if (report->left > 0) {
    warn(target + ": " + counted_as(report->left, "closed component", "closed components") +
         " cannot look one way");
  }
  note_change(scene, change("--orient", [&](report::JsonWriter& json) {
                write_ids(json, "turned_over", report->reversed);
              }));
  return {};
}

}  // namespace

void add_repair_options(CLI::App& command, RepairOptions& options) {
  command
      .add_option("--snap", options.snap,
                  "Make vertices within this distance one, and polygons within it of one plane lie "
                  "in it,\nexactly; scene units")
      ->type_name("D");
  command.add_flag("--parent", options.parent,
                   "Make polygons that lie in another one holes of it: windows of their wall");
  command.add_flag("--orient", options.orient,
                   "Turn closed components outwards, and those around a light inwards");
}

Expected<void> repair(SceneAsRead& read, const SceneOptions& source, const RepairOptions& options,
                      const std::string& target) {
  Scene& scene = read.scene;
  if (!read.left_out.empty()) {
    std::vector<std::string> ids;
    for (const LeftOutPolygon& polygon : read.left_out) ids.push_back(polygon.id);
    note_change(scene, change("--skip-bad",
                              [&](report::JsonWriter& json) { write_ids(json, "left_out", ids); }));
  }
  const auto done = [&]() -> Expected<void> {
    if (!options.snap.empty()) {
      if (auto snapped = snap(scene, options.snap, target); !snapped) return snapped;
    }
    if (options.parent) {
      if (auto made = make_parents(scene, target); !made) return made;
    }
    if (options.orient) {
      if (auto oriented = orient(scene, target); !oriented) return oriented;
    }
    return {};
  }();
  if (!done) {
    return tl::unexpected(with_line_of_polygon(done.error(), source.scene, read_options(source)));
  }
  if (source.two_sided) {
    tell(target, "all polygons are two-sided");
    note_change(scene, change("--two-sided", [](report::JsonWriter&) {}));
  }
  return {};
}

}  // namespace gnomon::cli
