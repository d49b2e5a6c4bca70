// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of point lights and directional lights.
#include <vector>

#include "fuzz/kinds/predicate_tables.h"

namespace gnomon::fuzz {

namespace {

constexpr int kPoint = 1, kDirectional = 0;  // weights of an apex

bool is_in_plane(const Apex& apex, const Face& face) { return face.planar && apex.side(face) == 0; }

bool is_grazing(const Apex& apex, const Face& face) {
  return grazes(face, apex.from(face.loop[0]));
}

bool has_light_in_plane(const SceneView& view) {
  return view.any_apex_and_face(kPoint, is_in_plane);
}

bool has_sun_in_plane(const SceneView& view) {
  return view.any_apex_and_face(kDirectional, is_in_plane);
}

bool has_light_on_face(const SceneView& view) {
  return view.any_apex_and_face(
      kPoint, [](const Apex& apex, const Face& face) { return face.holds_inside(apex.p); });
}

bool has_light_on_edge(const SceneView& view) {
  return view.any_apex_and_face(kPoint, [](const Apex& apex, const Face& face) {
    return any_edge(
        face, [&](const Integers& p, const Integers& q) { return inside_edge(apex.p, p, q); });
  });
}

bool has_light_on_edge_line(const SceneView& view) {
  return view.any_apex_and_face(kPoint, [](const Apex& apex, const Face& face) {
    return any_edge(face, [&](const Integers& p, const Integers& q) {
      return collinear(p, q, apex.p) && !inside_edge(apex.p, p, q) && apex.p != p && apex.p != q;
    });
  });
}

bool has_light_at_vertex(const SceneView& view) {
  return view.any_apex_and_face(kPoint, [](const Apex& apex, const Face& face) {
    return any_corner(face, [&](const Integers& p) { return p == apex.p; });
  });
}

bool has_light_far(const SceneView& view) {
  return std::ranges::any_of(view.apexes, [&](const Apex& apex) {
    return apex.weight == kPoint && std::ranges::all_of(view.corners, [&](const Integers& p) {
             return largest(minus(apex.p, p)) > view.extent * 1000000;
           });
  });
}

bool has_light_near(const SceneView& view) {
  return view.any_apex_and_face(
      kPoint, [](const Apex& apex, const Face& face) { return is_near(face, apex.p); });
}

bool has_grazing_light(const SceneView& view) { return view.any_apex_and_face(kPoint, is_grazing); }

bool has_grazing_sun(const SceneView& view) {
  return view.any_apex_and_face(kDirectional, is_grazing);
}

bool has_sun_along_edge(const SceneView& view) {
  return view.any_apex_and_face(kDirectional, [](const Apex& apex, const Face& face) {
    return any_edge(face, [&](const Integers& p, const Integers& q) {
      return p != q && is_zero(cross(apex.p, minus(q, p)));
    });
  });
}

/// Is an edge of `b` in the plane through the apex and the edge pq, but not on the line of pq?
bool has_edge_in_shadow_plane(const Apex& apex, const Integers& p, const Integers& q,
                              const Face& b) {
  const Integers normal = apex.plane(p, q);
  if (is_zero(normal)) return false;
  return any_edge(b, [&](const Integers& r, const Integers& s) {
    return sgn(dot(normal, minus(r, p))) == 0 && sgn(dot(normal, minus(s, p))) == 0 &&
           !(collinear(p, q, r) && collinear(p, q, s));
  });
}

bool has_shadow_edges(const SceneView& view) {
  return view.any_apex_and_pair([](const Apex& apex, const Face& a, const Face& b) {
    return any_edge(a, [&](const Integers& p, const Integers& q) {
      return has_edge_in_shadow_plane(apex, p, q, b);
    });
  });
}

bool has_shadow_vertex_on_edge(const SceneView& view) {
  return view.any_apex_and_pair([](const Apex& apex, const Face& a, const Face& b) {
    return any_corner(a, [&](const Integers& c) {
      return any_edge(
          b, [&](const Integers& p, const Integers& q) { return on_shadow_edge(apex, p, q, c); });
    });
  });
}

bool has_shadow_vertices(const SceneView& view) {
  return view.any_apex_and_pair([](const Apex& apex, const Face& a, const Face& b) {
    return any_corner(a, [&](const Integers& p) {
      return any_corner(b, [&](const Integers& q) { return on_shadow_vertex(apex, p, q); });
    });
  });
}

/// before[i * n + k]: is face i nearer to the apex than face k somewhere?
std::vector<bool> nearer_relation(const Apex& apex, const std::vector<Face>& faces) {
  const std::size_t n = faces.size();
  std::vector<bool> before(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const int order = nearer(apex, faces[i], faces[k]);
      before[i * n + k] = order > 0;
      before[k * n + i] = order < 0;
    }
  }
  return before;
}

/// By the transitive closure of the relation (Warshall).
bool has_cycle(std::vector<bool> before, std::size_t n) {
  for (std::size_t by = 0; by < n; ++by) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) {
        if (before[i * n + by] && before[by * n + k]) before[i * n + k] = true;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (before[i * n + i]) return true;
  }
  return false;
}

bool has_cyclic_overlap(const SceneView& view) {
  return std::ranges::any_of(view.apexes, [&](const Apex& apex) {
    return has_cycle(nearer_relation(apex, view.faces), view.faces.size());
  });
}

}  // namespace

std::span<const KindPredicate> light_predicates() {
  static constexpr KindPredicate kPredicates[] = {
      {Kind::kLightInPlane, has_light_in_plane},
      {Kind::kLightOnFace, has_light_on_face},
      {Kind::kLightOnEdge, has_light_on_edge},
      {Kind::kLightOnEdgeLine, has_light_on_edge_line},
      {Kind::kLightAtVertex, has_light_at_vertex},
      {Kind::kLightFar, has_light_far},
      {Kind::kLightNear, has_light_near},
      {Kind::kGrazingLight, has_grazing_light},
      {Kind::kSunInPlane, has_sun_in_plane},
      {Kind::kSunAlongEdge, has_sun_along_edge},
      {Kind::kGrazingSun, has_grazing_sun},
      {Kind::kShadowEdges, has_shadow_edges},
      {Kind::kShadowVertexOnEdge, has_shadow_vertex_on_edge},
      {Kind::kShadowVertices, has_shadow_vertices},
      {Kind::kCyclicOverlap, has_cyclic_overlap},
  };
  return kPredicates;
}

}  // namespace gnomon::fuzz
