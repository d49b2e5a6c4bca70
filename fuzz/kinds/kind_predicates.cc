// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/kinds/kind_predicates.h"

#include <array>

#include "fuzz/kinds/predicate_tables.h"
#include "fuzz/kinds/scene_view.h"

namespace gnomon::fuzz {

namespace {

using Predicate = bool (*)(const SceneView&);

bool says_nothing(const SceneView&) { return true; }

constexpr KindPredicate kBases[] = {
    {Kind::kSoupUniform, says_nothing}, {Kind::kSoupClustered, says_nothing},
    {Kind::kSoupLattice, says_nothing}, {Kind::kScene, says_nothing},
    {Kind::kFile, says_nothing},
};

using Table = std::array<Predicate, static_cast<std::size_t>(Kind::kFirstFamily)>;

/// All tables by the number of the kind. tests/fuzz/kind_check_test.cc sees that none is missing.
const Table& predicates() {
  static const Table kTable = [] {
    Table table{};
    for (const auto part :
         {std::span<const KindPredicate>(kBases), polygon_predicates(), light_predicates(),
          area_light_predicates(), whole_scene_predicates()}) {
      for (const KindPredicate& row : part) table[id_of(row.kind)] = row.holds;
    }
    return table;
  }();
  return kTable;
}

}  // namespace

KindChecker::KindChecker(const Scene& scene) : view_(std::make_unique<const SceneView>(scene)) {}
KindChecker::~KindChecker() = default;

bool KindChecker::holds(Kind kind) const {
  return kind >= Kind::kFirstFamily || predicates()[id_of(kind)](*view_);
}

}  // namespace gnomon::fuzz
