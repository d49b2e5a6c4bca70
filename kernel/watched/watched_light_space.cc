// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/watched/watched_light_space.h"

#include <string>

namespace gnomon {

using Kind = PlaneName::Kind;

// --- Planes. ---

WatchedLightSpace::Plane WatchedLightSpace::at(PlaneRef ref) const {
  Plane plane;
  if (!ref.valid()) return plane;
  if (ref.index() < edge_count_) {
    plane.exact = ref;
    if (knows_identity()) plane.tested = ref;
    plane.name = {Kind::kEdge, {ref.index()}};
    plane.hash = hash_of(plane.name);
    return plane;
  }
  plane = own_[ref.index() - edge_count_];
  if (ref.flipped()) {
    plane.exact = -plane.exact;
    plane.tested = -plane.tested;
  }
  return plane;
}

WatchedLightSpace::Plane WatchedLightSpace::new_plane() const {
  Plane plane;
  plane.exact_mark = exact_.plane_mark();
  if (rounded_) plane.tested_mark = rounded_->plane_mark();
  return plane;
}

PlaneRef WatchedLightSpace::add(Plane plane, const PlaneName& name) {
  plane.name = name;
  plane.hash = hash_of(name);
  own_.push_back(plane);
  return PlaneRef(edge_count_ + static_cast<std::uint32_t>(own_.size() - 1));
}

void WatchedLightSpace::release_planes(std::uint32_t mark) {
  if (mark >= own_.size()) return;
  const Plane& first = own_[mark];
  exact_.release_planes(first.exact_mark);
  if (rounded_) rounded_->release_planes(first.tested_mark);
  own_.resize(mark);
}

PlaneRef WatchedLightSpace::import_edge(PlaneRef edge, PlaneId support, bool reversed,
                                        const Vertex& from, const Vertex& to) {
  Plane plane = new_plane();
  plane.exact = exact_.import_edge(edge, support, reversed, from.exact, to.exact);
  if (rounded_) {
    plane.tested = rounded_->import_edge(edge, support, reversed, from.tested, to.tested);
  }
  if (scene_->edges().is_input_edge(edge)) return plane.exact;
  return add(plane, {Kind::kCut, {support, edge.index()}});
}

// As a rounded kernel has it: without identity every edge has a plane of its own, with it only
// those that were cut along a support plane.
PlaneRef WatchedLightSpace::shadow_plane(PlaneRef edge, const Vertex& from, const Vertex& to) {
  const Plane cut = at(edge);
  if (knows_identity() && !cut.is_support_cut) return edge;
  Plane plane = new_plane();
  plane.exact = exact_.shadow_plane(cut.exact, from.exact, to.exact);
  if (rounded_) plane.tested = rounded_->shadow_plane(cut.tested, from.tested, to.tested);
  return add(plane, cut.name);
}

PlaneRef WatchedLightSpace::add_prefix_plane(const PrefixPlane& prefix) {
  Plane plane = new_plane();
  plane.exact = exact_.add_prefix_plane(prefix);
  if (rounded_) plane.tested = rounded_->add_prefix_plane(prefix);
  PlaneName name{Kind::kBorder, {}};
  for (const mpz_class& n : prefix.n) {
    for (const char digit : n.get_str(62)) {
      name.rest = mixed(name.rest, static_cast<unsigned char>(digit));
    }
    name.rest = mixed(name.rest, 0);
  }
  return add(plane, name);
}

PlaneRef WatchedLightSpace::import_cut(const WatchedLightSpace& other, PlaneRef cut,
                                       PlaneId support) {
  const Plane source = other.at(cut);
  Plane plane = new_plane();
  plane.exact = exact_.import_cut(other.exact_, source.exact, support);
  return add(plane, source.name);
}

PlaneRef WatchedLightSpace::cut_of_supports(PlaneId first, PlaneId second) {
  Plane plane = new_plane();
  plane.is_support_cut = true;
  plane.exact = exact_.cut_of_supports(first, second);
  if (rounded_) plane.tested = rounded_->cut_of_supports(first, second);
  return add(plane, {Kind::kCut, {first, second}});
}

void WatchedLightSpace::finish_vertex(Vertex& vertex, PlaneRef before, PlaneRef after) const {
  const Plane first = at(before), second = at(after);
  exact_.finish_vertex(vertex.exact, first.exact, second.exact);
  vertex.before = before;
  vertex.after = after;
  vertex.hash = hash_of_meeting(first, second);
}

std::uint64_t WatchedLightSpace::hash_of_meeting(const Plane& before, const Plane& after) {
  return hash_of_made(before.hash, after.hash, before.exact.flipped() != after.exact.flipped(), 0);
}

// --- Questions. ---

Predicate WatchedLightSpace::predicate_of(const PlaneName& name) {
  switch (name.kind) {
    case Kind::kEdge:
      return Predicate::kShadowPlane;
    case Kind::kBorder:
      return Predicate::kBorder;
    default:
      return Predicate::kCut;
  }
}

Sign WatchedLightSpace::light_side(PlaneId plane) const {
  const Side exact = side_of(exact_.light_side(plane));
  std::optional<Side> tested;
  if (rounded_) tested = side_of(rounded_->light_side(plane));
  const PlaneName name{Kind::kSupport, {plane}};
  const Side side = watch_->settle(
      Predicate::kFacing, watch_->question(Predicate::kFacing, hash_of(name), 0), false, exact,
      tested, [&](DifferingDecision& decision) {
        decision.plane = name;
        decision.corner.support = plane;
        if (exact == Side::kOn) return;
        const Geometry& geometry = scene_->geometry();
        ExactPlane<mpz_class> support = ExactGeometry<mpz_class>(geometry).plane(plane);
        const LightPoint& light = exact_.light();
        std::array<mpq_class, 3> point;
        for (std::size_t k = 0; k < 3; ++k) {
          point[k] = light.directional
                         ? mpq_class(light.grid[k])
                         : mpq_class(geometry.origin[k] + geometry.step * light.grid[k]);
        }
        decision.ulps = light.directional
                            ? size_in_ulps({}, {support.n, 0}, point, scene_->rounded()->digits())
                            : size_in_ulps(geometry, support, point, scene_->rounded()->digits());
      });
  return static_cast<Sign>(side);
}

void WatchedLightSpace::describe(DifferingDecision& decision, const PlaneName& name,
                                 const ExactPlane<mpz_class>& plane,
                                 const Corner<Vertex>& corner) const {
  decision.plane = name;
  decision.corner = {corner.vertex.source, at(corner.before).name, at(corner.after).name,
                     corner.support};
  const std::array<mpq_class, 3> point = exact_.exact_position(exact_corner(corner));
  tell_positions(decision, scene_->geometry(), corner.vertex, point);
  if (decision.exact == Side::kOn) return;
  decision.ulps = size_in_ulps(scene_->geometry(), plane, point, scene_->rounded()->digits());
}

// A vertex that was made in a flipped decision is said to be on the planes of its edges, wherever
// it is.
Side WatchedLightSpace::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) {
  if (watch_->flips() && (ref.same_plane(corner.before) || ref.same_plane(corner.after))) {
    return Side::kOn;
  }
  const Plane plane = at(ref);
  const Side exact = exact_.side_of_plane(plane.exact, exact_corner(corner));
  std::optional<Side> tested;
  if (rounded_ && plane.tested.valid()) {
    tested = rounded_->side_of_plane(plane.tested, tested_corner(corner));
  }
  return watch_->settle(predicate_of(plane.name), question(plane, corner), plane.exact.flipped(),
                        exact, tested, [&](DifferingDecision& decision) {
                          describe(decision, plane.name, exact_.in_scene(plane.exact), corner);
                        });
}

