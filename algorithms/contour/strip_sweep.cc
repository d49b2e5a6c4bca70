// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/contour/strip_sweep.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace gnomon {
namespace {

/// A number that is the greater, the greater the float; that of -0 is below that of 0.
std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits ^ ((bits >> 31) != 0 ? 0xffffffffu : 0x80000000u);
}

}  // namespace

/// Sorts by the upper half of the keys, digit by digit from the lowest; equal ones keep their
/// order.
template <unsigned kBits>
void StripSweep::sort_by_digits(std::uint32_t count) {
  constexpr unsigned kDigits = (32 + kBits - 1) / kBits;
  constexpr std::uint32_t kValues = 1u << kBits;
  std::array<std::array<std::uint32_t, kValues>, kDigits> starts{};
  const auto digit_of = [](std::uint64_t key, unsigned digit) {
    return static_cast<std::uint32_t>(key >> (32 + digit * kBits)) & (kValues - 1);
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    for (unsigned digit = 0; digit < kDigits; ++digit) ++starts[digit][digit_of(keys_[i], digit)];
  }
  for (unsigned digit = 0; digit < kDigits; ++digit) {
    std::uint32_t* start = starts[digit].data();
    if (start[digit_of(keys_[0], digit)] == count) continue;  // the same in all
    std::uint32_t next = 0;
    for (std::uint32_t value = 0; value < kValues; ++value) {
      next += std::exchange(start[value], next);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      other_keys_[start[digit_of(keys_[i], digit)]++] = keys_[i];
    }
    keys_.swap(other_keys_);
  }
}

void StripSweep::sort_keys(std::uint32_t count) {
  if (count < 64) {
    std::sort(keys_.begin(), keys_.begin() + count);
  } else if (count < 2048) {
    sort_by_digits<8>(count);
  } else {
    sort_by_digits<11>(count);
  }
}

/// The entries [begin, end) as a list in the order of low u, then of their numbers.
SweepList StripSweep::sorted(const StripEntries& entries, std::uint32_t begin, std::uint32_t end,
                             List& list, std::uint32_t* slots, std::uint32_t* owners) {
  constexpr std::uint32_t kPadding = 8;
  const std::uint32_t count = end - begin;
  make_room(keys_, count);
  make_room(other_keys_, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    keys_[i] = std::uint64_t{ordered_bits(entries[begin + i].low_u)} << 32 | i;
  }
  sort_keys(count);
  for (auto* values : {&list.low_u, &list.low_v, &list.high_u, &list.high_v}) {
    make_room(*values, count + kPadding);
  }
  make_room(list.traits, count + kPadding);
  for (std::uint32_t i = 0; i < count; ++i) {
    const StripEntry& entry = entries[begin + static_cast<std::uint32_t>(keys_[i])];
    list.low_u[i] = entry.low_u;
    list.low_v[i] = entry.low_v;
    list.high_u[i] = entry.high_u;
    list.high_v[i] = entry.high_v;
    list.traits[i] = entry.traits;
    slots[begin + i] = entry.slot;
    owners[begin + i] = entry.owner;
  }
  std::fill_n(list.low_u.begin() + count, kPadding, std::numeric_limits<float>::quiet_NaN());
  return {list.low_u.data(),
          list.low_v.data(),
          list.high_u.data(),
          list.high_v.data(),
          list.traits.data(),
          count,
          begin};
}

/// The pairs of a query and a target. Counts those of the targets here, those of the queries as
/// they are found.
bool StripSweep::sweep(const Lanes& lanes, const SweepList& queries, const SweepList& targets,
                       SweepOrder order, std::uint64_t most, std::uint32_t* counts) {
  SweepState state;
  const std::uint64_t before = pairs_.used;
  for (bool done = false; !done;) {
    const std::uint64_t room = pairs_.used + targets.count + 8;
    if (pairs_.first.size() < room) {
      pairs_.first.resize(room + room / 2);
      pairs_.second.resize(room + room / 2);
    }
    state.found = pairs_.used;
    state.capacity = pairs_.first.size();
    state.queries = pairs_.first.data();
    state.targets = pairs_.second.data();
    done = lanes.sweep(queries, targets, order, state, counts + queries.base);
    pairs_.used = state.found;
    if (pairs_.used - before > most) return false;
  }
  for (std::uint64_t i = before; i < pairs_.used; ++i) ++counts[pairs_.second[i]];
  return true;
}

bool StripSweep::run(const Lanes& lanes, const StripEntries& entries, std::uint32_t strip,
                     std::uint64_t most, std::uint32_t* slots, std::uint32_t* owners,
                     std::uint32_t* counts) {
  const std::uint32_t begin = entries.own_begin(strip), finer_begin = entries.finer_begin(strip);
  const std::uint32_t end = entries.end(strip);
  std::fill(counts + begin, counts + end, 0);
  const SweepList own = sorted(entries, begin, finer_begin, lists_[0], slots, owners);
  if (!sweep(lanes, own, own, SweepOrder::kAfter, most, counts)) return false;
  if (finer_begin == end) return true;
  const SweepList finer = sorted(entries, finer_begin, end, lists_[1], slots, owners);
  return sweep(lanes, own, finer, SweepOrder::kNotBelow, most, counts) &&
         sweep(lanes, finer, own, SweepOrder::kAbove, most, counts);
}

}  // namespace gnomon
