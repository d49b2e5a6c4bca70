// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/generator.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "fuzz/generate/area_families.h"
#include "fuzz/generate/families.h"
#include "fuzz/generate/soups.h"
#include "fuzz/kinds/kind_predicates.h"
#include "fuzz/moves/move_tools.h"
#include "fuzz/moves/moves.h"
#include "fuzz/scene/scene_coordinates.h"
#include "gnomon/scene/generate.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "scene/base/text_hash.h"

namespace gnomon::fuzz {
namespace {

enum class BaseType : std::uint8_t { kMix, kSoup, kFamily, kScene, kFile };

/// What moves are put on.
struct Base {
  BaseType type = BaseType::kMix;
  bool area = false;         // under area lights
  std::string name;          // as it is written, such as "area-soup-lattice" or "file:room.obj"
  std::size_t index = 0;     // of the soup or family
  std::string scene;         // of generate()
  std::uint16_t kind = 0;    // not of mixes
  std::vector<Kind> others;  // that scenes of the base may hold
};

constexpr const char* kSoupNames[] = {"soup-uniform", "soup-clustered", "soup-lattice",
                                      "soup-mixed-sizes"};

/// What the families' scenes are made to hold.
std::vector<Kind> kinds_in_family(std::string_view name) {
  static const std::map<std::string_view, std::vector<Kind>> kHeld = {
      {"AlmostPlanar", {Kind::kAlmostPlanar}},
      {"Crossing", {Kind::kCrossing}},
      {"CrossingSticks", {Kind::kCrossing}},
      {"CoplanarTiles", {Kind::kCoplanar, Kind::kOverlap}},
      {"NestedBoxes", {Kind::kNestedBoxes}},
      {"Needles", {Kind::kNeedle}},
      {"PowersOfTwo", {Kind::kScaledUp, Kind::kScaledDown}},
      {"MixedMagnitudes", {Kind::kMixedMagnitudes}},
      {"Decimals", {Kind::kDecimals}},
      {"Repaired", {Kind::kNonConvex}},
      {"SmallLattice", {Kind::kCoplanar,           Kind::kOverlap,         Kind::kDuplicate,
                        Kind::kBackToBack,         Kind::kSharedEdge,      Kind::kSharedVertex,
                        Kind::kTJunction,          Kind::kEdgeOverlap,     Kind::kVertexInFace,
                        Kind::kCrossing,           Kind::kLightInPlane,    Kind::kLightOnFace,
                        Kind::kLightOnEdge,        Kind::kLightOnEdgeLine, Kind::kLightAtVertex,
                        Kind::kSunInPlane,         Kind::kSunAlongEdge,    Kind::kShadowEdges,
                        Kind::kShadowVertexOnEdge, Kind::kShadowVertices,  Kind::kCyclicOverlap}},
  };
  const auto found = kHeld.find(name);
  return found == kHeld.end() ? std::vector<Kind>{} : found->second;
}

std::vector<Base> all_soups(bool area) {
  std::vector<Base> bases;
  for (std::size_t i = 0; i < std::size(kSoupNames); ++i) {
    Base base{BaseType::kSoup, area, area ? "area-" : "", i, "", 0, {}};
    base.name += kSoupNames[i];
    base.kind = *kind_by_name(kSoupNames[i]);
    bases.push_back(std::move(base));
  }
  return bases;
}

std::vector<Base> all_families(bool area) {
  std::vector<Base> bases;
  const auto& families = area ? area_families() : fuzz::families();
  for (std::size_t i = 0; i < families.size(); ++i) {
    Base base{BaseType::kFamily, area, "", i, "", 0, {}};
    base.kind = area ? kind_of_area_family(i) : kind_of_family(i);
    base.name = kinds()[base.kind].name;
    base.others = kinds_in_family(families[i].name);
    bases.push_back(std::move(base));
  }
  return bases;
}

Base scene_base(bool area, const std::string& name) {
  Base base{BaseType::kScene, area, area ? "area-" : "", 0, name, id_of(Kind::kScene), {}};
  base.name += "scene:" + name;
  return base;
}

/// Scenes that are hard with few polygons, for every seed in another way.
std::vector<Base> hard_scenes(bool area) {
  std::vector<Base> bases;
  for (const char* name : {"crossing-sticks", "grazing", "lattice", "near-coplanar", "needles",
                           "pinwheel", "slanted-through", "touching-boxes"}) {
    bases.push_back(scene_base(area, name));
  }
  return bases;
}

/// Random numbers of one purpose, which do not depend on those of another.
Random stream(std::uint64_t seed, std::string_view purpose, std::uint64_t attempt) {
  Random first(seed);
  Random second(first.next() ^ text_hash(purpose));
  return Random(second.next() + attempt * 0x9e3779b97f4a7c15u);
}

/// A file's scene, with the middles of its polygons.
struct FileScene {
  Scene scene;
  std::vector<std::array<double, 3>> middles;
};

FileScene with_middles(Scene scene) {
  FileScene file{std::move(scene), {}};
  for (const Polygon& polygon : file.scene.polygons) {
    std::array<double, 3> low{}, high{};
    for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
      const Position& p = file.scene.vertices[polygon.loop[i]];
      for (std::size_t k = 0; k < 3; ++k) {
        const double value = p[k].nearest() / 2;
        low[k] = i == 0 ? value : std::min(low[k], value);
        high[k] = i == 0 ? value : std::max(high[k], value);
      }
    }
    file.middles.push_back({low[0] + high[0], low[1] + high[1], low[2] + high[2]});
  }
  return file;
}

Expected<FileScene> read_file_scene(const std::string& path) {
  auto read = read_scene(path);
  if (!read) return tl::unexpected(read.error());
  if (read->scene.polygons.empty()) {
    return fail(ErrorCode::kUsage, path + ": no polygons", "a scene to cut polygons from");
  }
  return with_middles(std::move(read->scene));
}

/// A polygon and those nearest to it, two to five in all, with what lights of the file are of use.
Scene cut_from(const FileScene& file, bool area, Random& random) {
  const Scene& whole = file.scene;
  const std::size_t count =
      std::min<std::size_t>(whole.polygons.size(), 2 + random.below(random.chance(1, 40) ? 11 : 4));
  const auto& middle = file.middles[random.below(file.middles.size())];
  std::vector<std::pair<double, std::uint32_t>> nearest;
  for (std::uint32_t i = 0; i < file.middles.size(); ++i) {
    double distance = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      distance = std::max(distance, std::abs(file.middles[i][k] - middle[k]));
    }
    nearest.emplace_back(distance, i);
  }
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count),
                    nearest.end());
  Scene scene;
  scene.name = whole.name;
  scene.numbers = whole.numbers;
  scene.two_sided = whole.two_sided;
  std::map<VertexId, VertexId> ids;
  const auto take = [&](std::vector<VertexId>& loop) {
    for (VertexId& v : loop) {
      const auto [place, is_new] = ids.emplace(v, static_cast<VertexId>(scene.vertices.size()));
      if (is_new) scene.vertices.push_back(whole.vertices[v]);
      v = place->second;
    }
  };
  for (std::size_t i = 0; i < count; ++i) {
    Polygon polygon = whole.polygons[nearest[i].second];
    take(polygon.loop);
    for (auto& hole : polygon.holes) take(hole);
    scene.polygons.push_back(std::move(polygon));
  }
  std::vector<const Light*> lights;
  for (const Light& light : whole.lights) {
    if (light.has_area() == area) lights.push_back(&light);
  }
  if (!lights.empty() && random.chance(1, 2)) {
    scene.lights.push_back(*lights[random.below(lights.size())]);
  }
  return scene;
}

