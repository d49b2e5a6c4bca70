// SPDX-License-Identifier: LGPL-3.0-or-later
// Finds the volumes of one area light that may reach a receiver: a walk of a bounding-volume
// hierarchy down the shaft between receiver and light, and volumes against the receiver's box and
// corners, eight planes at a time.
//
// Guarantee: a volume that is not found certainly misses the receiver; what is said to be all in
// penumbra or umbra certainly is, by one caster. All else is for exact arithmetic to decide. What
// is found depends on the receiver alone: casters that covered the last receivers are tried first,
// but would be found without.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_VOLUME_SEARCH_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_VOLUME_SEARCH_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/area_contour/box_groups.h"
#include "algorithms/area_contour/receiver_chart.h"
#include "algorithms/partition/box.h"
#include "algorithms/partition/in_parallel.h"
#include "algorithms/shadow_volumes/caster_tree.h"

namespace gnomon::area_contour {

/// Eight planes n . x - d in single precision; what fills up the last block is positive everywhere.
struct alignas(32) PlaneBlock {
  static constexpr std::uint32_t kSize = 8;
  float n[3][kSize], d[kSize];
};

/// The umbra of one side of a part, as the search sees it.
struct SearchedUmbra {
  std::uint32_t number = 0;  // of its volume in the light's store
  std::uint32_t part = 0, support = 0;
  std::uint32_t first = 0, blocks = 0;  // 0: none, under the whole light
};

/// A penumbra, of one side of a part or of a shell, and the umbras in it.
struct SearchedVolume {
  std::uint32_t number = 0;  // in the light's store
  std::uint32_t caster = 0;  // a part, or a shell by its number after those of parts
  std::uint32_t first = 0, blocks = 0;
  std::uint32_t umbras_begin = 0, umbras_end = 0;
};

/// The volumes of one light.
class LightVolumes {
 public:
  /// `boxes`: of all casters, and of the light, in fractions of the grid's extent. `bound`: of the
  /// error of a plane's value at a corner.
  LightVolumes(std::vector<Box> boxes, const Box& light, std::vector<Point3> light_corners,
               double bound);
  /// Adds a volume whose penumbra has so many planes. In any order.
  void add(std::uint32_t number, std::uint32_t caster, std::size_t planes);
  /// Adds an umbra of so many planes to the last volume: none, if only a part of the light has it.
  void add_umbra(std::uint32_t number, std::uint32_t part, std::uint32_t support,
                 std::size_t planes);
  /// Sorts what was added into a hierarchy. `planes(number, umbra, found)` leaves those of a
  /// volume's penumbra or umbra in `found`, as PlaneDoubles, turned so that it is in front of them.
  /// `jobs` other than 1: on the threads of the arena that the caller is in, `planes`, too.
  template <class Planes>
  void finish(unsigned jobs, const Planes& planes) {
    constexpr std::uint32_t kGrain = 512;
    sort(jobs);
    in_parallel(jobs, static_cast<std::uint32_t>(volumes_.size()), kGrain,
                [&](std::uint32_t begin, std::uint32_t end) {
                  std::vector<PlaneDoubles> found;
                  for (std::uint32_t i = begin; i < end; ++i) {
                    const SearchedVolume& volume = volumes_[i];
                    planes(volume.number, false, found);
                    put(found, volume.first);
                    for (const SearchedUmbra& umbra : umbras_of(volume)) {
                      planes(umbra.number, true, found);
                      put(found, umbra.first);
                    }
                  }
                });
  }

  const Box& light() const { return light_; }
  std::span<const Point3> light_corners() const { return light_corners_; }
  const Box& box(std::uint32_t caster) const { return boxes_[caster]; }
  double bound() const { return bound_; }
  /// The same of the planes of a block, at a corner in single precision.
  float block_bound() const { return block_bound_; }

 private:
  friend class VolumeSearch;
  void sort(unsigned jobs);
  std::span<const SearchedUmbra> umbras_of(const SearchedVolume& volume) const {
    return std::span(umbras_).subspan(volume.umbras_begin, volume.umbras_end - volume.umbras_begin);
  }
  void put(std::span<const PlaneDoubles> planes, std::uint32_t block);

