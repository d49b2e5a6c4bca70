// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exports/result_pieces.h"

#include "report/sides/polygon_sides.h"

namespace gnomon::report {

namespace {

std::optional<std::uint32_t> caster_of(const PreparedScene& prepared, const LightResult& light,
                                       const Fragment& fragment) {
  if (fragment.caster != Fragment::kNoCaster) return prepared.parts[fragment.caster].polygon;
  if (fragment.casters == Fragment::kNoCaster) return std::nullopt;
  // Several together: the first stands for all.
  const std::vector<std::uint32_t>& set = light.caster_sets[fragment.casters];
  if (set.empty()) return std::nullopt;
  return prepared.parts[set.front()].polygon;
}

void add_side(const PreparedScene& prepared, const LightResult& light, const ResultPiece& like,
              const ClassifiedSide& side, std::vector<ResultPiece>& pieces) {
  const std::uint32_t first = prepared.first_part[side.polygon];
  for (std::uint32_t i = 0; i < side.parts.size(); ++i) {
    const PartSide& part = side.parts[i];
    if (!part.sees()) {
      ResultPiece whole = like;
      whole.state = side.area_light ? LightState::kUmbra : LightState::kShadow;
      for (const VertexId vertex : prepared.loop(prepared.parts[first + i])) {
        whole.loop.push_back(prepared.geometry.positions[vertex]);
      }
      pieces.push_back(std::move(whole));
      continue;
    }
    for (std::uint32_t f = 0; f < part.result->fragment_count; ++f) {
      const Fragment& fragment = light.fragments[part.result->first_fragment + f];
      ResultPiece piece = like;
      piece.state = fragment.state;
      piece.caster = caster_of(prepared, light, fragment);
      const auto begin = light.points.begin() + fragment.first;
      piece.loop.assign(begin, begin + fragment.count);
      pieces.push_back(std::move(piece));
    }
  }
}

}  // namespace

Expected<std::vector<ResultPiece>> result_pieces(const PreparedScene& prepared,
                                                 const ShadowResult& result) {
  std::vector<ResultPiece> pieces;
  for (std::uint32_t l = 0; l < result.lights.size(); ++l) {
    const LightResult& light = result.lights[l];
    if (light.cover != Cover::kPartition || light.background) {
      return fail(ErrorCode::kUsage,
                  "fragments that lie over each other, or leave a class out, are no pieces",
                  "a method whose fragments tile each polygon, such as --algorithm sectors");
    }
    for (const ClassifiedSide& side : classified_sides(prepared, light, false)) {
      ResultPiece like;
      like.light = l;
      like.polygon = side.polygon;
      like.side = side.side;
      like.lit = side.lit;
      add_side(prepared, light, like, side, pieces);
    }
  }
  return pieces;
}

}  // namespace gnomon::report
