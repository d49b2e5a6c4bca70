// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/kernel/precision_plan.h"

namespace gnomon {
namespace {

// The tables of docs/exactness.md: a building in millimetres, and full doubles of one magnitude;
// for the directional lights, directions of 53 bits.
constexpr bool has_bits(bool directional, unsigned b, unsigned e,
                        const std::array<unsigned, 13>& bits) {
  const auto plan = precision_plan(directional, b, e);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i].bits != bits[i] || plan[i].width != narrowest_width(bits[i])) return false;
  }
  return true;
}
static_assert(has_bits(false, 17, 0, {35, 53, 106, 159, 35, 88, 53, 105, 88, 158, 211, 264, 53}));
static_assert(has_bits(false, 53, 0,
                       {107, 161, 322, 483, 107, 268, 161, 321, 268, 482, 643, 804, 161}));
static_assert(has_bits(true, 17, 53, {35, 53, 106, 159, 90, 143, 90, 234, 180, 287, 339, 391, 53}));
static_assert(has_bits(true, 53, 53,
                       {107, 161, 322, 483, 162, 323, 162, 378, 324, 539, 699, 859, 161}));

constexpr bool has_volume_bits(LightCuts cuts, unsigned b, const std::array<unsigned, 4>& bits) {
  const auto plan = volume_precision_plan(cuts, b);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (plan[i].bits != bits[i] || plan[i].width != narrowest_width(bits[i])) return false;
  }
  return true;
}
static_assert(has_volume_bits(LightCuts::kNone, 17, {35, 53, 106, 159}));
static_assert(has_volume_bits(LightCuts::kOnce, 17, {88, 107, 214, 319}));
static_assert(has_volume_bits(LightCuts::kTwice, 17, {142, 161, 322, 481}));
static_assert(has_volume_bits(LightCuts::kNone, 53, {107, 161, 322, 483}));
static_assert(has_volume_bits(LightCuts::kOnce, 53, {268, 323, 646, 967}));
static_assert(has_volume_bits(LightCuts::kTwice, 53, {430, 485, 970, 1453}));

}  // namespace

std::string_view width_name(IntegerWidth width) {
  switch (width) {
    case IntegerWidth::k64:
      return "64";
    case IntegerWidth::k128:
      return "128";
    case IntegerWidth::k256:
      return "256";
    case IntegerWidth::k512:
      return "512";
    case IntegerWidth::k1024:
      return "1024";
    case IntegerWidth::kUnbounded:
      return "GMP";
  }
  return "?";
}

}  // namespace gnomon
