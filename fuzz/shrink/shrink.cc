// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/shrink/shrink.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>

#include "fuzz/scene/scene_coordinates.h"
#include "fuzz/scene/scene_steps.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/write.h"
#include "scene/base/text_hash.h"

namespace gnomon::fuzz {

namespace {

/// Digits that a rounded coordinate may keep, the fewest first.
constexpr std::array<std::size_t, 16> kKeptBits = {1,  2,  3,  4,  5,  6,  7,  8,
                                                   10, 12, 16, 20, 24, 32, 40, 48};
/// Whole numbers that a coordinate is set to.
constexpr std::array kSmallValues = {0, 1, 2, 3, 4, -1, -2};
/// Other coordinates of the same axis that a coordinate is set to, the nearest first.
constexpr std::size_t kMostNeighbours = 8;
constexpr std::size_t kAxes = 3;

std::uint64_t repairs_of(const PreparedScene& prepared) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(prepared.notes, [](const PreparationNote& note) {
        return note.repair == Repair::kNotPlanar || note.repair == Repair::kNotConvex;
      }));
}

/// The size without `repairs`, which only prepare() knows.
SceneSize size_unprepared(const Scene& scene) {
  SceneSize size;
  size.polygons = scene.polygons.size();
  size.lights = scene.lights.size();
  size.vertices = scene.vertices.size();
  size.flags = flags_of(scene);
  size.names = long_names_of(scene);
  for (const Polygon& polygon : scene.polygons) {
    size.holes += polygon.holes.size();
    size.corners += polygon.loop.size();
    for (const auto& hole : polygon.holes) size.corners += hole.size();
  }
  for (const Light& light : scene.lights) size.corners += light.loop.size();
  std::array<std::set<std::pair<std::string, bool>>, kAxes> distinct;
  for (const Position* position : points_of(scene)) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const Number& number = (*position)[axis];
      size.bits += bits_of(number);
      distinct[axis].emplace(number.to_text(), number.is_decimal());
    }
  }
  for (const auto& values : distinct) size.values += values.size();
  return size;
}

class Shrinker {
 public:
  Shrinker(Scene scene, const StillFails& fails, const ShrinkOptions& options)
      : fails_(fails), options_(options), start_(Clock::now()), best_(std::move(scene)) {
    for (const std::string_view name :
         {"moves", "tidying", "polygons", "lights", "holes", "corners", "flags", "vertices",
          "scene", "axes", "values", "points", "coordinates", "names"}) {
      result_.passes.push_back({name});
    }
    result_.before = size_of(best_);
    size_ = result_.before;
  }

