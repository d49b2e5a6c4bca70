// SPDX-License-Identifier: GPL-3.0-or-later
// A file that tells shares alone (ToldShare) against the truth. A share that is off proves that the
// file is wrong, by at least that much; one that is right proves nothing, as a shadow in the wrong
// place keeps its share.
//
// Exactness: where the parts of a polygon are coplanar the true share is a rational, and compared
// as one. Otherwise it is enclosed, and a share that the enclosure does not exclude is right.
#ifndef GNOMON_ORACLE_JUDGE_TOLD_SHARE_CHECK_H
#define GNOMON_ORACLE_JUDGE_TOLD_SHARE_CHECK_H

#include "gnomon/oracle/compare.h"

namespace gnomon::oracle {

/// As compare_entry(), of a side of which shares alone are told. Under an area light `lit` is
/// compared, and unless umbra is claimed per caster, penumbra and umbra may be claimed wherever lit
/// is not true: each is at most the share that is not lit, and both together are that share.
PolygonComparison compare_told_shares(const ExactAnswer& answer, std::uint32_t light,
                                      const AnswerEntry& entry, const ClaimedPolygon& candidate,
                                      const ClaimedTerms& terms, const ComparisonOptions& options);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_TOLD_SHARE_CHECK_H
