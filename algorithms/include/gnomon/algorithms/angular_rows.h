// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the method ridge-edges looks: with a table of N rows a point is taken for one in the middle
// of its row, seen from the light. For who judges its pictures, and tells what the rows cost from
// what is wrong.
#ifndef GNOMON_ALGORITHMS_ANGULAR_ROWS_H
#define GNOMON_ALGORITHMS_ANGULAR_ROWS_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

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

  /// The point of the part's plane in the same column and the middle of the row that holds `point`,
  /// scene units, exactly; none if there are no rows, none of them holds it, or the plane does not
  /// reach there. Thread-safe.
  std::optional<std::array<mpq_class, 3>> middle(std::uint32_t part,
                                                 const std::array<mpq_class, 3>& point) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_ROWS_H
