// SPDX-License-Identifier: GPL-3.0-or-later
// What the oracle says of one side under one sun: the exact lit share, and what shades it. Asked of
// a few values of a table, since it costs far more than a kernel does.
#ifndef GNOMON_COMPARISON_ENGINE_TABLES_TRUE_SHARE_H
#define GNOMON_COMPARISON_ENGINE_TABLES_TRUE_SHARE_H

#include <gmpxx.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/oracle/enclosure.h"
#include "gnomon/oracle/exact_answer.h"

namespace gnomon::comparison {

struct CasterShare {
  std::string polygon;
  double share = 0;  // of the side's area, whatever else shadows it
};

struct TrueShare {
  oracle::Enclosure lit;
  std::optional<mpq_class> exact;    // where the side's parts lie in one plane
  bool faces = false;                // the sun is in front of some of it
  std::vector<CasterShare> casters;  // all, largest share first
};

/// `light`: of PreparedScene::lights, directional or a point.
TrueShare true_share(const oracle::ExactAnswer& answer, std::uint32_t light, std::uint32_t polygon,
                     Side side);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ENGINE_TABLES_TRUE_SHARE_H
