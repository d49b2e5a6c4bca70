// SPDX-License-Identifier: GPL-3.0-or-later
// The place on a polygon that is nearest to a point in space: where a sample belongs that some
// program wrote, whose numbers seldom lie exactly in a plane.
//
// Exactness: places are exact, distances certified upper bounds. Doubles only put aside boxes that
// are certainly farther.
#ifndef GNOMON_ORACLE_GEOMETRY_NEAREST_PLACE_H
#define GNOMON_ORACLE_GEOMETRY_NEAREST_PLACE_H

#include <cstdint>
#include <optional>
#include <vector>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/box_tree.h"
#include "oracle/geometry/scene_point.h"

namespace gnomon::oracle {

struct PolygonPlace {
  std::uint32_t part = 0;
  RationalPoint point;         // of the part, borders included; scene units
  double distance = 0;         // from the point that was asked for; 0: it is that point
  mpq_class squared_distance;  // the same, exactly
};

class NearestPlaces {
 public:
  /// Keeps a reference to the scene.
  explicit NearestPlaces(const PreparedScene& scene);

  /// On one polygon; nothing if it was dropped. Of parts that are equally near the first.
  std::optional<PolygonPlace> on_polygon(std::uint32_t polygon, const RationalPoint& point) const;
  /// The nearest place of all, and those of other polygons that are farther by no more than a
  /// margin, scene units; one a polygon, in order of parts. Empty if there are no parts.
  std::vector<PolygonPlace> all_near(const RationalPoint& point, double margin) const;
  /// Parts in whose box, grown by a margin, the point is.
  template <class Visit>
  void parts_near(const RationalPoint& point, double margin, const Visit& visit) const {
    tree_.meeting(box_around(point, margin), visit);
  }
  /// Is a point of the part's plane in the part, borders included?
  bool holds(std::uint32_t part, const RationalPoint& point) const;

 private:
  struct PartPlanes {
    Integers4 support;
    std::vector<Integers4> edges;  // across the support plane, inside positive
  };

  PolygonPlace on_part(std::uint32_t part, const RationalPoint& point) const;
  PolygonPlace on_border(std::uint32_t part, const RationalPoint& point) const;
  std::vector<RationalPoint> loop_of(std::uint32_t part) const;
  bool holds(const PartPlanes& planes, const Integers4& point) const;
  SpaceBox box_around(const RationalPoint& point, double margin) const;

  const PreparedScene& scene_;
  std::vector<PartPlanes> planes_;
  double error_ = 0;  // of a coordinate of a box
  SpaceTree tree_;    // of parts, grown by that
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_NEAREST_PLACE_H
