// SPDX-License-Identifier: GPL-3.0-or-later
// What certify finds of runs, as numbers of the pieces of a result: errors to look at where they
// are.
#ifndef GNOMON_REPORT_EXPORTS_VERDICT_ARRAYS_H
#define GNOMON_REPORT_EXPORTS_VERDICT_ARRAYS_H

#include <span>
#include <vector>

#include "report/certificate/certificate.h"
#include "report/exports/result_pieces.h"
#include "report/exports/vtp.h"

namespace gnomon::report {

/// Two arrays for each run that was judged, of the polygon side that a piece is of:
/// "wrong_share RUN", the greatest of its shares that are misclassified, uncovered, covered twice
/// or outside; "wrong_width RUN", the widest region of error, scene units. Upper bounds, and
/// exactly 0 where there is no error; nothing is excused as rounding or ill-conditioned. -1 where
/// nothing was compared: of pieces of lights, after an interrupt. `result`: whose pieces they are.
std::vector<CellArray> verdict_arrays(const Certificate& certificate, const ShadowResult& result,
                                      std::span<const ResultPiece> pieces);

/// PolyData of VTK (vtp.h) of the exact answer, with verdict_arrays() and the field data `run_ids`
/// and `run_verdicts`. `exact`: a result of an exact kernel, of the lights that were judged.
/// Requires: LightResult::points. Errors: those of result_pieces().
Expected<void> write_verdict_vtp(TextSink& sink, const Certificate& certificate,
                                 const ShadowResult& exact);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_EXPORTS_VERDICT_ARRAYS_H
