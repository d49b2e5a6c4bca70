// SPDX-License-Identifier: GPL-3.0-or-later
// By how many polygons the points of an edge are hidden from an eye or a light, found twice and
// without contours: each polygon by itself along a whole edge, and at one point by the segment from
// it to the eye.
//
// Exactness: exact, in integers and rationals. Doubles only set polygons aside whose boxes are
// clear of the triangle between edge and eye.
#ifndef GNOMON_ORACLE_LINE_COUNTS_H
#define GNOMON_ORACLE_LINE_COUNTS_H

#include <gmpxx.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon::oracle {

/// From the end of the part before it, or from the edge's first vertex (0).
struct CountedPart {
  mpq_class end;
  std::uint32_t hidden_by = 0;
  friend bool operator==(const CountedPart&, const CountedPart&) = default;
};

class LineCounts {
 public:
  /// Requires: a point or directional light; an eye is one with `is_eye`, from which every polygon
  /// hides. Keeps a reference to the scene.
  LineCounts(const PreparedScene& scene, const PreparedLight& light);
  ~LineCounts();
  LineCounts(LineCounts&&) noexcept;

  /// The edge of the geometry in parts, neighbours with different counts (docs: hidden-lines). A
  /// polygon hides one interval of points moved to one side of the plane of edge and eye, and one
  /// of those moved to the other; the larger count is taken. Cost: all polygons. Thread-safe.
  std::vector<CountedPart> parts(EdgeId edge) const;

  /// At the point a + t (b - a): how many polygons meet the open segment to the eye. Nothing if it
  /// meets a border, and not all along the edge, or if the edge goes through a polygon there. Cost:
  /// all polygons. Thread-safe.
  std::optional<std::uint32_t> count_at(EdgeId edge, const mpq_class& t) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_LINE_COUNTS_H
