// SPDX-License-Identifier: GPL-3.0-or-later
// The exact answer of one planar receiver under one light, drawn into its overlay.
#ifndef GNOMON_ORACLE_ANSWER_TRUTH_OVERLAY_H
#define GNOMON_ORACLE_ANSWER_TRUTH_OVERLAY_H

#include <cstdint>

#include "gnomon/oracle/exact_answer.h"
#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

/// Adds the shadows of each part of the group, or under an area light its penumbra and umbra. Keeps
/// references to `answer` and `group`.
GroupOverlay::Truth truth_of(const ExactAnswer& answer, std::uint32_t light,
                             const ReceiverGroup& group);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_ANSWER_TRUTH_OVERLAY_H
