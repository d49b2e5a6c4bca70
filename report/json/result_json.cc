// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/json/result_json.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/signs/nearest_double.h"
#include "report/json/area_json.h"
#include "report/json/extras_json.h"
#include "report/json/json_writer.h"
#include "report/json/told_share.h"
#include "report/sides/part_area.h"
#include "report/sides/polygon_sides.h"
#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

/// Where a share is certain to less than this, one number says it all.
constexpr double kTight = 1e-12;

class ResultWriter {
 public:
  ResultWriter(JsonWriter& json, const Scene& scene, const PreparedScene& prepared,
               const ShadowResult& result, const ResultJsonOptions& options)
      : json_(json),
        scene_(scene),
        prepared_(prepared),
        result_(result),
        options_(options),
        areas_(prepared),
        weights_(prepared) {
    if (options.extras == nullptr) return;
    extras_.emplace(json_, scene, prepared, *options.extras, areas_, weights_,
                    options.exact_fractions);
  }

  void write() {
    json_.begin_object();
    json_.member("format", "gnomon-result");
    json_.member("version", 1);
    json_.member("scene", scene_.name);
    json_.member("geometry", options_.geometry_digest);
    json_.member("kernel", result_.kernel);
    json_.member("algorithm", result_.algorithm);
    json_.member("exact", result_.exact);
    json_.member("identity", result_.identity);
    json_.member("thickness", result_.thickness);
    write_dropped();
    json_.key("lights");
    json_.begin_array();
    for (const LightResult& light : result_.lights) write_light(light);
    json_.end_array();
    if (options_.combined) write_combined();
    if (options_.overlay) write_overlay();
    if (extras_) extras_->write_result();
    write_findings();
    json_.end_object();
  }

 private:
  void write_dropped() {
    json_.key("dropped");
    json_.begin_array();
    for (const PreparationNote& note : prepared_.notes) {
      if (note.repair != Repair::kZeroArea) continue;
      json_.begin_object(JsonLayout::kInline);
      json_.member("id", scene_.polygons[note.polygon].id);
      json_.member("detail", note.detail);
      json_.end_object();
    }
    json_.end_array();
  }

  /// The ids of the lights whose bits are set.
  void write_lights(std::string_view name, std::uint64_t bits) {
    json_.key(name);
    json_.begin_array(JsonLayout::kInline);
    for (std::size_t light = 0; light < result_.lights.size(); ++light) {
      if (bits >> light & 1) json_.value(light_id(result_.lights[light]));
    }
    json_.end_array();
  }

  /// Entries that are grouped by polygon and side, one object a group with the group's list.
  /// `write_one` gets the index of an entry and of the first of its group.
  template <class Entry, class WriteOne>
  void write_by_side(std::string_view name, std::string_view list,
                     const std::vector<Entry>& entries, const WriteOne& write_one) {
    const auto polygon_of = [&](const Entry& entry) { return prepared_.parts[entry.part].polygon; };
    json_.key(name);
    json_.begin_array();
    for (std::size_t i = 0; i < entries.size();) {
      const std::size_t first = i;
      json_.begin_object();
      json_.member("id", scene_.polygons[polygon_of(entries[first])].id);
      json_.member("side", name_of(entries[first].side));
      json_.key(list);
      json_.begin_array();
      for (; i < entries.size() && polygon_of(entries[i]) == polygon_of(entries[first]) &&
             entries[i].side == entries[first].side;
           ++i) {
        json_.begin_object(JsonLayout::kInline);
        write_one(i, first);
        json_.end_object();
      }
      json_.end_array();
      json_.end_object();
    }
    json_.end_array();
  }

