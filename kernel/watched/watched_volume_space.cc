// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/watched/watched_volume_space.h"

#include <algorithm>
#include <bit>

namespace gnomon {

using Kind = PlaneName::Kind;

WatchedVolumeSpace::WatchedVolumeSpace(const SceneSpace& scene, const KernelOptions& options)
    : scene_(&scene),
      watch_(&scene.watch()),
      first_own_(scene.edges().planes + static_cast<std::uint32_t>(scene.geometry().edges.size())),
      exact_(scene.exact(), options),
      rounded_(scene.rounded() != nullptr ? scene.rounded()->volume() : nullptr) {}

WatchedVolumeSpace::Vertex WatchedVolumeSpace::input_vertex(VertexId v) const {
  Vertex vertex;
  vertex.exact = exact_.input_vertex(v);
  if (rounded_) vertex.tested = scene_->rounded()->input_vertex(v);
  vertex.source = v;
  vertex.hash = hash_of_input(v);
  return vertex;
}

// --- Planes. ---

WatchedVolumeSpace::Plane WatchedVolumeSpace::at(PlaneRef ref) const {
  Plane plane;
  if (!ref.valid()) return plane;
  if (ref.index() < first_own_) {
    plane.exact = plane.tested = ref;
    plane.name = scene_->name_of(ref);
    plane.hash = hash_of(plane.name);
    return plane;
  }
  plane = own_[ref.index() - first_own_];
  if (ref.flipped()) {
    plane.exact = -plane.exact;
    plane.tested = -plane.tested;
  }
  return plane;
}

PlaneId WatchedVolumeSpace::support_at(PlaneId support, bool tested) const {
  // A vertex that is asked about apart from any loop has none.
  if (support < first_own_ || support - first_own_ >= own_.size()) return support;
  const Plane& plane = own_[support - first_own_];
  return (tested ? plane.tested : plane.exact).index();
}

WatchedVolumeSpace::Plane WatchedVolumeSpace::new_plane() const {
  Plane plane;
  plane.exact_mark = exact_.plane_mark();
  if (rounded_) plane.tested_mark = rounded_->plane_mark();
  return plane;
}

PlaneRef WatchedVolumeSpace::add(Plane plane) {
  own_.push_back(plane);
  return PlaneRef(first_own_ + static_cast<std::uint32_t>(own_.size() - 1));
}

void WatchedVolumeSpace::release_planes(std::uint32_t mark) {
  if (mark >= own_.size()) return;
  const Plane& first = own_[mark];
  exact_.release_planes(first.exact_mark);
  if (rounded_) rounded_->release_planes(first.tested_mark);
  own_.resize(mark);
}

// A plane that only the rounded kernel finds is no plane of the exact run, and that it finds none
// cannot be flipped into one.
bool WatchedVolumeSpace::makes_plane(const Plane& plane) {
  const Side exact = plane.exact.valid() ? Side::kFront : Side::kOn;
  std::optional<Side> tested;
  if (rounded_) tested = plane.tested.valid() ? Side::kFront : Side::kOn;
  const Side made = watch_->settle(
      Predicate::kThreePoints, watch_->question(Predicate::kThreePoints, plane.hash, 0), false,
      exact, tested, [&](DifferingDecision& decision) { decision.plane = plane.name; });
  return made != Side::kOn && plane.exact.valid();
}

PlaneRef WatchedVolumeSpace::add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b,
                                       const Corner<Vertex>& c) {
  Plane plane = new_plane();
  plane.exact = exact_.add_plane(exact_corner(a), exact_corner(b), exact_corner(c));
  if (rounded_) {
    plane.tested = rounded_->add_plane(tested_corner(a), tested_corner(b), tested_corner(c));
  }
  plane.name = {Kind::kThrough, {a.vertex.source, b.vertex.source, c.vertex.source}};
  for (const Corner<Vertex>* corner : {&a, &b, &c}) {
    if (corner->vertex.source != kMadeVertex) continue;
    plane.name.rest = mixed(plane.name.rest, corner->vertex.hash);
  }
  plane.hash = hash_of(plane.name);
  return makes_plane(plane) ? add(plane) : PlaneRef();
}

PlaneRef WatchedVolumeSpace::add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b,
                                       const LightPoint& direction) {
  Plane plane = new_plane();
  plane.exact = exact_.add_plane(exact_corner(a), exact_corner(b), direction);
  if (rounded_) plane.tested = rounded_->add_plane(tested_corner(a), tested_corner(b), direction);
  plane.name = {Kind::kThrough, {a.vertex.source, b.vertex.source, kMadeVertex}};
  plane.hash = hash_of(plane.name);
  return makes_plane(plane) ? add(plane) : PlaneRef();
}

