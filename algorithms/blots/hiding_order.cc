// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/blots/hiding_order.h"

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/strong_components.hpp>
#include <utility>

namespace gnomon {

HidingOrder hiding_order(std::uint32_t count, std::span<const HidingPair> pairs) {
  HidingOrder order;
  if (count == 0) {
    order.start.assign(1, 0);
    return order;
  }
  using Graph =
      boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                         boost::no_property, std::uint32_t, std::uint32_t>;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(pairs.size());
  for (const HidingPair& pair : pairs) edges.emplace_back(pair.nearer, pair.farther);
  const Graph graph(boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(), count);
  std::vector<std::uint32_t> component(count);
  const auto components = static_cast<std::uint32_t>(boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(),
                                               boost::get(boost::vertex_index, graph))));
  // A component gets its number when all that can be reached from it have theirs: what hides
  // others has a larger number than they. Counting sort.
  const auto place = [&](std::uint32_t thing) { return components - 1 - component[thing]; };
  order.start.assign(components + 1, 0);
  for (std::uint32_t i = 0; i < count; ++i) ++order.start[place(i) + 1];
  for (std::uint32_t i = 1; i <= components; ++i) order.start[i] += order.start[i - 1];
  std::vector<std::uint32_t> next(order.start.begin(), order.start.end() - 1);
  order.members.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) order.members[next[place(i)]++] = i;
  return order;
}

}  // namespace gnomon