/// A light where there is none of the kind wanted. False if it did not fit.
bool complete_lights(Scene& scene, bool area, Random& random) {
  const bool has =
      std::ranges::any_of(scene.lights, [&](const Light& l) { return l.has_area() == area; });
  if (has) return true;
  if (!area) std::erase_if(scene.lights, [](const Light& l) { return l.has_area(); });
  for (int i = 0; i < 8; ++i) {
    const Vector at = free_point(scene, random);
    if (area ? set_panel(scene, random, completed(scene, random, {at}))
             : set_light(scene, random, LightType::kPoint, position_of(at, scene.numbers))) {
      return true;
    }
  }
  return false;
}

Scene scene_of_generator(const Base& base, Random& random) {
  const GeneratorInfo& info = *generator_by_name(base.scene);
  std::map<std::string, std::int64_t> values;
  for (const GeneratorParameter& parameter : info.parameters) {
    if (info.small && parameter.name == "n") {
      values["n"] = std::min(parameter.default_value, random.between(1, 4));
    }
    if (parameter.name == "light") values["light"] = random.between(0, 2);
    if (parameter.name == "area") values["area"] = base.area ? 1 : 0;
  }
  auto scene = generate(base.scene, values, random.next());
  if (!scene) return Scene{};
  constexpr std::size_t kMost = 12;
  if (scene->polygons.size() <= kMost) return std::move(*scene);
  return cut_from(with_middles(std::move(*scene)), base.area, random);
}

