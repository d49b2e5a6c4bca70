// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as the predicates of kinds see it: its polygons and lights with integer corners on one
// grid, and the walks over all of them, over pairs and over lights with polygons.
#ifndef GNOMON_FUZZ_KINDS_SCENE_VIEW_H
#define GNOMON_FUZZ_KINDS_SCENE_VIEW_H

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fuzz/kinds/apex.h"
#include "fuzz/kinds/exact_face.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct SceneView {
  const Scene& scene;
  std::vector<Face> faces;   // the polygons, in the scene's order
  std::vector<Face> panels;  // the area lights
  std::vector<Apex> apexes;  // the point lights, then the directional lights
  mpz_class extent;          // of all polygons
  Loop corners;              // of all polygons

  /// The scene must outlive the view.
  explicit SceneView(const Scene& of);

  template <class Test>
  bool any_face(const Test& test) const {
    return std::ranges::any_of(faces, test);
  }
  template <class Test>
  bool any_panel(const Test& test) const {
    return std::ranges::any_of(panels, test);
  }
  /// Of two different polygons, in both orders.
  template <class Test>
  bool any_pair(const Test& test) const {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (std::size_t k = 0; k < faces.size(); ++k) {
        if (i != k && test(faces[i], faces[k])) return true;
      }
    }
    return false;
  }
  /// Of a point light (weight 1) or a directional light (weight 0), and a polygon.
  template <class Test>
  bool any_apex_and_face(int weight, const Test& test) const {
    return std::ranges::any_of(apexes, [&](const Apex& apex) {
      return apex.weight == weight && any_face([&](const Face& face) { return test(apex, face); });
    });
  }
  /// Of a point light or a directional light, and two polygons.
  template <class Test>
  bool any_apex_and_pair(const Test& test) const {
    return std::ranges::any_of(apexes, [&](const Apex& apex) {
      return any_pair([&](const Face& a, const Face& b) { return test(apex, a, b); });
    });
  }
  /// Of an area light and a polygon.
  template <class Test>
  bool any_panel_and_face(const Test& test) const {
    return any_panel([&](const Face& panel) {
      return any_face([&](const Face& face) { return test(panel, face); });
    });
  }
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_KINDS_SCENE_VIEW_H
