// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/moves/metamorphic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "gnomon/scene/rational_text.h"
#include "report/sides/part_area.h"
#include "report/sides/polygon_sides.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {

namespace {

using report::ClassifiedSide;

/// Light, polygon, side.
using Place = std::tuple<std::string, std::string, Side>;
struct Classes {
  mpq_class lit, penumbra, umbra;
  friend bool operator==(const Classes&, const Classes&) = default;
};
/// The classes of every polygon side whose parts lie in one plane.
using Answer = std::map<Place, Classes>;

struct Solved {
  Answer answer;
  // Of the parts in the plane of a polygon, twice its area vector's largest component: ratios of
  // coplanar polygons are exact.
  std::map<std::string, mpz_class> areas;
};

using Failed = std::optional<BrokenRelation>;

std::string side_text(const Place& place) {
  return fmt::format("light {}, polygon {} ({})", std::get<0>(place), std::get<1>(place),
                     name_of(std::get<2>(place)));
}

BrokenRelation broken(const Place& place, std::string text) {
  return {std::get<0>(place), std::get<1>(place), side_text(place) + ": " + std::move(text)};
}

std::string classes_text(const Classes& classes) {
  return fmt::format("lit {}, penumbra {}, umbra {}", text_for_people(classes.lit),
                     text_for_people(classes.penumbra), text_for_people(classes.umbra));
}

Answer answer_of(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result) {
  Answer answer;
  for (const LightResult& light : result.lights) {
    const std::string& id = scene.lights[prepared.lights[light.light].light].id;
    for (std::uint32_t polygon = 0; polygon < scene.polygons.size(); ++polygon) {
      for (const ClassifiedSide& side : report::polygon_sides(prepared, light, polygon, true)) {
        if (!side.coplanar) continue;
        Classes& classes = answer[{id, scene.polygons[polygon].id, side.side}];
        classes.lit = side.exact_lit.value_or(0);
        classes.penumbra = side.exact_penumbra.value_or(0);
        classes.umbra = side.area_light ? side.exact_umbra.value_or(0) : mpq_class(0);
      }
    }
  }
  return answer;
}

Expected<Answer> solve(const Scene& scene, const PreparedScene& prepared,
                       const ShadowOptions& options) {
  const Expected<ShadowResult> result = compute_shadows(prepared, options);
  if (!result) return tl::unexpected(result.error());
  return answer_of(scene, prepared, *result);
}

Expected<Answer> solve(const Scene& scene, const ShadowOptions& options) {
  const Expected<PreparedScene> prepared = prepare(scene);
  if (!prepared) return tl::unexpected(prepared.error());
  return solve(scene, *prepared, options);
}

Failed difference(const Answer& before, const Answer& after) {
  for (const auto& [place, classes] : before) {
    const auto other = after.find(place);
    if (other == after.end()) return broken(place, "is missing afterwards");
    if (other->second != classes) {
      return broken(place, classes_text(classes) + "; afterwards " + classes_text(other->second));
    }
  }
  if (before.size() != after.size()) return BrokenRelation{{}, {}, "other sides are listed"};
  return std::nullopt;
}

Number times_power_of_two(const Number& number, int exponent) {
  if (number.is_zero()) return number;
  mpz_class mantissa = number.mantissa();
  if (!number.is_decimal()) return Number::from_dyadic(mantissa, number.exponent() + exponent);
  mpz_class factor;
  mpz_ui_pow_ui(factor.get_mpz_t(), exponent < 0 ? 5 : 2,
                static_cast<unsigned long>(std::abs(exponent)));
  return Number::from_decimal(mantissa * factor, number.exponent() + std::min(exponent, 0));
}

Number negative(const Number& number) {
  if (number.is_decimal()) return Number::from_decimal(-number.mantissa(), number.exponent());
  return Number::from_dyadic(-number.mantissa(), number.exponent());
}

Number sum(const Number& a, const Number& b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  const bool decimal = a.is_decimal() || b.is_decimal();
  // A dyadic number is a decimal too; sums here are of small ones.
  const std::int32_t exponent = std::min(a.exponent(), b.exponent());
  const auto shifted = [&](const Number& number) {
    mpz_class power;
    mpz_ui_pow_ui(power.get_mpz_t(), decimal ? 10 : 2,
                  static_cast<unsigned long>(number.exponent() - exponent));
    return mpz_class(number.mantissa() * power);
  };
  const mpz_class total = shifted(a) + shifted(b);
  return decimal ? Number::from_decimal(total, exponent) : Number::from_dyadic(total, exponent);
}

/// Vertices, positions and directions of lights, corners of area lights.
void for_each_position(Scene& scene, const std::function<void(Position&)>& change) {
  for (Position& vertex : scene.vertices) change(vertex);
  for (Light& light : scene.lights) {
    if (!light.has_area()) change(light.position);
    for (Position& corner : light.loop) change(corner);
  }
}

void reverse_loops(Scene& scene) {
  for (Polygon& polygon : scene.polygons) std::ranges::reverse(polygon.loop);
  for (Light& light : scene.lights) std::ranges::reverse(light.loop);
}

/// What a relation is checked on.
struct Subjected {
  const Scene& scene;
  const PreparedScene& prepared;
  const ShadowOptions& options;
  Random random;

