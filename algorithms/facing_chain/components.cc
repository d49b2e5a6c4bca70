// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/components.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "algorithms/facing_chain/joined_parts.h"

namespace gnomon {

namespace {

using joined_parts::ConvexityTest;
using joined_parts::EdgeUsers;
using joined_parts::Partition;

/// The first edge of the component along which its parts do not run equally often each way, and
/// there the first part that runs the way of most.
void find_unpaired(const PreparedScene& scene, const EdgeUsers& users,
                   const std::vector<std::uint32_t>& component_of, Component& component) {
  component.is_closed = true;
  for (const std::uint32_t index : component.parts) {
    for (const PlaneRef edge : scene.edges(scene.parts[index])) {
      int sum = 0;
      for (const EdgePart& user : users.of(edge.index())) {
        if (component_of[user.part] != component_of[index]) continue;
        sum += user.flipped == edge.flipped() ? 1 : -1;
      }
      if (sum <= 0) continue;
      component.is_closed = false;
      component.unpaired = {edge.index(), index};
      return;
    }
  }
}

std::string position_text(const Geometry& geometry, VertexId vertex) {
  std::string text;
  for (const double coordinate : geometry.positions[vertex]) {
    char digits[32];
    text += text.empty() ? '(' : ',';
    text.append(digits, std::to_chars(digits, digits + sizeof digits, coordinate).ptr);
  }
  return text + ')';
}

}  // namespace

std::vector<Component> find_components(const PreparedScene& scene) {
  const EdgeUsers users(scene);
  const Partition partition = joined_parts::partition_of(scene, users);
  const ConvexityTest test(scene, users, partition.component_of);
  std::vector<Component> components(partition.size());
  for (std::size_t i = 0; i < components.size(); ++i) {
    Component& component = components[i];
    const auto parts = partition.parts(i);
    component.parts.assign(parts.begin(), parts.end());
    find_unpaired(scene, users, partition.component_of, component);
    component.is_convex =
        component.is_closed && test.is_convex(component.parts, test.vertices_of(component.parts));
  }
  return components;
}

std::string unpaired_edge_text(const Scene& scene, const PreparedScene& prepared,
                               const UnpairedEdge& unpaired) {
  const EdgeEnds ends = prepared.geometry.edges[unpaired.edge];
  return "edge " + position_text(prepared.geometry, ends.a) + "-" +
         position_text(prepared.geometry, ends.b) + " of polygon " +
         scene.polygons[prepared.parts[unpaired.part].polygon].id + " has no partner";
}

}  // namespace gnomon