/// Some families have lights between doubles, which no file can say.
void round_to_doubles(Scene& scene) {
  if (scene.numbers == NumberMeaning::kDecimal) return;
  for (Position* position : points_of(scene)) {
    for (Number& number : *position) {
      if (!number.is_double()) number = Number(number.nearest());
    }
  }
}

bool can_be_prepared(const Scene& scene) {
  if (scene.lights.empty()) return false;
  const auto prepared = prepare(scene);
  return prepared && !prepared->parts.empty();
}

}  // namespace

struct GeneratorRecipe {
  std::string name;
  Base base;
  std::vector<const Move*> named;
  bool any = false;
  std::optional<FileScene> file;
  std::vector<Base> soups, families, scenes;                     // of a mix
  std::vector<const Move*> polygon_pool, light_pool, area_pool;  // of "any"
  std::vector<std::uint16_t> expected;

  /// What a seed chooses.
  struct Plan {
    Base base;
    std::vector<const Move*> moves;
  };
  Plan plan(std::uint64_t seed) const;
  Scene make_base(const Base& from, Random& random) const;
  /// Moves whose bit in `mask` is set.
  MadeScene build(const Plan& plan, std::uint64_t seed, std::uint64_t mask) const;
};

GeneratorRecipe::Plan GeneratorRecipe::plan(std::uint64_t seed) const {
  Random random = stream(seed, "plan", 0);
  Plan result{base, named};
  if (base.type == BaseType::kMix) {
    const std::uint64_t draw = random.below(100);
    const std::vector<Base>& from = draw < 45 ? soups : draw < 88 ? families : scenes;
    result.base = from[random.below(from.size())];
  }
  if (any) {
    static constexpr int kCounts[] = {0, 1, 1, 1, 2, 2, 2, 3, 3, 4};
    const int count = kCounts[random.below(std::size(kCounts))];
    for (int i = 0; i < count; ++i) {
      const bool lights_too = base.area && random.chance(1, 12);
      const auto& pool = random.chance(1, 2)        ? polygon_pool
                         : base.area && !lights_too ? area_pool
                                                    : light_pool;
      const Move* const move = pool[random.below(pool.size())];
      if (std::ranges::find(result.moves, move) == result.moves.end()) {
        result.moves.push_back(move);
      }
    }
    // In the order of the table.
    std::ranges::sort(result.moves);
  }
  return result;
}

Scene GeneratorRecipe::make_base(const Base& from, Random& random) const {
  Scene scene;
  switch (from.type) {
    case BaseType::kSoup:
      scene = make_soup(static_cast<Soup>(from.index), from.area, random);
      break;
    case BaseType::kFamily:
      scene = (from.area ? area_families() : fuzz::families())[from.index].make(random.next());
      break;
    case BaseType::kScene:
      scene = scene_of_generator(from, random);
      break;
    case BaseType::kFile:
      scene = cut_from(*file, from.area, random);
      break;
    case BaseType::kMix:
      break;
  }
  round_to_doubles(scene);
  if (scene.polygons.empty() || !complete_lights(scene, from.area, random)) scene.lights.clear();
  return scene;
}