  /// Fragments of each polygon's side with the lights that reach all of them, and those that they
  /// are in the penumbra of: the pipeline of lights.
  void write_combined() {
    const bool any_area = std::ranges::any_of(
        result_.lights, [&](const LightResult& light) { return is_area(light); });
    write_by_side("combined", "fragments", result_.combined, [&](std::size_t i, std::size_t) {
      const CombinedFragment& fragment = result_.combined[i];
      write_lights("lit_by", fragment.lit_by);
      if (any_area) write_lights("penumbra_of", fragment.penumbra_of);
      write_loops(result_.combined_points, result_.combined_exact_points, fragment.first,
                  fragment.count);
    });
  }

  /// Loops painted on each polygon's side by level. An owner is named by its place in the list.
  void write_overlay() {
    write_by_side("overlay", "painted", result_.overlay, [&](std::size_t i, std::size_t first) {
      const PaintedPolygon& painted = result_.overlay[i];
      json_.member("level", painted.level);
      write_lights("dark_for", painted.dark_for);
      json_.member("on",
                   painted.on == PaintedPolygon::kNoOwner
                       ? -1
                       : static_cast<std::int64_t>(painted.on) - static_cast<std::int64_t>(first));
      write_loops(result_.overlay_points, result_.overlay_exact_points, painted.first,
                  painted.count);
    });
  }

  void write_findings() {
    for (const LightResult& light : result_.lights) {
      if (light.dropped_slivers == 0) continue;
      findings_.push_back("light " + light_id(light) + ": " +
                          std::to_string(light.dropped_slivers) +
                          " loops vanished in rounding and were dropped");
    }
    if (findings_.empty()) return;
    json_.key("findings");
    json_.begin_array();
    for (const std::string& finding : findings_) json_.value(finding);
    json_.end_array();
  }

  std::string light_id(const LightResult& light) const {
    return light_name(scene_, prepared_, light);
  }

  bool is_area(const LightResult& light) const { return prepared_.lights[light.light].has_area(); }

  void write_light(const LightResult& light) {
    json_.begin_object();
    json_.member("id", light_id(light));
    // Umbra is where one caster alone hides all of the light.
    if (is_area(light)) json_.member("umbra", "per-caster");
    write_piece(light);
    write_terms(light);
    const FacingShare facing = facing_share(prepared_, light);
    json_.key("facing");
    json_.begin_object(JsonLayout::kInline);
    json_.member("polygons", facing.facing);
    json_.member("away", facing.away);
    json_.member("light_in_plane", facing.in_plane);
    json_.member("away_share", facing.away_share());
    json_.end_object();
    json_.key("polygons");
    json_.begin_array();
    if (options_.sides != nullptr) {
      const auto index = static_cast<std::size_t>(&light - result_.lights.data());
      for (const ClassifiedSide& side : (*options_.sides)[index]) write_side(light, side);
    } else {
      write_sides(light);
    }
    json_.end_array();
    if (extras_) extras_->write_light(light);
    json_.end_object();
  }

  /// What a light's piece was cut from, and where it is.
  void write_piece(const LightResult& light) {
    if (light.piece == LightResult::kWhole) return;
    json_.member("piece_of", scene_.lights[prepared_.lights[light.light].light].id);
    write_loop("exact_loop", light.piece_loop,
               [&](const auto& point) { write_exact_point(point); });
  }

  /// How fragments are meant: whether they are painted over each other, and what is true of all
  /// that they leave out. One class that is left out is that of all the rest; of several, only
  /// membership in the classes that are listed is told.
  void write_terms(const LightResult& light) {
    if (light.cover != Cover::kPartition) json_.member("cover", name_of(light.cover));
    if (light.background) json_.member("background", name_of(*light.background));
    if (!leaves_out(light)) return;
    std::vector<LightState> listed, left;
    for (const LightState state : light_states(is_area(light))) {
      (is_listed(light, state) ? listed : left).push_back(state);
    }
    if (left.size() == 1) {
      json_.member("background", name_of(left.front()));
      return;
    }
    json_.key("listed");
    json_.begin_array(JsonLayout::kInline);
    for (const LightState state : listed) json_.value(name_of(state));
    json_.end_array();
  }

