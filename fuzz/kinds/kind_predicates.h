// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a scene holds a kind of degeneracy, decided by exact integer arithmetic from the scene's
// own numbers: no code of moves, kernels or oracle. What a move says that it did counts only if
// this agrees.
#ifndef GNOMON_FUZZ_KINDS_KIND_PREDICATES_H
#define GNOMON_FUZZ_KINDS_KIND_PREDICATES_H

#include <memory>

#include "fuzz/scene/kinds.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct SceneView;

class KindChecker {
 public:
  /// The scene must outlive it.
  explicit KindChecker(const Scene& scene);
  ~KindChecker();
  KindChecker(const KindChecker&) = delete;
  KindChecker& operator=(const KindChecker&) = delete;

  /// True for every kind of base, about which a scene says nothing. Kinds that speak of a polygon's
  /// interior see convex polygons only; those that compare sizes do so by the largest extent along
  /// an axis.
  bool holds(Kind kind) const;

 private:
  std::unique_ptr<const SceneView> view_;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_KINDS_KIND_PREDICATES_H