Side WatchedLightSpace::side_of_support(PlaneId plane, const Corner<Vertex>& corner) {
  const Side exact = exact_.side_of_support(plane, exact_corner(corner));
  std::optional<Side> tested;
  if (rounded_) tested = rounded_->side_of_support(plane, tested_corner(corner));
  const PlaneName name{Kind::kSupport, {plane}};
  const std::uint64_t asked = watch_->question(Predicate::kDepth, hash_of(name),
                                               mixed(hash_of_corner(corner), corner.support));
  return watch_->settle(
      Predicate::kDepth, asked, false, exact, tested, [&](DifferingDecision& decision) {
        describe(decision, name, ExactGeometry<mpz_class>(scene_->geometry()).plane(plane), corner);
      });
}

WatchedLightSpace::Vertex WatchedLightSpace::crossing(PlaneRef ref, PlaneRef edge, bool leaving,
                                                      const Corner<Vertex>& from,
                                                      const Corner<Vertex>& to) const {
  const Plane plane = at(ref), along = at(edge);
  if (watch_->flips()) {
    for (const Corner<Vertex>* end : {&from, &to}) {
      if (watch_->is_flipped(question(plane, *end))) return end->vertex;
    }
  }
  Vertex vertex;
  vertex.exact =
      exact_.crossing(plane.exact, along.exact, leaving, exact_corner(from), exact_corner(to));
  name_making(vertex, ref, edge, leaving, from.support);
  vertex.hash = leaving ? hash_of_meeting(along, plane) : hash_of_meeting(plane, along);
  if (!rounded_ || !plane.tested.valid()) return vertex;
  vertex.tested = rounded_crossing(
      *rounded_, plane.tested, along.tested, leaving, tested_corner(from), tested_corner(to), [&] {
        return exact_position({vertex.before, vertex, vertex.after, from.support});
      });
  return vertex;
}

}  // namespace gnomon