  ShrinkResult run() {
    in("moves", [&] { undo_moves(); });
    for (;;) {
      const std::uint64_t accepted = result_.accepted;
      ++result_.rounds;
      in("tidying", [&] { tidy_up(); });
      in("polygons", [&] { drop_polygons(); });
      in("lights", [&] { drop_lights(); });
      in("holes", [&] { drop_holes(); });
      in("corners", [&] { drop_corners(); });
      in("flags", [&] { reset_flags(); });
      in("vertices", [&] { join_vertices(); });
      in("scene", [&] { change_scene(); });
      in("axes", [&] { change_axes(); });
      in("values", [&] { change_values(); });
      in("points", [&] { change_points(); });
      in("coordinates", [&] { change_coordinates(); });
      in("names", [&] { attempt(with_short_names(best_)); });
      if (stopped_) break;
      if (result_.accepted == accepted) {
        result_.locally_minimal = true;
        break;
      }
    }
    result_.scene = std::move(best_);
    result_.after = size_;
    return std::move(result_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  using NumberList = std::vector<Number*>;

  template <class Pass>
  void in(std::string_view name, const Pass& pass) {
    if (stopped_) return;
    pass_ = &*std::ranges::find(result_.passes, name, &ShrinkPass::name);
    pass();
  }

  bool out_of_time() const {
    if (options_.interrupted != nullptr && *options_.interrupted) return true;
    if (options_.most_tries != 0 && result_.tries >= options_.most_tries) return true;
    if (options_.seconds <= 0) return false;
    return std::chrono::duration<double>(Clock::now() - start_).count() >= options_.seconds;
  }

  /// Asks the predicate, unless the answer is known. `any_size`: also of a scene that is larger.
  bool attempt(Scene candidate, bool any_size = false) {
    if (stopped_) return false;
    SceneSize size = size_unprepared(candidate);
    if (!any_size && !(size < size_)) return false;
    const auto text = scene_to_text(candidate, SceneFormat::kJson);
    if (!text) return false;  // a decimal of too many digits
    if (!tried_.insert(text_hash(text->text)).second) {
      ++result_.repeated;
      return false;
    }
    const auto prepared = prepare(candidate);
    if (!prepared) {
      ++result_.refused;
      return false;
    }
    size.repairs = repairs_of(*prepared);
    if (!any_size && !(size < size_)) return false;
    if (out_of_time()) {
      stopped_ = true;
      return false;
    }
    ++result_.tries;
    ++pass_->tries;
    const bool improved = fails_(candidate);
    if (improved) {
      ++result_.accepted;
      ++pass_->accepted;
      best_ = std::move(candidate);
      size_ = size;
    }
    if (options_.progress) {
      options_.progress({best_, size_, pass_->name, result_.tries, result_.accepted, improved});
    }
    return improved;
  }

  /// The same for a scene whose unused vertices and doubled positions are to go; where tidying does
  /// away with the failure, as it is.
  bool attempt_tidy(Scene candidate) {
    Scene tidy = tidied(candidate);
    return attempt(std::move(tidy)) || attempt(std::move(candidate));
  }

  void undo_moves() {
    for (const Scene& simpler : options_.simpler) {
      if (attempt(simpler, true)) return;
    }
  }

  void tidy_up() {
    attempt(tidied(best_));
    attempt(without_unused_vertices(best_));
  }

  /// Delta debugging: halves first, then ever smaller chunks, from the end. `without(begin, end)`
  /// is the best scene without these items; `count()` how many it has now.
  template <class Count, class Without>
  void drop_in_chunks(const Count& count, const Without& without) {
    for (std::size_t chunk = (count() + 1) / 2; chunk > 0;
         chunk = chunk == 1 ? 0 : (chunk + 1) / 2) {
      for (std::size_t end = count(); end > 0 && !stopped_;) {
        const std::size_t begin = end > chunk ? end - chunk : 0;
        attempt_tidy(without(begin, end));
        end = std::min(begin, count());
      }
    }
  }

  void drop_polygons() {
    drop_in_chunks([&] { return best_.polygons.size(); },
                   [&](std::size_t begin, std::size_t end) {
                     Scene scene = best_;
                     scene.polygons.erase(
                         scene.polygons.begin() + static_cast<std::ptrdiff_t>(begin),
                         scene.polygons.begin() + static_cast<std::ptrdiff_t>(end));
                     return scene;
                   });
  }

  void drop_lights() {
    // Most failures need one light.
    for (std::size_t i = 0; best_.lights.size() > 1 && i < best_.lights.size(); ++i) {
      Scene scene = best_;
      scene.lights = {best_.lights[i]};
      if (attempt(std::move(scene))) break;
    }
    for (std::size_t i = best_.lights.size(); i-- > 0;) {
      Scene scene = best_;
      scene.lights.erase(scene.lights.begin() + static_cast<std::ptrdiff_t>(i));
      attempt(std::move(scene));
    }
  }

  void drop_holes() {
    for (std::size_t p = 0; p < best_.polygons.size(); ++p) {
      for (std::size_t h = best_.polygons[p].holes.size(); h-- > 0;) {
        Scene scene = best_;
        auto& holes = scene.polygons[p].holes;
        holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(h));
        attempt_tidy(std::move(scene));
      }
    }
  }

  /// `loop_of(scene)` is one loop of the scene.
  template <class LoopOf>
  void drop_corners_of(const LoopOf& loop_of) {
    constexpr std::size_t kFewest = 3;
    drop_in_chunks([&] { return loop_of(best_).size(); },
                   [&](std::size_t begin, std::size_t end) {
                     Scene scene = best_;
                     auto& loop = loop_of(scene);
                     if (loop.size() >= kFewest + (end - begin)) {
                       loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(begin),
                                  loop.begin() + static_cast<std::ptrdiff_t>(end));
                     }
                     return scene;
                   });
  }

