// SPDX-License-Identifier: LGPL-3.0-or-later
// The functions of lanes.h for one level of vector instructions: each source of this folder that
// includes this header defines GNOMON_LANES_LEVEL, the namespace of its table, and is compiled with
// the flags of its level. Everything else here has internal linkage.
//
// Only the way in which a vector of comparisons becomes bits is written level by level; values are
// computed by the same vector expressions, which compilers lower to what the level has.
#ifndef GNOMON_LANES_LEVEL
#error "define GNOMON_LANES_LEVEL, the namespace of the level"
#endif

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "algorithms/contour/lanes/lanes.h"

namespace gnomon::GNOMON_LANES_LEVEL {
namespace {

#define GNOMON_INLINE inline __attribute__((always_inline))

// Four doubles at any place of an array of doubles.
typedef double Doubles __attribute__((vector_size(32), aligned(8), may_alias));

// --- Comparisons as bits ---

/// Bit k: greater[k] > smaller[k].
GNOMON_INLINE std::uint32_t bits_greater(const Doubles& greater, const Doubles& smaller) {
#if defined(__AVX512VL__)
  return _mm256_cmp_pd_mask((__m256d)greater, (__m256d)smaller, _CMP_GT_OQ);
#elif defined(__AVX2__)
  return static_cast<std::uint32_t>(
      _mm256_movemask_pd(_mm256_cmp_pd((__m256d)greater, (__m256d)smaller, _CMP_GT_OQ)));
#elif defined(__SSE2__)
  const __m128d low = _mm_cmpgt_pd(_mm_set_pd(greater[1], greater[0]),  //
                                   _mm_set_pd(smaller[1], smaller[0]));
  const __m128d high =
      _mm_cmpgt_pd(_mm_set_pd(greater[3], greater[2]), _mm_set_pd(smaller[3], smaller[2]));
  return static_cast<std::uint32_t>(_mm_movemask_pd(low) | _mm_movemask_pd(high) << 2);
#else
  std::uint32_t bits = 0;
  for (int k = 0; k < 4; ++k) bits |= static_cast<std::uint32_t>(greater[k] > smaller[k]) << k;
  return bits;
#endif
}

/// What a query asks of targets.
struct Query {
  float low_v, high_u, high_v;
  std::uint32_t traits;
};

/// Bit k of `reached`: the low u of target k is not above the query's high u; bit k of `found`:
/// the pair is reported, provided that the target's low u is not below the query's.
struct Found {
  std::uint32_t reached, found;
};

#if defined(__AVX2__)
GNOMON_INLINE Found test_targets(const Query& query, const SweepList& targets, std::uint32_t at) {
  const __m256 low_u = _mm256_loadu_ps(targets.low_u + at);
  const __m256 low_v = _mm256_loadu_ps(targets.low_v + at);
  const __m256 high_v = _mm256_loadu_ps(targets.high_v + at);
  const __m256i traits =
      _mm256_or_si256(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(targets.traits + at)),
                      _mm256_set1_epi32(static_cast<int>(query.traits)));
  const __m256i all = _mm256_set1_epi32(static_cast<int>(kAllTraits));
#if defined(__AVX512VL__)
  const __mmask8 reached = _mm256_cmp_ps_mask(low_u, _mm256_set1_ps(query.high_u), _CMP_LE_OQ);
  const __mmask8 below =
      _mm256_mask_cmp_ps_mask(reached, low_v, _mm256_set1_ps(query.high_v), _CMP_LE_OQ);
  const __mmask8 overlap =
      _mm256_mask_cmp_ps_mask(below, high_v, _mm256_set1_ps(query.low_v), _CMP_GE_OQ);
  return {reached, _mm256_mask_cmpeq_epi32_mask(overlap, traits, all)};
#else
  const __m256 reached = _mm256_cmp_ps(low_u, _mm256_set1_ps(query.high_u), _CMP_LE_OQ);
  const __m256 below = _mm256_cmp_ps(low_v, _mm256_set1_ps(query.high_v), _CMP_LE_OQ);
  const __m256 above = _mm256_cmp_ps(high_v, _mm256_set1_ps(query.low_v), _CMP_GE_OQ);
  const __m256 complete = _mm256_castsi256_ps(_mm256_cmpeq_epi32(traits, all));
  const __m256 found = _mm256_and_ps(_mm256_and_ps(reached, below), _mm256_and_ps(above, complete));
  return {static_cast<std::uint32_t>(_mm256_movemask_ps(reached)),
          static_cast<std::uint32_t>(_mm256_movemask_ps(found))};
#endif
}
#elif defined(__SSE2__)
GNOMON_INLINE Found test_four(const Query& query, const SweepList& targets, std::uint32_t at) {
  const __m128 reached = _mm_cmple_ps(_mm_loadu_ps(targets.low_u + at), _mm_set1_ps(query.high_u));
  const __m128 below = _mm_cmple_ps(_mm_loadu_ps(targets.low_v + at), _mm_set1_ps(query.high_v));
  const __m128 above = _mm_cmpge_ps(_mm_loadu_ps(targets.high_v + at), _mm_set1_ps(query.low_v));
  const __m128i traits =
      _mm_or_si128(_mm_loadu_si128(reinterpret_cast<const __m128i*>(targets.traits + at)),
                   _mm_set1_epi32(static_cast<int>(query.traits)));
  const __m128 complete =
      _mm_castsi128_ps(_mm_cmpeq_epi32(traits, _mm_set1_epi32(static_cast<int>(kAllTraits))));
  const __m128 found = _mm_and_ps(_mm_and_ps(reached, below), _mm_and_ps(above, complete));
  return {static_cast<std::uint32_t>(_mm_movemask_ps(reached)),
          static_cast<std::uint32_t>(_mm_movemask_ps(found))};
}
GNOMON_INLINE Found test_targets(const Query& query, const SweepList& targets, std::uint32_t at) {
  const Found low = test_four(query, targets, at), high = test_four(query, targets, at + 4);
  return {low.reached | high.reached << 4, low.found | high.found << 4};
}
#else
GNOMON_INLINE Found test_targets(const Query& query, const SweepList& targets, std::uint32_t at) {
  Found result = {0, 0};
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::uint32_t target = at + k;
    const bool reached = targets.low_u[target] <= query.high_u;
    const bool found = reached & (targets.low_v[target] <= query.high_v) &
                       (targets.high_v[target] >= query.low_v) &
                       ((targets.traits[target] | query.traits) == kAllTraits);
    result.reached |= static_cast<std::uint32_t>(reached) << k;
    result.found |= static_cast<std::uint32_t>(found) << k;
  }
  return result;
}
#endif

