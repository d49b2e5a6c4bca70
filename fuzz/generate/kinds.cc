// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/scene/kinds.h"

#include <cctype>
#include <deque>
#include <string>
#include <vector>

#include "fuzz/generate/area_families.h"
#include "fuzz/generate/families.h"

namespace gnomon::fuzz {
namespace {

constexpr KindInfo kInfos[] = {
    {"soup-uniform", "independent polygons, uniform in a box, with 6 to 53 bits"},
    {"soup-clustered", "small polygons crowded round few places"},
    {"soup-lattice", "polygons on a small lattice, where everything meets everything"},
    {"soup-mixed-sizes", "polygons of sizes from 1 to 2^-30 of the scene's"},
    {"scene", "one of the scenes of 'gnomon generate'"},
    {"file", "polygons cut from a file"},
    {"one-sided", "every polygon has a front side only"},
    {"two-sided", "every polygon has two sides"},
    {"non-convex", "a planar loop that is not convex"},
    {"holes", "a polygon with a hole"},
    {"almost-planar", "a loop of more than three corners that is not exactly planar"},
    {"sliver", "a polygon whose corners are nearly collinear, none near another: aspect over 1e6"},
    {"needle", "a polygon of which one edge is over 1e6 times shorter than another"},
    {"coplanar", "two polygons in one plane"},
    {"overlap", "two coplanar polygons with an area in common"},
    {"duplicate", "two polygons with the same corners"},
    {"back-to-back", "two coplanar polygons with an area in common that look opposite ways"},
    {"shared-edge", "an edge of two polygons"},
    {"shared-vertex", "a vertex of two polygons"},
    {"t-junction", "a vertex inside an edge of another polygon"},
    {"edge-overlap", "two edges on one line that share a part, but not both ends"},
    {"vertex-in-face", "a polygon touches another's interior with a vertex"},
    {"edge-in-face", "a polygon stands on another's interior with an edge"},
    {"crossing", "an edge pierces another polygon's interior"},
    {"nested-boxes", "a box inside a box"},
    {"nextafter", "two points that differ by one unit in the last place of one coordinate"},
    {"near-parallel", "two planes less than 2^-28 from parallel, and not parallel"},
    {"light-in-plane", "a point light exactly in a polygon's plane"},
    {"light-on-face", "a point light in a polygon's interior"},
    {"light-on-edge", "a point light inside an edge"},
    {"light-on-edge-line", "a point light on an edge's line, outside of the edge"},
    {"light-at-vertex", "a point light at a polygon's vertex"},
    {"light-far", "a point light at over 1e6 times the scene's size"},
    {"light-near", "a point light within 2^-28 of a polygon's size of it, but not on it"},
    {"grazing-light", "a point light less than 2^-28 above or below a polygon's plane"},
    {"sun-in-plane", "a directional light exactly parallel to a polygon"},
    {"sun-along-edge", "a directional light exactly parallel to an edge"},
    {"grazing-sun", "a directional light less than 2^-28 from parallel to a polygon"},
    {"shadow-edges", "edges of two polygons, not on one line, in one plane through the light"},
    {"shadow-vertex-on-edge", "a vertex exactly in front of or behind another polygon's edge"},
    {"shadow-vertices", "vertices of two polygons on one line through the light"},
    {"cyclic-overlap", "polygons each in front of the next in a circle, seen from a light"},
    {"area-vertex", "an area light and a polygon share a vertex", true},
    {"area-edge", "an area light and a polygon share an edge", true},
    {"area-edge-overlap", "edges of light and polygon on one line share a part, but not both ends",
     true},
    {"area-in-plane", "an area light in a polygon's plane", true},
    {"area-on-caster", "an area light and a coplanar polygon have an area in common", true},
    {"area-inside", "an area light inside a coplanar polygon, or the other way round", true},
    {"area-vertex-in-face", "an area light touches a polygon's interior with a vertex", true},
    {"area-touched", "a polygon touches an area light's interior with a vertex", true},
    {"area-straddled", "a polygon's plane cuts an area light", true},
    {"area-cut", "a polygon itself cuts an area light", true},
    {"area-vertex-in-plane", "a light's vertex exactly in a polygon's plane that it is not in",
     true},
    {"area-edge-in-plane", "a light's edge exactly in a polygon's plane that it is not in", true},
    {"area-parallel-edge", "parallel edges of light and polygon: penumbra planes coincide", true},
    {"area-grazing", "a light's vertex less than 2^-28 off a polygon's plane", true},
    {"area-sliver", "an area light with an aspect over 1e6", true},
    {"area-small", "an area light over 2^20 times smaller than the scene", true},
    {"area-huge", "an area light over 2^10 times larger than the scene", true},
    {"mixed-magnitudes", "magnitudes of coordinates over 2^64 apart"},
    {"scaled-up", "coordinates beyond 2^300"},
    {"scaled-down", "all coordinates below 2^-300"},
    {"large-offset", "a scene over 2^18 times its size away from the origin"},
    {"decimals", "coordinates that are decimal fractions and no doubles"},
};
static_assert(std::size(kInfos) == static_cast<std::size_t>(Kind::kFirstFamily));

/// MixedMagnitudes: mixed-magnitudes.
std::string dashed(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0 && !result.empty()) result += '-';
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

struct Table {
  std::deque<std::string> texts;  // that infos refer to
  std::vector<KindInfo> infos{std::begin(kInfos), std::end(kInfos)};

  Table() {
    const auto keep = [&](std::string text) -> std::string_view {
      return texts.emplace_back(std::move(text));
    };
    for (const Family& family : families()) {
      infos.push_back(
          {keep("family-" + dashed(family.name)), keep("of the family " + family.name), false});
    }
    for (const Family& family : area_families()) {
      infos.push_back({keep("area-family-" + dashed(family.name)),
                       keep("of the family " + family.name + " under area lights"), true});
    }
  }
};

}  // namespace

std::span<const KindInfo> kinds() {
  static const Table kTable;
  return kTable.infos;
}

std::optional<std::uint16_t> kind_by_name(std::string_view name) {
  const auto all = kinds();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name == name) return static_cast<std::uint16_t>(i);
  }
  return std::nullopt;
}

std::uint16_t kind_of_family(std::size_t family) {
  return static_cast<std::uint16_t>(id_of(Kind::kFirstFamily) + family);
}
std::uint16_t kind_of_area_family(std::size_t family) {
  return static_cast<std::uint16_t>(kind_of_family(families().size()) + family);
}

}  // namespace gnomon::fuzz