PlaneRef WatchedVolumeSpace::add_axis_plane(int axis, double value) {
  Plane plane = new_plane();
  plane.exact = exact_.add_axis_plane(axis, value);
  if (rounded_) plane.tested = rounded_->add_axis_plane(axis, value);
  plane.name = {
      Kind::kBorder, {static_cast<std::uint32_t>(axis)}, std::bit_cast<std::uint64_t>(value)};
  plane.hash = hash_of(plane.name);
  return add(plane);
}

WatchedVolumeSpace::Vertex WatchedVolumeSpace::axis_point(
    const std::array<double, 3>& fractions) const {
  Vertex vertex;
  vertex.exact = exact_.axis_point(fractions);
  if (rounded_) vertex.tested = rounded_->axis_point(fractions);
  for (const double fraction : fractions) {
    vertex.hash = mixed(vertex.hash, std::bit_cast<std::uint64_t>(fraction));
  }
  return vertex;
}

// --- Questions. ---

Predicate WatchedVolumeSpace::predicate_of(const PlaneName& name) {
  switch (name.kind) {
    case Kind::kSupport:
      return Predicate::kSupport;
    case Kind::kBorder:
      return Predicate::kBorder;
    default:
      return Predicate::kVolume;
  }
}

// The three planes that meet in a made vertex, in any order.
std::uint64_t WatchedVolumeSpace::hash_of_meeting(PlaneRef before, PlaneRef after,
                                                  PlaneId support) const {
  std::array<std::uint64_t, 3> planes{at(before).hash, at(after).hash, at(PlaneRef(support)).hash};
  std::ranges::sort(planes);
  return mixed(mixed(planes[0], planes[1]), planes[2]);
}

void WatchedVolumeSpace::describe(DifferingDecision& decision, const Plane& plane,
                                  const Corner<Vertex>& corner) const {
  decision.plane = plane.name;
  decision.corner = {corner.vertex.source, at(corner.before).name, at(corner.after).name,
                     corner.support < edges().planes ? corner.support : CornerName::kNoSupport};
  const std::array<mpq_class, 3> point = exact_.exact_position(exact_corner(corner));
  tell_positions(decision, geometry(), corner.vertex, point);
  if (decision.exact == Side::kOn) return;
  decision.ulps =
      size_in_ulps(geometry(), exact_.in_scene(plane.exact), point, scene_->rounded()->digits());
}

// A vertex that was made in a flipped decision is said to be on the planes that its corner names,
// wherever it is.
Side WatchedVolumeSpace::side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) {
  if (watch_->flips() && (ref.same_plane(corner.before) || ref.same_plane(corner.after) ||
                          ref.index() == corner.support)) {
    return Side::kOn;
  }
  const Plane plane = at(ref);
  const Side exact = exact_.side_of_plane(plane.exact, exact_corner(corner));
  std::optional<Side> tested;
  if (rounded_ && plane.tested.valid()) {
    tested = rounded_->side_of_plane(plane.tested, tested_corner(corner));
  }
  return watch_->settle(predicate_of(plane.name), question(plane, corner), plane.exact.flipped(),
                        exact, tested,
                        [&](DifferingDecision& decision) { describe(decision, plane, corner); });
}

WatchedVolumeSpace::Vertex WatchedVolumeSpace::crossing(PlaneRef ref, PlaneRef edge, bool leaving,
                                                        const Corner<Vertex>& from,
                                                        const Corner<Vertex>& to) const {
  const Plane plane = at(ref), along = at(edge);
  if (watch_->flips()) {
    for (const Corner<Vertex>* end : {&from, &to}) {
      if (watch_->is_flipped(question(plane, *end))) return end->vertex;
    }
  }
  // The new vertex is in the loop's plane, whatever planes made the ends.
  const PlaneId support = support_at(from.support, false);
  const auto end_of = [&](const Corner<Vertex>& corner) -> Corner<Exact::Vertex> {
    const Corner<Exact::Vertex> own = exact_corner(corner);
    return {own.before, own.vertex, own.after, support};
  };
  Vertex vertex;
  vertex.exact = exact_.crossing(plane.exact, along.exact, leaving, end_of(from), end_of(to));
  name_making(vertex, ref, edge, leaving, from.support);
  vertex.hash = hash_of_meeting(ref, edge, from.support);
  if (!rounded_ || !plane.tested.valid()) return vertex;
  vertex.tested = rounded_crossing(
      *rounded_, plane.tested, along.tested, leaving, tested_corner(from), tested_corner(to), [&] {
        return exact_position({vertex.before, vertex, vertex.after, from.support});
      });
  return vertex;
}

}  // namespace gnomon