  std::vector<Box> boxes_;
  Box light_;
  std::vector<Point3> light_corners_;
  double bound_ = 0;
  float block_bound_ = 0;
  std::vector<SearchedVolume> volumes_;  // in the order of the tree's members
  std::vector<SearchedUmbra> umbras_;    // those of a volume follow one another
  std::unique_ptr<PlaneBlock[]> blocks_;
  BoxGroups groups_;  // of the volumes' boxes; the largest diagonals are of parts with umbras
};

struct SearchedReceiver {
  std::uint32_t part = 0, support = 0;
  std::uint32_t behind = 0;  // the caster that has it as a face and lies behind it, or itself
  std::vector<Point3> corners;
};

/// Which planes of a volume may have corners of a receiver behind or on them: bit i for plane i,
/// and the last one for all that follow, too.
struct OpenPlanes {
  std::uint64_t bits = ~std::uint64_t{0};
  static constexpr std::size_t kMost = 63;
  bool has(std::size_t plane) const { return (bits >> std::min(plane, kMost) & 1) != 0; }
};

/// A volume that may reach a receiver.
struct FoundVolume {
  std::uint32_t number = 0, caster = 0;
  bool penumbra = false, umbra = false;  // which of the two may
  OpenPlanes of_penumbra, of_umbra;
};

/// Where the part of a light is that is in front of a receiver whose plane cuts it.
struct CutLight {
  Box box;
  std::vector<Point3> corners;  // to within UmbraReach::kMargin; none: not known so well
};

/// So many of the largest receivers come before all others: what is started last is waited for.
inline constexpr std::size_t kLargestFirst = 64;
/// Sorts parts so that neighbours in space follow one another: what holds one receiver is likely to
/// hold the next, and lies in the caches. `jobs`: as LightVolumes::finish() has it.
void sort_by_space(const CasterTree& tree, std::span<std::uint32_t> parts, unsigned jobs);

/// Of one thread and one light.
class VolumeSearch {
 public:
  enum class Outcome : std::uint8_t { kSome, kAllPenumbra, kAllUmbra };

  /// Leaves in found() what may reach the receiver. kAllUmbra: one caster's umbra holds all of it.
  /// kAllPenumbra: one caster's penumbra does, and only volumes whose umbra may reach it are found.
  Outcome find(const LightVolumes& light, const SearchedReceiver& receiver);

  // Of a receiver whose plane cuts the light, in this order. The volumes are those of the whole
  // light: its penumbras hold those of a part of it, its umbras are held by them.

  /// True if an umbra of the whole light holds all of the receiver. `cut` must outlive the search.
  bool begin_cut(const LightVolumes& light, const SearchedReceiver& receiver, const CutLight& cut);
  /// Leaves in found() a few volumes before the middle of the cut light. True as above.
  bool find_blocking();
  /// Leaves in found() the others that may reach the receiver. True as above. `all_penumbra`: only
  /// those whose umbra may.
  bool find_others(bool all_penumbra);

  std::span<const FoundVolume> found() const { return found_; }

 private:
  static constexpr std::size_t kHints = 8, kMostBlocking = 8;
  enum class Relation : std::uint8_t { kOutside, kInside, kOpen };
  struct Hints {
    std::array<std::uint32_t, kHints> places{};
    std::size_t count = 0, next = 0;
    void add(std::uint32_t place);
  };

  Relation relate(std::span<const PlaneBlock> planes, OpenPlanes& open) const;
  Relation relate(std::span<const PlaneBlock> planes) const {
    OpenPlanes open;
    return relate(planes, open);
  }
  bool misses_box(std::span<const PlaneBlock> planes) const;
  std::span<const PlaneBlock> planes_of(const SearchedVolume& volume) const {
    return {light_->blocks_.get() + volume.first, volume.blocks};
  }
  std::span<const PlaneBlock> planes_of(const SearchedUmbra& umbra) const {
    return {light_->blocks_.get() + umbra.first, umbra.blocks};
  }
  void begin(const LightVolumes& light, const SearchedReceiver& receiver, const CutLight* cut);
  /// Whether it is in the receiver's plane, and so is never asked.
  bool is_own(const SearchedUmbra& umbra) const {
    return umbra.part == receiver_->part || umbra.support == receiver_->support;
  }
  bool is_own(const SearchedVolume& volume) const;
  /// Whether an umbra of the whole light certainly holds the receiver.
  bool is_inside(const SearchedUmbra& umbra) const;
  bool try_umbras(std::uint32_t place);
  const UmbraReach& reach();
  bool try_to_cover(std::uint32_t place);
  bool try_hints();
  bool try_blocking();
  bool is_worth_blocking();
  bool test(std::uint32_t place);
  bool test_cut(std::uint32_t place);
  void add_umbra(const SearchedUmbra& umbra, OpenPlanes open);
  void drop_penumbra(std::size_t place);
  bool walk();

  const LightVolumes* light_ = nullptr;
  const SearchedReceiver* receiver_ = nullptr;
  const CutLight* cut_ = nullptr;  // if the receiver's plane cuts the light
  Box box_;
  std::array<float, 3> middle_{}, half_{};
  std::vector<std::array<float, 3>> corners_;
  bool has_reach_ = false, all_penumbra_ = false;
  UmbraReach reach_;
  std::vector<FoundVolume> found_;
  std::vector<std::uint32_t> blocking_;  // places of those found before the middle of a cut light
  Hints penumbra_hints_, umbra_hints_;
  std::uint32_t blocking_tried_ = 0, blocking_found_ = 0, blocking_left_out_ = 0;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_VOLUME_SEARCH_H