  /// Polygon by polygon: all sides of a large scene at once would take more room than its result.
  void write_sides(const LightResult& light) {
    for (std::uint32_t polygon = 0; polygon + 1 < prepared_.first_part.size(); ++polygon) {
      if (options_.interrupted != nullptr && *options_.interrupted) break;
      for (const ClassifiedSide& side :
           polygon_sides(prepared_, light, polygon, options_.exact_fractions, weights_)) {
        write_side(light, side);
      }
    }
  }

  void write_side(const LightResult& light, const ClassifiedSide& side) {
    const bool has_parts = side.parts.size() > 1 && !side.coplanar;
    const bool lines = options_.fragments || options_.exact_loops || has_parts;
    const std::string& id = scene_.polygons[side.polygon].id;
    json_.begin_object(lines ? JsonLayout::kLines : JsonLayout::kInline);
    json_.member("id", id);
    json_.member("side", name_of(side.side));
    const double area = areas_.nearest(side.polygon);
    write_area(json_, area, [&] { return precise_area(prepared_, side.polygon); });
    for (const LightState state : light_states(side.area_light)) {
      write_share(state, light, side, area);
    }
    if (side.area_light && !options_.deep_umbra.empty()) {
      const auto index = static_cast<std::size_t>(&light - result_.lights.data());
      const Interval deep = deep_umbra_share(prepared_, light, side, options_.deep_umbra[index]);
      json_.key("deep_umbra");
      json_.begin_object(JsonLayout::kInline);
      json_.member("lower", deep.lower);
      json_.member("upper", deep.upper);
      json_.end_object();
    }
    if (extras_) {
      extras_->write_side(light, static_cast<std::size_t>(&light - result_.lights.data()), side);
    }
    if (side.reason != ShadowReason::kNone) json_.member("reason", name_of(side.reason));
    if (has_parts) write_parts(side);
    if (options_.fragments || options_.exact_loops) write_fragments(light, side);
    json_.end_object();
  }

  void write_bounds(std::string_view key, double lower, double upper) {
    json_.key(key);
    json_.begin_array(JsonLayout::kInline);
    json_.value(lower);
    json_.value(upper);
    json_.end_array();
  }

  /// A whole that has no one exact fraction says how certain its number is: the nearest double, and
  /// its neighbours.
  void write_precise_share(const ClassifiedSide& side, LightState state) {
    const mpq_class share = precise_share(prepared_, side, state);
    const double nearest = nearest_double(share);
    json_.member("fraction", nearest);
    if (share == 0) {
      write_bounds("enclosure", 0, 0);
    } else {
      write_bounds("enclosure", std::nextafter(nearest, 0.0),
                   std::min(1.0, std::nextafter(nearest, 2.0)));
    }
    write_area_of(side, areas_.nearest(side.polygon, share), share);
  }

  /// Of a share of a side, a double or a rational.
  template <class Share>
  void write_area_of(const ClassifiedSide& side, double nearest, const Share& share) {
    write_area(json_, nearest, [&]() -> mpq_class {
      if (share == 0) return 0;  // the usual reason for an area of 0
      return mpq_class(share) * precise_area(prepared_, side.polygon);
    });
  }

