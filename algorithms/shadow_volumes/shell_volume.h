// SPDX-License-Identifier: LGPL-3.0-or-later
// The penumbra of a convex shell under an area light, as one convex volume in place of one for each
// of its faces.
//
// Let S be the solid that the shell bounds, with its missing faces, and let the light A be outside
// of S, behind all missing faces. A segment from a point a of A through the interior of S enters it
// through a face that a is in front of, and so through one that is there and casts. Hence the
// points (1 + t) s - t a, with s in S, a in A and t >= 0, are those that faces of S hide some of A
// from: the union of their penumbras, but for points that only edges hide something from, and these
// are on the border. They are a convex set, as those of a polygon are (shadow_volume.h). Its
// half-spaces hold S and have A on their other side: the backs of those faces that all of A is in
// front of, and each plane that touches S and A and lies between them, through an edge of the one
// and a vertex of the other. Around an edge of S planes turn, outside of S, from the plane of one
// of its faces to that of the other. If A is in front of exactly one of the two, one plane touches
// A; if of both, or behind one and not in front of the other, none does.
//
// The umbra of a shell is the union of its faces' umbras, and is not convex; what several faces
// hide together is none (docs/illumination.md, "Deep umbra").
//
// Exactness: that of the space's decisions, as in shadow_volume.h.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHELL_VOLUME_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHELL_VOLUME_H

#include <algorithm>
#include <cstdint>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/shadow_volumes/shadow_volume.h"
#include "algorithms/shadow_volumes/touching_planes.h"
#include "gnomon/algorithms/components.h"
#include "gnomon/kernel/orientation.h"
#include "gnomon/scene/prepare.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

template <VolumeSpaceModel Space>
class ShellBuilder {
 public:
  using Vertex = typename Space::Vertex;
  using Light = LightShape<Vertex>;

  explicit ShellBuilder(Space& space) : space_(&space) {}

  /// Whether the penumbra of a shell is one volume under an area light, and under each part of it.
  bool casts_as_one(const PreparedScene& scene, const ConvexShell& shell, const Light& light) {
    find_sides(scene, shell, light);
    const auto is_in_light_plane = [&](std::uint32_t part) {
      return scene.parts[part].plane == light.plane.index();
    };
    return std::ranges::any_of(faces_,
                               [](const Face& face) { return face.light == Where::kFront; }) &&
           std::ranges::none_of(shell.parts, is_in_light_plane) &&
           std::ranges::all_of(shell.missing,
                               [&](const SupportTriple& face) { return is_behind(light, face); });
  }