MadeScene GeneratorRecipe::build(const Plan& plan, std::uint64_t seed, std::uint64_t mask) const {
  // Each attempt has random numbers of its own, so that the same is found again by another recipe.
  constexpr std::uint64_t kAttempts = 8;
  MadeScene made;
  for (std::uint64_t attempt = 0; !can_be_prepared(made.scene); ++attempt) {
    Random random = stream(seed, plan.base.name, attempt);
    // Of some files hardly a polygon can be prepared.
    const bool give_up = attempt >= 64;
    made.scene =
        give_up ? make_soup(Soup::kLattice, plan.base.area, random) : make_base(plan.base, random);
  }
  made.recipe = plan.base.name;
  std::vector<Kind> claims = plan.base.others;
  claims.push_back(Kind::kOneSided);
  claims.push_back(Kind::kTwoSided);
  if (plan.base.type == BaseType::kSoup && plan.base.index == 3) {
    claims.push_back(Kind::kSoupMixedSizes);
  } else {
    made.kinds.push_back(plan.base.kind);
  }
  std::optional<Kind> last;  // that was put in, and looked for already
  for (std::size_t i = 0; i < plan.moves.size(); ++i) {
    if ((mask >> i & 1) == 0) continue;
    const Move& move = *plan.moves[i];
    claims.push_back(move.kind);
    for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
      Random random = stream(seed, move.name(), attempt);
      Scene next = made.scene;
      if (!move.apply(next, random) || !KindChecker(next).holds(move.kind) ||
          !can_be_prepared(next)) {
        continue;
      }
      made.scene = std::move(next);
      made.recipe += "+";
      made.recipe += move.name();
      last = move.kind;
      break;
    }
  }
  // A later move may have undone what an earlier one did.
  const KindChecker checker(made.scene);
  for (const Kind kind : claims) {
    if (kind == last || checker.holds(kind)) made.kinds.push_back(id_of(kind));
  }
  std::ranges::sort(made.kinds);
  made.kinds.erase(std::unique(made.kinds.begin(), made.kinds.end()), made.kinds.end());
  made.scene.name = made.recipe;
  return made;
}

namespace {

Expected<Base> parse_base(std::string_view text, std::optional<FileScene>& file) {
  const bool area = text.starts_with("area-");
  const std::string_view rest = area ? text.substr(5) : text;
  if (rest == "mix") return Base{BaseType::kMix, area, std::string(text), 0, "", 0, {}};
  for (const auto& list : {all_soups(area), all_families(area)}) {
    for (const Base& base : list) {
      if (base.name == text) return base;
    }
  }
  if (rest.starts_with("scene:")) {
    const std::string name(rest.substr(6));
    if (generator_by_name(name) == nullptr) {
      return fail(ErrorCode::kUsage, "there is no scene '" + name + "'",
                  "one of those that 'gnomon generate --list' names");
    }
    return scene_base(area, name);
  }
  if (rest.starts_with("file:")) {
    auto read = read_file_scene(std::string(rest.substr(5)));
    if (!read) return tl::unexpected(read.error());
    file = std::move(*read);
    return Base{BaseType::kFile, area, std::string(text), 0, "", id_of(Kind::kFile), {}};
  }
  std::string names;
  for (const std::string& name : generator_names()) names += " " + name;
  return fail(ErrorCode::kUsage, "there is no generator '" + std::string(text) + "'",
              "scene:NAME, file:PATH, or one of:" + names);
}

/// The moves at the end of a text, which is cut off there. A path may hold a '+' of its own.
Expected<std::vector<std::string>> take_moves(std::string_view& text) {
  std::vector<std::string> moves;
  for (;;) {
    const std::size_t plus = text.rfind('+');
    if (plus == std::string_view::npos) break;
    const std::string name(text.substr(plus + 1));
    if (name != "any" && move_by_name(name) == nullptr) {
      if (text.find("file:") != std::string_view::npos) break;
      std::string names = "any";
      for (const Move& move : fuzz::moves()) names += " " + std::string(move.name());
      return fail(ErrorCode::kUsage, "there is no move '" + name + "'", "one of: " + names);
    }
    moves.push_back(name);
    text = text.substr(0, plus);
  }
  return moves;
}

}  // namespace