  bool has(Repair repair) const {
    return std::ranges::any_of(prepared.notes,
                               [&](const PreparationNote& note) { return note.repair == repair; });
  }
};

using Outcome = Expected<Failed>;

/// The changed scene has the same answer.
Outcome same_after(Subjected& on, const std::function<void(Scene&)>& change) {
  Scene changed = on.scene;
  change(changed);
  const Expected<Answer> before = solve(on.scene, on.prepared, on.options);
  if (!before) return tl::unexpected(before.error());
  const Expected<Answer> after = solve(changed, on.options);
  if (!after) return tl::unexpected(after.error());
  return difference(*before, *after);
}

Outcome order(Subjected& on) {
  return same_after(on, [&](Scene& scene) {
    on.random.shuffle(std::span(scene.polygons));
    on.random.shuffle(std::span(scene.lights));
  });
}

// How a polygon that is not planar is cut into triangles depends on its first vertex and on the
// axes, and says so in the definitions; such scenes have no part in the relations that change them.

void turn_loops(Scene& scene, Random& random) {
  const auto turn = [&](auto& loop) {
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())),
                loop.end());
  };
  for (Polygon& polygon : scene.polygons) turn(polygon.loop);
  for (Light& light : scene.lights) {
    if (!light.loop.empty()) turn(light.loop);
  }
}

Outcome rotation(Subjected& on) {
  if (on.has(Repair::kNotPlanar)) return Failed{};
  return same_after(on, [&](Scene& scene) { turn_loops(scene, on.random); });
}

Outcome scale(Subjected& on) {
  static constexpr std::array kExponents = {-200, -9, -1, 1, 7, 300};
  const bool decimal = on.scene.numbers == NumberMeaning::kDecimal;
  const int exponent = decimal ? 1 + static_cast<int>(on.random.below(5))
                               : kExponents[on.random.below(kExponents.size())];
  return same_after(on, [&](Scene& scene) {
    for_each_position(scene, [&](Position& position) {
      for (Number& number : position) number = times_power_of_two(number, exponent);
    });
  });
}

Outcome axes(Subjected& on) {
  if (on.has(Repair::kNotPlanar)) return Failed{};
  return same_after(on, [&](Scene& scene) {
    const auto turn = static_cast<std::ptrdiff_t>(1 + on.random.below(2));
    for_each_position(scene, [&](Position& position) {
      std::rotate(position.begin(), position.begin() + turn, position.end());
    });
  });
}

Outcome mirror(Subjected& on) {
  if (on.has(Repair::kNotPlanar)) return Failed{};
  return same_after(on, [&](Scene& scene) {
    const auto k = on.random.below(4);
    for_each_position(scene, [&](Position& position) {
      if (k < 3) {
        std::swap(position[k], position[(k + 1) % 3]);
      } else {
        for (Number& number : position) number = negative(number);
      }
    });
    reverse_loops(scene);
  });
}

