// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/exact_answer.h"

#include <map>
#include <mutex>

#include "oracle/answer/truth_overlay.h"
#include "oracle/geometry/convex_loop.h"
#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

struct ExactAnswer::Data {
  struct PerLight {
    std::once_flag made, listed, seen;
    std::unique_ptr<PointRegions> regions;
    std::unique_ptr<AreaRegions> area_regions;
    std::unique_ptr<AreaVisibility> area_visibility;
    std::vector<AnswerEntry> entries;
    std::mutex mutex;
    std::map<std::uint32_t, std::vector<ShadowPiece>> shadows;
    std::map<std::pair<std::uint32_t, Side>, AreaShade> shades;
  };

  const Scene& scene;
  const PreparedScene& prepared;
  mutable std::vector<PerLight> lights;

  Data(const Scene& s, const PreparedScene& p) : scene(s), prepared(p), lights(p.lights.size()) {}
};

ExactAnswer::ExactAnswer(const Scene& scene, const PreparedScene& prepared)
    : data_(std::make_unique<Data>(scene, prepared)) {}
ExactAnswer::~ExactAnswer() = default;

const Scene& ExactAnswer::scene() const { return data_->scene; }
const PreparedScene& ExactAnswer::prepared() const { return data_->prepared; }

bool ExactAnswer::is_area(std::uint32_t light) const {
  return data_->prepared.lights[light].has_area();
}

const PointRegions& ExactAnswer::regions(std::uint32_t light) const {
  Data::PerLight& own = data_->lights[light];
  std::call_once(own.made, [&] {
    own.regions = std::make_unique<PointRegions>(data_->prepared, data_->prepared.lights[light]);
  });
  return *own.regions;
}

const AreaRegions& ExactAnswer::area_regions(std::uint32_t light) const {
  Data::PerLight& own = data_->lights[light];
  std::call_once(own.made, [&] {
    own.area_regions =
        std::make_unique<AreaRegions>(data_->prepared, data_->prepared.lights[light]);
  });
  return *own.area_regions;
}

const AreaVisibility& ExactAnswer::area_visibility(std::uint32_t light) const {
  Data::PerLight& own = data_->lights[light];
  std::call_once(own.seen, [&] {
    own.area_visibility =
        std::make_unique<AreaVisibility>(data_->prepared, data_->prepared.lights[light]);
  });
  return *own.area_visibility;
}

namespace {

/// Coplanar parts of one polygon, and the sides on which light can arrive.
struct PlaneGroup {
  ReceiverGroup group;
  std::array<bool, 2> sees{};  // front, back
};

/// Coplanar parts together; parts of one polygon in one plane are next to none or all of them.
std::vector<PlaneGroup> planes_of(const PreparedScene& prepared, std::uint32_t begin,
                                  std::uint32_t end) {
  std::vector<PlaneGroup> groups;
  std::vector<ExactPlane> planes;
  for (std::uint32_t part = begin; part < end; ++part) {
    const ExactPlane plane = support_of(prepared, part);
    std::size_t g = 0;
    while (g < groups.size() &&
           !(planes[g].normal == plane.normal && planes[g].offset == plane.offset)) {
      ++g;
    }
    if (g == groups.size()) {
      groups.emplace_back();
      planes.push_back(plane);
    }
    groups[g].group.parts.push_back(part);
  }
  return groups;
}

}  // namespace

const std::vector<AnswerEntry>& ExactAnswer::entries(std::uint32_t light) const {
  Data::PerLight& own = data_->lights[light];
  const bool area = is_area(light);
  if (area) {
    area_regions(light);
  } else {
    regions(light);
  }
  std::call_once(own.listed, [&] {
    const PreparedScene& prepared = data_->prepared;
    for (std::uint32_t polygon = 0; polygon + 1 < prepared.first_part.size(); ++polygon) {
      const std::uint32_t begin = prepared.first_part[polygon];
      const std::uint32_t end = prepared.first_part[polygon + 1];
      if (begin == end) continue;
      std::vector<PlaneGroup> groups = planes_of(prepared, begin, end);
      for (PlaneGroup& plane : groups) {
        if (!area) {
          const std::uint32_t part = plane.group.parts.front();
          const Side lit = own.regions->lit_side(part);
          plane.sees = {lit == Side::kFront, lit == Side::kBack};
          plane.group.light_in_plane = own.regions->light_in_plane(part);
          continue;
        }
        // Of coplanar parts some may lie behind the light: the others decide.
        for (std::uint32_t part : plane.group.parts) {
          plane.sees[0] = plane.sees[0] || own.area_regions->sees(part, Side::kFront);
          plane.sees[1] = plane.sees[1] || own.area_regions->sees(part, Side::kBack);
        }
      }
      // A polygon is listed once for each side that some plane of it sees the light from, or with
      // its front; a plane that sees nothing belongs to the first side listed.
      std::array<bool, 2> listed{};
      for (const PlaneGroup& plane : groups) {
        for (const int side : {0, 1}) listed[side] = listed[side] || plane.sees[side];
      }
      if (!listed[1]) listed[0] = true;
      const int first = listed[0] ? 0 : 1;
      for (const int side : {0, 1}) {
        if (!listed[side]) continue;
        AnswerEntry entry;
        entry.polygon = polygon;
        entry.side = side == 1 ? Side::kBack : Side::kFront;
        for (const PlaneGroup& plane : groups) {
          const bool dark = !plane.sees[0] && !plane.sees[1];
          entry.groups.push_back(plane.group);
          entry.groups.back().faces = plane.sees[side];
          entry.groups.back().optional = !plane.sees[side] && !(dark && side == first);
          entry.groups.back().side = entry.side;
        }
        own.entries.push_back(std::move(entry));
      }
    }
  });
  return own.entries;
}

