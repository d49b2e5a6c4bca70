// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of area lights ("panels") and polygons.
#include "fuzz/kinds/predicate_tables.h"

namespace gnomon::fuzz {

namespace {

bool shares_vertex(const SceneView& view) { return view.any_panel_and_face(share_vertex); }

bool shares_edge(const SceneView& view) { return view.any_panel_and_face(share_edge); }

bool shares_part_of_edge(const SceneView& view) {
  return view.any_panel_and_face(share_part_of_edge);
}

bool is_panel_in_plane(const SceneView& view) {
  return view.any_panel_and_face(
      [](const Face& panel, const Face& face) { return face.coplanar_with(panel); });
}

bool is_on_caster(const SceneView& view) { return view.any_panel_and_face(overlap); }

bool all_inside(const Face& a, const Face& b) {
  return std::ranges::all_of(a.loop, [&](const Integers& p) { return b.holds_inside(p); });
}

bool is_panel_inside(const SceneView& view) {
  return view.any_panel_and_face([](const Face& panel, const Face& face) {
    return all_inside(panel, face) || all_inside(face, panel);
  });
}

bool has_panel_vertex_in_face(const SceneView& view) {
  return view.any_panel_and_face(vertex_in_face);
}

bool is_touched(const SceneView& view) {
  return view.any_panel_and_face(
      [](const Face& panel, const Face& face) { return vertex_in_face(face, panel); });
}

bool is_straddled(const SceneView& view) {
  return view.any_panel_and_face([](const Face& panel, const Face& face) {
    return face.planar && any_corner(panel, [&](const Integers& p) { return face.side(p) > 0; }) &&
           any_corner(panel, [&](const Integers& p) { return face.side(p) < 0; });
  });
}

bool is_cut(const SceneView& view) {
  return view.any_panel_and_face([](const Face& panel, const Face& face) {
    return pierces(panel, face) || pierces(face, panel);
  });
}

bool has_vertex_in_plane(const SceneView& view) {
  return view.any_panel_and_face([](const Face& panel, const Face& face) {
    return face.planar && !face.coplanar_with(panel) &&
           any_corner(panel, [&](const Integers& p) { return face.side(p) == 0; });
  });
}

bool has_edge_in_plane(const SceneView& view) {
  return view.any_panel_and_face([](const Face& panel, const Face& face) {
    return face.planar && !face.coplanar_with(panel) &&
           any_edge(panel, [&](const Integers& p, const Integers& q) {
             return face.side(p) == 0 && face.side(q) == 0;
           });
  });
}

/// Edges pq and rs that are parallel, but not on one line.
bool are_parallel(const Integers& p, const Integers& q, const Integers& r, const Integers& s) {
  return p != q && r != s && is_zero(cross(minus(q, p), minus(s, r))) && !collinear(p, q, r);
}

bool has_parallel_edge(const SceneView& view) {
  return view.any_panel_and_face(
      [](const Face& panel, const Face& face) { return any_edges(panel, face, are_parallel); });
}

bool is_panel_grazing(const SceneView& view) {
  return view.any_panel_and_face([](const Face& panel, const Face& face) {
    return any_corner(panel,
                      [&](const Integers& p) { return grazes(face, minus(p, face.loop[0])); });
  });
}

bool is_sliver(const SceneView& view) {
  return view.any_panel(
      [](const Face& panel) { return is_thin(panel, false) || is_thin(panel, true); });
}

bool is_small(const SceneView& view) {
  return view.any_panel(
      [&](const Face& panel) { return (extent_of(panel.loop) << 20) < view.extent; });
}

bool is_huge(const SceneView& view) {
  return view.any_panel(
      [&](const Face& panel) { return extent_of(panel.loop) > view.extent << 10; });
}

}  // namespace

std::span<const KindPredicate> area_light_predicates() {
  static constexpr KindPredicate kPredicates[] = {
      {Kind::kAreaVertex, shares_vertex},
      {Kind::kAreaEdge, shares_edge},
      {Kind::kAreaEdgeOverlap, shares_part_of_edge},
      {Kind::kAreaInPlane, is_panel_in_plane},
      {Kind::kAreaOnCaster, is_on_caster},
      {Kind::kAreaInside, is_panel_inside},
      {Kind::kAreaVertexInFace, has_panel_vertex_in_face},
      {Kind::kAreaTouched, is_touched},
      {Kind::kAreaStraddled, is_straddled},
      {Kind::kAreaCut, is_cut},
      {Kind::kAreaVertexInPlane, has_vertex_in_plane},
      {Kind::kAreaEdgeInPlane, has_edge_in_plane},
      {Kind::kAreaParallelEdge, has_parallel_edge},
      {Kind::kAreaGrazing, is_panel_grazing},
      {Kind::kAreaSliver, is_sliver},
      {Kind::kAreaSmall, is_small},
      {Kind::kAreaHuge, is_huge},
  };
  return kPredicates;
}

}  // namespace gnomon::fuzz
