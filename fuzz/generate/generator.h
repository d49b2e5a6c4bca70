// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes for campaigns: a base (a soup, a family, a scene generator's scene, a file's polygons) and
// degenerate moves on it, each drawn from its own random numbers, so that undoing one leaves the
// others as they were.
//
// Guarantees: the same text and seed give the same scene on every machine (a file's scene, as long
// as the file is the same); every scene has a polygon and a light and can be prepared. Scenes are
// small, two to six polygons mostly, so that checking one takes milliseconds.
#ifndef GNOMON_FUZZ_GENERATE_GENERATOR_H
#define GNOMON_FUZZ_GENERATE_GENERATOR_H

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/scene/kinds.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct MadeScene {
  Scene scene;                       // its name is the recipe
  std::string recipe;                // what was done: "soup-lattice+duplicate+light-in-plane"
  std::vector<std::uint16_t> kinds;  // sorted, distinct: base and moves, where they hold
};

struct GeneratorRecipe;  // what a text says

class Generator {
 public:
  /// BASE[+MOVE]...: a base is "mix" (point and directional lights; all soups, families and some
  /// scenes), "area-mix" (area lights), "soup-uniform" and the other soups, "family-NAME",
  /// "area-family-NAME", "scene:NAME" (of `gnomon generate`), or "file:PATH" (any scene that can be
  /// read); of more than a dozen polygons a few near each other are cut out. "area-" before a soup,
  /// scene or file puts it under area lights. A move is the name of a kind (moves.h), or "any":
  /// up to four that the seed chooses, which "mix" and "area-mix" have without being told. The
  /// recipe of a scene is such a text too, and gives it again from the same seed. Errors: kUsage,
  /// with the names that there are; those of read_scene.
  static Expected<Generator> parse(std::string_view text);

  MadeScene make(std::uint64_t seed) const;
  /// The same scene with some or all moves undone, fewest moves first; empty if it has none.
  std::vector<Scene> with_fewer_moves(std::uint64_t seed) const;
  /// Every one of them appears in a campaign of 1,000 scenes or more. Sorted.
  const std::vector<std::uint16_t>& expected_kinds() const;
  /// The text that makes it.
  const std::string& name() const;

 private:
  explicit Generator(std::shared_ptr<const GeneratorRecipe> recipe) : recipe_(std::move(recipe)) {}

  std::shared_ptr<const GeneratorRecipe> recipe_;
};

/// The names of bases that need nothing else: mixes, soups, families.
std::vector<std::string> generator_names();

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_GENERATOR_H
