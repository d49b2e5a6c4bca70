// SPDX-License-Identifier: GPL-3.0-or-later
// An area as the oracle tells it: certified, exact where that is asked for, and with the one fact
// that no enclosure can tell: whether there is any area at all.
#ifndef GNOMON_ORACLE_AREA_SHARE_H
#define GNOMON_ORACLE_AREA_SHARE_H

#include <gmpxx.h>

#include <optional>

#include "gnomon/oracle/enclosure.h"

namespace gnomon::oracle {

/// Area as a share of the polygon and in scene units squared. `exact` is the share, where known.
struct AreaShare {
  Enclosure fraction;
  Enclosure area;
  std::optional<mpq_class> exact;
  /// True iff no area at all: decided by the subdivision, not by the enclosure.
  bool zero = true;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_AREA_SHARE_H