Outcome translation(Subjected& on) {
  // Where magnitudes are mixed a translation would fill all the bits between them.
  constexpr unsigned kMostBits = 200;
  if (on.prepared.position_bits > kMostBits) return Failed{};
  return same_after(on, [&](Scene& scene) {
    Position shift;
    for (Number& number : shift) {
      number = Number(static_cast<double>(on.random.between(-100, 100)));
      if (on.scene.numbers == NumberMeaning::kDecimal) {
        number = Number::from_decimal(number.mantissa() << number.exponent(), 0);
      }
    }
    const auto move = [&](Position& position) {
      for (std::size_t k = 0; k < 3; ++k) position[k] = sum(position[k], shift[k]);
    };
    for (Position& vertex : scene.vertices) move(vertex);
    for (Light& light : scene.lights) {
      if (light.is_point()) move(light.position);
      for (Position& corner : light.loop) move(corner);
    }
  });
}

Outcome flip(Subjected& on) {
  if (on.has(Repair::kNotPlanar)) return Failed{};
  Scene changed = on.scene;
  std::map<std::string, bool> flipped;
  for (Polygon& polygon : changed.polygons) {
    if (!changed.is_two_sided(polygon) || on.random.chance(1, 2)) continue;
    std::ranges::reverse(polygon.loop);
    flipped[polygon.id] = true;
  }
  const Expected<Answer> before = solve(on.scene, on.prepared, on.options);
  if (!before) return tl::unexpected(before.error());
  const Expected<Answer> after = solve(changed, on.options);
  if (!after) return tl::unexpected(after.error());
  for (const auto& [place, classes] : *before) {
    const auto& [light, polygon, side] = place;
    auto other = after->find({light, polygon, flipped.contains(polygon) ? opposite(side) : side});
    // A polygon that no light reaches is listed with its front, whatever its front is.
    if (other == after->end()) other = after->find(place);
    if (other == after->end()) return broken(place, "is missing with its loop reversed");
    if (other->second != classes) {
      return broken(place,
                    classes_text(classes) + "; with loops reversed " + classes_text(other->second));
    }
  }
  return Failed{};
}

Outcome duplicate(Subjected& on) {
  Scene changed = on.scene;
  Polygon copy = changed.polygons[on.random.below(changed.polygons.size())];
  const std::string original = copy.id;
  copy.id += " again";
  changed.polygons.push_back(copy);
  const Expected<Answer> before = solve(on.scene, on.prepared, on.options);
  if (!before) return tl::unexpected(before.error());
  Expected<Answer> after = solve(changed, on.options);
  if (!after) return tl::unexpected(after.error());
  for (auto at = after->begin(); at != after->end();) {
    const auto& [light, polygon, side] = at->first;
    if (polygon != copy.id) {
      ++at;
      continue;
    }
    const auto first = after->find({light, original, side});
    if (first == after->end() || first->second != at->second) {
      return broken(at->first, "a polygon in the same place has other shadows");
    }
    at = after->erase(at);
  }
  return difference(*before, *after);
}

Outcome lights_apart(Subjected& on) {
  if (on.prepared.lights.size() < 2) return Failed{};
  const Expected<Answer> together = solve(on.scene, on.prepared, on.options);
  if (!together) return tl::unexpected(together.error());
  Answer apart;
  for (std::uint32_t light = 0; light < on.prepared.lights.size(); ++light) {
    ShadowOptions one = on.options;
    one.lights = {light};
    Expected<Answer> answer = solve(on.scene, on.prepared, one);
    if (!answer) return tl::unexpected(answer.error());
    apart.merge(*answer);
  }
  return difference(*together, apart);
}

/// Lit area may only shrink, umbra may only grow.
Outcome caster_less(Subjected& on) {
  if (on.scene.polygons.size() < 2) return Failed{};
  Scene fewer = on.scene;
  fewer.polygons.erase(fewer.polygons.begin() +
                       static_cast<std::ptrdiff_t>(on.random.below(fewer.polygons.size())));
  const Expected<Answer> with = solve(on.scene, on.prepared, on.options);
  if (!with) return tl::unexpected(with.error());
  const Expected<Answer> without = solve(fewer, on.options);
  if (!without) return tl::unexpected(without.error());
  for (const auto& [place, classes] : *without) {
    const auto other = with->find(place);
    if (other == with->end()) return broken(place, "is missing with one polygon more");
    if (other->second.lit > classes.lit || other->second.umbra < classes.umbra) {
      return broken(
          place, classes_text(classes) + "; with one polygon more " + classes_text(other->second));
    }
  }
  return Failed{};
}

