// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/volume_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "algorithms/area_contour/four_doubles.h"

namespace gnomon::area_contour {
namespace {

double diagonal_of(const Box& box) {
  return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
}

// As in caster_tree.cc: coordinates are off by 2^-53 and at most 1; a line through two points at
// least kShortest apart is off by less than 2^-50 / kShortest anywhere.
constexpr double kMargin = 1e-12, kShortest = 1e-3;

/// The bits of a number below 2^10, two places apart.
std::uint32_t spread(std::uint32_t bits) {
  std::uint32_t result = 0;
  for (std::uint32_t k = 0; k < 10; ++k) result |= (bits >> k & 1) << 3 * k;
  return result;
}

}  // namespace

/// By the Morton codes of their boxes' middles.
void sort_by_space(const CasterTree& tree, std::vector<std::uint32_t>& parts) {
  constexpr std::size_t kFirst = 64;
  if (parts.size() <= kFirst) return;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> codes;
  codes.reserve(parts.size() - kFirst);
  for (std::size_t i = kFirst; i < parts.size(); ++i) {
    const Box& box = tree.box(parts[i]);
    std::uint32_t code = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle = (box.low[k] + box.high[k]) / 2;
      code |= spread(static_cast<std::uint32_t>(std::clamp(middle, 0.0, 1.0) * 1023)) << k;
    }
    codes.emplace_back(code, parts[i]);
  }
  std::ranges::sort(codes);
  for (std::size_t i = 0; i < codes.size(); ++i) parts[kFirst + i] = codes[i].second;
}

LightVolumes::LightVolumes(std::vector<Box> boxes, const Box& light,
                           std::vector<Point3> light_corners, double bound)
    : boxes_(std::move(boxes)),
      light_(light),
      light_corners_(std::move(light_corners)),
      bound_(bound) {}

void LightVolumes::put(std::span<const PlaneDoubles> planes, std::uint32_t first) {
  constexpr PlaneBlock kFilling{{}, {-1, -1, -1, -1}};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    PlaneBlock& block = blocks_[first + i / 4];
    if (i % 4 == 0) block = kFilling;
    const double sign = planes[i].plane.flipped() ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) block.n[k][i % 4] = sign * planes[i].n[k];
    block.d[i % 4] = sign * planes[i].d;
  }
}

void LightVolumes::add(std::uint32_t number, std::uint32_t part, std::uint32_t support,
                       std::size_t penumbra, std::size_t umbra) {
  const auto blocks_of = [](std::size_t planes) {
    return static_cast<std::uint32_t>((planes + 3) / 4);
  };
  volumes_.push_back({number, part, support, 0, blocks_of(penumbra), blocks_of(umbra)});
}

/// Volumes in the order in which the walk comes to them.
void LightVolumes::sort(unsigned jobs) {
  std::vector<Box> boxes;
  boxes.reserve(volumes_.size());
  for (const SearchedVolume& volume : volumes_) boxes.push_back(boxes_[volume.part]);
  std::vector<std::uint32_t> members(volumes_.size());
  std::iota(members.begin(), members.end(), 0u);
  tree_ = BoxTree(std::move(boxes), std::move(members), jobs);
  const std::span<const BoxTree::Node> nodes = tree_.nodes();
  std::vector<SearchedVolume> volumes;
  volumes.reserve(volumes_.size());
  if (!nodes.empty()) {
    for (const std::uint32_t member : tree_.members(nodes[0])) volumes.push_back(volumes_[member]);
  }
  volumes_ = std::move(volumes);
  std::uint32_t blocks = 0;
  for (SearchedVolume& volume : volumes_) {
    volume.first = blocks;
    blocks += volume.penumbra_blocks + volume.umbra_blocks;
  }
  blocks_ = std::make_unique_for_overwrite<PlaneBlock[]>(blocks);
  largest_.assign(nodes.size(), 0);
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
    if (nodes[i].right != 0) {
      largest_[i] = std::max(largest_[i + 1], largest_[nodes[i].right]);
      continue;
    }
    for (std::uint32_t k = nodes[i].begin; k < nodes[i].end; ++k) {
      largest_[i] = std::max(largest_[i], diagonal_of(boxes_[volumes_[k].part]));
    }
  }
}

