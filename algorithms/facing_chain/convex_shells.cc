// SPDX-License-Identifier: LGPL-3.0-or-later
// Components that are the surface of a convex solid, but perhaps for some of its faces.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "algorithms/facing_chain/joined_parts.h"
#include "algorithms/partition/in_parallel.h"
#include "gnomon/algorithms/components.h"

namespace gnomon {
namespace {

using joined_parts::ConvexityTest;
using joined_parts::EdgeUsers;
using joined_parts::OrientedPlane;
using joined_parts::Partition;

/// The edges of a shell. False if at one of them parts are not as a shell has them.
bool find_edges(const PreparedScene& scene, const EdgeUsers& users,
                const std::vector<std::uint32_t>& component_of, ConvexShell& shell) {
  const auto place_of = [&](std::uint32_t part) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(shell.parts, part) -
                                      shell.parts.begin());
  };
  shell.edges.reserve(2 * shell.parts.size() + 4);  // of a box all that there are
  for (std::uint32_t i = 0; i < shell.parts.size(); ++i) {
    const std::uint32_t own = shell.parts[i];
    for (const PlaneRef edge : scene.edges(scene.parts[own])) {
      std::uint32_t right = ShellEdge::kMissing;
      for (const EdgePart& user : users.of(edge.index())) {
        if (user.part == own || component_of[user.part] != component_of[own]) continue;
        if (right != ShellEdge::kMissing || user.flipped == edge.flipped()) return false;
        right = place_of(user.part);
      }
      if (right < i) continue;  // it has been found
      const EdgeEnds ends = scene.geometry.edges[edge.index()];
      shell.edges.push_back(
          {edge.flipped() ? ends.b : ends.a, edge.flipped() ? ends.a : ends.b, i, right});
    }
  }
  return true;
}

/// The missing faces of a shell: what closes its borders. An edge of a border is on the plane of a
/// part and on the border's, both of which have all vertices behind them or on them: it is an edge
/// of the solid, and the border is that of one of its faces. False if no plane holds a border with
/// the shell behind it. Requires: edges and vertices are there, and all of these are behind the
/// planes of parts.
bool find_missing(const PreparedScene& scene, ConvexShell& shell) {
  // A border edge begins where the edge of the missing face ends.
  std::vector<std::pair<VertexId, VertexId>> borders;  // of missing faces, from, to
  for (const ShellEdge& edge : shell.edges) {
    if (edge.right == ShellEdge::kMissing) borders.emplace_back(edge.to, edge.from);
  }
  std::ranges::sort(borders);
  const auto starts_at = [&](VertexId vertex) {
    return std::ranges::lower_bound(borders, std::pair<VertexId, VertexId>(vertex, 0));
  };
  for (std::size_t i = 1; i < borders.size(); ++i) {
    if (borders[i - 1].first == borders[i].first) return false;
  }
  const GridPositions& grid = scene.geometry.grid;
  std::vector<bool> seen(borders.size(), false);
  for (std::size_t first = 0; first < borders.size(); ++first) {
    if (seen[first]) continue;
    std::vector<VertexId> loop;
    for (std::size_t at = first; !seen[at];) {
      seen[at] = true;
      loop.push_back(borders[at].first);
      const auto next = starts_at(borders[at].second);
      if (next == borders.end() || next->first != borders[at].second) return false;
      at = static_cast<std::size_t>(next - borders.begin());
    }
    std::size_t third = 2;
    const auto is_line = [&] {
      return OrientedPlane(grid, {loop[0], loop[1], loop[third]}, false).is_line();
    };
    while (third < loop.size() && is_line()) ++third;
    if (third >= loop.size()) return false;
    const SupportTriple triple{loop[0], loop[1], loop[third]};
    const OrientedPlane plane(grid, triple, false);
    if (std::ranges::any_of(loop, [&](VertexId v) { return plane.side(v) != 0; }) ||
        std::ranges::any_of(shell.vertices, [&](VertexId v) { return plane.side(v) > 0; })) {
      return false;
    }
    shell.missing.push_back(triple);
  }
  return true;
}

}  // namespace

std::vector<ConvexShell> find_convex_shells(const PreparedScene& scene, std::uint32_t most_parts,
                                            unsigned jobs) {
  constexpr std::uint32_t kGrain = 256;
  const EdgeUsers users(scene);
  const Partition partition = joined_parts::partition_of(scene, users);
  const ConvexityTest test(scene, users, partition.component_of);
  std::vector<std::uint32_t> asked;  // components
  for (std::uint32_t i = 0; i < partition.size(); ++i) {
    const std::size_t parts = partition.parts(i).size();
    if (parts >= 2 && parts <= most_parts) asked.push_back(i);
  }
  // Of those asked; without parts where there is none.
  std::vector<ConvexShell> found(asked.size());
  const auto look_at = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const auto parts = partition.parts(asked[i]);
      ConvexShell shell;
      shell.parts.assign(parts.begin(), parts.end());
      if (!find_edges(scene, users, partition.component_of, shell)) continue;
      shell.vertices = test.vertices_of(shell.parts);
      if (test.is_convex(shell.parts, shell.vertices) && find_missing(scene, shell)) {
        found[i] = std::move(shell);
      }
    }
  };
  in_parallel(jobs, static_cast<std::uint32_t>(found.size()), kGrain, look_at);
  std::erase_if(found, [](const ConvexShell& shell) { return shell.parts.empty(); });
  return found;
}

}  // namespace gnomon