Number half_way(const Number& a, const Number& b) { return times_power_of_two(sum(a, b), -1); }

/// A polygon cut in two has together what it had as a whole, and casts the same shadow. (Umbra is
/// of single casters, so that a cut caster may have less of it.)
Outcome split(Subjected& on) {
  constexpr unsigned kMostBits = 200;
  if (on.prepared.position_bits > kMostBits || on.has(Repair::kNotPlanar)) return Failed{};
  const std::size_t chosen = on.random.below(on.scene.polygons.size());
  const Polygon& whole = on.scene.polygons[chosen];
  const std::uint32_t part = on.prepared.first_part[chosen];
  if (on.prepared.first_part[chosen + 1] != part + 1 || !whole.holes.empty()) return Failed{};
  for (const PreparationNote& note : on.prepared.notes) {
    if (note.polygon == chosen) return Failed{};
  }
  Scene changed = on.scene;
  const std::size_t n = whole.loop.size();
  // From a vertex to a vertex that is no neighbour, or to the middle of an edge: a T-vertex.
  const std::size_t from = on.random.below(n);
  std::vector<VertexId> loop = whole.loop;
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(from), loop.end());
  std::size_t to = 2;
  if (n == 3 || on.random.chance(1, 2)) {
    const Position &a = changed.vertices[loop[1]], &b = changed.vertices[loop[2]];
    loop.insert(loop.begin() + 2, static_cast<VertexId>(changed.vertices.size()));
    changed.vertices.push_back({half_way(a[0], b[0]), half_way(a[1], b[1]), half_way(a[2], b[2])});
  }
  const auto cut = loop.begin() + static_cast<std::ptrdiff_t>(to);
  std::array<Polygon, 2> halves = {whole, whole};
  halves[0].loop.assign(loop.begin(), cut + 1);
  halves[1].loop.assign(cut, loop.end());
  halves[1].loop.push_back(loop.front());
  for (std::size_t i = 0; i < 2; ++i) halves[i].id += i == 0 ? " half 1" : " half 2";
  changed.polygons[chosen] = halves[0];
  changed.polygons.push_back(halves[1]);

  const Expected<PreparedScene> prepared = prepare(changed);
  if (!prepared) return tl::unexpected(prepared.error());
  std::array<mpz_class, 2> areas;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t polygon = i == 0 ? chosen : changed.polygons.size() - 1;
    if (prepared->first_part[polygon] == prepared->first_part[polygon + 1]) return Failed{};
    const auto vector =
        report::doubled_area_vector(*prepared, prepared->parts[prepared->first_part[polygon]]);
    for (const mpz_class& component : vector) {
      // Coplanar and of one orientation: any component that is not zero has the ratio.
      if (component != 0 && areas[i] == 0) areas[i] = component;
    }
  }
  mpq_class share(areas[0], areas[0] + areas[1]);
  share.canonicalize();
  const Expected<Answer> before = solve(on.scene, on.prepared, on.options);
  if (!before) return tl::unexpected(before.error());
  const Expected<Answer> after = solve(changed, *prepared, on.options);
  if (!after) return tl::unexpected(after.error());
  for (const auto& [place, classes] : *before) {
    const auto& [light, polygon, side] = place;
    Classes sum;
    if (polygon == whole.id) {
      const auto first = after->find({light, halves[0].id, side});
      const auto second = after->find({light, halves[1].id, side});
      // A side that sees the light may have a half that does not.
      if (first != after->end()) sum.lit += share * first->second.lit;
      if (second != after->end()) sum.lit += (1 - share) * second->second.lit;
    } else {
      const auto same = after->find(place);
      if (same == after->end()) return broken(place, "is missing with a polygon cut in two");
      sum = same->second;
    }
    if (sum.lit != classes.lit) {
      return broken(
          place, fmt::format("lit {}; with polygon {} cut in two {}", text_for_people(classes.lit),
                             whole.id, text_for_people(sum.lit)));
    }
  }
  return Failed{};
}

struct Relation {
  RelationInfo info;
  Outcome (*check)(Subjected& on);
};

