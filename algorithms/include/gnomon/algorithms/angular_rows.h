// SPDX-License-Identifier: LGPL-3.0-or-later
// What the rows of the method ridge-edges cannot tell apart: with a table of N rows a point is
// taken for one in the middle of its row, seen from the light. Where no edge lies between the two
// the table is right. For who judges its pictures, and tells what rows cost from what is wrong.
#ifndef GNOMON_ALGORITHMS_ANGULAR_ROWS_H
#define GNOMON_ALGORITHMS_ANGULAR_ROWS_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <memory>

#include "gnomon/algorithms/method_options.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/image_frame.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

class AngularRows {
 public:
  /// The rows of the tables of one light, an index into PreparedScene::lights. Requires: a point or
  /// directional light. Keeps a reference to the scene. Cost: that of the table without its
  /// entries.
  AngularRows(const PreparedScene& scene, const ImageFrame& frame,
              const MethodOptionValues& options, std::uint32_t light);
  ~AngularRows();
  AngularRows(AngularRows&&) noexcept;

  /// Whether, as the light sees it, an edge of a polygon that casts lies between the point, scene
  /// units, and the middle of its row: within half a row of it, in the same column. Exact; false if
  /// there are no rows or none holds the point. Thread-safe. Cost: all polygons.
  bool has_edge_near(const std::array<mpq_class, 3>& point) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_ROWS_H
