// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/solid_checks.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "algorithms/angular_table/polygon_contact.h"
#include "scene/geometry/box_tree.h"

namespace gnomon {

namespace {

using scene_detail::Box;
using scene_detail::BoxTree;

constexpr const char* kInstead = "solids that do not; or depth=facing, which takes any polygons";

Box box_of(const PreparedScene& scene, const Part& part) {
  Box box = Box::empty();
  for (const VertexId v : scene.loop(part)) {
    for (int k = 0; k < 3; ++k) {
      const double x = scene.geometry.positions[v][static_cast<std::size_t>(k)];
      box.add(k, x, x);
    }
  }
  return box;
}

DirectionVector thrice(const PreparedScene& scene, VertexId a, VertexId b, VertexId c) {
  const GridPositions& grid = scene.geometry.grid;
  DirectionVector sum;
  for (int k = 0; k < 3; ++k) {
    sum[static_cast<std::size_t>(k)] = grid.at(a, k) + grid.at(b, k) + grid.at(c, k);
  }
  return sum;
}

class SolidChecks {
 public:
  SolidChecks(const PreparedScene& scene, const Scene* names,
              const std::vector<TableObject>& objects)
      : scene_(scene), names_(names), objects_(objects), object_of_(scene.parts.size()) {
    for (std::uint32_t o = 0; o < objects.size(); ++o) {
      for (const std::uint32_t p : objects[o].component.parts) object_of_[p] = o;
    }
  }

  Expected<void> check_closed() const {
    for (const TableObject& object : objects_) {
      if (!is_solid(object)) continue;
      const Component& component = object.component;
      if (!component.is_closed) {
        return fail(ErrorCode::kGeometry,
                    names_ != nullptr
                        ? unpaired_edge_text(*names_, scene_, component.unpaired)
                        : "an edge of polygon " + name(component.unpaired.part) + " has no partner",
                    "closed solids; or depth=facing, which takes any polygons");
      }
      for (const std::uint32_t p : component.parts) {
        const Part& part = scene_.parts[p];
        if (part.casts && !part.two_sided) continue;
        return fail(ErrorCode::kGeometry,
                    "polygon " + name(p) + (part.casts ? " has two sides" : " casts no shadow"),
                    "solids of one-sided polygons that cast; or depth=facing, which takes any");
      }
    }
    return {};
  }

  /// Of each pair of parts that may touch.
  Expected<void> check_contacts() const {
    std::vector<Box> boxes;
    for (const Part& part : scene_.parts) boxes.push_back(box_of(scene_, part));
    const BoxTree tree(boxes);
    std::vector<std::uint32_t> near;
    for (std::uint32_t face = 0; face < scene_.parts.size(); ++face) {
      const std::uint32_t own = object_of_[face];
      if (!is_solid(objects_[own])) continue;
      // Of a convex solid all is behind or on each of its planes, and meets them at its edges.
      const bool is_convex = objects_[own].component.is_convex;
      near.clear();
      tree.for_each_that_meets(boxes[face], [&](std::uint32_t p) {
        if (p != face && !(is_convex && object_of_[p] == own)) near.push_back(p);
      });
      std::ranges::sort(near);  // so that the first error does not depend on the tree
      for (const std::uint32_t p : near) {
        if (const auto checked = check_contact(p, face); !checked) return checked;
      }
    }
    return {};
  }

  /// Surfaces that do not go through each other are inside or outside of each other as a whole.
  Expected<void> check_insides() const {
    std::vector<Box> boxes;
    for (const TableObject& object : objects_) {
      Box box = Box::empty();
      for (const std::uint32_t p : object.component.parts) box.add(box_of(scene_, scene_.parts[p]));
      boxes.push_back(box);
    }
    const BoxTree tree(boxes);
    std::vector<std::uint32_t> near;
    for (std::uint32_t o = 0; o < objects_.size(); ++o) {
      if (!is_solid(objects_[o])) continue;
      const bool is_room = sign_of_volume(scene_, objects_[o].component.parts) < 0;
      near.clear();
      if (is_room) {  // all that is outside of it is inside of its walls
        for (std::uint32_t other = 0; other < objects_.size(); ++other) near.push_back(other);
      } else {
        tree.for_each_that_meets(boxes[o], [&](std::uint32_t other) { near.push_back(other); });
      }
      std::ranges::sort(near);
      for (const std::uint32_t other : near) {
        if (other == o) continue;
        const auto inside = part_inside(o, other, is_room);
        if (!inside) continue;
        return fail(ErrorCode::kGeometry,
                    "polygon " + name(*inside) + " is inside of the solid of polygon " +
                        name(objects_[o].component.parts.front()),
                    kInstead);
      }
    }
    return {};
  }

  /// Behind every polygon of a solid is solid, and before it is none. Along edges of two polygons
  /// the one has what the other has, so that one of each such patch is asked.
  Expected<void> check_sides() const {
    for (const TableObject& object : objects_) {
      if (!is_solid(object)) continue;
      const auto& parts = object.component.parts;
      const int room = sign_of_volume(scene_, parts) < 0 ? 1 : 0;
      for (const std::uint32_t p : first_of_patches(parts)) {
        const WindingBeside beside = winding_beside(scene_, parts, scene_.parts[p]);
        if (beside.winding + room == (beside.in_front ? 0 : 1)) continue;
        return fail(ErrorCode::kGeometry,
                    "polygon " + name(p) + " is turned inside out, or inside of its own solid",
                    kInstead);
      }
    }
    return {};
  }