constexpr std::array kRelations = {
    Relation{{"order", "the order of polygons and lights means nothing"}, order},
    Relation{{"rotation", "nor does the vertex that a loop starts with"}, rotation},
    Relation{{"scale", "a power of two times all positions"}, scale},
    Relation{{"axes", "cyclic exchange of the axes"}, axes},
    Relation{{"mirror", "reflection, loops reversed"}, mirror},
    Relation{{"translation", "by whole units"}, translation},
    Relation{{"flip", "a reversed two-sided polygon exchanges its sides"}, flip},
    Relation{{"duplicate", "a second polygon in the place of a first"}, duplicate},
    Relation{{"lights-apart", "a light alone does what it does among others"}, lights_apart},
    Relation{{"caster-less", "a polygon more lights nothing"}, caster_less},
    Relation{{"split", "a polygon cut in two has and casts what it had and cast"}, split},
};

constexpr auto kRelationInfos = [] {
  std::array<RelationInfo, kRelations.size()> infos;
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = kRelations[i].info;
  return infos;
}();

/// The shares of all sides under one light, sorted. What is no number, as the share of a sliver
/// whose area has rounded to nothing, is -1.
using Shares = std::vector<std::array<double, 4>>;

std::map<std::string, Shares> shares_of(const Scene& scene, const PreparedScene& prepared,
                                        const ShadowResult& result) {
  std::map<std::string, Shares> all;
  for (const LightResult& light : result.lights) {
    Shares& shares = all[scene.lights[prepared.lights[light.light].light].id];
    for (std::size_t i = 0; i < light.parts.size(); ++i) {
      const PartResult& part = light.parts[i];
      const bool area = !light.area_fractions.empty();
      shares.push_back({part.lit.lower, part.shadow.lower,
                        area ? light.area_fractions[i].penumbra.lower : 0,
                        area ? light.area_fractions[i].umbra.lower : 0});
    }
    for (auto& side : shares) {
      for (double& share : side) share = std::isnan(share) ? -1 : share;
    }
    std::ranges::sort(shares);
  }
  return all;
}

}  // namespace

Expected<std::optional<BrokenRelation>> check_written_otherwise(const Scene& scene,
                                                                const PreparedScene& prepared,
                                                                const ShadowOptions& options,
                                                                std::uint64_t seed) {
  if (scene.polygons.empty()) return std::nullopt;
  ShadowOptions shares_alone = options;
  shares_alone.output.points = shares_alone.output.exact_points = false;
  Random random(seed);
  Scene changed = scene;
  random.shuffle(std::span(changed.polygons));
  random.shuffle(std::span(changed.lights));
  turn_loops(changed, random);
  const Expected<PreparedScene> otherwise = prepare(changed);
  if (!otherwise) return tl::unexpected(otherwise.error());
  const Expected<ShadowResult> before = compute_shadows(prepared, shares_alone);
  if (!before) return tl::unexpected(before.error());
  const Expected<ShadowResult> after = compute_shadows(*otherwise, shares_alone);
  if (!after) return tl::unexpected(after.error());
  const auto old_shares = shares_of(scene, prepared, *before);
  const auto new_shares = shares_of(changed, *otherwise, *after);
  for (const auto& [light, shares] : old_shares) {
    const auto same = new_shares.find(light);
    if (same != new_shares.end() && same->second == shares) continue;
    return BrokenRelation{light,
                          {},
                          "light " + light +
                              ": other shares where polygons come in another order and loops start "
                              "elsewhere"};
  }
  return std::nullopt;
}

std::span<const RelationInfo> relations() { return kRelationInfos; }

Expected<std::optional<BrokenRelation>> check_relation(std::size_t relation, const Scene& scene,
                                                       const PreparedScene& prepared,
                                                       const ShadowOptions& options,
                                                       std::uint64_t seed) {
  if (scene.polygons.empty()) return std::nullopt;
  ShadowOptions exact = options;
  exact.output.exact_fractions = true;
  exact.output.points = exact.output.exact_points = false;
  Subjected on{scene, prepared, exact, Random(seed)};
  return kRelations.at(relation).check(on);
}

}  // namespace gnomon::fuzz
