// SPDX-License-Identifier: LGPL-3.0-or-later
// Finds the volumes of one area light that may reach a receiver: a walk of a bounding-volume
// hierarchy down the shaft between receiver and light, and volumes against the receiver's box and
// corners, four planes at a time.
//
// Guarantee: a volume that is not found certainly misses the receiver; what is said to be all in
// penumbra or umbra certainly is, by one caster. All else is for exact arithmetic to decide. What
// is found depends on the receiver alone: casters that covered the last receivers are tried first,
// but would be found without.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_VOLUME_SEARCH_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_VOLUME_SEARCH_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "algorithms/area_contour/receiver_chart.h"
#include "algorithms/partition/box.h"
#include "algorithms/partition/box_tree.h"
#include "algorithms/partition/in_parallel.h"
#include "algorithms/shadow_volumes/caster_tree.h"

namespace gnomon::area_contour {

/// Four planes n . x - d; what fills up the last block is positive everywhere.
struct alignas(32) PlaneBlock {
  double n[3][4], d[4];
};

/// A volume as the search sees it.
struct SearchedVolume {
  std::uint32_t number = 0;  // in the light's store
  std::uint32_t part = 0, support = 0;
  std::uint32_t first = 0;                              // block of the penumbra; the umbra's follow
  std::uint32_t penumbra_blocks = 0, umbra_blocks = 0;  // 0: no umbra
};

/// The volumes of one light.
class LightVolumes {
 public:
  /// `boxes`: of all parts, and of the light, in fractions of the grid's extent. `bound`: of the
  /// error of a plane's value at a corner.
  LightVolumes(std::vector<Box> boxes, const Box& light, std::vector<Point3> light_corners,
               double bound);
  /// Adds a volume of so many planes. In any order.
  void add(std::uint32_t number, std::uint32_t part, std::uint32_t support, std::size_t penumbra,
           std::size_t umbra);
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
                    planes(volume.number, true, found);
                    put(found, volume.first + volume.penumbra_blocks);
                  }
                });
  }

  const Box& light() const { return light_; }
  std::span<const Point3> light_corners() const { return light_corners_; }
  const Box& box(std::uint32_t part) const { return boxes_[part]; }
  double bound() const { return bound_; }

 private:
  friend class VolumeSearch;
  void sort(unsigned jobs);
  void put(std::span<const PlaneDoubles> planes, std::uint32_t block);

  std::vector<Box> boxes_;
  Box light_;
  std::vector<Point3> light_corners_;
  double bound_ = 0;
  std::vector<SearchedVolume> volumes_;  // in the order of the tree's members
  std::unique_ptr<PlaneBlock[]> blocks_;
  BoxTree tree_;
  std::vector<double> largest_;  // of each node: the longest diagonal of a caster's box below it
};

struct SearchedReceiver {
  std::uint32_t part = 0, support = 0;
  std::vector<Point3> corners;
};

/// What may reach a receiver.
struct FoundVolume {
  std::uint32_t number = 0, part = 0;
  bool umbra = false;  // that of the volume may, too
};

/// Where the part of a light is that is in front of a receiver whose plane cuts it.
struct CutLight {
  Box box;
  std::vector<Point3> corners;  // to within UmbraReach::kMargin; none: not known so well
};

/// Sorts parts, but for the first few, so that neighbours in space follow one another: what holds
/// one receiver is likely to hold the next, and lies in the caches.
void sort_by_space(const CasterTree& tree, std::vector<std::uint32_t>& parts);

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
  struct Shaft;
  struct Hints {
    std::array<std::uint32_t, kHints> places{};
    std::size_t count = 0, next = 0;
    void add(std::uint32_t place);
  };

  Relation relate(std::span<const PlaneBlock> planes) const;
  bool misses_box(std::span<const PlaneBlock> planes) const;
  std::span<const PlaneBlock> penumbra(const SearchedVolume& volume) const;
  std::span<const PlaneBlock> umbra(const SearchedVolume& volume) const;
  void begin(const LightVolumes& light, const SearchedReceiver& receiver, const CutLight* cut);
  bool is_own(const SearchedVolume& volume) const {
    return volume.part == receiver_->part || volume.support == receiver_->support;
  }
  bool may_have_umbra(const SearchedVolume& volume) const;
  const UmbraReach& reach();
  bool try_to_cover(std::uint32_t place);
  bool try_hints();
  bool try_blocking();
  bool is_worth_blocking();
  bool test(std::uint32_t place);
  bool test_cut(std::uint32_t place);
  bool walk();

  const LightVolumes* light_ = nullptr;
  const SearchedReceiver* receiver_ = nullptr;
  const CutLight* cut_ = nullptr;  // if the receiver's plane cuts the light
  Box box_;
  Point3 middle_{}, half_{};
  bool has_reach_ = false, all_penumbra_ = false;
  UmbraReach reach_;
  std::vector<FoundVolume> found_;
  std::vector<std::uint32_t>
      blocking_;  // the numbers of those found before the middle of a cut light
  Hints penumbra_hints_, umbra_hints_;
  std::uint32_t blocking_tried_ = 0, blocking_found_ = 0, blocking_left_out_ = 0;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_VOLUME_SEARCH_H