  Expected<void> check_light(const LightPoint& light) const {
    DirectionVector point;
    for (std::size_t k = 0; k < 3; ++k) point[k] = 3 * light.grid[k];
    for (const TableObject& object : objects_) {
      if (!is_solid(object)) continue;
      const auto& parts = object.component.parts;
      const bool is_room = sign_of_volume(scene_, parts) < 0;
      // A sun is outside of every solid, which for a room is inside of its walls.
      const bool is_on = !light.directional && lies_on(object, point);
      const int winding = light.directional || is_on ? 0 : winding_number(scene_, parts, point);
      if (!is_on && winding + (is_room ? 1 : 0) <= 0) continue;
      return fail(ErrorCode::kGeometry,
                  std::string("the light is ") + (is_on ? "on" : "inside of") +
                      " the solid of polygon " + name(parts.front()),
                  "a light outside of solids; or depth=facing, which takes any polygons");
    }
    return {};
  }

 private:
  bool is_solid(const TableObject& object) const { return !object.vertices.empty(); }
  std::string name(std::uint32_t part) const { return polygon_name(names_, scene_, part); }

  Expected<void> check_contact(std::uint32_t p, std::uint32_t face) const {
    const Part &part = scene_.parts[p], &own = scene_.parts[face];
    if (part.plane == own.plane) {
      const bool is_back_to_back = object_of_[p] == object_of_[face] && part.flipped != own.flipped;
      if (!is_back_to_back || !overlap_in_plane(scene_, part, own)) return {};
      return fail(ErrorCode::kGeometry,
                  "polygons " + name(std::min(p, face)) + " and " + name(std::max(p, face)) +
                      " of one solid lie back to back",
                  kInstead);
    }
    if (!comes_behind(scene_, part, own)) return {};
    return fail(ErrorCode::kGeometry,
                "polygon " + name(p) + " goes through polygon " + name(face) + " of a solid",
                kInstead);
  }

  /// The first part of each set of parts that hang together along edges that two of them have.
  std::vector<std::uint32_t> first_of_patches(const std::vector<std::uint32_t>& parts) const {
    std::map<EdgeId, std::vector<std::uint32_t>> along;  // places in `parts`
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
      for (const PlaneRef edge : scene_.edges(scene_.parts[parts[i]])) {
        along[edge.index()].push_back(i);
      }
    }
    std::vector<std::uint32_t> firsts, waiting;
    std::vector<bool> seen(parts.size(), false);
    for (std::uint32_t first = 0; first < parts.size(); ++first) {
      if (seen[first]) continue;
      firsts.push_back(parts[first]);
      seen[first] = true;
      waiting.push_back(first);
      while (!waiting.empty()) {
        const std::uint32_t i = waiting.back();
        waiting.pop_back();
        for (const PlaneRef edge : scene_.edges(scene_.parts[parts[i]])) {
          const std::vector<std::uint32_t>& both = along[edge.index()];
          for (const std::uint32_t j : both) {
            if (both.size() != 2 || seen[j]) continue;
            seen[j] = true;
            waiting.push_back(j);
          }
        }
      }
    }
    return firsts;
  }

  /// A part of the other object that is inside of this one's solid.
  std::optional<std::uint32_t> part_inside(std::uint32_t solid, std::uint32_t other,
                                           bool is_room) const {
    for (const std::uint32_t p : objects_[other].component.parts) {
      const auto loop = scene_.loop(scene_.parts[p]);
      const DirectionVector point = thrice(scene_, loop[0], loop[1], loop[2]);
      // One that touches the solid there tells nothing; the next may.
      if (lies_on(objects_[solid], point)) continue;
      const int winding = winding_number(scene_, objects_[solid].component.parts, point);
      return winding + (is_room ? 1 : 0) > 0 ? std::optional(p) : std::nullopt;
    }
    return std::nullopt;
  }
  /// `point`: three times a position.
  bool lies_on(const TableObject& object, const DirectionVector& point) const {
    return std::ranges::any_of(object.component.parts, [&](std::uint32_t face) {
      return is_on_part(scene_, scene_.parts[face], point);
    });
  }

  const PreparedScene& scene_;
  const Scene* names_;
  const std::vector<TableObject>& objects_;
  std::vector<std::uint32_t> object_of_;  // by parts
};

}  // namespace

Expected<void> check_solids(const PreparedScene& scene, const Scene* names,
                            const std::vector<TableObject>& objects) {
  const SolidChecks checks(scene, names, objects);
  if (auto closed = checks.check_closed(); !closed) return closed;
  if (auto apart = checks.check_contacts(); !apart) return apart;
  if (auto sides = checks.check_sides(); !sides) return sides;
  return checks.check_insides();
}

Expected<void> check_light(const PreparedScene& scene, const Scene* names,
                           const std::vector<TableObject>& objects, const LightPoint& light) {
  return SolidChecks(scene, names, objects).check_light(light);
}

}  // namespace gnomon