Expected<Generator> Generator::parse(std::string_view text) {
  auto recipe = std::make_shared<GeneratorRecipe>();
  recipe->name = text;
  const auto moves = take_moves(text);
  if (!moves) return tl::unexpected(moves.error());
  auto base = parse_base(text, recipe->file);
  if (!base) return tl::unexpected(base.error());
  recipe->base = std::move(*base);
  const bool area = recipe->base.area, mix = recipe->base.type == BaseType::kMix;
  recipe->any = mix;
  for (const std::string& name : *moves) {
    if (name == "any") {
      recipe->any = true;
      continue;
    }
    const Move* const move = move_by_name(name);
    if (std::ranges::find(recipe->named, move) == recipe->named.end()) {
      recipe->named.push_back(move);
    }
  }
  std::ranges::sort(recipe->named);
  std::vector<std::uint16_t>& expected = recipe->expected;
  for (const Move* const move : recipe->named) expected.push_back(id_of(move->kind));
  for (const Move& move : fuzz::moves()) {
    const bool of_lights = move.group == MoveGroup::kLight;
    if (move.large) continue;
    (of_lights                        ? recipe->light_pool
     : move.group == MoveGroup::kArea ? recipe->area_pool
                                      : recipe->polygon_pool)
        .push_back(&move);
    if (mix && (area ? !of_lights : move.group != MoveGroup::kArea)) {
      expected.push_back(id_of(move.kind));
    }
  }
  if (mix) {
    recipe->soups = all_soups(area);
    const auto& families = area ? area_families() : fuzz::families();
    for (Base& each : all_families(area)) {
      if (families[each.index].in_mix) recipe->families.push_back(std::move(each));
    }
    recipe->scenes = hard_scenes(area);
    for (const auto* list : {&recipe->soups, &recipe->families, &recipe->scenes}) {
      for (const Base& each : *list) expected.push_back(each.kind);
    }
    expected.push_back(id_of(Kind::kOneSided));
    expected.push_back(id_of(Kind::kTwoSided));
    if (!area) expected.push_back(id_of(Kind::kNestedBoxes));
  } else {
    expected.push_back(recipe->base.kind);
    // A move that is put on every scene may undo what the base holds.
    if (moves->empty()) {
      for (const Kind kind : recipe->base.others) expected.push_back(id_of(kind));
    }
  }
  std::ranges::sort(expected);
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  return Generator(std::move(recipe));
}

MadeScene Generator::make(std::uint64_t seed) const {
  return recipe_->build(recipe_->plan(seed), seed, ~std::uint64_t{0});
}

std::vector<Scene> Generator::with_fewer_moves(std::uint64_t seed) const {
  const GeneratorRecipe::Plan plan = recipe_->plan(seed);
  const std::size_t count = std::min<std::size_t>(plan.moves.size(), 63);
  const std::uint64_t all = (std::uint64_t{1} << count) - 1;
  std::vector<std::uint64_t> masks;
  constexpr std::size_t kFew = 5;
  if (count <= kFew) {
    for (std::uint64_t mask = 0; mask < all; ++mask) masks.push_back(mask);
  } else {  // none, single ones, all but one
    masks.push_back(0);
    for (std::size_t i = 0; i < count; ++i) {
      masks.push_back(std::uint64_t{1} << i);
      masks.push_back(all & ~(std::uint64_t{1} << i));
    }
  }
  std::ranges::stable_sort(masks, {}, [](std::uint64_t mask) { return std::popcount(mask); });
  std::vector<Scene> scenes;
  scenes.reserve(masks.size());
  for (const std::uint64_t mask : masks) scenes.push_back(recipe_->build(plan, seed, mask).scene);
  return scenes;
}

const std::vector<std::uint16_t>& Generator::expected_kinds() const { return recipe_->expected; }
const std::string& Generator::name() const { return recipe_->name; }

std::vector<std::string> generator_names() {
  std::vector<std::string> names = {"mix", "area-mix"};
  for (const bool area : {false, true}) {
    for (const auto& list : {all_soups(area), all_families(area)}) {
      for (const Base& base : list) names.push_back(base.name);
    }
  }
  return names;
}

}  // namespace gnomon::fuzz