// --- Bits as lists ---

/// The numbers of the bits of each byte in rising order, as eight bytes, and how many there are.
struct BitLists {
  std::uint64_t lists[256];
  std::uint8_t counts[256];
};
constexpr BitLists make_bit_lists() {
  BitLists result = {};
  for (int byte = 0; byte < 256; ++byte) {
    for (std::uint64_t bit = 0; bit < 8; ++bit) {
      if ((byte >> bit & 1) == 0) continue;
      result.lists[byte] |= bit << 8 * result.counts[byte];
      ++result.counts[byte];
    }
  }
  return result;
}
constexpr BitLists kBitLists = make_bit_lists();

/// Writes base + the number of each bit that is set, and anything behind them up to eight words;
/// returns how many bits are set.
GNOMON_INLINE std::uint32_t write_bits(std::uint32_t bits, std::uint32_t base,
                                       std::uint32_t* place) {
  const std::uint64_t list = kBitLists.lists[bits];
#if defined(__AVX2__)
  const __m256i numbers = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(list)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(place),
                      _mm256_add_epi32(numbers, _mm256_set1_epi32(static_cast<int>(base))));
#else
  for (int k = 0; k < 8; ++k) place[k] = base + (list >> 8 * k & 0xff);
#endif
  return kBitLists.counts[bits];
}

