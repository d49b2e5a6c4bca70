// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/prepared_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

namespace {

class PreparedChecker {
 public:
  PreparedChecker(const Scene& scene, const PreparedScene& prepared, std::size_t most)
      : scene_(scene), prepared_(prepared), most_(most) {}

  std::vector<PreparedFinding> run() {
    check_positions();
    if (prepared_.first_part.size() != scene_.polygons.size() + 1 ||
        prepared_.first_part.back() != prepared_.parts.size()) {
      report({}, "the list of parts does not fit the list of polygons");
      return std::move(findings_);
    }
    for (std::uint32_t part = 0; part < prepared_.parts.size(); ++part) check_part(part);
    check_planes();
    if (findings_.empty()) {
      for (std::uint32_t p = 0; p < scene_.polygons.size(); ++p) check_tiling(p);
    }
    return std::move(findings_);
  }

 private:
  void report(const std::string& polygon, std::string text) {
    if (findings_.size() < most_) findings_.push_back({polygon, std::move(text)});
  }
  Integers3 grid(VertexId vertex) const {
    return {prepared_.geometry.grid.at(vertex, 0), prepared_.geometry.grid.at(vertex, 1),
            prepared_.geometry.grid.at(vertex, 2)};
  }
  void check_positions();
  void check_part(std::uint32_t part);
  void check_planes();
  void check_tiling(std::uint32_t polygon);
  bool is_its_own_part(const Polygon& polygon, std::uint32_t part) const;

