// SPDX-License-Identifier: LGPL-3.0-or-later
// From the unions of penumbras and of umbras to classes and shares of a receiver; and the names of
// lines by which places are known to be one.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_SHARE_CLASSES_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_SHARE_CLASSES_H

#include <cstdint>
#include <optional>

#include "algorithms/area_contour/outline_union.h"
#include "algorithms/area_contour/receiver_chart.h"
#include "gnomon/algorithms/shadow_result.h"

namespace gnomon::area_contour {

/// Certified shares of one side of a receiver; what is exactly 0 or 1 is.
struct Shares {
  Interval lit, penumbra, umbra;
};
inline constexpr Shares kAllUmbra{{0, 0}, {0, 0}, {1, 1}};

/// Whether bounds leave open that a union covers nothing. Then, if something is known to be inside
/// of an outline, UnionShare::some is to be set, and if nothing is inside of any, there is no
/// union.
bool may_be_nothing(const UnionShare& share);

/// `penumbra`, `umbra`: of the unions; none: no volume of the kind reaches the receiver.
/// `all_penumbra`: one penumbra holds all of it. None: the bounds leave a class open, or much of a
/// share.
std::optional<Shares> shares_of(const std::optional<UnionShare>& penumbra, bool all_penumbra,
                                const std::optional<UnionShare>& umbra);

/// The same where nothing but the light's own plane dims the receiver: what is behind it is umbra,
/// and there is no penumbra.
std::optional<Shares> shares_of(const UnionShare& behind_light);

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_SHARE_CLASSES_H
