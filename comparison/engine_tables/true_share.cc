// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/engine_tables/true_share.h"

#include <algorithm>
#include <map>

#include "gnomon/oracle/caster_counts.h"
#include "report/sides/part_area.h"

namespace gnomon::comparison {

namespace {

std::vector<CasterShare> casters_on(const oracle::ExactAnswer& answer, std::uint32_t light,
                                    std::uint32_t polygon, Side side) {
  const PreparedScene& prepared = answer.prepared();
  const oracle::PointRegions& regions = answer.regions(light);
  double whole = 0;
  std::map<std::uint32_t, double> areas;  // by polygon that casts
  for (std::uint32_t part = prepared.first_part[polygon]; part < prepared.first_part[polygon + 1];
       ++part) {
    const double area = report::comparable_area(prepared, prepared.parts[part]).middle();
    whole += area;
    if (regions.lit_side(part) != side) continue;
    for (const auto& [caster, share] : oracle::caster_shares(prepared, regions, part)) {
      areas[prepared.parts[caster].polygon] += area * share.get_d();
    }
  }
  std::vector<CasterShare> casters;
  for (const auto& [caster, area] : areas) {
    // The shadows of parts of one polygon may overlap.
    casters.push_back({answer.scene().polygons[caster].id, std::min(1.0, area / whole)});
  }
  std::ranges::stable_sort(casters, std::greater<>(), &CasterShare::share);
  return casters;
}

}  // namespace

TrueShare true_share(const oracle::ExactAnswer& answer, std::uint32_t light, std::uint32_t polygon,
                     Side side) {
  TrueShare result;
  const auto& entries = answer.entries(light);
  const auto entry = std::ranges::find_if(entries, [&](const oracle::AnswerEntry& one) {
    return one.polygon == polygon && one.side == side;
  });
  result.faces =
      entry != entries.end() && std::ranges::any_of(entry->groups, &oracle::ReceiverGroup::faces);
  if (!result.faces) {
    result.lit = {0, 0};
    result.exact = mpq_class(0);
    return result;
  }
  const oracle::AreaShare lit = answer.fractions(light, *entry).lit;
  result.lit = lit.fraction;
  result.exact = lit.exact;
  result.casters = casters_on(answer, light, polygon, side);
  return result;
}

}  // namespace gnomon::comparison