  /// Adds the penumbra of a shell that casts as one. `caster`: as ShadowVolume has it.
  void add(const PreparedScene& scene, const ConvexShell& shell, std::uint32_t caster,
           const Light& light, VolumeStore& store) {
    find_sides(scene, shell, light);
    corners_.vertices.clear();
    for (const VertexId vertex : shell.vertices) {
      corners_.vertices.push_back(space_->input_vertex(vertex));
    }
    bool all_in_front = true, any_in_front = false;
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      const bool in_front = space_->side_of_plane(light.plane, corners_.corner(i)) == Side::kFront;
      all_in_front = all_in_front && in_front;
      any_in_front = any_in_front || in_front;
    }
    planes_.clear();
    add_faces();
    if (!any_in_front || planes_.empty()) return;
    for (const ShellEdge& edge : shell.edges) add_edge(edge, light.loop);
    add_light_edges(*space_, corners_, light.loop, all_in_front, planes_);
    store.add(caster, {}, planes_, {});
  }

 private:
  using CornerOf = Corner<Vertex>;
  /// Where the light is, of the plane of a face: nothing of it behind, nothing in front.
  enum class Where : std::uint8_t { kFront, kBack, kBoth };
  struct Face {
    PlaneRef side;
    Where light = Where::kBoth;
    std::uint32_t first = 0;  // into sides_, of the light's corners
  };
  struct Corners {
    std::vector<Vertex> vertices;
    std::uint32_t size() const { return static_cast<std::uint32_t>(vertices.size()); }
    CornerOf corner(std::uint32_t i) const { return lone_corner(vertices[i]); }
  };
  void find_sides(const PreparedScene& scene, const ConvexShell& shell, const Light& light) {
    faces_.clear();
    sides_.clear();
    for (const std::uint32_t index : shell.parts) {
      const Part& part = scene.parts[index];
      Face face{PlaneRef(part.plane, part.flipped), Where::kBoth,
                static_cast<std::uint32_t>(sides_.size())};
      bool front = false, back = false;
      for (std::uint32_t i = 0; i < light.loop.size(); ++i) {
        const Side side = space_->side_of_plane(face.side, light.loop.corner(i));
        front = front || side == Side::kFront;
        back = back || side == Side::kBack;
        sides_.push_back(side);
      }
      if (!front || !back) face.light = front ? Where::kFront : Where::kBack;
      faces_.push_back(face);
    }
  }

  bool is_behind(const Light& light, const SupportTriple& face) {
    const std::uint32_t mark = space_->plane_mark();
    const Vertex a = space_->input_vertex(face.a), b = space_->input_vertex(face.b),
                 c = space_->input_vertex(face.c);
    const PlaneRef plane = space_->add_plane(lone_corner(a), lone_corner(b), lone_corner(c));
    bool result = plane.valid();
    for (std::uint32_t i = 0; i < light.loop.size() && result; ++i) {
      result = space_->side_of_plane(plane, light.loop.corner(i)) != Side::kFront;
    }
    space_->release_planes(mark);
    return result;
  }

  void add_faces() {
    for (const Face& face : faces_) {
      const auto is_there = [&](PlaneRef plane) { return plane.same_plane(face.side); };
      if (face.light == Where::kFront && std::ranges::none_of(planes_, is_there)) {
        planes_.push_back(-face.side);
      }
    }
  }

  void add_edge(const ShellEdge& edge, const LoopView<Vertex>& light) {
    const bool has_right = edge.right != ShellEdge::kMissing;
    const Where left = faces_[edge.left].light;
    const Where right = has_right ? faces_[edge.right].light : Where::kBack;
    const Vertex first = space_->input_vertex(edge.from), last = space_->input_vertex(edge.to);
    const CornerOf from = lone_corner(first), to = lone_corner(last);
    if (left == Where::kFront && right != Where::kFront) {
      add_around(to, from, faces_[edge.left], light);
    } else if (right == Where::kFront && left != Where::kFront) {
      add_around(from, to, faces_[edge.right], light);
    } else if (left == Where::kBoth && right == Where::kBoth) {
      // A light on both sides of both planes may be touched twice, or not at all.
      for (std::uint32_t i = 0; i < light.size(); ++i) {
        const std::uint32_t mark = space_->plane_mark();
        const PlaneRef plane = space_->add_plane(from, to, light.corner(i));
        const PlaneRef turned =
            plane.valid() ? separating(*space_, corners_, light, plane) : PlaneRef();
        if (turned.valid()) {
          planes_.push_back(turned);
        } else {
          space_->release_planes(mark);
        }
      }
    }
  }

  /// The plane through an edge of a face that the light is in front of, as a polygon's penumbra has
  /// it. None if a corner of the light is in the face's plane, over the face: then that plane
  /// touches the light already.
  void add_around(const CornerOf& a, const CornerOf& b, const Face& face,
                  const LoopView<Vertex>& light) {
    own_sides_.assign(sides_.begin() + face.first, sides_.begin() + face.first + light.size());
    const std::uint32_t mark = space_->plane_mark();
    const PlaneRef plane = extreme_plane(*space_, a, b, light, Side::kFront, [&](std::uint32_t k) {
      return own_sides_[k] == Side::kFront;
    });
    if (plane.valid() && !any_on_plane(*space_, light, own_sides_, plane, Side::kFront)) {
      planes_.push_back(plane);
    } else {
      space_->release_planes(mark);
    }
  }

  Space* space_;
  std::vector<Face> faces_;
  std::vector<Side> sides_, own_sides_;
  Corners corners_;
  std::vector<PlaneRef> planes_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHELL_VOLUME_H
