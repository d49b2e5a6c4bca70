// SPDX-License-Identifier: GPL-3.0-or-later
// The translation of results into claims, which all other tests lean on as the command does, held
// against a second one that was written apart from it.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "fuzz/generate/area_families.h"
#include "fuzz/generate/families.h"
#include "solve.h"

namespace gnomon::test {
namespace {

class SecondTranslation {
 public:
  explicit SecondTranslation(const Case& scene) : scene_(scene), prepared_(scene.prepared()) {}

  ClaimedLight claims_of(const LightResult& light) const {
    ClaimedLight found;
    found.id = scene_.scene().lights[prepared_.lights[light.light].light].id;
    found.per_caster_umbra = scene_.is_area(light.light);
    // The results of each part: one, or one for each side that sees an area light.
    std::vector<std::vector<const PartResult*>> results(prepared_.parts.size());
    for (const PartResult& part : light.parts) results[part.part].push_back(&part);
    for (std::uint32_t polygon = 0; polygon < scene_.scene().polygons.size(); ++polygon) {
      std::set<Side, std::greater<>> sides;  // front first
      for_each_part(polygon, [&](std::uint32_t part) {
        for (const PartResult* own : results[part]) {
          if (own->reason == ShadowReason::kNone) sides.insert(own->side);
        }
      });
      if (prepared_.first_part[polygon] == prepared_.first_part[polygon + 1]) continue;
      if (sides.empty()) sides.insert(Side::kFront);
      for (const Side side : sides) {
        ClaimedPolygon& entry = found.polygons.emplace_back();
        entry.id = scene_.scene().polygons[polygon].id;
        entry.side = side;
        for_each_part(polygon, [&](std::uint32_t part) {
          add_part(light, results[part], part, side, entry.fragments);
        });
      }
    }
    return found;
  }

 private:
  template <class Visit>
  void for_each_part(std::uint32_t polygon, const Visit& visit) const {
    for (std::uint32_t part = prepared_.first_part[polygon];
         part < prepared_.first_part[polygon + 1]; ++part) {
      visit(part);
    }
  }

  void add_part(const LightResult& light, const std::vector<const PartResult*>& results,
                std::uint32_t part, Side side, std::vector<ClaimedFragment>& fragments) const {
    for (const PartResult* own : results) {
      if (own->reason != ShadowReason::kNone || own->side != side) continue;
      for (std::uint32_t i = 0; i < own->fragment_count; ++i) {
        const Fragment& fragment = light.fragments[own->first_fragment + i];
        ClaimedFragment& piece = fragments.emplace_back();
        piece.state = fragment.state;
        piece.reason = name_of(fragment.reason);
        if (fragment.caster != Fragment::kNoCaster) {
          piece.caster = scene_.scene().polygons[prepared_.parts[fragment.caster].polygon].id;
        }
        const auto first = light.exact_points.begin() + fragment.first;
        piece.loop.assign(first, first + fragment.count);
      }
      return;
    }
    fragments.push_back(dark(*results.front(), part, side, scene_.is_area(light.light)));
  }

  /// A part that sees nothing of an area light has the reason of its front; no light is behind
  /// either if the part lies behind the light.
  ClaimedFragment dark(const PartResult& result, std::uint32_t part, Side side, bool area) const {
    ShadowReason reason = result.reason;
    if (area && result.side != side && reason == ShadowReason::kFacesAway) {
      reason = ShadowReason::kBehindLight;
    }
    ClaimedFragment whole;
    whole.state = area ? LightState::kUmbra : LightState::kShadow;
    whole.reason = reason == ShadowReason::kNone ? "faces-away" : name_of(reason);
    const Geometry& geometry = prepared_.geometry;
    for (const VertexId vertex : prepared_.loop(prepared_.parts[part])) {
      RationalPoint& point = whole.loop.emplace_back();
      for (int k = 0; k < 3; ++k) {
        point[k] = geometry.origin[k] + geometry.step * mpq_class(geometry.grid.at(vertex, k));
      }
    }
    return whole;
  }

  const Case& scene_;
  const PreparedScene& prepared_;
};

void expect_same(const ClaimedLight& product, const ClaimedLight& second) {
  EXPECT_EQ(product.id, second.id);
  EXPECT_EQ(product.per_caster_umbra, second.per_caster_umbra);
  EXPECT_FALSE(product.background);
  ASSERT_EQ(product.polygons.size(), second.polygons.size());
  for (std::size_t i = 0; i < product.polygons.size(); ++i) {
    const ClaimedPolygon &a = product.polygons[i], &b = second.polygons[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.side, b.side) << a.id;
    EXPECT_TRUE(a.side_given);
    ASSERT_EQ(a.fragments.size(), b.fragments.size()) << a.id;
    for (std::size_t f = 0; f < a.fragments.size(); ++f) {
      const ClaimedFragment &one = a.fragments[f], &two = b.fragments[f];
      EXPECT_EQ(one.state, two.state) << a.id;
      EXPECT_EQ(one.caster, two.caster) << a.id;
      EXPECT_EQ(one.reason, two.reason) << a.id;
      EXPECT_TRUE(one.loop == two.loop) << a.id;
    }
  }
}

TEST(Claims, BothTranslationsAgree) {
  std::size_t lights = 0;
  for (const auto& all : {fuzz::families(), fuzz::area_families()}) {
    for (const fuzz::Family& family : all) {
      for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto scene = Case::make(family.make(seed));
        if (!scene) continue;
        const auto result = compute_shadows(scene->prepared(), options_for(KernelId::kPlane));
        ASSERT_TRUE(result) << to_string(result.error());
        const Claims claims = claims_of(*scene, *result);
        EXPECT_EQ(claims.name, "plane");
        ASSERT_EQ(claims.lights.size(), result->lights.size());
        for (std::size_t l = 0; l < claims.lights.size(); ++l, ++lights) {
          SCOPED_TRACE(std::string(family.name) + " seed " + std::to_string(seed));
          expect_same(claims.lights[l], SecondTranslation(*scene).claims_of(result->lights[l]));
        }
      }
    }
  }
  EXPECT_GT(lights, 200u);
}

}  // namespace
}  // namespace gnomon::test
