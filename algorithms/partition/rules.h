// SPDX-License-Identifier: LGPL-3.0-or-later
// The choices of the definition (docs/semantics.md), each named by what is right. The defaults are
// the definition, and every public function runs with them. Algorithms ask a rule wherever they
// make its choice: its name finds all such places, and a test can turn one rule around and see who
// notices (docs/bug-zoo.md).
#ifndef GNOMON_ALGORITHMS_PARTITION_RULES_H
#define GNOMON_ALGORITHMS_PARTITION_RULES_H

#include <array>
#include <span>

namespace gnomon {

/// A loop as one that only looks at its shape sees it.
struct LoopShape {
  std::span<const std::array<double, 3>> corners;  // rounded, in scene units
  bool is_input = true;                            // no corner was made by a split
};

struct Rules {
  /// All polygons of a plane are classified before any of them casts: coplanar polygons do not
  /// shadow each other (semantics, "Lit and in shadow").
  bool coplanar_classified_first = true;
  /// What lies in a plane goes to the side that the definition names: a coplanar polygon is not
  /// behind, penumbra volumes are open and umbra volumes closed ("Lit and in shadow", "Lit,
  /// penumbra and umbra").
  bool on_goes_to_its_own_side = true;
  /// A light in the plane of a polygon reaches neither of its sides ("Lights").
  bool light_in_plane_does_not_reach = true;
  /// Of an area light on both sides of a polygon's plane only the part in front of it counts
  /// ("Lit, penumbra and umbra": A_R and A_O).
  bool straddling_light_is_cut = true;
  /// A shadow volume goes on behind the volumes in its way, as far as its caster hides the light
  /// ("Lit, penumbra and umbra": a penumbra volume depends on its caster alone).
  bool volumes_continue_behind_others = true;
  /// When a later volume holds one that closed a tile, it takes its place there: the shadow in the
  /// tile is still theirs (Slater 1992, sec. 5, does not say so).
  bool closed_tiles_pass_to_the_killer = true;
  /// A volume dies, and a tile closes, only when all polygons of the new one's plane have received
  /// the old one's shadow ("Lit and in shadow": coplanar polygons).
  bool volumes_die_after_their_plane_received = true, tiles_close_after_their_plane_received = true;
  /// A blot is absorbed by a later outline only when no polygon that lies in a plane of that
  /// outline's object has still to receive the old one's shadow ("Lit and in shadow": coplanar
  /// polygons).
  bool blots_absorbed_after_their_planes_received = true;
  /// The edges of a complete shadow volume stand above its support plane in the tree: what is in
  /// front of the plane then has no volume that goes on behind it ("Lit and in shadow").
  bool edges_above_supports = true;
  /// A polygon's volume has a plane for every edge of its pieces, also for those that the scene BSP
  /// made: what is beside a piece is beside its volume (1989, sec. 6, says that they need not
  /// count).
  bool edges_of_splits_bound_volumes = true;
  /// A polygon classified by a finished shadow volume tree sees what was there when its turn came:
  /// volumes made with it, or after it, are behind it or beside it.
  bool later_volumes_do_not_count = true;
  /// An edge on the line of another one has that polygon on one side only (docs/contour.md).
  bool edges_on_a_line_count = true;
  /// What hides an edge and what lies behind it are found among the same casters.
  bool casters_are_the_same_in_each_step = true;
  /// Of a polygon whose plane holds an edge, the two planes tell which is nearer beside the edge.
  bool equal_depth_by_its_planes = true;
  /// One-sided polygons are seen from their front alone, as they receive and cast with it alone
  /// ("Scene"); an eye sees through their backs.
  bool backs_are_transparent = true;
  /// A sample in a plane is moved a little along the picture's frame, and the plane that it lies on
  /// keeps its side of the ray (docs/image-space.md, "Ties").
  bool planes_stay_at_ties = true;
  /// Shadow volumes that hold the eye are counted, all of them; where the eye is on a plane of one,
  /// each sample decides by where its ray begins (docs/shadow-polygons.md, "The eye").
  bool eye_may_be_in_shadow = true, eye_in_several_volumes_counts_all = true,
       eye_on_planes_counts_by_sample = true;
  /// Walls of shadow volumes meet: which is nearer is asked again wherever it matters.
  bool order_of_walls_is_verified = true;
  /// A light has no field of view: what is beside and behind it is shadowed as what is before it.
  bool light_looks_all_around = true;
  /// A vertex on the edge of a neighbouring face is a vertex of that face, too: its illumination
  /// is the same from both sides (shading_mesh.h, "no T-vertices").
  bool neighbour_vertices_are_in_the_face = true;
  /// Fragments of several lights together become one only if the same lights reach them ("A
  /// result": a fragment has one class under each light).
  bool merged_fragments_agree_on_every_light = true;
  /// The crossings of a ridge loop with a row are paired by the arcs of the loop above it, not by
  /// their order along it (docs/ridge-edges.md, "Pairs").
  bool crossings_pair_by_arcs = true;
  /// A pair runs from where one comes onto the facing side to where one leaves it; the other way
  /// round it is a hole (docs/ridge-edges.md, "Pairs").
  bool holes_have_a_direction = true;
  /// What lies on a face that the light does not see is behind the solid ("Lit and in shadow": a
  /// floor under a box).
  bool on_a_hidden_face_is_behind_it = true;
  /// Which fragments stay: null for all of them, however thin they are, since fragments tile their
  /// polygon ("A result").
  bool (*fragment_stays)(const LoopShape&) = nullptr;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_RULES_H
