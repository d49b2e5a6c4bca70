// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/group_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernel/signs/nearest_double.h"
#include "report/sides/part_area.h"

namespace gnomon::report {

namespace {

constexpr std::size_t kMostExactParts = 10'000;

/// One part of one side.
struct Member {
  const Part* part;
  const PartSide* side;
};

mpz_class squared_area(const PreparedScene& scene, const Part& part) {
  const std::array<mpz_class, 3> doubled = doubled_area_vector(scene, part);
  return doubled[0] * doubled[0] + doubled[1] * doubled[1] + doubled[2] * doubled[2];
}

/// Areas of all members in units of one of them, if these are rational; else none.
std::vector<mpq_class> rational_areas(const PreparedScene& scene,
                                      const std::vector<Member>& members) {
  std::vector<mpq_class> areas;
  const mpz_class unit = squared_area(scene, *members.front().part);
  for (const Member& member : members) {
    // sqrt(a / u) = sqrt(a u) / u.
    const mpz_class product = squared_area(scene, *member.part) * unit;
    if (mpz_perfect_square_p(product.get_mpz_t()) == 0) return {};
    areas.emplace_back(sqrt(product), unit);
    areas.back().canonicalize();
  }
  return areas;
}

/// Sums of many rationals in a balanced way: denominators grow late.
mpq_class sum_of(std::span<const mpq_class> terms) {
  if (terms.empty()) return 0;
  if (terms.size() == 1) return terms.front();
  const std::size_t half = terms.size() / 2;
  return sum_of(terms.first(half)) + sum_of(terms.subspan(half));
}

/// A number in [0, 1] cut off behind 256 bits, so that sums of many stay short.
mpq_class cut_off(const mpq_class& share) {
  constexpr unsigned kBits = 256;
  mpq_class result((share.get_num() << kBits) / share.get_den());
  result >>= kBits;
  return result;
}

Interval around(double nearest) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {std::max(0.0, std::nextafter(nearest, -kInfinity)),
          std::min(1.0, std::nextafter(nearest, kInfinity))};
}

/// From exact shares and areas of far more digits than a double has.
void sum_exactly(const PreparedScene& scene, const std::vector<Member>& members,
                 std::span<const LightState> states, GroupSum& sum) {
  std::vector<mpq_class> rational;
  if (members.size() <= kMostExactParts) rational = rational_areas(scene, members);
  mpq_class total = 0;
  std::vector<mpq_class> precise;
  for (const Member& member : members) {
    precise.push_back(precise_area(scene, *member.part));
    total += precise.back();
  }
  sum.precise_area = total;
  sum.area = nearest_double(total);
  const mpq_class rational_total = sum_of(rational);
  for (const LightState state : states) {
    GroupShare& share = sum.shares[static_cast<std::size_t>(state)];
    mpq_class area = 0;
    std::vector<mpq_class> terms;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const mpq_class own = exact_share(*members[i].side, state);
      area += cut_off(own) * precise[i];
      if (!rational.empty()) terms.push_back(own * rational[i]);
    }
    share.precise_area = area;
    share.area = nearest_double(area);
    share.share = around(nearest_double(area / total));
    if (!rational.empty()) share.exact = sum_of(terms) / rational_total;
  }
}

/// From enclosures, or what a rounded kernel says.
void sum_enclosures(const PreparedScene& scene, const std::vector<Member>& members,
                    std::span<const LightState> states, GroupSum& sum) {
  using oracle::Enclosure;
  std::vector<Enclosure> areas;
  std::vector<mpq_class> precise;
  Enclosure total{0, 0};
  mpq_class precise_total = 0;
  for (const Member& member : members) {
    areas.push_back(to_enclosure(comparable_area(scene, *member.part)));
    total = total + areas.back();
    precise.push_back(precise_area(scene, *member.part));
    precise_total += precise.back();
  }
  sum.precise_area = precise_total;
  sum.area = nearest_double(precise_total);
  for (const LightState state : states) {
    GroupShare& share = sum.shares[static_cast<std::size_t>(state)];
    Enclosure area{0, 0};
    mpq_class precise_sum = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const Interval& own = share_of(*members[i].side, state);
      area = area + areas[i] * to_enclosure(own);
      if (std::isfinite(own.middle())) precise_sum += precise[i] * mpq_class(own.middle());
    }
    const bool known = std::isfinite(area.middle()) && total.lower > 0;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    share.precise_area = precise_sum;
    share.area = std::isfinite(area.middle()) ? nearest_double(precise_sum) : kNone;
    const Enclosure ratio = known ? area / total : Enclosure{kNone, kNone};
    share.share = {ratio.lower, std::min(ratio.upper, 1.0)};
  }
}

/// What is nothing or all of every member is so of the group.
void set_certain(const std::vector<Member>& members, std::span<const LightState> states,
                 GroupSum& sum) {
  for (const LightState state : states) {
    GroupShare& share = sum.shares[static_cast<std::size_t>(state)];
    for (const double value : {0.0, 1.0}) {
      const bool all = std::ranges::all_of(members, [&](const Member& member) {
        const Interval& own = share_of(*member.side, state);
        return own.lower == value && own.upper == value;
      });
      if (!all) continue;
      share.share = {value, value};
      share.precise_area = value == 0 ? mpq_class(0) : sum.precise_area;
      share.area = value == 0 ? 0 : sum.area;
    }
  }
}

}  // namespace

GroupSum group_sum(const PreparedScene& scene, std::span<const ClassifiedSide* const> sides,
                   bool area_light, bool exact) {
  GroupSum sum;
  sum.sides = sides.size();
  std::vector<Member> members;
  for (const ClassifiedSide* side : sides) {
    const std::uint32_t first = scene.first_part[side->polygon];
    for (std::size_t i = 0; i < side->parts.size(); ++i) {
      members.push_back({&scene.parts[first + i], &side->parts[i]});
    }
  }
  if (members.empty()) return sum;
  const std::span<const LightState> states = light_states(area_light);
  if (exact) {
    sum_exactly(scene, members, states, sum);
  } else {
    sum_enclosures(scene, members, states, sum);
  }
  set_certain(members, states, sum);
  return sum;
}

}  // namespace gnomon::report
