// SPDX-License-Identifier: LGPL-3.0-or-later
// The vertices of a shading mesh as its faces see them, and their illumination, each computed once.
//
// Illumination depends on a vertex and an oriented plane, whichever part of that plane it belongs
// to, since coplanar polygons do not shadow each other. Where a caster touches the plane, each face
// behind the caster has the vertex for itself.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_NODES_H
#define GNOMON_ALGORITHMS_SHADING_MESH_NODES_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "algorithms/shading_mesh/contacts.h"
#include "algorithms/shading_mesh/edges.h"
#include "algorithms/shading_mesh/points.h"
#include "gnomon/algorithms/shading_mesh.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

struct MeshNode {
  static constexpr std::uint32_t kShared = 0xffffffffu;
  std::uint32_t vertex = 0;
  std::uint32_t inside = kShared;  // of a node that one face has for itself: a point inside of it
  std::uint32_t part = 0;
  Side side = Side::kFront;
  std::uint64_t lit_by = 0, penumbra_of = 0;        // classes of faces that meet in it
  std::uint64_t known_lit = 0, known_penumbra = 0;  // what its values were computed as
};

class NodeTable {
 public:
  /// Keeps references. `points` gets points inside of faces.
  NodeTable(const PreparedScene& scene, std::size_t lights, PointTable& points)
      : scene_(scene), lights_(lights), points_(points), contacts_(scene) {}

  /// Finds where casters touch the penumbra faces, at their corners and at other points. Call it
  /// whenever there are new faces, before their nodes are asked for.
  void find_contacts(const FaceLoops& loops, std::vector<std::uint32_t> others);

  /// The node of a point of face number `f`, which from now on belongs to the face's classes too.
  /// Lit faces need no node of their own: they are lit whatever touches them.
  std::uint32_t node(std::uint32_t vertex, const FaceLoops& loops, std::uint32_t f);

  std::size_t size() const { return nodes_.size(); }
  const MeshNode& operator[](std::uint32_t node) const { return nodes_[node]; }
  double value(std::uint32_t node, std::size_t light) const {
    return values_[node * lights_ + light];
  }
  /// What a face of these classes has at this node.
  double shade(std::uint32_t node, const MeshFace& face) const;

  /// Computes by one light what is not known yet; `go_on(fraction)` returns false to stop. Values
  /// do not depend on each other, nor on the order in which they are computed.
  void illuminate(std::size_t light, const ShadeFunction& shade,
                  const std::function<bool(double)>& go_on);

  /// Of all lights together.
  double largest_shade() const;
  double largest_error(std::size_t light) const;

 private:
  struct Key {
    std::uint32_t vertex = 0;
    std::uint32_t plane = 0;  // 2 plane, + 1 for its back
    std::uint32_t inside = MeshNode::kShared;
    friend bool operator==(Key, Key) = default;
  };
  struct Hash {
    std::size_t operator()(Key key) const {
      std::uint64_t hash = (std::uint64_t{key.vertex} << 32 | key.plane) * 0x9e3779b97f4a7c15u;
      hash = (hash ^ key.inside) * 0x9e3779b97f4a7c15u;
      return static_cast<std::size_t>(hash ^ hash >> 29);
    }
  };

  std::uint32_t add(std::uint32_t vertex, const MeshFace& face, std::uint32_t inside);
  void illuminate_node(std::uint32_t node, std::size_t light, const ShadeFunction& shade);

  const PreparedScene& scene_;
  std::size_t lights_;
  PointTable& points_;
  Contacts contacts_;
  std::vector<std::uint32_t> insides_;  // of faces; kShared: not asked for yet
  std::vector<MeshNode> nodes_;
  std::vector<double> values_, errors_;  // of node n by light i: [n * lights_ + i]
  std::unordered_map<Key, std::uint32_t, Hash> numbers_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_NODES_H