  void drop_corners() {
    for (std::size_t p = 0; p < best_.polygons.size(); ++p) {
      drop_corners_of([p](Scene & scene) -> auto& { return scene.polygons[p].loop; });
      for (std::size_t h = 0; h < best_.polygons[p].holes.size(); ++h) {
        drop_corners_of([ p, h ](Scene & scene) -> auto& { return scene.polygons[p].holes[h]; });
      }
    }
    for (std::size_t i = 0; i < best_.lights.size(); ++i) {
      if (best_.lights[i].type != LightType::kArea) continue;
      drop_corners_of([i](Scene & scene) -> auto& { return scene.lights[i].loop; });
    }
  }

  void reset_flags() {
    if (flags_of(best_) == 0) return;
    attempt(with_default_flags(best_));
    const std::size_t count = flag_steps(best_);
    for (std::size_t i = 0; i < count; ++i) attempt(with_flag_step(best_, i));
  }

  /// A vertex takes the place of another, and is it from then on.
  void join_vertices() {
    for (std::size_t from = best_.vertices.size(); from-- > 0 && !stopped_;) {
      for (std::size_t to = 0; to < best_.vertices.size(); ++to) {
        if (from == to || from >= best_.vertices.size()) continue;
        if (attempt(without_unused_vertices(with_joined_vertices(best_, static_cast<VertexId>(from),
                                                                 static_cast<VertexId>(to))))) {
          break;
        }
      }
    }
  }

  // Coordinates. All steps go through the integers of one grid and back.

  NumberList axis_numbers(Scene& scene, std::size_t axis) const {
    NumberList numbers;
    for (Position* position : positions_of(scene)) numbers.push_back(&(*position)[axis]);
    return numbers;
  }
  static NumberList numbers_of(const std::vector<Position*>& points) {
    NumberList numbers;
    for (Position* point : points) {
      for (Number& number : *point) numbers.push_back(&number);
    }
    return numbers;
  }

