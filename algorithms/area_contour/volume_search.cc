// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/area_contour/volume_search.h"

#include <tbb/parallel_sort.h>

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

/// The bits of a number below 2^10, two places apart.
std::uint32_t spread(std::uint32_t bits) {
  std::uint32_t result = 0;
  for (std::uint32_t k = 0; k < 10; ++k) result |= (bits >> k & 1) << 3 * k;
  return result;
}

/// Components of normals and coordinates are at most 1 and off by 2^-25, offsets at most 3 and off
/// by 2^-23. Three products are off by 3 2^-25 each, their sums by 2^-24 and 2^-23, and that with
/// the offset by 2^-22: together below 2^-20. What a box is wider than its middle by adds as much.
constexpr double kRounding = 0x1p-19;

std::uint32_t blocks_of(std::size_t planes) {
  return static_cast<std::uint32_t>((planes + PlaneBlock::kSize - 1) / PlaneBlock::kSize);
}

}  // namespace

/// By the Morton codes of their boxes' middles.
void sort_by_space(const CasterTree& tree, std::span<std::uint32_t> parts, unsigned jobs) {
  constexpr std::uint32_t kGrain = 2048;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> codes(parts.size());
  const auto size = static_cast<std::uint32_t>(parts.size());
  in_parallel(jobs, size, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const Box& box = tree.box(parts[i]);
      std::uint32_t code = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double middle = (box.low[k] + box.high[k]) / 2;
        code |= spread(static_cast<std::uint32_t>(std::clamp(middle, 0.0, 1.0) * 1023)) << k;
      }
      codes[i] = {code, parts[i]};
    }
  });
  if (jobs == 1) {
    std::ranges::sort(codes);
  } else {
    tbb::parallel_sort(codes.begin(), codes.end());
  }
  for (std::size_t i = 0; i < codes.size(); ++i) parts[i] = codes[i].second;
}

LightVolumes::LightVolumes(std::vector<Box> boxes, const Box& light,
                           std::vector<Point3> light_corners, double bound)
    : boxes_(std::move(boxes)),
      light_(light),
      light_corners_(std::move(light_corners)),
      bound_(bound),
      block_bound_(static_cast<float>(bound + kRounding)) {}

void LightVolumes::put(std::span<const PlaneDoubles> planes, std::uint32_t first) {
  constexpr std::size_t kSize = PlaneBlock::kSize;
  constexpr PlaneBlock kFilling{{}, {-1, -1, -1, -1, -1, -1, -1, -1}};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    PlaneBlock& block = blocks_[first + i / kSize];
    const std::size_t lane = i % kSize;
    if (lane == 0) block = kFilling;
    const double sign = planes[i].plane.flipped() ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      block.n[k][lane] = static_cast<float>(sign * planes[i].n[k]);
    }
    block.d[lane] = static_cast<float>(sign * planes[i].d);
  }
}

void LightVolumes::add(std::uint32_t number, std::uint32_t caster, std::size_t planes) {
  const auto umbras = static_cast<std::uint32_t>(umbras_.size());
  volumes_.push_back({number, caster, 0, blocks_of(planes), umbras, umbras});
}

void LightVolumes::add_umbra(std::uint32_t number, std::uint32_t part, std::uint32_t support,
                             std::size_t planes) {
  umbras_.push_back({number, part, support, 0, blocks_of(planes)});
  ++volumes_.back().umbras_end;
}