/// The convex hull of two boxes (shadow_volumes/caster_tree.h), its tangents four at a time: in
/// each of the three coordinate planes at most four count. What fills up a row is never exceeded.
struct VolumeSearch::Shaft {
  struct alignas(32) Tangents {
    double u_up[4] = {}, u_down[4] = {}, v_up[4] = {}, v_down[4] = {}, d[4] = {1, 1, 1, 1};
  };
  Box hull;
  std::array<Tangents, 3> tangents;

  Shaft(const Box& receiver, const Box& light) {
    hull = receiver;
    hull.add(light);
    for (std::size_t k = 0; k < 3; ++k) {
      hull.low[k] -= 2 * kMargin;
      hull.high[k] += 2 * kMargin;
    }
    for (std::size_t u = 0; u < 3; ++u) add_tangents(u, receiver, light);
  }

  void add_tangents(std::size_t u, const Box& receiver, const Box& light) {
    const std::size_t v = (u + 1) % 3;
    Tangents& own = tangents[u];
    std::size_t count = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const bool high_u = (corner & 1) != 0, high_v = (corner & 2) != 0;
      const double ru = high_u ? receiver.high[u] : receiver.low[u];
      const double rv = high_v ? receiver.high[v] : receiver.low[v];
      const double du = (high_u ? light.high[u] : light.low[u]) - ru;
      const double dv = (high_v ? light.high[v] : light.low[v]) - rv;
      const double square = du * du + dv * dv;
      if (!(square > kShortest * kShortest)) continue;
      const double inverse = 1 / std::sqrt(square);
      for (const double sign : {1.0, -1.0}) {
        const double nu = sign * -dv * inverse, nv = sign * du * inverse;
        // A tangent has both rectangles, and so their outermost corners, on one side.
        if ((nu > 0) != high_u && nu != 0) continue;
        if ((nv > 0) != high_v && nv != 0) continue;
        const double d = nu * ru + nv * rv;
        own.u_up[count] = std::max(nu, 0.0);
        own.u_down[count] = std::min(nu, 0.0);
        own.v_up[count] = std::max(nv, 0.0);
        own.v_down[count] = std::min(nv, 0.0);
        own.d[count++] = d + kMargin * (1 + std::fabs(d));
        break;
      }
    }
  }

  bool may_meet(const Box& box) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (box.low[k] > hull.high[k] || box.high[k] < hull.low[k]) return false;
    }
    for (std::size_t u = 0; u < 3; ++u) {
      const std::size_t v = (u + 1) % 3;
      const Tangents& own = tangents[u];
      // The corner of the box that is deepest inside.
      const Doubles value = row(own.u_up) * box.low[u] + row(own.u_down) * box.high[u] +
                            row(own.v_up) * box.low[v] + row(own.v_down) * box.high[v];
      if (any(value > row(own.d))) return false;
    }
    return true;
  }
};

void VolumeSearch::Hints::add(std::uint32_t place) {
  for (std::size_t i = 0; i < count; ++i) {
    if (places[i] == place) return;
  }
  places[next] = place;
  next = (next + 1) % kHints;
  count = std::max(count, next == 0 ? kHints : next);
}

std::span<const PlaneBlock> VolumeSearch::penumbra(const SearchedVolume& volume) const {
  return {light_->blocks_.get() + volume.first, volume.penumbra_blocks};
}
std::span<const PlaneBlock> VolumeSearch::umbra(const SearchedVolume& volume) const {
  return {light_->blocks_.get() + volume.first + volume.penumbra_blocks, volume.umbra_blocks};
}

/// Whether the receiver's box is behind a plane, and so its corners, whose values are bounded.
GNOMON_FOR_AVX2 bool VolumeSearch::misses_box(std::span<const PlaneBlock> planes) const {
  for (const PlaneBlock& block : planes) {
    const Doubles &x = row(block.n[0]), &y = row(block.n[1]), &z = row(block.n[2]);
    const Doubles value = x * middle_[0] + y * middle_[1] + z * middle_[2] - row(block.d) +
                          (x > 0 ? x : -x) * half_[0] + (y > 0 ? y : -y) * half_[1] +
                          (z > 0 ? z : -z) * half_[2];
    // The box has been computed, too.
    if (any(value < -2 * light_->bound_)) return true;
  }
  return false;
}