// --- The functions of the table ---

/// Vectors are passed by reference: below AVX, how they are passed by value is not settled.
GNOMON_INLINE void put_values(double a, double b, double c, const double* corners,
                              Doubles& values) {
  const Doubles* rows = reinterpret_cast<const Doubles*>(corners);
  values = (a * rows[0] + b * rows[1]) + c * rows[2];
}

CornerSigns corner_signs(const double* line, double bound, const double* corners,
                         std::uint32_t blocks) {
  const Doubles upper = {bound, bound, bound, bound}, lower = -upper;
  CornerSigns signs = {0, 0};
  for (std::uint32_t block = 0; block < blocks; ++block) {
    Doubles values;
    put_values(line[0], line[1], line[2], corners + kBlockDoubles * block, values);
    signs.positive |= static_cast<std::uint64_t>(bits_greater(values, upper)) << 4 * block;
    signs.negative |= static_cast<std::uint64_t>(bits_greater(lower, values)) << 4 * block;
  }
  return signs;
}

template <bool kStore>
GNOMON_INLINE BlockSigns signs_of_block(const double* lines, const double* errors, double reach,
                                        const double* corners, double* place) {
  std::uint32_t positive = 0, negative = 0;
  for (int i = 0; i < 4; ++i) {
    const double bound = errors[i] * reach;
    const Doubles upper = {bound, bound, bound, bound}, lower = -upper;
    Doubles values;
    put_values(lines[i], lines[4 + i], lines[8 + i], corners, values);
    if constexpr (kStore) *reinterpret_cast<Doubles*>(place + 4 * i) = values;
    positive |= bits_greater(values, upper) << 4 * i;
    negative |= bits_greater(lower, values) << 4 * i;
  }
  return {static_cast<std::uint16_t>(positive), static_cast<std::uint16_t>(negative)};
}

BlockSigns block_signs(const double* lines, const double* errors, double reach,
                       const double* corners) {
  return signs_of_block<false>(lines, errors, reach, corners, nullptr);
}

BlockSigns block_values(const double* lines, const double* errors, double reach,
                        const double* corners, double* values) {
  return signs_of_block<true>(lines, errors, reach, corners, values);
}

bool sweep(const SweepList& queries, const SweepList& targets, SweepOrder order, SweepState& state,
           std::uint32_t* query_counts) {
  std::uint32_t target = state.target;
  std::uint64_t found = state.found;
  std::uint32_t number = state.query;
  for (; number < queries.count; ++number) {
    const float low_u = queries.low_u[number];
    // A NaN behind the targets ends these loops.
    if (order == SweepOrder::kAfter) {
      target = number + 1;
    } else if (order == SweepOrder::kNotBelow) {
      while (targets.low_u[target] < low_u) ++target;
    } else {
      while (targets.low_u[target] <= low_u) ++target;
    }
    if (state.capacity - found < targets.count - target + 8) break;
    const Query query = {queries.low_v[number], queries.high_u[number], queries.high_v[number],
                         queries.traits[number]};
    const std::uint64_t before = found;
    for (std::uint32_t at = target;; at += 8) {
      const Found bits = test_targets(query, targets, at);
      for (int k = 0; k < 8; ++k) state.queries[found + k] = queries.base + number;
      found += write_bits(bits.found, targets.base + at, state.targets + found);
      if (bits.reached != 0xff) break;
    }
    query_counts[number] += static_cast<std::uint32_t>(found - before);
  }
  state.query = number;
  state.target = target;
  state.found = found;
  return number == queries.count;
}

#undef GNOMON_INLINE

}  // namespace

const Lanes kLanes = {corner_signs, block_signs, block_values, sweep};

}  // namespace gnomon::GNOMON_LANES_LEVEL