/// Volumes in the order in which the walk comes to them.
void LightVolumes::sort(unsigned jobs) {
  std::vector<Box> boxes;
  boxes.reserve(volumes_.size());
  for (const SearchedVolume& volume : volumes_) boxes.push_back(boxes_[volume.caster]);
  std::vector<std::uint32_t> members(volumes_.size());
  std::iota(members.begin(), members.end(), 0u);
  const BoxTree tree(std::move(boxes), std::move(members), jobs);
  const std::span<const BoxTree::Node> nodes = tree.nodes();
  std::vector<SearchedVolume> volumes;
  std::vector<SearchedUmbra> umbras;
  volumes.reserve(volumes_.size());
  umbras.reserve(umbras_.size());
  if (!nodes.empty()) {
    for (const std::uint32_t member : tree.members(nodes[0])) volumes.push_back(volumes_[member]);
  }
  std::uint32_t blocks = 0;
  for (SearchedVolume& volume : volumes) {
    volume.first = blocks;
    blocks += volume.blocks;
    const auto begin = static_cast<std::uint32_t>(umbras.size());
    for (SearchedUmbra umbra : umbras_of(volume)) {
      umbra.first = blocks;
      blocks += umbra.blocks;
      umbras.push_back(umbra);
    }
    volume.umbras_begin = begin;
    volume.umbras_end = static_cast<std::uint32_t>(umbras.size());
  }
  volumes_ = std::move(volumes);
  umbras_ = std::move(umbras);
  blocks_ = std::make_unique_for_overwrite<PlaneBlock[]>(blocks);
  std::vector<double> largest(nodes.size(), 0);
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
    if (nodes[i].right != 0) {
      largest[i] = std::max(largest[i + 1], largest[nodes[i].right]);
      continue;
    }
    for (std::uint32_t k = nodes[i].begin; k < nodes[i].end; ++k) {
      for (const SearchedUmbra& umbra : umbras_of(volumes_[k])) {
        largest[i] = std::max(largest[i], diagonal_of(boxes_[umbra.part]));
      }
    }
  }
  groups_ = BoxGroups(tree, largest);
}

void VolumeSearch::Hints::add(std::uint32_t place) {
  for (std::size_t i = 0; i < count; ++i) {
    if (places[i] == place) return;
  }
  places[next] = place;
  next = (next + 1) % kHints;
  count = std::max(count, next == 0 ? kHints : next);
}

/// Whether the receiver's box is behind a plane, and so its corners, whose values are bounded.
GNOMON_FOR_AVX2 bool VolumeSearch::misses_box(std::span<const PlaneBlock> planes) const {
  const float bound = light_->block_bound_;
  for (const PlaneBlock& block : planes) {
    const Floats &x = row(block.n[0]), &y = row(block.n[1]), &z = row(block.n[2]);
    const Floats value = x * middle_[0] + y * middle_[1] + z * middle_[2] - row(block.d) +
                         (x > 0 ? x : -x) * half_[0] + (y > 0 ? y : -y) * half_[1] +
                         (z > 0 ? z : -z) * half_[2];
    // The box has been computed, too.
    if (lanes_of(value < -2 * bound) != 0) return true;
  }
  return false;
}

GNOMON_FOR_AVX2 VolumeSearch::Relation VolumeSearch::relate(std::span<const PlaneBlock> planes,
                                                            OpenPlanes& open) const {
  const float bound = light_->block_bound_;
  open.bits = 0;
  unsigned first = 0;  // lane of the block
  for (const PlaneBlock& block : planes) {
    const Floats &x = row(block.n[0]), &y = row(block.n[1]), &z = row(block.n[2]);
    Floats least = {1, 1, 1, 1, 1, 1, 1, 1}, most = -least;
    for (const std::array<float, 3>& corner : corners_) {
      const Floats value = x * corner[0] + y * corner[1] + z * corner[2] - row(block.d);
      least = value < least ? value : least;
      most = value > most ? value : most;
    }
    if (lanes_of(most < -bound) != 0) return Relation::kOutside;
    const std::uint64_t own = lanes_of(least <= bound);
    if (first + PlaneBlock::kSize <= OpenPlanes::kMost) {
      open.bits |= own << first;
      first += PlaneBlock::kSize;
    } else if (own != 0) {
      open.bits |= ~std::uint64_t{0} << first;
    }
  }
  return open.bits == 0 ? Relation::kInside : Relation::kOpen;
}

const UmbraReach& VolumeSearch::reach() {
  if (!has_reach_) {
    reach_ = UmbraReach(cut_ != nullptr ? cut_->corners : light_->light_corners_, box_);
    has_reach_ = true;
  }
  return reach_;
}

