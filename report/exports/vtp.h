// SPDX-License-Identifier: GPL-3.0-or-later
// A shadow result as PolyData of VTK (.vtp), for ParaView, PyVista and the like: one cell for each
// piece of each polygon under each light. Written by hand, as text: VTK's own library is hundreds
// of megabytes. Doubles read back to the same value; the same result gives the same bytes.
//
// Arrays of cells: `polygon`, `light` and `caster` (numbers into the field data `polygon_ids` and
// `light_ids`; -1: no caster), `side` (0 front, 1 back), `class` (0 lit, 1 penumbra, 2 umbra, 3
// shadow), `lit_share` (of the whole side under the light) and `lit_share_width` (the width of its
// certified bounds; 0 where it is exact or of a kernel that rounds).
#ifndef GNOMON_REPORT_EXPORTS_VTP_H
#define GNOMON_REPORT_EXPORTS_VTP_H

#include <span>
#include <string>
#include <vector>

#include "report/exports/result_pieces.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

/// A number for each piece.
struct CellArray {
  std::string name;
  std::vector<double> values;  // finite
};
/// Field data.
struct NamedTexts {
  std::string name;
  std::vector<std::string> texts;
};
/// What stands behind the arrays above.
struct VtpExtras {
  std::vector<CellArray> cells;
  std::vector<NamedTexts> fields;
};

void write_vtp(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
               const ShadowResult& result, std::span<const ResultPiece> pieces,
               const VtpExtras& extras = {});

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_EXPORTS_VTP_H
