// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/exact_answer.h"

#include <map>
#include <mutex>

#include "group_overlay.h"

namespace gnomon::oracle {

struct ExactAnswer::Data {
  struct PerLight {
    std::once_flag made, listed;
    std::unique_ptr<PointRegions> regions;
    std::vector<AnswerEntry> entries;
    std::mutex mutex;
    std::map<std::uint32_t, std::vector<ShadowPiece>> shadows;
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

const PointRegions& ExactAnswer::regions(std::uint32_t light) const {
  Data::PerLight& own = data_->lights[light];
  std::call_once(own.made, [&] {
    own.regions = std::make_unique<PointRegions>(data_->prepared, data_->prepared.lights[light]);
  });
  return *own.regions;
}

const std::vector<AnswerEntry>& ExactAnswer::entries(std::uint32_t light) const {
  Data::PerLight& own = data_->lights[light];
  if (data_->prepared.lights[light].type == LightType::kArea) return own.entries;
  const PointRegions& found = regions(light);
  std::call_once(own.listed, [&] {
    const PreparedScene& prepared = data_->prepared;
    for (std::uint32_t polygon = 0; polygon + 1 < prepared.first_part.size(); ++polygon) {
      const std::uint32_t begin = prepared.first_part[polygon];
      const std::uint32_t end = prepared.first_part[polygon + 1];
      if (begin == end) continue;
      // Coplanar parts together; parts of one polygon in one plane are next to none or all of them.
      std::vector<ReceiverGroup> groups;
      std::vector<ExactPlane> planes;
      std::vector<Side> sides;
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
          sides.push_back(found.lit_side(part));
          groups[g].faces = sides[g] != Side::kOn;
          groups[g].light_in_plane = found.light_in_plane(part);
        }
        groups[g].parts.push_back(part);
      }
      for (const Side side : {Side::kFront, Side::kBack}) {
        AnswerEntry entry;
        entry.polygon = polygon;
        entry.side = side == Side::kBack ? PolygonSide::kBack : PolygonSide::kFront;
        bool asked = false;
        for (std::size_t g = 0; g < groups.size(); ++g) {
          const Side own_side = sides[g] == Side::kBack ? Side::kBack : Side::kFront;
          entry.groups.push_back(groups[g]);
          entry.groups.back().optional = own_side != side;
          if (own_side != side) entry.groups.back().faces = false;
          asked = asked || own_side == side;
        }
        if (asked) own.entries.push_back(std::move(entry));
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

void ExactAnswer::forget(std::uint32_t light) const {
  Data::PerLight& own = data_->lights[light];
  const std::lock_guard lock(own.mutex);
  own.shadows.clear();
}

TrueFractions ExactAnswer::group_fractions(std::uint32_t light, const ReceiverGroup& group,
                                           bool exact) const {
  GroupOverlay overlay(*this, light, group);
  overlay.build();
  const auto is_lit = [](const Winding& w) { return w[kReceiver] != 0 && w[kTruth] == 0; };
  const auto is_shadow = [](const Winding& w) { return w[kReceiver] != 0 && w[kTruth] != 0; };
  const std::size_t limit = exact ? static_cast<std::size_t>(-1) : 0;
  return {overlay.share(is_lit, limit), overlay.share(is_shadow, limit)};
}

TrueFractions ExactAnswer::fractions(std::uint32_t light, const AnswerEntry& entry,
                                     bool exact) const {
  ShareSum lit, shadow;
  for (const ReceiverGroup& group : entry.groups) {
    if (group.optional) continue;
    const TrueFractions own = group_fractions(light, group, exact);
    const Enclosure whole = group_area(prepared(), group);
    lit.add(own.lit, whole);
    shadow.add(own.shadow, whole);
  }
  return {lit.result(), shadow.result()};
}

}  // namespace gnomon::oracle
