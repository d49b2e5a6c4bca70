// SPDX-License-Identifier: GPL-3.0-or-later
// What the rows of an angular table do to a picture, as the oracle is told of it.
#ifndef GNOMON_REPORT_PIXELS_ROWS_OF_TABLE_H
#define GNOMON_REPORT_PIXELS_ROWS_OF_TABLE_H

#include "gnomon/algorithms/method_options.h"
#include "gnomon/oracle/image.h"
#include "gnomon/scene/camera.h"

namespace gnomon::report {

/// Of ridge-edges with rows: whether an edge is within half a row. Nothing of other methods. Keeps
/// a reference to the view.
oracle::NearBorder rows_of_table(const PreparedView& view, const MethodSelection& method);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PIXELS_ROWS_OF_TABLE_H
