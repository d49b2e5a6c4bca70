// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/result/shared_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace gnomon {

namespace {

bool names(const std::vector<std::string>& ids, const std::string& id) {
  return std::ranges::find(ids, id) != ids.end();
}

class SharedBlock {
 public:
  SharedBlock(const Claims& claims, const Scene& scene, Block block)
      : claims_(claims),
        scene_(scene),
        block_(block),
        polygons_(block == Block::kCombined ? *claims.combined : *claims.overlay) {
    for (const Light& light : scene.lights) known_.emplace(light.id, &light);
  }

  Claims make() {
    result_.name = claims_.name;
    choose_lights();
    std::unordered_set<std::string> ids;
    for (const Polygon& polygon : scene_.polygons) ids.insert(polygon.id);
    std::set<std::pair<std::string, Side>> listed;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
      const SharedPolygon& polygon = polygons_[i];
      const std::string place = fmt::format("/{}/{}", name_of(block_), i);
      if (!ids.contains(polygon.id)) {
        problem(place, fmt::format("no polygon '{}' in the scene", polygon.id));
      } else if (!listed.emplace(polygon.id, polygon.side).second) {
        problem(place, fmt::format("polygon '{}' ({}) is listed twice", polygon.id,
                                   name_of(polygon.side)));
      } else {
        add(polygon, place);
      }
    }
    return std::move(result_);
  }

 private:
  void problem(const std::string& place, const std::string& text) {
    result_.problems.push_back(fmt::format("{}: {}", place, text));
  }

  /// The lights that the block tells of, in the order of the result.
  void choose_lights() {
    const auto choose = [&](const std::string& id, bool per_caster_umbra) {
      const auto light = known_.find(id);
      if (light == known_.end()) return;  // told where the light is listed
      if (block_ == Block::kOverlay && light->second->has_area()) return;
      ClaimedLight& own = result_.lights.emplace_back();
      own.id = id;
      own.per_caster_umbra = per_caster_umbra;
      own.block = block_;
      if (block_ != Block::kOverlay) return;
      own.cover = Cover::kOverlay;
      own.background = LightState::kLit;
    };
    for (const ClaimedLight& light : claims_.lights) choose(light.id, light.per_caster_umbra);
    if (!claims_.lights.empty()) return;
    for (const Light& light : scene_.lights) choose(light.id, false);
  }

  /// One side under every light.
  void add(const SharedPolygon& polygon, const std::string& place) {
    for (std::size_t f = 0; f < polygon.fragments.size(); ++f) {
      const std::string own =
          fmt::format("{}/{}/{}", place, block_ == Block::kCombined ? "fragments" : "painted", f);
      block_ == Block::kCombined ? check_combined(polygon.fragments[f], own)
                                 : check_painted(polygon, polygon.fragments[f], own);
    }
    for (ClaimedLight& light : result_.lights) {
      ClaimedPolygon& side = light.polygons.emplace_back();
      side.id = polygon.id;
      side.side = polygon.side;
      side.side_given = polygon.side_given;
      for (const SharedFragment& fragment : polygon.fragments) {
        ClaimedFragment& one = side.fragments.emplace_back();
        static_cast<ClaimedShape&>(one) = fragment;
        one.level = fragment.level;
        one.state = state_of(fragment, light.id);
      }
    }
  }

  LightState state_of(const SharedFragment& fragment, const std::string& light) const {
    if (block_ == Block::kOverlay) {
      return names(fragment.dark_for, light) ? LightState::kShadow : LightState::kLit;
    }
    if (names(fragment.lit_by, light)) return LightState::kLit;
    if (names(fragment.penumbra_of, light)) return LightState::kPenumbra;
    return known_.at(light)->has_area() ? LightState::kUmbra : LightState::kShadow;
  }

  /// Lights of the scene; `area`: the only kind that may stand there, if any.
  void check_lights(const std::vector<std::string>& ids, std::optional<bool> area,
                    const std::string& place) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto light = known_.find(ids[i]);
      const std::string own = fmt::format("{}/{}", place, i);
      if (light == known_.end()) {
        problem(own, fmt::format("no light '{}' in the scene", ids[i]));
      } else if (area && light->second->has_area() != *area) {
        problem(own, fmt::format("light '{}' is {}", ids[i],
                                 *area ? "no area light and has no penumbra"
                                       : "an area light, and an overlay tells of point and "
                                         "directional ones"));
      } else if (std::ranges::find(result_.lights, ids[i], &ClaimedLight::id) ==
                 result_.lights.end()) {
        problem(own, fmt::format("light '{}' is none of the result's lights", ids[i]));
      }
    }
  }

  void check_combined(const SharedFragment& fragment, const std::string& place) {
    check_lights(fragment.lit_by, std::nullopt, place + "/lit_by");
    check_lights(fragment.penumbra_of, true, place + "/penumbra_of");
    for (const std::string& light : fragment.penumbra_of) {
      if (!names(fragment.lit_by, light)) continue;
      problem(place, fmt::format("light '{}' is in both lit_by and penumbra_of", light));
    }
  }

  /// A loop lies above the one that it was cut from, and no light comes back.
  void check_painted(const SharedPolygon& polygon, const SharedFragment& fragment,
                     const std::string& place) {
    check_lights(fragment.dark_for, false, place + "/dark_for");
    if (!fragment.on) return;
    if (*fragment.on >= polygon.fragments.size()) {
      return problem(place + "/on", fmt::format("there is no painted loop {}", *fragment.on));
    }
    const SharedFragment& owner = polygon.fragments[*fragment.on];
    if (owner.level >= fragment.level) {
      problem(place + "/on",
              fmt::format("the owner's level {} is not below {}", owner.level, fragment.level));
    }
    for (const std::string& light : owner.dark_for) {
      if (names(fragment.dark_for, light)) continue;
      problem(place + "/dark_for",
              fmt::format("light '{}' is missing, for which the owner is dark", light));
    }
  }

  const Claims& claims_;
  const Scene& scene_;
  Block block_;
  const std::vector<SharedPolygon>& polygons_;
  std::unordered_map<std::string, const Light*> known_;
  Claims result_;
};

}  // namespace

std::vector<Claims> shared_claims(const Claims& claims, const Scene& scene) {
  std::vector<Claims> blocks;
  if (claims.combined) blocks.push_back(SharedBlock(claims, scene, Block::kCombined).make());
  if (claims.overlay) blocks.push_back(SharedBlock(claims, scene, Block::kOverlay).make());
  return blocks;
}

}  // namespace gnomon
