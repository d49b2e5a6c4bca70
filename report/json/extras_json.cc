// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/json/extras_json.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "kernel/signs/nearest_double.h"
#include "report/json/area_json.h"
#include "report/json/told_share.h"
#include "report/sides/count_shares.h"
#include "report/sides/group_sums.h"
#include "report/sides/lit_centroid.h"

namespace gnomon::report {

namespace {

/// Where a share is certain to less than this, one number says it all.
constexpr double kCertain = 1e-12;

}  // namespace

void ExtrasWriter::write_fraction(const Interval& share, const std::optional<mpq_class>& exact) {
  if (exact) {
    json_.member("fraction", exact->get_str());
    return;
  }
  json_.member("fraction", told_share(share));
  if (share.lower == share.upper || (!exact_ && share.upper - share.lower <= kCertain)) return;
  json_.key("enclosure");
  json_.begin_array(JsonLayout::kInline);
  json_.value(share.lower);
  json_.value(share.upper);
  json_.end_array();
}

void ExtrasWriter::write_side(const LightResult& light, std::size_t index,
                              const ClassifiedSide& side) {
  if (!extras_.counts.empty()) write_counts(extras_.counts[index], side);
  if (extras_.centroids) write_centroid(light, side);
}

void ExtrasWriter::write_counts(const CasterCounts& counts, const ClassifiedSide& side) {
  json_.key("counts");
  json_.begin_array(JsonLayout::kInline);
  for (const CountShare& own : count_shares(prepared_, counts, side.polygon, exact_, weights_)) {
    json_.begin_object(JsonLayout::kInline);
    json_.member("count", own.count);
    write_fraction(own.share, own.exact);
    if (own.exact || std::isfinite(own.share.middle())) {
      const mpq_class share = own.exact ? *own.exact : mpq_class(own.share.middle());
      write_area(json_,
                 own.exact ? areas_.nearest(side.polygon, share)
                           : areas_.nearest(side.polygon, own.share.middle()),
                 [&] { return mpq_class(share * precise_area(prepared_, side.polygon)); });
    } else {
      json_.key("area");
      json_.null();
    }
    json_.end_object();
  }
  json_.end_array();
}

void ExtrasWriter::write_centroid(const LightResult& light, const ClassifiedSide& side) {
  const auto centroid = lit_centroid(prepared_, light, side);
  if (!centroid) return;
  json_.key("lit_centroid");
  json_.begin_array(JsonLayout::kInline);
  for (const mpq_class& coordinate : centroid->point) json_.value(nearest_double(coordinate));
  json_.end_array();
  if (!exact_ || !centroid->exact) return;
  json_.key("exact_lit_centroid");
  json_.begin_array(JsonLayout::kInline);
  for (const mpq_class& coordinate : centroid->point) json_.value(coordinate.get_str());
  json_.end_array();
}

void ExtrasWriter::write_light(const LightResult& light) {
  if (extras_.groups.empty()) return;
  const bool area_light = prepared_.lights[light.light].has_area();
  json_.key("groups");
  json_.begin_array();
  for (const PolygonGroup& group : extras_.groups) {
    std::vector<ClassifiedSide> sides;
    for (const std::uint32_t polygon : group.polygons) {
      std::ranges::move(polygon_sides(prepared_, light, polygon, exact_, weights_),
                        std::back_inserter(sides));
    }
    std::vector<const ClassifiedSide*> members;
    for (const ClassifiedSide& side : sides) members.push_back(&side);
    const GroupSum sum = group_sum(prepared_, members, area_light, exact_);
    json_.begin_object(JsonLayout::kInline);
    json_.member("id", group.name);
    json_.member("polygons", group.polygons.size());
    json_.member("sides", sum.sides);
    write_area(json_, sum.area, [&] { return sum.precise_area; });
    for (const LightState state : light_states(area_light)) {
      const GroupShare& share = sum.of(state);
      json_.key(name_of(state));
      json_.begin_object(JsonLayout::kInline);
      write_fraction(share.share, share.exact);
      write_area(json_, share.area, [&] { return share.precise_area; });
      json_.end_object();
    }
    json_.end_object();
  }
  json_.end_array();
}

void ExtrasWriter::write_factors(std::string_view name, const std::vector<SideFactor>& factors,
                                 bool with_to) {
  if (factors.empty()) return;
  json_.key(name);
  json_.begin_array();
  for (const SideFactor& own : factors) {
    json_.begin_object(JsonLayout::kInline);
    json_.member(with_to ? "from" : "id", scene_.polygons[own.polygon].id);
    json_.member("side", name_of(own.side));
    if (with_to) json_.member("to", scene_.polygons[own.to].id);
    json_.member("factor", own.factor.value);
    json_.key("enclosure");
    json_.begin_array(JsonLayout::kInline);
    json_.value(own.factor.lower);
    json_.value(own.factor.upper);
    json_.end_array();
    json_.member("unobstructed", own.factor.unobstructed);
    json_.end_object();
  }
  json_.end_array();
}

void ExtrasWriter::write_result() {
  if (!extras_.sky.empty()) {
    json_.key("up");
    json_.begin_array(JsonLayout::kInline);
    for (const double component : extras_.up) json_.value(component);
    json_.end_array();
  }
  write_factors("sky", extras_.sky, false);
  write_factors("view_factors", extras_.view_factors, true);
}

}  // namespace gnomon::report