const std::vector<ShadowPiece>& ExactAnswer::shadows(std::uint32_t light,
                                                     std::uint32_t part) const {
  Data::PerLight& own = data_->lights[light];
  const PointRegions& found = regions(light);
  {
    const std::lock_guard lock(own.mutex);
    const auto place = own.shadows.find(part);
    if (place != own.shadows.end()) return place->second;
  }
  std::vector<ShadowPiece> pieces;
  if (found.lit_side(part) != Side::kOn) pieces = found.shadows_on(part);
  const std::lock_guard lock(own.mutex);
  // Two threads may have computed the same; the first one's stays. Nodes of a map do not move.
  return own.shadows.try_emplace(part, std::move(pieces)).first->second;
}

const AreaShade& ExactAnswer::area_shade(std::uint32_t light, std::uint32_t part, Side side) const {
  Data::PerLight& own = data_->lights[light];
  const AreaRegions& found = area_regions(light);
  const std::pair key{part, side};
  {
    const std::lock_guard lock(own.mutex);
    const auto place = own.shades.find(key);
    if (place != own.shades.end()) return place->second;
  }
  AreaShade shade;
  if (found.sees(part, side)) {
    shade = found.shade_on(part, side);
  } else {
    const Chart chart(support_of(data_->prepared, part));
    shade.behind = loop_in_chart(chart, grid_loop(data_->prepared, part)).vertices;
  }
  const std::lock_guard lock(own.mutex);
  return own.shades.try_emplace(key, std::move(shade)).first->second;
}

void ExactAnswer::forget(std::uint32_t light) const {
  Data::PerLight& own = data_->lights[light];
  const std::lock_guard lock(own.mutex);
  own.shadows.clear();
  own.shades.clear();
}

TrueFractions ExactAnswer::group_fractions(std::uint32_t light, const ReceiverGroup& group,
                                           bool exact) const {
  GroupOverlay overlay(prepared(), group.parts, truth_of(*this, light, group));
  overlay.build();
  const std::size_t limit = exact ? static_cast<std::size_t>(-1) : 0;
  const auto share = [&](const GroupOverlay::Choice& choice) {
    return overlay.share([&](const Winding& w) { return w[kReceiver] != 0 && choice(w); }, limit);
  };
  TrueFractions result;
  result.lit = share([](const Winding& w) { return w[kTruth] == 0 && w[kTrueUmbra] == 0; });
  if (is_area(light)) {
    result.penumbra = share([](const Winding& w) { return w[kTruth] != 0 && w[kTrueUmbra] == 0; });
    result.umbra = share([](const Winding& w) { return w[kTrueUmbra] != 0; });
    result.shadow.exact = 0;
  } else {
    result.shadow = share([](const Winding& w) { return w[kTruth] != 0; });
    result.penumbra.exact = result.umbra.exact = 0;
  }
  return result;
}

TrueFractions ExactAnswer::fractions(std::uint32_t light, const AnswerEntry& entry,
                                     bool exact) const {
  ShareSum lit, shadow, penumbra, umbra;
  for (const ReceiverGroup& group : entry.groups) {
    if (group.optional) continue;
    const TrueFractions own = group_fractions(light, group, exact);
    const Enclosure whole = group_area(prepared(), group.parts);
    lit.add(own.lit, whole);
    shadow.add(own.shadow, whole);
    penumbra.add(own.penumbra, whole);
    umbra.add(own.umbra, whole);
  }
  return {lit.result(), shadow.result(), penumbra.result(), umbra.result()};
}

}  // namespace gnomon::oracle
