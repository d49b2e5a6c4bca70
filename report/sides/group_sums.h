// SPDX-License-Identifier: GPL-3.0-or-later
// Shares of groups of polygons (gnomon/scene/groups.h): the sides of all members that the result
// lists, added up by their areas.
//
// Exactness: a share is a rational if exact fractions were asked for and the areas of all members
// are rational multiples of each other (all in parallel planes, or with normals of rational length,
// as axis-parallel ones have); else an enclosure. All and nothing are exactly 1 and 0 either way.
#ifndef GNOMON_REPORT_SIDES_GROUP_SUMS_H
#define GNOMON_REPORT_SIDES_GROUP_SUMS_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "report/sides/polygon_sides.h"

namespace gnomon::report {

struct GroupShare {
  Interval share;
  std::optional<mpq_class> exact;
  double area = 0;             // scene units squared
  mpq_class precise_area = 0;  // the same, to more digits than a double has, at every scale
};

struct GroupSum {
  std::uint64_t sides = 0;           // that were added: of a polygon each one that the result lists
  double area = 0;                   // of them, scene units squared
  mpq_class precise_area = 0;        // the same, to more digits than a double has
  std::array<GroupShare, 4> shares;  // by LightState; those that the light knows

  const GroupShare& of(LightState state) const { return shares[static_cast<std::size_t>(state)]; }
};

/// `sides`: of the members, under one light. `exact`: the parts carry exact fractions. A group of
/// more than 10,000 parts has no exact share, since such sums grow without bound.
GroupSum group_sum(const PreparedScene& scene, std::span<const ClassifiedSide* const> sides,
                   bool area_light, bool exact);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_GROUP_SUMS_H