  const Scene& scene_;
  const PreparedScene& prepared_;
  std::size_t most_;
  std::vector<PreparedFinding> findings_;
};

void PreparedChecker::check_positions() {
  const Geometry& geometry = prepared_.geometry;
  for (std::size_t i = 0; i < scene_.vertices.size(); ++i) {
    const std::uint32_t vertex = prepared_.vertex_of_input[i];
    if (vertex == PreparedScene::kUnused) continue;
    for (int k = 0; k < 3; ++k) {
      const mpq_class exact = scene_.vertices[i][k].exact();
      if (geometry.origin[k] + geometry.step * geometry.grid.at(vertex, k) != exact) {
        report({}, fmt::format("vertex {} is not where the scene says", i));
      }
      if (geometry.positions[vertex][k] != scene_.vertices[i][k].nearest()) {
        report({}, fmt::format("vertex {} has a double that is not the nearest", i));
      }
    }
  }
}

void PreparedChecker::check_part(std::uint32_t index) {
  const Part& part = prepared_.parts[index];
  const std::string& id = scene_.polygons[part.polygon].id;
  if (part.count < 3) return report(id, "a part has fewer than three vertices");
  const std::vector<Integers3> loop = grid_loop(prepared_, index);
  const ExactPlane plane = plane_of(loop);
  if (plane.normal[0] == 0 && plane.normal[1] == 0 && plane.normal[2] == 0) {
    return report(id, "a part has no area");
  }
  for (const Integers3& vertex : loop) {
    if (value_at(plane, vertex) != 0) return report(id, "a part is not planar");
  }
  // Strictly convex and once around: every corner turns left seen from the front, and the direction
  // in the chart goes from rising to falling once.
  const Chart chart(plane);
  int flips = 0, turn = 0;
  const std::size_t size = loop.size();
  for (std::size_t i = 0; i < size; ++i) {
    const ChartPoint a = chart.at(loop[i]), b = chart.at(loop[(i + 1) % size]),
                     c = chart.at(loop[(i + 2) % size]);
    const int own = orientation(a, b, c);
    if (own == 0 || (turn != 0 && own != turn)) return report(id, "a part is not strictly convex");
    turn = own;
    if (compare(a, b) != compare(b, c)) ++flips;
  }
  if (flips != 2) report(id, "a part winds around more than once");
  const SupportTriple triple = prepared_.geometry.planes[part.plane];
  const std::vector<Integers3> corners{grid(triple.a), grid(triple.b), grid(triple.c)};
  ExactPlane family = plane_of(corners);
  if (part.flipped) family = opposite(family);
  if (family.normal != plane.normal || family.offset != plane.offset) {
    report(id, "a part does not lie in its family's plane, or is turned the wrong way");
  }
  const std::span<const PlaneRef> edges = prepared_.edges(part);
  const std::span<const VertexId> vertices = prepared_.loop(part);
  for (std::size_t i = 0; i < size; ++i) {
    const EdgeEnds ends = prepared_.geometry.edges[edges[i].index()];
    const VertexId from = edges[i].flipped() ? ends.b : ends.a;
    const VertexId to = edges[i].flipped() ? ends.a : ends.b;
    if (from != vertices[i] || to != vertices[(i + 1) % size]) {
      report(id, "an edge of a part does not join its vertices");
    }
  }
  const Polygon& polygon = scene_.polygons[part.polygon];
  if (part.casts != polygon.casts || part.two_sided != scene_.is_two_sided(polygon)) {
    report(id, "a part does not cast or receive as its polygon does");
  }
}

void PreparedChecker::check_planes() {
  const auto before = [](const ExactPlane& a, const ExactPlane& b) {
    for (int k = 0; k < 3; ++k) {
      const int order = cmp(a.normal[k], b.normal[k]);
      if (order != 0) return order < 0;
    }
    return cmp(a.offset, b.offset) < 0;
  };
  std::set<ExactPlane, decltype(before)> seen(before);
  for (const SupportTriple& triple : prepared_.geometry.planes) {
    ExactPlane plane =
        plane_of(std::vector<Integers3>{grid(triple.a), grid(triple.b), grid(triple.c)});
    for (const mpz_class& component : plane.normal) {
      if (component == 0) continue;
      if (component < 0) plane = opposite(plane);
      break;
    }
    if (!seen.insert(std::move(plane)).second) report({}, "one plane has two families");
  }
}

bool PreparedChecker::is_its_own_part(const Polygon& polygon, std::uint32_t part) const {
  const std::span<const VertexId> vertices = prepared_.loop(prepared_.parts[part]);
  if (!polygon.holes.empty() || polygon.loop.size() != vertices.size()) return false;
  std::vector<VertexId> loop;
  for (VertexId vertex : polygon.loop) loop.push_back(prepared_.vertex_of_input[vertex]);
  const auto start = std::find(loop.begin(), loop.end(), vertices[0]);
  std::rotate(loop.begin(), start, loop.end());
  return std::equal(loop.begin(), loop.end(), vertices.begin());
}

void PreparedChecker::check_tiling(std::uint32_t index) {
  const Polygon& polygon = scene_.polygons[index];
  const std::uint32_t begin = prepared_.first_part[index], end = prepared_.first_part[index + 1];
  if (end == begin + 1 && is_its_own_part(polygon, begin)) return;
  const auto in_grid = [&](const std::vector<VertexId>& loop) {
    std::vector<Integers3> points;
    for (VertexId vertex : loop) points.push_back(grid(prepared_.vertex_of_input[vertex]));
    return points;
  };
  for (VertexId vertex : polygon.loop) {
    if (prepared_.vertex_of_input[vertex] == PreparedScene::kUnused) {
      if (begin != end) report(polygon.id, "a vertex of the loop is on no grid");
      return;  // dropped as a whole
    }
  }
  const std::vector<Integers3> outline = in_grid(polygon.loop);
  ExactPlane along;
  along.normal = area_vector(outline);
  if (along.normal[0] == 0 && along.normal[1] == 0 && along.normal[2] == 0) {
    if (begin != end) report(polygon.id, "a loop without area has parts");
    return;
  }
  // Holes may fill a polygon; the overlay below shows whether they do.
  if (begin == end && polygon.holes.empty()) {
    return report(polygon.id, "a polygon with an area has no parts");
  }
  // A loop that is not planar is cut in its projection along its area vector's largest component:
  // the chart of any plane with this normal.
  const Chart chart(along);
  Overlay overlay;
  const auto add = [&](const std::vector<Integers3>& points, Layer layer, int weight) {
    std::vector<ChartPoint> loop;
    for (const Integers3& point : points) loop.push_back(chart.at(point));
    const NormalisedLoop normal = normalise(std::move(loop));
    overlay.add_loop(normal.loop, layer, weight);
    for (const auto& [a, b] : normal.edges) overlay.add_edge(a, b, layer, weight);
  };
  add(outline, kReceiver, 1);
  for (const std::vector<VertexId>& hole : polygon.holes) {
    bool known = true;
    for (VertexId vertex : hole) {
      known = known && prepared_.vertex_of_input[vertex] != PreparedScene::kUnused;
    }
    if (known) add(in_grid(hole), kReceiver, -1);
  }
  for (std::uint32_t part = begin; part < end; ++part) add(grid_loop(prepared_, part), kTruth, 1);
  overlay.build();
  bool tiles = overlay.consistent();
  for (const Overlay::Face& face : overlay.faces()) {
    tiles = tiles && face.winding[kReceiver] == face.winding[kTruth];
  }
  if (!tiles) report(polygon.id, "the parts do not tile the polygon");
}

}  // namespace

std::vector<PreparedFinding> check_prepared(const Scene& scene, const PreparedScene& prepared,
                                            std::size_t most) {
  return PreparedChecker(scene, prepared, most).run();
}

}  // namespace gnomon::oracle
