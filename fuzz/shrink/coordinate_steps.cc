// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/shrink/coordinate_steps.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "fuzz/scene/scene_coordinates.h"

namespace gnomon::fuzz {

namespace {

using NumberList = std::vector<Number*>;

/// Digits that a rounded coordinate may keep, the fewest first.
constexpr std::array<std::size_t, 16> kKeptBits = {1,  2,  3,  4,  5,  6,  7,  8,
                                                   10, 12, 16, 20, 24, 32, 40, 48};
/// Whole numbers that a coordinate is set to.
constexpr std::array kSmallValues = {0, 1, 2, 3, 4, -1, -2};
/// Other coordinates of the same axis that a coordinate is set to, the nearest first.
constexpr std::size_t kMostNeighbours = 8;

NumberList axis_numbers(Scene& scene, std::size_t axis) {
  NumberList numbers;
  for (Position* position : positions_of(scene)) numbers.push_back(&(*position)[axis]);
  return numbers;
}
NumberList numbers_of(const std::vector<Position*>& points) {
  NumberList numbers;
  for (Position* point : points) {
    for (Number& number : *point) numbers.push_back(&number);
  }
  return numbers;
}

/// The scene with `change` done to the numbers that `choose` picks, if it can hold the outcome:
/// change(GridValues&) may move the values and the exponent.
template <class Choose, class Change>
bool attempt_change(SmallestScene& search, const Choose& choose, const Change& change,
                    bool merge = false) {
  if (search.stopped()) return false;
  Scene scene = search.best();
  const NumberList numbers = choose(scene);
  GridValues grid = on_grid({numbers.data(), numbers.size()}, scene.numbers);
  change(grid);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!grid.number(grid.values[i], *numbers[i])) return false;
  }
  return merge ? search.attempt_tidy(std::move(scene)) : search.attempt(std::move(scene));
}

std::size_t widest(const GridValues& grid) {
  std::size_t bits = 0;
  for (const mpz_class& value : grid.values) bits = std::max(bits, bits_of(value));
  return bits;
}

/// Numbers of a base's digits that leave `kept` bits or so of the widest value.
unsigned long dropped_digits(const GridValues& grid, std::size_t bits, std::size_t kept) {
  const std::size_t dropped = bits > kept ? bits - kept : 0;
  constexpr std::size_t kBitsOfThreeTens = 10;
  return static_cast<unsigned long>(grid.base == 2 ? dropped
                                                   : (dropped * 3 + 9) / kBitsOfThreeTens);
}

/// Rounds to `kept` bits of the widest, and then, if `small`, to whole numbers of that size.
void round_all(GridValues& grid, std::size_t kept, bool small) {
  const unsigned long digits = dropped_digits(grid, widest(grid), kept);
  const mpz_class unit = power_of(grid.base, digits);
  for (mpz_class& value : grid.values) {
    value = rounded_quotient(value, unit);
    if (!small) value *= unit;
  }
  if (small) grid.exponent = 0;
}

void divide_by_common_divisor(GridValues& grid) {
  mpz_class divisor;
  for (const mpz_class& value : grid.values) divisor = gcd(divisor, value);
  if (sgn(divisor) == 0) return;
  for (mpz_class& value : grid.values) value /= divisor;
  grid.exponent = 0;
}

/// Values of every `stride`-th place from `first` on start at 0.
void to_zero(GridValues& grid, std::size_t first, std::size_t stride) {
  if (first >= grid.values.size()) return;
  mpz_class least = grid.values[first];
  for (std::size_t i = first; i < grid.values.size(); i += stride) {
    least = std::min(least, grid.values[i]);
  }
  for (std::size_t i = first; i < grid.values.size(); i += stride) grid.values[i] -= least;
}

void to_ranks(GridValues& grid, std::size_t first, std::size_t stride) {
  std::map<mpz_class, long> ranks;
  for (std::size_t i = first; i < grid.values.size(); i += stride) ranks[grid.values[i]] = 0;
  long next = 0;
  for (auto& [value, rank] : ranks) rank = next++;
  for (std::size_t i = first; i < grid.values.size(); i += stride) {
    grid.values[i] = ranks[grid.values[i]];
  }
  grid.exponent = 0;
}

/// Powers of two (or ten) are taken off the exponent: all that is there, half, a quarter, ...
template <class Choose>
void scale_down(SmallestScene& search, const Choose& choose) {
  Scene scene = search.best();
  const NumberList numbers = choose(scene);
  for (std::int32_t away = on_grid({numbers.data(), numbers.size()}, scene.numbers).exponent;
       away != 0 && !search.stopped(); away /= 2) {
    attempt_change(search, choose, [&](GridValues& grid) { grid.exponent -= away; });
  }
}

