// SPDX-License-Identifier: GPL-3.0-or-later
// Claims that tell how much of a side is lit, and not where (ClaimedTerms::shares_alone), against
// what is true: the share must be the true one, or its bounds hold it, and what is said to have one
// class as a whole must have it, and nothing else.
#ifndef GNOMON_ORACLE_JUDGE_SHARE_CHECK_H
#define GNOMON_ORACLE_JUDGE_SHARE_CHECK_H

#include <optional>
#include <string>

#include "gnomon/oracle/area_share.h"
#include "gnomon/oracle/compare.h"

namespace gnomon::oracle {

struct ShareError {
  AreaShare wrong;                         // by how much; zero if nothing is
  std::optional<LightState> found, truth;  // none: both classes
  std::string text;                        // one sentence; empty if nothing is wrong
};

/// `shadow`: all that is not lit.
ShareError share_error(const ClaimedPolygon& claimed, const AreaShare& lit,
                       const AreaShare& shadow);

/// The true shares of all classes on one side of a polygon, of all of its parts: those that this
/// side does not show the light are dark. `exact`: rationals where the parts are coplanar.
struct SideShares : TrueFractions {
  Enclosure area;  // of the side, scene units squared
};
SideShares true_shares(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry,
                       bool exact);

/// A witness of a side whose shares are wrong. Where they are is not told: the middle of the first
/// part stands for the side.
Witness witness_of_side(const ExactAnswer& answer, std::uint32_t light, const AnswerEntry& entry);

/// As compare_entry(), of a candidate without fragments.
PolygonComparison compare_shares(const ExactAnswer& answer, std::uint32_t light,
                                 const AnswerEntry& entry, const ClaimedPolygon& candidate);

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_SHARE_CHECK_H
