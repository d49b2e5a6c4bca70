// SPDX-License-Identifier: GPL-3.0-or-later
// One planar receiver (the coplanar parts of one polygon), what is true of it and what is claimed
// of it in one overlay, and areas of sets of its cells.
#ifndef GNOMON_ORACLE_GEOMETRY_GROUP_OVERLAY_H
#define GNOMON_ORACLE_GEOMETRY_GROUP_OVERLAY_H

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gnomon/oracle/area_share.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/chart.h"
#include "oracle/geometry/overlay.h"

namespace gnomon::oracle {

std::vector<Integers3> grid_loop(const PreparedScene& scene, std::uint32_t part);
/// Of the part's own loop, reduced: equal planes with equal fronts are equal as data.
ExactPlane support_of(const PreparedScene& scene, std::uint32_t part);
/// Of coplanar parts, in scene units squared.
Enclosure group_area(const PreparedScene& scene, std::span<const std::uint32_t> parts);
/// The same in units of the scene's grid, which are of its size whatever the scale of its numbers.
Enclosure group_area_on_grid(const PreparedScene& scene, std::span<const std::uint32_t> parts);
/// The same of several groups in units of the largest, which doubles hold at every scale.
std::vector<Enclosure> areas_in_ratio(const PreparedScene& scene,
                                      std::span<const std::vector<std::uint32_t>> groups);
/// |a| / |b| without overflow on the way.
Enclosure enclose_ratio(const mpz_class& a, const mpz_class& b);

class GroupOverlay {
 public:
  /// Adds to the overlay what is true of one part, whose own loop is given counter-clockwise in the
  /// chart and has been added.
  using Truth =
      std::function<void(Overlay&, std::uint32_t part, const std::vector<ChartPoint>& loop)>;
  /// `parts`: coplanar ones, at least one.
  GroupOverlay(const PreparedScene& scene, std::span<const std::uint32_t> parts,
               const Truth& add_truth);

  const Chart& chart() const { return chart_; }
  Overlay& overlay() { return overlay_; }
  const Overlay& overlay() const { return overlay_; }
  /// After all fragments have been added to overlay().
  void build();
  using Choice = std::function<bool(const Winding&)>;
  /// Area of the cells chosen, as a share of the receiver; exact if the boundary has at most
  /// `exact_limit` edges.
  AreaShare share(const Choice& choice, std::size_t exact_limit) const;
  AreaShare share(const std::vector<bool>& faces, std::size_t exact_limit) const;
  std::vector<bool> choose(const Choice& choice) const;
  Enclosure whole_area() const { return whole_area_; }

 private:
  Chart chart_;
  Overlay overlay_;
  Enclosure whole_area_;
  Overlay::FixedArea whole_fixed_;
  std::vector<bool> receiver_faces_;
};

/// Sums shares of several planes of one polygon; exact as long as there is only one.
class ShareSum {
 public:
  /// `weight`: the area of the whole, in a unit that doubles hold (areas_in_ratio()).
  void add(const AreaShare& share, Enclosure weight);
  AreaShare result() const;

 private:
  AreaShare only_;
  Enclosure area_, weighted_, whole_;
  int count_ = 0;
  bool zero_ = true, full_ = true;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_GROUP_OVERLAY_H