GNOMON_FOR_AVX2 VolumeSearch::Relation VolumeSearch::relate(
    std::span<const PlaneBlock> planes) const {
  const double bound = light_->bound_;
  bool inside = true;
  for (const PlaneBlock& block : planes) {
    const Doubles &x = row(block.n[0]), &y = row(block.n[1]), &z = row(block.n[2]);
    Doubles least = {1, 1, 1, 1}, most = {-1, -1, -1, -1};
    for (const Point3& corner : receiver_->corners) {
      const Doubles value = x * corner[0] + y * corner[1] + z * corner[2] - row(block.d);
      least = value < least ? value : least;
      most = value > most ? value : most;
    }
    if (any(most < -bound)) return Relation::kOutside;
    inside = inside && all(least > bound);
  }
  return inside ? Relation::kInside : Relation::kOpen;
}

const UmbraReach& VolumeSearch::reach() {
  if (!has_reach_) {
    reach_ = UmbraReach(cut_ != nullptr ? cut_->corners : light_->light_corners_, box_);
    has_reach_ = true;
  }
  return reach_;
}

bool VolumeSearch::may_have_umbra(const SearchedVolume& volume) const {
  return volume.umbra_blocks != 0 && !misses_box(umbra(volume));
}

/// Whether a volume's umbra holds the receiver. Notes if its penumbra does.
bool VolumeSearch::try_to_cover(std::uint32_t place) {
  const SearchedVolume& volume = light_->volumes_[place];
  if (is_own(volume) || relate(penumbra(volume)) != Relation::kInside) return false;
  all_penumbra_ = true;
  penumbra_hints_.add(place);
  if (volume.umbra_blocks == 0 || relate(umbra(volume)) != Relation::kInside) return false;
  umbra_hints_.add(place);
  return true;
}

bool VolumeSearch::try_hints() {
  for (std::size_t i = 0; i < umbra_hints_.count; ++i) {
    if (try_to_cover(umbra_hints_.places[i])) return true;
  }
  for (std::size_t i = 0; i < penumbra_hints_.count && !all_penumbra_; ++i) {
    if (try_to_cover(penumbra_hints_.places[i])) return true;
  }
  return false;
}

/// Casters before the middle of the light are most likely to have all of the receiver in their
/// penumbra; then only umbras remain to be looked for, which reach less far.
GNOMON_FOR_AVX2 bool VolumeSearch::try_blocking() {
  Box from, to;
  from.add(middle_);
  Point3 middle{};
  const Box& light = cut_ != nullptr ? cut_->box : light_->light_;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (light.low[k] + light.high[k]) / 2;
  to.add(middle);
  const Shaft shaft(from, to);
  std::size_t tried = 0;
  std::vector<std::uint32_t> none;
  bool found = false;
  if (cut_ == nullptr) ++blocking_tried_;
  const auto goes_on = [&] { return !found && !all_penumbra_ && tried < kMostBlocking; };
  light_->tree_.find(
      [&](const BoxTree::Node& node, std::uint32_t) {
        if (!goes_on() || !shaft.may_meet(node.box)) return false;
        if (node.right != 0) return true;
        for (std::uint32_t place = node.begin; place < node.end && goes_on(); ++place) {
          if (!shaft.may_meet(light_->box(light_->volumes_[place].part))) continue;
          if (cut_ != nullptr) {
            found = test_cut(place);
            tried = found_.size();
          } else {
            ++tried;
            found = try_to_cover(place);
          }
        }
        return false;
      },
      [](std::uint32_t) { return false; }, none);
  if (all_penumbra_) ++blocking_found_;
  return found;
}

/// Only where that has been found often: else it costs more than it saves.
bool VolumeSearch::is_worth_blocking() {
  constexpr std::uint32_t kSample = 64, kAgain = 16;
  if (blocking_tried_ < kSample || blocking_found_ * 3 > blocking_tried_) return true;
  return (++blocking_left_out_ % kAgain) == 0;
}