/// What lies above a gap between neighbouring values moves down, order kept.
void close_gaps(SmallestScene& search, std::size_t axis) {
  const auto own = [&](Scene& scene) { return axis_numbers(scene, axis); };
  const auto gaps = [&](const GridValues& grid) {
    std::set<mpz_class> sorted(grid.values.begin(), grid.values.end());
    return std::vector<mpz_class>(sorted.begin(), sorted.end());
  };
  Scene scene = search.best();
  const NumberList numbers = own(scene);
  const std::size_t count = gaps(on_grid({numbers.data(), numbers.size()}, scene.numbers)).size();
  for (std::size_t i = 1; i < count && !search.stopped(); ++i) {
    for (const int way : {0, 1, 2, 3}) {
      const bool done = attempt_change(search, own, [&](GridValues& grid) {
        const std::vector<mpz_class> sorted = gaps(grid);
        if (i >= sorted.size()) return;
        // Steps of 1, 2, 4 units, or half of the gap.
        const mpz_class unit = grid.exponent < 0
                                   ? power_of(grid.base, static_cast<unsigned long>(-grid.exponent))
                                   : mpz_class(1);
        const mpz_class gap = sorted[i] - sorted[i - 1];
        const mpz_class target = way < 3 ? mpz_class(unit * (1 << way)) : mpz_class(gap / 2);
        if (target >= gap || sgn(target) == 0) return;
        const mpz_class shift = gap - target;
        for (mpz_class& value : grid.values) {
          if (value >= sorted[i]) value -= shift;
        }
      });
      if (done || search.stopped()) break;
    }
  }
}

/// Tries simpler values for what `choose` picks, all of which hold the same value now; `others`
/// are worth trying too.
template <class Choose>
void simplify_value(SmallestScene& search, const Choose& choose, const std::vector<Number>& others,
                    bool merge) {
  const auto set = [&](const Number& number) {
    Scene scene = search.best();
    for (Number* own : choose(scene)) *own = number;
    return merge ? search.attempt_tidy(std::move(scene)) : search.attempt(std::move(scene));
  };
  for (const int value : kSmallValues) {
    if (set(Number(static_cast<double>(value)))) return;
  }
  const auto change = [&](const auto& how) { return attempt_change(search, choose, how, merge); };
  for (const Number& other : others) {
    if (set(other)) return;
  }
  for (const std::size_t kept : kKeptBits) {
    for (const bool up : {false, true}) {
      const bool done = change([&](GridValues& grid) {
        const unsigned long digits = dropped_digits(grid, widest(grid), kept);
        const mpz_class unit = power_of(grid.base, digits);
        for (mpz_class& value : grid.values) {
          value /= unit;  // towards 0
          if (up) value += sgn(value) < 0 ? -1 : 1;
          value *= unit;
        }
      });
      if (done || search.stopped()) return;
    }
  }
  // Halves of the exponent, halves of the value, one less.
  scale_down(search, choose);
  if (change([](GridValues& grid) {
        for (mpz_class& value : grid.values) value /= 2;
      })) {
    return;
  }
  change([](GridValues& grid) {
    const mpz_class unit = grid.exponent < 0
                               ? power_of(grid.base, static_cast<unsigned long>(-grid.exponent))
                               : mpz_class(1);
    for (mpz_class& value : grid.values) value -= sgn(value) < 0 ? mpz_class(-unit) : unit;
  });
}

/// Distinct numbers of an axis, ascending.
std::vector<Number> distinct_on_axis(Scene scene, std::size_t axis) {
  std::map<mpq_class, Number> sorted;
  for (const Number* number : axis_numbers(scene, axis)) sorted.emplace(number->exact(), *number);
  std::vector<Number> result;
  for (auto& [value, number] : sorted) result.push_back(std::move(number));
  return result;
}

/// The numbers of an axis that cost no more than `own`, the nearest first.
std::vector<Number> neighbours(const SmallestScene& search, std::size_t axis, const Number& own) {
  std::vector<Number> others = distinct_on_axis(search.best(), axis);
  std::erase_if(others,
                [&](const Number& other) { return other == own || bits_of(other) > bits_of(own); });
  const mpq_class at = own.exact();
  std::ranges::stable_sort(others, {},
                           [&](const Number& other) { return mpq_class(abs(other.exact() - at)); });
  if (others.size() > kMostNeighbours) others.resize(kMostNeighbours);
  return others;
}

}  // namespace

