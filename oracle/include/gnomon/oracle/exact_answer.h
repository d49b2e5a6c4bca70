// SPDX-License-Identifier: GPL-3.0-or-later
// The exact answer of a scene, computed once and compared with as many candidates as there are: for
// every light, the sides that a result must list, and every shadow, penumbra and umbra on every
// part.
//
// Exactness: regions are those of point_regions.h and area_regions.h. Everything is computed when
// it is first asked for; all member functions may be called from several threads at once.
#ifndef GNOMON_ORACLE_EXACT_ANSWER_H
#define GNOMON_ORACLE_EXACT_ANSWER_H

#include <gmpxx.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/oracle/area_regions.h"
#include "gnomon/oracle/area_share.h"
#include "gnomon/oracle/area_visibility.h"
#include "gnomon/oracle/point_regions.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::oracle {

/// Coplanar parts of one polygon: one plane, one chart, one comparison.
struct ReceiverGroup {
  std::vector<std::uint32_t> parts;
  bool faces = false;  // some light can arrive; otherwise all of it is in shadow, or umbra
  bool light_in_plane = false;
  bool optional = false;     // of another side than the entry's: may be listed here, as shadow
  Side side = Side::kFront;  // area lights: the entry's
  bool tiling = true;        // false: whether fragments tile it is judged under another light
};

/// One polygon side that a result lists.
struct AnswerEntry {
  std::uint32_t polygon = 0;
  Side side = Side::kFront;
  std::vector<ReceiverGroup> groups;
};

struct TrueFractions {
  AreaShare lit, shadow;      // shadow: none for an area light
  AreaShare penumbra, umbra;  // area lights
};

class ExactAnswer {
 public:
  /// Keeps references to both.
  ExactAnswer(const Scene& scene, const PreparedScene& prepared);
  ~ExactAnswer();

  const Scene& scene() const;
  const PreparedScene& prepared() const;
  /// Index into PreparedScene::lights.
  const std::vector<AnswerEntry>& entries(std::uint32_t light) const;
  bool is_area(std::uint32_t light) const;
  /// Requires: a point or directional light.
  const PointRegions& regions(std::uint32_t light) const;
  /// Requires: an area light.
  const AreaRegions& area_regions(std::uint32_t light) const;
  /// All shadows on a part; empty if it faces nothing.
  const std::vector<ShadowPiece>& shadows(std::uint32_t light, std::uint32_t part) const;
  /// Requires: an area light.
  const AreaVisibility& area_visibility(std::uint32_t light) const;
  /// All that is not lit on one side of a part under an area light; umbra `behind` if it sees
  /// nothing of it.
  const AreaShade& area_shade(std::uint32_t light, std::uint32_t part, Side side) const;
  /// Drops what was kept of one light, for scenes with many.
  void forget(std::uint32_t light) const;

  /// Fractions of an entry's classes, from the true regions alone; `exact` is set for an entry
  /// whose parts are coplanar.
  TrueFractions fractions(std::uint32_t light, const AnswerEntry& entry, bool exact = true) const;
  /// The same of one group.
  TrueFractions group_fractions(std::uint32_t light, const ReceiverGroup& group,
                                bool exact = true) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_EXACT_ANSWER_H