/// Puts a volume down if it may reach the receiver. True if its umbra holds all of it.
bool VolumeSearch::test(std::uint32_t place) {
  const SearchedVolume& volume = light_->volumes_[place];
  if (is_own(volume) || misses_box(penumbra(volume))) return false;
  const Relation relation = relate(penumbra(volume));
  if (relation == Relation::kOutside) return false;
  if (relation == Relation::kInside && !all_penumbra_) {
    all_penumbra_ = true;
    penumbra_hints_.add(place);
  }
  bool umbra_may = may_have_umbra(volume);
  if (umbra_may) {
    const Relation own = relate(umbra(volume));
    if (own == Relation::kInside) {
      umbra_hints_.add(place);
      return true;
    }
    umbra_may = own == Relation::kOpen && reach().may_reach(light_->box(volume.part));
  }
  if (!all_penumbra_ || umbra_may) found_.push_back({volume.number, volume.part, umbra_may});
  return false;
}

/// The same where the receiver's plane cuts the light: nothing but an umbra is known to hold it.
bool VolumeSearch::test_cut(std::uint32_t place) {
  const SearchedVolume& volume = light_->volumes_[place];
  if (is_own(volume) || misses_box(penumbra(volume))) return false;
  const bool umbra_may = reach().may_reach(light_->box(volume.part));
  if (all_penumbra_ && !umbra_may) return false;
  if (relate(penumbra(volume)) == Relation::kOutside) return false;
  if (may_have_umbra(volume) && relate(umbra(volume)) == Relation::kInside) {
    umbra_hints_.add(place);
    return true;
  }
  if (std::ranges::find(blocking_, volume.number) == blocking_.end()) {
    found_.push_back({volume.number, volume.part, umbra_may});
  }
  return false;
}

GNOMON_FOR_AVX2 bool VolumeSearch::walk() {
  const Shaft shaft(box_, cut_ != nullptr ? cut_->box : light_->light_);
  std::vector<std::uint32_t> none;
  bool found = false;
  light_->tree_.find(
      [&](const BoxTree::Node& node, std::uint32_t index) {
        if (found || !shaft.may_meet(node.box)) return false;
        if (all_penumbra_ && !reach().may_reach(node.box, light_->largest_[index])) return false;
        if (node.right != 0) return true;
        for (std::uint32_t place = node.begin; place < node.end && !found; ++place) {
          if (!shaft.may_meet(light_->box(light_->volumes_[place].part))) continue;
          found = cut_ != nullptr ? test_cut(place) : test(place);
        }
        return false;
      },
      [](std::uint32_t) { return false; }, none);
  return found;
}

void VolumeSearch::begin(const LightVolumes& light, const SearchedReceiver& receiver,
                         const CutLight* cut) {
  light_ = &light;
  receiver_ = &receiver;
  cut_ = cut;
  box_ = light.box(receiver.part);
  for (std::size_t k = 0; k < 3; ++k) {
    middle_[k] = (box_.low[k] + box_.high[k]) / 2;
    half_[k] = (box_.high[k] - box_.low[k]) / 2;
  }
  has_reach_ = all_penumbra_ = false;
  found_.clear();
}

VolumeSearch::Outcome VolumeSearch::find(const LightVolumes& light,
                                         const SearchedReceiver& receiver) {
  begin(light, receiver, nullptr);
  if (try_hints() || (!all_penumbra_ && is_worth_blocking() && try_blocking()) || walk()) {
    return Outcome::kAllUmbra;
  }
  if (!all_penumbra_) return Outcome::kSome;
  std::erase_if(found_, [](const FoundVolume& volume) { return !volume.umbra; });
  return Outcome::kAllPenumbra;
}

bool VolumeSearch::begin_cut(const LightVolumes& light, const SearchedReceiver& receiver,
                             const CutLight& cut) {
  begin(light, receiver, &cut);
  blocking_.clear();
  for (std::size_t i = 0; i < umbra_hints_.count; ++i) {
    const SearchedVolume& volume = light.volumes_[umbra_hints_.places[i]];
    if (!is_own(volume) && relate(penumbra(volume)) != Relation::kOutside &&
        volume.umbra_blocks != 0 && relate(umbra(volume)) == Relation::kInside) {
      return true;
    }
  }
  return false;
}

bool VolumeSearch::find_blocking() {
  if (try_blocking()) return true;
  for (const FoundVolume& volume : found_) blocking_.push_back(volume.number);
  return false;
}

bool VolumeSearch::find_others(bool all_penumbra) {
  found_.clear();
  all_penumbra_ = all_penumbra;
  return walk();
}

}  // namespace gnomon::area_contour
