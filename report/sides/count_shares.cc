// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/count_shares.h"

#include <algorithm>
#include <map>
#include <utility>

namespace gnomon::report {

namespace {

using Found = std::vector<CasterCount>::const_iterator;

CountShare share_of_one_part(const CasterCount& own, bool exact) {
  CountShare share{own.count, own.share, {}};
  if (exact) share.exact = own.exact;
  return share;
}

/// Sums those of one count over the parts of a polygon.
CountShare sum_of(const PreparedScene& scene, const std::vector<const CasterCount*>& own,
                  std::uint32_t polygon, const std::vector<mpq_class>& exactly,
                  const PartWeights& weights) {
  const std::uint32_t first = scene.first_part[polygon];
  std::vector<Interval> shares(scene.first_part[polygon + 1] - first);
  mpq_class sum = 0;
  for (const CasterCount* one : own) {
    shares[one->part - first] = one->share;
    if (!exactly.empty()) sum += exactly[one->part - first] * one->exact;
  }
  CountShare share{own.front()->count, weights.sum(polygon, shares), {}};
  if (!exactly.empty()) share.exact = std::move(sum);
  return share;
}

}  // namespace

std::vector<CountShare> count_shares(const PreparedScene& scene, const CasterCounts& counts,
                                     std::uint32_t polygon, bool exact,
                                     const PartWeights& weights) {
  const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
  const Found begin = std::ranges::lower_bound(counts.shares, first, {}, &CasterCount::part);
  const Found end = std::ranges::lower_bound(counts.shares, last, {}, &CasterCount::part);
  std::vector<CountShare> result;
  if (last - first == 1) {
    for (Found own = begin; own != end; ++own) result.push_back(share_of_one_part(*own, exact));
    return result;
  }
  std::map<std::uint32_t, std::vector<const CasterCount*>> by_count;
  for (Found own = begin; own != end; ++own) by_count[own->count].push_back(&*own);
  std::vector<mpq_class> exactly;
  if (exact && is_coplanar(scene, polygon)) exactly = exact_weights(scene, polygon);
  for (const auto& [count, own] : by_count) {
    result.push_back(sum_of(scene, own, polygon, exactly, weights));
  }
  return result;
}

}  // namespace gnomon::report
