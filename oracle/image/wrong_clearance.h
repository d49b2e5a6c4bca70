// SPDX-License-Identifier: GPL-3.0-or-later
// How far one vertex must move for another polygon to be seen at a sample: an upper bound from
// three families of moves, as oracle/judge/clearance.h has it for light and shadow.
#ifndef GNOMON_ORACLE_IMAGE_WRONG_CLEARANCE_H
#define GNOMON_ORACLE_IMAGE_WRONG_CLEARANCE_H

#include <optional>

#include "oracle/image/seen_parts.h"

namespace gnomon::oracle {

/// Scene units; none if no part faces the eye. Of doubles, rounded up by a millionth.
std::optional<double> clearance_of_view(const SampledView& view, const SeenParts& seen,
                                        const Seen& at, const SampleRay& ray);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_IMAGE_WRONG_CLEARANCE_H