  /// The scene with `change` done to the numbers that `choose` picks, if it can hold the outcome:
  /// change(GridValues&) may move the values and the exponent.
  template <class Choose, class Change>
  bool attempt_change(const Choose& choose, const Change& change, bool merge = false) {
    if (stopped_) return false;
    Scene scene = best_;
    const NumberList numbers = choose(scene);
    GridValues grid = on_grid({numbers.data(), numbers.size()}, scene.numbers);
    change(grid);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (!grid.number(grid.values[i], *numbers[i])) return false;
    }
    return merge ? attempt_tidy(std::move(scene)) : attempt(std::move(scene));
  }

  static std::size_t widest(const GridValues& grid) {
    std::size_t bits = 0;
    for (const mpz_class& value : grid.values) bits = std::max(bits, bits_of(value));
    return bits;
  }

  /// Numbers of a base's digits that leave `kept` bits or so of the widest value.
  static unsigned long dropped_digits(const GridValues& grid, std::size_t bits, std::size_t kept) {
    const std::size_t dropped = bits > kept ? bits - kept : 0;
    constexpr std::size_t kBitsOfThreeTens = 10;
    return static_cast<unsigned long>(grid.base == 2 ? dropped
                                                     : (dropped * 3 + 9) / kBitsOfThreeTens);
  }

  /// Rounds to `kept` bits of the widest, and then, if `small`, to whole numbers of that size.
  static void round_all(GridValues& grid, std::size_t kept, bool small) {
    const unsigned long digits = dropped_digits(grid, widest(grid), kept);
    const mpz_class unit = power_of(grid.base, digits);
    for (mpz_class& value : grid.values) {
      value = rounded_quotient(value, unit);
      if (!small) value *= unit;
    }
    if (small) grid.exponent = 0;
  }

  static void divide_by_common_divisor(GridValues& grid) {
    mpz_class divisor;
    for (const mpz_class& value : grid.values) divisor = gcd(divisor, value);
    if (sgn(divisor) == 0) return;
    for (mpz_class& value : grid.values) value /= divisor;
    grid.exponent = 0;
  }

  /// Values of every `stride`-th place from `first` on start at 0.
  static void to_zero(GridValues& grid, std::size_t first, std::size_t stride) {
    if (first >= grid.values.size()) return;
    mpz_class least = grid.values[first];
    for (std::size_t i = first; i < grid.values.size(); i += stride) {
      least = std::min(least, grid.values[i]);
    }
    for (std::size_t i = first; i < grid.values.size(); i += stride) grid.values[i] -= least;
  }

  static void to_ranks(GridValues& grid, std::size_t first, std::size_t stride) {
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
  void scale_down(const Choose& choose) {
    Scene scene = best_;
    const NumberList numbers = choose(scene);
    for (std::int32_t away = on_grid({numbers.data(), numbers.size()}, scene.numbers).exponent;
         away != 0 && !stopped_; away /= 2) {
      attempt_change(choose, [&](GridValues& grid) { grid.exponent -= away; });
    }
  }

  void change_scene() {
    const auto all = [](Scene& scene) { return numbers_of(positions_of(scene)); };
    const auto directions = [](Scene& scene) { return numbers_of(directions_of(scene)); };
    const auto translate = [](GridValues& grid) {
      for (std::size_t axis = 0; axis < kAxes; ++axis) to_zero(grid, axis, kAxes);
    };
    attempt_change(
        all,
        [](GridValues& grid) {
          for (std::size_t axis = 0; axis < kAxes; ++axis) to_ranks(grid, axis, kAxes);
        },
        true);
    const auto round = [&](bool move, bool small) {
      for (const std::size_t kept : kKeptBits) {
        const bool done = attempt_change(
            all,
            [&](GridValues& grid) {
              if (move) translate(grid);
              round_all(grid, kept, small);
            },
            true);
        if (done || stopped_) return;
      }
    };
    round(true, true);
    round(false, true);
    attempt_change(all, [&](GridValues& grid) {
      translate(grid);
      divide_by_common_divisor(grid);
    });
    attempt_change(all, divide_by_common_divisor);
    attempt_change(all, translate);
    scale_down(all);
    round(true, false);
    round(false, false);
    attempt_change(directions, divide_by_common_divisor);
    scale_down(directions);
    for (const std::size_t kept : kKeptBits) {
      if (attempt_change(directions, [&](GridValues& grid) { round_all(grid, kept, true); })) break;
    }
  }

  void change_axes() {
    for (std::size_t axis = 0; axis < kAxes && !stopped_; ++axis) {
      const auto own = [&](Scene& scene) { return axis_numbers(scene, axis); };
      attempt_change(
          own, [](GridValues& grid) { to_ranks(grid, 0, 1); }, true);
      for (const bool small : {true, false}) {
        for (const std::size_t kept : kKeptBits) {
          const bool done = attempt_change(
              own,
              [&](GridValues& grid) {
                to_zero(grid, 0, 1);
                round_all(grid, kept, small);
              },
              true);
          if (done || stopped_) break;
        }
      }
      attempt_change(own, [](GridValues& grid) {
        to_zero(grid, 0, 1);
        divide_by_common_divisor(grid);
      });
      attempt_change(own, divide_by_common_divisor);
      attempt_change(own, [](GridValues& grid) { to_zero(grid, 0, 1); });
      attempt_change(own, [](GridValues& grid) {
        for (mpz_class& value : grid.values) value = -value;
      });
      scale_down(own);
      close_gaps(axis);
    }
  }

  /// What lies above a gap between neighbouring values moves down, order kept.
  void close_gaps(std::size_t axis) {
    const auto own = [&](Scene& scene) { return axis_numbers(scene, axis); };
    const auto gaps = [&](const GridValues& grid) {
      std::set<mpz_class> sorted(grid.values.begin(), grid.values.end());
      return std::vector<mpz_class>(sorted.begin(), sorted.end());
    };
    Scene scene = best_;
    const NumberList numbers = own(scene);
    const std::size_t count = gaps(on_grid({numbers.data(), numbers.size()}, scene.numbers)).size();
    for (std::size_t i = 1; i < count && !stopped_; ++i) {
      for (const int way : {0, 1, 2, 3}) {
        const bool done = attempt_change(own, [&](GridValues& grid) {
          const std::vector<mpz_class> sorted = gaps(grid);
          if (i >= sorted.size()) return;
          // Steps of 1, 2, 4 units, or half of the gap.
          const mpz_class unit =
              grid.exponent < 0 ? power_of(grid.base, static_cast<unsigned long>(-grid.exponent))
                                : mpz_class(1);
          const mpz_class gap = sorted[i] - sorted[i - 1];
          const mpz_class target = way < 3 ? mpz_class(unit * (1 << way)) : mpz_class(gap / 2);
          if (target >= gap || sgn(target) == 0) return;
          const mpz_class shift = gap - target;
          for (mpz_class& value : grid.values) {
            if (value >= sorted[i]) value -= shift;
          }
        });
        if (done || stopped_) break;
      }
    }
  }

  /// Tries simpler values for what `choose` picks, all of which hold the same value now; `others`
  /// are worth trying too.
  template <class Choose>
  void simplify_value(const Choose& choose, const std::vector<Number>& others, bool merge) {
    const auto set = [&](const Number& number) {
      Scene scene = best_;
      for (Number* own : choose(scene)) *own = number;
      return merge ? attempt_tidy(std::move(scene)) : attempt(std::move(scene));
    };
    for (const int value : kSmallValues) {
      if (set(Number(static_cast<double>(value)))) return;
    }
    const auto change = [&](const auto& how) { return attempt_change(choose, how, merge); };
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
        if (done || stopped_) return;
      }
    }
    // Halves of the exponent, halves of the value, one less.
    scale_down(choose);
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
  std::vector<Number> distinct_on_axis(std::size_t axis) {
    std::map<mpq_class, Number> sorted;
    for (const Number* number : axis_numbers(best_, axis)) sorted.emplace(number->exact(), *number);
    std::vector<Number> result;
    for (auto& [value, number] : sorted) result.push_back(std::move(number));
    return result;
  }

  /// The numbers of an axis that cost no more than `own`, the nearest first.
  std::vector<Number> neighbours(std::size_t axis, const Number& own) {
    std::vector<Number> others = distinct_on_axis(axis);
    std::erase_if(
        others, [&](const Number& other) { return other == own || bits_of(other) > bits_of(own); });
    const mpq_class at = own.exact();
    std::ranges::stable_sort(
        others, {}, [&](const Number& other) { return mpq_class(abs(other.exact() - at)); });
    if (others.size() > kMostNeighbours) others.resize(kMostNeighbours);
    return others;
  }

  /// All places that hold one value of an axis change together: what is level stays level.
  void change_values() {
    for (std::size_t axis = 0; axis < kAxes && !stopped_; ++axis) {
      for (const Number& value : distinct_on_axis(axis)) {
        if (stopped_) return;
        if (value.is_zero()) continue;
        const auto places = [&](Scene& scene) {
          NumberList numbers = axis_numbers(scene, axis);
          std::erase_if(numbers, [&](const Number* number) { return !(*number == value); });
          return numbers;
        };
        // A step before may have changed it.
        if (places(best_).empty()) continue;
        simplify_value(places, neighbours(axis, value), true);
      }
    }
  }

  void change_points() {
    for (std::size_t i = 0; i < points_of(best_).size() && !stopped_; ++i) {
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
                  own, [&](GridValues& grid) { round_all(grid, kept, small); }, true)) {
            break;
          }
          if (stopped_) return;
        }
      }
      attempt_change(own, divide_by_common_divisor, true);
      scale_down(own);
      attempt_change(own, [](GridValues& grid) {
        for (mpz_class& value : grid.values) value /= 2;
      });
    }
  }

  void change_coordinates() {
    for (std::size_t i = 0; i < points_of(best_).size() && !stopped_; ++i) {
      for (std::size_t axis = 0; axis < kAxes && !stopped_; ++axis) {
        if (i >= points_of(best_).size()) return;
        const Number own = (*points_of(best_)[i])[axis];
        if (own.is_zero()) continue;
        const auto place = [&](Scene& scene) {
          const std::vector<Position*> points = points_of(scene);
          return i < points.size() ? NumberList{&(*points[i])[axis]} : NumberList{};
        };
        simplify_value(place, neighbours(axis, own), true);
      }
    }
  }

  const StillFails& fails_;
  const ShrinkOptions& options_;
  const Clock::time_point start_;
  Scene best_;
  SceneSize size_;
  ShrinkResult result_;
  ShrinkPass* pass_ = nullptr;
  std::unordered_set<std::uint64_t> tried_;
  bool stopped_ = false;
};

}  // namespace

SceneSize size_of(const Scene& scene) {
  SceneSize size = size_unprepared(scene);
  if (const auto prepared = prepare(scene)) size.repairs = repairs_of(*prepared);
  return size;
}

std::string fingerprint_of(const Scene& scene) {
  Scene plain = scene;
  plain.name.clear();
  plain.extra.clear();
  const auto text = scene_to_text(plain, SceneFormat::kJson);
  return fmt::format("{:016x}", text ? text_hash(text->text) : 0);
}

ShrinkResult shrink(Scene scene, const StillFails& fails, const ShrinkOptions& options) {
  return Shrinker(std::move(scene), fails, options).run();
}

}  // namespace gnomon::fuzz