void change_scene(SmallestScene& search) {
  const auto all = [](Scene& scene) { return numbers_of(positions_of(scene)); };
  const auto directions = [](Scene& scene) { return numbers_of(directions_of(scene)); };
  const auto translate = [](GridValues& grid) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) to_zero(grid, axis, kAxes);
  };
  attempt_change(
      search, all,
      [](GridValues& grid) {
        for (std::size_t axis = 0; axis < kAxes; ++axis) to_ranks(grid, axis, kAxes);
      },
      true);
  const auto round = [&](bool move, bool small) {
    for (const std::size_t kept : kKeptBits) {
      const bool done = attempt_change(
          search, all,
          [&](GridValues& grid) {
            if (move) translate(grid);
            round_all(grid, kept, small);
          },
          true);
      if (done || search.stopped()) return;
    }
  };
  round(true, true);
  round(false, true);
  attempt_change(search, all, [&](GridValues& grid) {
    translate(grid);
    divide_by_common_divisor(grid);
  });
  attempt_change(search, all, divide_by_common_divisor);
  attempt_change(search, all, translate);
  scale_down(search, all);
  round(true, false);
  round(false, false);
  attempt_change(search, directions, divide_by_common_divisor);
  scale_down(search, directions);
  for (const std::size_t kept : kKeptBits) {
    if (attempt_change(search, directions, [&](GridValues& grid) { round_all(grid, kept, true); }))
      break;
  }
}

void change_axes(SmallestScene& search) {
  for (std::size_t axis = 0; axis < kAxes && !search.stopped(); ++axis) {
    const auto own = [&](Scene& scene) { return axis_numbers(scene, axis); };
    attempt_change(
        search, own, [](GridValues& grid) { to_ranks(grid, 0, 1); }, true);
    for (const bool small : {true, false}) {
      for (const std::size_t kept : kKeptBits) {
        const bool done = attempt_change(
            search, own,
            [&](GridValues& grid) {
              to_zero(grid, 0, 1);
              round_all(grid, kept, small);
            },
            true);
        if (done || search.stopped()) break;
      }
    }
    attempt_change(search, own, [](GridValues& grid) {
      to_zero(grid, 0, 1);
      divide_by_common_divisor(grid);
    });
    attempt_change(search, own, divide_by_common_divisor);
    attempt_change(search, own, [](GridValues& grid) { to_zero(grid, 0, 1); });
    attempt_change(search, own, [](GridValues& grid) {
      for (mpz_class& value : grid.values) value = -value;
    });
    scale_down(search, own);
    close_gaps(search, axis);
  }
}

void change_values(SmallestScene& search) {
  for (std::size_t axis = 0; axis < kAxes && !search.stopped(); ++axis) {
    for (const Number& value : distinct_on_axis(search.best(), axis)) {
      if (search.stopped()) return;
      if (value.is_zero()) continue;
      const auto places = [&](Scene& scene) {
        NumberList numbers = axis_numbers(scene, axis);
        std::erase_if(numbers, [&](const Number* number) { return !(*number == value); });
        return numbers;
      };
      // A step before may have changed it.
      Scene scene = search.best();
      if (places(scene).empty()) continue;
      simplify_value(search, places, neighbours(search, axis, value), true);
    }
  }
}

void change_points(SmallestScene& search) {
  for (std::size_t i = 0; i < points_of(search.best()).size() && !search.stopped(); ++i) {
    const auto own = [&](Scene& scene) {
      NumberList numbers;
      const std::vector<Position*> points = points_of(scene);
      if (i >= points.size()) return numbers;
      for (Number& number : *points[i]) numbers.push_back(&number);
      return numbers;
    };
    for (const bool small : {true, false}) {
      for (const std::size_t kept : kKeptBits) {
        if (attempt_change(
                search, own, [&](GridValues& grid) { round_all(grid, kept, small); }, true)) {
          break;
        }
        if (search.stopped()) return;
      }
    }
    attempt_change(search, own, divide_by_common_divisor, true);
    scale_down(search, own);
    attempt_change(search, own, [](GridValues& grid) {
      for (mpz_class& value : grid.values) value /= 2;
    });
  }
}

void change_coordinates(SmallestScene& search) {
  for (std::size_t i = 0; i < points_of(search.best()).size() && !search.stopped(); ++i) {
    for (std::size_t axis = 0; axis < kAxes && !search.stopped(); ++axis) {
      if (i >= points_of(search.best()).size()) return;
      const Number own = (*points_of(search.best())[i])[axis];
      if (own.is_zero()) continue;
      const auto place = [&](Scene& scene) {
        const std::vector<Position*> points = points_of(scene);
        return i < points.size() ? NumberList{&(*points[i])[axis]} : NumberList{};
      };
      simplify_value(search, place, neighbours(search, axis, own), true);
    }
  }
}

}  // namespace gnomon::fuzz