/// A shell of which the receiver is a face is behind it, and a part's own umbra is its volume's
/// only one.
bool VolumeSearch::is_own(const SearchedVolume& volume) const {
  return volume.caster == receiver_->behind || (volume.umbras_end - volume.umbras_begin == 1 &&
                                                is_own(light_->umbras_[volume.umbras_begin]));
}

bool VolumeSearch::is_inside(const SearchedUmbra& umbra) const {
  return umbra.blocks != 0 && !is_own(umbra) && relate(planes_of(umbra)) == Relation::kInside;
}

/// Whether one of a volume's umbras holds the receiver.
bool VolumeSearch::try_umbras(std::uint32_t place) {
  const auto is_inside = [&](const SearchedUmbra& umbra) { return this->is_inside(umbra); };
  if (!std::ranges::any_of(light_->umbras_of(light_->volumes_[place]), is_inside)) return false;
  umbra_hints_.add(place);
  return true;
}

/// Whether an umbra of a volume holds the receiver. Notes if its penumbra does.
bool VolumeSearch::try_to_cover(std::uint32_t place) {
  const SearchedVolume& volume = light_->volumes_[place];
  if (is_own(volume) || relate(planes_of(volume)) != Relation::kInside) return false;
  all_penumbra_ = true;
  penumbra_hints_.add(place);
  return try_umbras(place);
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
  from.add(Point3{middle_[0], middle_[1], middle_[2]});
  Point3 middle{};
  const Box& light = cut_ != nullptr ? cut_->box : light_->light_;
  for (std::size_t k = 0; k < 3; ++k) middle[k] = (light.low[k] + light.high[k]) / 2;
  to.add(middle);
  const GroupShaft shaft(from, to);
  std::size_t tried = 0;
  if (cut_ == nullptr) ++blocking_tried_;
  bool found = false;
  light_->groups_.find(
      shaft, [](const BoxGroup&, std::uint32_t) { return true; },
      [&](std::uint32_t place) {
        if (cut_ != nullptr) {
          const std::size_t before = found_.size();
          found = test_cut(place);
          if (found_.size() > before) blocking_.push_back(place);
          tried = blocking_.size();
        } else {
          ++tried;
          found = try_to_cover(place);
        }
        return found || all_penumbra_ || tried == kMostBlocking;
      });
  if (all_penumbra_) ++blocking_found_;
  return found;
}

/// Only where that has been found often: else it costs more than it saves.
bool VolumeSearch::is_worth_blocking() {
  constexpr std::uint32_t kSample = 64, kAgain = 16;
  if (blocking_tried_ < kSample || blocking_found_ * 3 > blocking_tried_) return true;
  return (++blocking_left_out_ % kAgain) == 0;
}

/// Puts a volume and its umbras down if they may reach the receiver. True if an umbra holds all of
/// it.
bool VolumeSearch::test(std::uint32_t place) {
  const SearchedVolume& volume = light_->volumes_[place];
  if (is_own(volume) || misses_box(planes_of(volume))) return false;
  FoundVolume found{volume.number, volume.caster, true, false, {}, {}};
  const Relation relation = relate(planes_of(volume), found.of_penumbra);
  if (relation == Relation::kOutside) return false;
  if (relation == Relation::kInside && !all_penumbra_) {
    all_penumbra_ = true;
    penumbra_hints_.add(place);
  }
  const std::size_t before = found_.size();
  found_.push_back(found);
  for (const SearchedUmbra& umbra : light_->umbras_of(volume)) {
    if (umbra.blocks == 0 || is_own(umbra) || misses_box(planes_of(umbra))) continue;
    OpenPlanes open;
    const Relation own = relate(planes_of(umbra), open);
    if (own == Relation::kInside) {
      umbra_hints_.add(place);
      return true;
    }
    if (own == Relation::kOpen && reach().may_reach(light_->box(umbra.part))) {
      add_umbra(umbra, open);
    }
  }
  if (all_penumbra_) drop_penumbra(before);
  return false;
}