  /// `area`: of the whole side.
  void write_share(LightState state, const LightResult& light, const ClassifiedSide& side,
                   double area) {
    const std::string_view name = name_of(state);
    const Interval& share = share_of(side, state);
    const std::optional<mpq_class>& exact = exact_share_of(side, state);
    json_.key(name);
    json_.begin_object(JsonLayout::kInline);
    if (options_.exact_fractions && exact) {
      json_.member("fraction", exact->get_str());
    } else if (options_.exact_fractions) {
      write_precise_share(side, state);
      json_.end_object();
      return;
    } else {
      if (!std::isfinite(share.middle())) {
        find("light " + light_id(light) + ", polygon " + scene_.polygons[side.polygon].id +
             ": its " + std::string(name) + " fraction is not a number");
      }
      json_.member("fraction", told_share(share));
      if (share.upper - share.lower > kTight) {
        write_bounds("enclosure", share.lower, share.upper);
      }
    }
    if (share.lower == share.upper && (share.lower == 0 || share.lower == 1)) {
      write_area_of(side, share.lower == 0 ? 0.0 : area, share.lower);
    } else if (exact) {
      write_area_of(side, areas_.nearest(side.polygon, *exact), *exact);
    } else if (std::isfinite(share.middle())) {
      write_area_of(side, areas_.nearest(side.polygon, share.middle()), share.middle());
    } else {
      json_.key("area");
      json_.null();
    }
    json_.end_object();
  }

  /// Of a part's shares those that one number does not tell.
  void write_enclosures(const ClassifiedSide& side, const PartSide& part) {
    if (options_.exact_fractions) return;
    bool is_open = false;
    for (const LightState state : light_states(side.area_light)) {
      const Interval& share = share_of(part, state);
      if (!(share.upper - share.lower > kTight)) continue;
      if (!is_open) {
        json_.key("enclosures");
        json_.begin_object(JsonLayout::kInline);
        is_open = true;
      }
      write_bounds(name_of(state), share.lower, share.upper);
    }
    if (is_open) json_.end_object();
  }

  void write_parts(const ClassifiedSide& side) {
    json_.key("parts");
    json_.begin_array();
    const std::uint32_t first = prepared_.first_part[side.polygon];
    for (std::uint32_t i = 0; i < side.parts.size(); ++i) {
      const PartSide& part = side.parts[i];
      json_.begin_object(JsonLayout::kInline);
      json_.member("part", i);
      const Part& own = prepared_.parts[first + i];
      write_area(json_, nearest_area(prepared_, own), [&] { return precise_area(prepared_, own); });
      for (const LightState state : light_states(side.area_light)) {
        if (options_.exact_fractions) {
          json_.member(name_of(state), exact_share(part, state).get_str());
        } else {
          json_.member(name_of(state), told_share(share_of(part, state)));
        }
      }
      write_enclosures(side, part);
      if (part.reason != ShadowReason::kNone) json_.member("reason", name_of(part.reason));
      json_.end_object();
    }
    json_.end_array();
  }

  void write_fragments(const LightResult& light, const ClassifiedSide& side) {
    json_.key("fragments");
    json_.begin_array();
    const std::uint32_t first = prepared_.first_part[side.polygon];
    for (std::uint32_t i = 0; i < side.parts.size(); ++i) {
      const PartSide& part = side.parts[i];
      if (part.reason != ShadowReason::kNone) {
        const LightState dark = side.area_light ? LightState::kUmbra : LightState::kShadow;
        if (is_listed(light, dark)) write_whole_part(prepared_.parts[first + i], dark, part.reason);
        continue;
      }
      for (std::uint32_t f = 0; f < part.result->fragment_count; ++f) {
        const Fragment& fragment = light.fragments[part.result->first_fragment + f];
        if (is_listed(light, fragment.state)) write_fragment(light, fragment);
      }
    }
    json_.end_array();
  }

  /// Where loops hide others, or stand before a background, all of them are needed.
  bool leaves_out(const LightResult& light) const {
    return options_.only && light.cover == Cover::kPartition && !light.background;
  }

  /// kShadow stands for all that is not lit.
  bool is_listed(const LightResult& light, LightState state) const {
    return !leaves_out(light) || *options_.only == state ||
           (*options_.only == LightState::kShadow && state != LightState::kLit);
  }

  void write_point(const std::array<double, 3>& point) {
    json_.begin_array(JsonLayout::kInline);
    for (double coordinate : point) {
      if (!std::isfinite(coordinate)) find("a fragment has a vertex that is not a number");
      json_.value(coordinate);
    }
    json_.end_array();
  }

