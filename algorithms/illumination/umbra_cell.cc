// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/illumination/umbra_cell.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algorithms/illumination/joined_shadows.h"

namespace gnomon {
namespace {

constexpr std::size_t kCorners = CellShadow::kCorners;

}  // namespace

std::array<UmbraCell, 2> UmbraCell::halves(const Geometry& geometry) const {
  std::array<double, kCorners> lengths{};
  std::array<Apex, kCorners> corners;
  for (std::size_t c = 0; c < kCorners; ++c) corners[c] = Apex::from(geometry, points[c], weight);
  for (std::size_t c = 0; c < kCorners; ++c) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double step = corners[(c + 1) % kCorners].near[k].high - corners[c].near[k].high;
      lengths[c] += step * step;
    }
  }
  const auto longest =
      static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  const std::size_t next = (longest + 1) % kCorners;
  ExactVector middle;
  std::array<UmbraCell, 2> result;
  for (UmbraCell& half : result) {
    half = *this;
    half.weight *= 2;
    for (ExactVector& point : half.points) {
      for (mpz_class& c : point) c *= 2;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) middle[k] = points[longest][k] + points[next][k];
  result[0].points[next] = middle;
  result[1].points[longest] = middle;
  return result;
}

std::vector<CasterSide> UmbraCells::casters_of(const UmbraCell& cell) const {
  std::vector<Apex> corners;
  for (const ExactVector& point : cell.points) {
    corners.push_back(Apex::from(view_.scene().geometry, point, cell.weight));
  }
  std::vector<std::uint32_t> found;
  view_.find_casters(corners, part_.plane, part_.flipped == (side_ == Side::kFront), found);
  std::vector<CasterSide> result;
  for (const std::uint32_t caster : found) {
    if (view_.casters()[caster].front) result.push_back({caster, true});
    if (view_.casters()[caster].back) result.push_back({caster, false});
  }
  return result;
}

CellAnswer UmbraCells::decide(const UmbraCell& cell, std::vector<CasterSide>& casters) const {
  const Geometry& geometry = view_.scene().geometry;
  LightPieces pieces(view_);
  ExactVector middle{0, 0, 0};
  for (const ExactVector& point : cell.points) {
    pieces.add_apex(Apex::from(geometry, point, cell.weight));
    for (std::size_t k = 0; k < 3; ++k) middle[k] += point[k];
  }
  const std::uint32_t centre =
      pieces.add_apex(Apex::from(geometry, middle, mpz_class(cell.weight * 3)));
  if (!clip_to_receiver(pieces, view_, part_, side_, centre)) return CellAnswer::kUndecided;
  const std::vector<LightPieces::Piece> in_front = pieces.pieces();

  std::vector<CellShadow> shadows;
  std::vector<CasterSide> reaching;
  std::vector<PlaneRef> region;
  for (const CasterSide& caster : casters) {
    CellShadow shadow(pieces, view_, caster);
    if (!shadow.exists()) continue;
    shadow.outer(region);
    if (pieces.is_apart(in_front[0], region)) continue;
    shadows.push_back(std::move(shadow));
    reaching.push_back(caster);
  }
  casters = std::move(reaching);
  // What the cell's centre sees says which of the two may be true.
  for (const CasterSide& caster : casters) {
    if (pieces.empty()) break;
    LightView::Caster one_side = view_.casters()[caster.caster];
    (caster.front ? one_side.back : one_side.front) = false;
    region = shadow_of(pieces, view_, one_side, centre, nullptr);
    if (!region.empty()) pieces.subtract(region);
  }
  const bool is_dark = pieces.empty();
  pieces.set_pieces(in_front);
  if (is_dark) {
    subtract_joined(pieces, lines_, shadows);
    return pieces.empty() ? CellAnswer::kDeep : CellAnswer::kUndecided;
  }
  for (CellShadow& shadow : shadows) {
    if (pieces.empty()) break;
    shadow.outer(region);
    pieces.subtract(region);
  }
  return pieces.empty() ? CellAnswer::kUndecided : CellAnswer::kSeen;
}

}  // namespace gnomon