/// The same where the receiver's plane cuts the light: nothing but an umbra is known to hold it.
bool VolumeSearch::test_cut(std::uint32_t place) {
  const SearchedVolume& volume = light_->volumes_[place];
  if (is_own(volume) || misses_box(planes_of(volume))) return false;
  const std::span<const SearchedUmbra> umbras = light_->umbras_of(volume);
  const auto may_reach = [&](const SearchedUmbra& umbra) {
    return !is_own(umbra) && reach().may_reach(light_->box(umbra.part));
  };
  if (all_penumbra_ && std::ranges::none_of(umbras, may_reach)) return false;
  if (relate(planes_of(volume)) == Relation::kOutside) return false;
  if (try_umbras(place)) return true;
  if (std::ranges::find(blocking_, place) != blocking_.end()) return false;
  const std::size_t before = found_.size();
  found_.push_back({volume.number, volume.caster, true, false, {}, {}});
  for (const SearchedUmbra& umbra : umbras) {
    if (may_reach(umbra)) add_umbra(umbra, {});
  }
  if (all_penumbra_) drop_penumbra(before);
  return false;
}

/// Puts an umbra down that is in the last penumbra found, or in one found just before.
void VolumeSearch::add_umbra(const SearchedUmbra& umbra, OpenPlanes open) {
  FoundVolume& last = found_.back();
  if (last.number == umbra.number) {
    last.umbra = true;
    last.of_umbra = open;
  } else {
    found_.push_back({umbra.number, umbra.part, false, true, {}, open});
  }
}

/// Drops the penumbra at that place of what is found.
void VolumeSearch::drop_penumbra(std::size_t place) {
  found_[place].penumbra = false;
  if (!found_[place].umbra) found_.erase(found_.begin() + static_cast<std::ptrdiff_t>(place));
}

GNOMON_FOR_AVX2 bool VolumeSearch::walk() {
  const GroupShaft shaft(box_, cut_ != nullptr ? cut_->box : light_->light_);
  return light_->groups_.find(
      shaft,
      [&](const BoxGroup& group, std::uint32_t lane) {
        return !all_penumbra_ || reach().may_reach(group.box(lane), group.largest[lane]);
      },
      [&](std::uint32_t place) { return cut_ != nullptr ? test_cut(place) : test(place); });
}

void VolumeSearch::begin(const LightVolumes& light, const SearchedReceiver& receiver,
                         const CutLight* cut) {
  light_ = &light;
  receiver_ = &receiver;
  cut_ = cut;
  box_ = light.box(receiver.part);
  for (std::size_t k = 0; k < 3; ++k) {
    middle_[k] = static_cast<float>((box_.low[k] + box_.high[k]) / 2);
    half_[k] = static_cast<float>((box_.high[k] - box_.low[k]) / 2);
  }
  corners_.clear();
  for (const Point3& corner : receiver.corners) {
    corners_.push_back({static_cast<float>(corner[0]), static_cast<float>(corner[1]),
                        static_cast<float>(corner[2])});
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
  for (FoundVolume& volume : found_) volume.penumbra = false;
  std::erase_if(found_, [](const FoundVolume& volume) { return !volume.umbra; });
  return Outcome::kAllPenumbra;
}

bool VolumeSearch::begin_cut(const LightVolumes& light, const SearchedReceiver& receiver,
                             const CutLight& cut) {
  begin(light, receiver, &cut);
  blocking_.clear();
  for (std::size_t i = 0; i < umbra_hints_.count; ++i) {
    const std::uint32_t place = umbra_hints_.places[i];
    const SearchedVolume& volume = light.volumes_[place];
    if (!is_own(volume) && relate(planes_of(volume)) != Relation::kOutside && try_umbras(place)) {
      return true;
    }
  }
  return false;
}

bool VolumeSearch::find_blocking() { return try_blocking(); }

bool VolumeSearch::find_others(bool all_penumbra) {
  found_.clear();
  all_penumbra_ = all_penumbra;
  return walk();
}

}  // namespace gnomon::area_contour
