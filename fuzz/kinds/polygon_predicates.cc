// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of single polygons, and of polygons to each other.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "fuzz/kinds/predicate_tables.h"

namespace gnomon::fuzz {

namespace {

bool has_non_convex(const SceneView& view) {
  for (std::size_t i = 0; i < view.faces.size(); ++i) {
    const Face& face = view.faces[i];
    if (view.scene.polygons[i].holes.empty() && face.planar && !face.convex) return true;
  }
  return false;
}

bool has_holes(const SceneView& view) {
  return std::ranges::any_of(view.scene.polygons,
                             [](const Polygon& polygon) { return !polygon.holes.empty(); });
}

bool has_almost_planar(const SceneView& view) {
  return view.any_face([](const Face& face) { return !face.planar; });
}

bool has_sliver(const SceneView& view) {
  return view.any_face([](const Face& face) { return is_thin(face, false); });
}

bool has_needle(const SceneView& view) {
  return view.any_face([](const Face& face) { return is_thin(face, true); });
}

bool has_coplanar(const SceneView& view) {
  return view.any_pair([](const Face& a, const Face& b) { return a.coplanar_with(b); });
}

bool has_overlap(const SceneView& view) { return view.any_pair(overlap); }

bool has_duplicate(const SceneView& view) { return view.any_pair(have_the_same_corners); }

bool has_back_to_back(const SceneView& view) {
  return view.any_pair([](const Face& a, const Face& b) {
    return sgn(dot(a.normal, b.normal)) < 0 && overlap(a, b);
  });
}

bool has_shared_edge(const SceneView& view) { return view.any_pair(share_edge); }

bool has_shared_vertex(const SceneView& view) { return view.any_pair(share_vertex); }

bool has_t_junction(const SceneView& view) {
  return view.any_pair([](const Face& a, const Face& b) {
    return any_corner(a, [&](const Integers& p) {
      return any_edge(b,
                      [&](const Integers& r, const Integers& s) { return inside_edge(p, r, s); });
    });
  });
}

bool has_edge_overlap(const SceneView& view) { return view.any_pair(share_part_of_edge); }

bool has_vertex_in_face(const SceneView& view) { return view.any_pair(vertex_in_face); }

bool has_edge_in_face(const SceneView& view) {
  return view.any_pair([](const Face& a, const Face& b) {
    return !b.coplanar_with(a) && any_edge(a, [&](const Integers& p, const Integers& q) {
      return b.holds_inside(p) && b.holds_inside(q);
    });
  });
}

bool has_crossing(const SceneView& view) { return view.any_pair(pierces); }

struct AxisBox {
  Integers low, high;
};

AxisBox box_around(std::span<const Face> faces) {
  AxisBox box{faces[0].loop[0], faces[0].loop[0]};
  for (const Face& face : faces) {
    for (const Integers& p : face.loop) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (p[k] < box.low[k]) box.low[k] = p[k];
        if (p[k] > box.high[k]) box.high[k] = p[k];
      }
    }
  }
  return box;
}

/// The common box of six quadrilaterals that are its sides, in any order; nothing if they are not.
std::optional<AxisBox> box_of_sides(std::span<const Face> faces) {
  if (!std::ranges::all_of(faces, [](const Face& face) { return face.loop.size() == 4; })) {
    return std::nullopt;
  }
  AxisBox box = box_around(faces);
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Integers* end : {&box.low, &box.high}) {
      const bool has_side = std::ranges::any_of(faces, [&](const Face& face) {
        return std::ranges::all_of(face.loop, [&](const Integers& p) { return p[k] == (*end)[k]; });
      });
      if (!has_side) return std::nullopt;
    }
  }
  return box;
}

bool is_inside(const AxisBox& inner, const AxisBox& outer) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (outer.low[k] >= inner.low[k] || inner.high[k] >= outer.high[k]) return false;
  }
  return true;
}

bool has_nested_boxes(const SceneView& view) {
  std::vector<AxisBox> boxes;
  for (std::size_t i = 0; i + 6 <= view.faces.size(); ++i) {
    auto box = box_of_sides(std::span(view.faces).subspan(i, 6));
    if (box) boxes.push_back(*std::move(box));
  }
  return std::ranges::any_of(boxes, [&](const AxisBox& outer) {
    return std::ranges::any_of(boxes,
                               [&](const AxisBox& inner) { return is_inside(inner, outer); });
  });
}

bool has_near_parallel(const SceneView& view) {
  return view.any_pair([](const Face& a, const Face& b) {
    const mpz_class sine = squared_length(cross(a.normal, b.normal));
    return sine != 0 && (sine << 56) < squared_length(a.normal) * squared_length(b.normal);
  });
}

}  // namespace

std::span<const KindPredicate> polygon_predicates() {
  static constexpr KindPredicate kPredicates[] = {
      {Kind::kNonConvex, has_non_convex},
      {Kind::kHoles, has_holes},
      {Kind::kAlmostPlanar, has_almost_planar},
      {Kind::kSliver, has_sliver},
      {Kind::kNeedle, has_needle},
      {Kind::kCoplanar, has_coplanar},
      {Kind::kOverlap, has_overlap},
      {Kind::kDuplicate, has_duplicate},
      {Kind::kBackToBack, has_back_to_back},
      {Kind::kSharedEdge, has_shared_edge},
      {Kind::kSharedVertex, has_shared_vertex},
      {Kind::kTJunction, has_t_junction},
      {Kind::kEdgeOverlap, has_edge_overlap},
      {Kind::kVertexInFace, has_vertex_in_face},
      {Kind::kEdgeInFace, has_edge_in_face},
      {Kind::kCrossing, has_crossing},
      {Kind::kNestedBoxes, has_nested_boxes},
      {Kind::kNearParallel, has_near_parallel},
  };
  return kPredicates;
}

}  // namespace gnomon::fuzz