  void write_exact_point(const std::array<mpq_class, 3>& point) {
    json_.begin_array(JsonLayout::kInline);
    for (const mpq_class& coordinate : point) json_.value(coordinate.get_str());
    json_.end_array();
  }

  template <class Points, class Write>
  void write_loop(std::string_view name, const Points& points, Write write) {
    json_.key(name);
    json_.begin_array(JsonLayout::kInline);
    for (const auto& point : points) write(point);
    json_.end_array();
  }

  void write_loops(const std::vector<std::array<double, 3>>& points,
                   const std::vector<std::array<mpq_class, 3>>& exact_points, std::uint32_t first,
                   std::uint32_t count) {
    if (!points.empty()) {
      write_loop("loop", std::span(points).subspan(first, count),
                 [&](const auto& point) { write_point(point); });
    }
    if (options_.exact_loops && !exact_points.empty()) {
      write_loop("exact_loop", std::span(exact_points).subspan(first, count),
                 [&](const auto& point) { write_exact_point(point); });
    }
  }

  void write_whole_part(const Part& part, LightState dark, ShadowReason reason) {
    const Geometry& geometry = prepared_.geometry;
    json_.begin_object(JsonLayout::kInline);
    json_.member("class", name_of(dark));
    if (options_.fragments) {
      write_loop("loop", prepared_.loop(part),
                 [&](VertexId vertex) { write_point(geometry.positions[vertex]); });
    }
    if (options_.exact_loops) {
      write_loop("exact_loop", prepared_.loop(part), [&](VertexId vertex) {
        std::array<mpq_class, 3> point;
        for (int k = 0; k < 3; ++k) {
          point[k] = geometry.origin[k] + geometry.step * geometry.grid.at(vertex, k);
        }
        write_exact_point(point);
      });
    }
    json_.member("reason", name_of(reason));
    json_.end_object();
  }

  void write_fragment(const LightResult& light, const Fragment& fragment) {
    json_.begin_object(JsonLayout::kInline);
    json_.member("class", name_of(fragment.state));
    write_loops(light.points, light.exact_points, fragment.first, fragment.count);
    if (fragment.caster != Fragment::kNoCaster) {
      json_.member("caster", scene_.polygons[prepared_.parts[fragment.caster].polygon].id);
    }
    if (fragment.casters != Fragment::kNoCaster) {
      json_.key("casters");
      json_.begin_array(JsonLayout::kInline);
      for (const std::string& id :
           caster_ids(scene_, prepared_, light.caster_sets[fragment.casters])) {
        json_.value(id);
      }
      json_.end_array();
    }
    if (fragment.reason != ShadowReason::kNone) {
      json_.member("reason", name_of(fragment.reason));
    }
    json_.end_object();
  }

  void find(std::string finding) {
    // A scene that breaks a kernel breaks it everywhere; a few places say enough.
    constexpr std::size_t kMost = 20;
    if (findings_.size() < kMost && (findings_.empty() || findings_.back() != finding)) {
      findings_.push_back(std::move(finding));
    }
  }

  JsonWriter& json_;
  const Scene& scene_;
  const PreparedScene& prepared_;
  const ShadowResult& result_;
  const ResultJsonOptions& options_;
  PolygonAreas areas_;
  PartWeights weights_;
  std::optional<ExtrasWriter> extras_;
  std::vector<std::string> findings_;
};

}  // namespace

void write_result_json(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                       const ShadowResult& result, const ResultJsonOptions& options) {
  JsonWriter json(sink);
  write_result_object(json, scene, prepared, result, options);
  json.finish();
}

void write_result_object(JsonWriter& json, const Scene& scene, const PreparedScene& prepared,
                         const ShadowResult& result, const ResultJsonOptions& options) {
  ResultWriter(json, scene, prepared, result, options).write();
}

}  // namespace gnomon::report
