// SPDX-License-Identifier: GPL-3.0-or-later
// Where a candidate claims umbra beyond what single casters hide: convex pieces from all of which
// no light is certified to be visible. The true deep umbra has a curved border; these pieces lie
// inside of it.
//
// Exactness: every piece is certified by exact tests (area_visibility.h); what is left out is not
// certified, whether dark or not.
#ifndef GNOMON_ORACLE_ANSWER_DEEP_UMBRA_H
#define GNOMON_ORACLE_ANSWER_DEEP_UMBRA_H

#include <cstddef>
#include <vector>

#include "gnomon/oracle/exact_answer.h"
#include "oracle/geometry/chart.h"

namespace gnomon::oracle {

class DeepUmbra {
 public:
  /// Keeps references. Requires: an area light, and a group that sees it.
  DeepUmbra(const ExactAnswer& answer, std::uint32_t light, const ReceiverGroup& group,
            const Chart& chart)
      : answer_(answer), light_(light), group_(group), chart_(chart) {}

  /// Looks for certified pieces in a convex, counter-clockwise loop of the chart.
  void certify(const std::vector<ChartPoint>& loop);
  /// The same in the box of points.
  void certify_box_of(const std::vector<ChartPoint>& points);
  /// The same in the whole receiver.
  void certify_whole();

  /// Inside the receiver, without what one umbra volume holds alone.
  const std::vector<std::vector<ChartPoint>>& certified() const { return certified_; }

 private:
  static constexpr int kDepth = 12;             // halvings of a loop
  static constexpr std::size_t kTests = 4'000;  // in all

  void certify_in_part(const std::vector<ChartPoint>& loop, std::uint32_t part);

  const ExactAnswer& answer_;
  std::uint32_t light_;
  const ReceiverGroup& group_;
  const Chart& chart_;
  std::size_t tests_ = 0;
  std::vector<std::vector<ChartPoint>> certified_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_ANSWER_DEEP_UMBRA_H
