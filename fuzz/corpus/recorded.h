// SPDX-License-Identifier: GPL-3.0-or-later
// The answer of a scene without a single fragment: what share of every polygon side has which class
// under every light. Exact shares do not depend on the algorithm or on how regions were cut, so
// they can be written down once and compared for ever (docs/corpus.md).
#ifndef GNOMON_FUZZ_CORPUS_RECORDED_H
#define GNOMON_FUZZ_CORPUS_RECORDED_H

#include <gmpxx.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/check/judged_scene.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/oracle/exact_answer.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/sides/polygon_sides.h"

namespace gnomon::fuzz {

/// A fraction of a polygon's area.
struct RecordedShare {
  std::optional<mpq_class> exact;  // none if parts in several planes are lit differently: their
                                   // areas are square roots
  double nearest = 0;              // to 1e-12
};

/// One side of a polygon, as a result lists it.
struct RecordedSide {
  std::string polygon;
  Side side = Side::kFront;
  std::vector<RecordedShare> shares;          // one a class, in the order of share_names()
  std::vector<std::vector<mpq_class>> parts;  // of each part, if the shares are not exact
};

struct RecordedLight {
  std::string id;
  bool area = false;
  std::vector<RecordedSide> sides;  // in order of polygons, front before back; none of dropped ones
};

/// {"lit", "shadow"}, or {"lit", "penumbra", "umbra"} of an area light.
std::span<const std::string_view> share_names(bool area_light);

/// Of a result with exact fractions, and its sides. Errors: kLimit (an enclosure too wide to
/// round).
Expected<std::vector<RecordedLight>> recorded_of(const Scene& scene, const PreparedScene& prepared,
                                                 const ShadowResult& result,
                                                 const report::SidesByLight& sides);

/// The first thing in which two answers differ, in words; empty if they are the same.
std::string difference(const std::vector<RecordedLight>& recorded,
                       const std::vector<RecordedLight>& found);

/// The same against the oracle's own regions, group of coplanar parts by group.
std::string difference_from_oracle(const oracle::ExactAnswer& answer,
                                   const std::vector<RecordedLight>& recorded);

/// The exact fractions of a scene by the kernel `plane` and by the oracle. Errors: those of
/// compute_shadows(); kGeometry if the two do not agree, which is a bug of ours.
Expected<std::vector<RecordedLight>> exact_answer_of(const JudgedScene& scene);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CORPUS_RECORDED_H
