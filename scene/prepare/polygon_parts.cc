// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/prepare/polygon_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <unordered_map>

#include "scene/base/large_pages.h"
#include "scene/base/parallel.h"
#include "scene/base/prefetch.h"
#include "scene/geometry/loop_geometry.h"
#include "scene/geometry/numbering.h"
#include "scene/geometry/plane_key.h"
#include "scene/prepare/polygon_cut.h"
#include "scene/prepare/support_triple.h"

namespace gnomon::scene_detail {
namespace {

/// What became of a run of polygons: loops and parts as in PreparedScene, but counted from the
/// run's first, without planes and edges.
template <class Int>
struct Run {
  std::vector<VertexId> loop_vertices;
  std::vector<Part> parts;
  std::vector<PlaneKey<Int>> keys;  // of parts
  std::vector<PreparationNote> notes;
  std::vector<PolygonProblem> problems;  // in order
};

/// Makes the parts of polygons first .. last - 1.
template <class Int>
class RunMaker {
 public:
  RunMaker(const Scene& scene, SceneWatch& watch, const PreparedScene& prepared)
      : scene_(scene), watch_(watch), prepared_(prepared), grid_(prepared.geometry.grid) {}

  /// Stops at the first polygon that has an error unless all errors are wanted.
  Run<Int> make(std::size_t first, std::size_t last, bool all_errors) {
    run_.parts.reserve(last - first);
    run_.keys.reserve(last - first);
    run_.loop_vertices.reserve(4 * (last - first));
    std::uint64_t corners = 0;
    for (std::size_t p = first; p < last && (all_errors || run_.problems.empty()); ++p) {
      if (watch_.stopped()) break;
      look_ahead(p, last);
      const auto polygon = static_cast<std::uint32_t>(p);
      told_ = 0;
      if (auto error = add_polygon(polygon)) run_.problems.push_back({polygon, *std::move(error)});
      corners += corners_of(scene_.polygons[p]) - told_;
    }
    if (!watch_.stopped()) watch_.add(corners);
    return std::move(run_);
  }

 private:
  using Point = Vec3<Int>;

  /// Polygons may name vertices in random order: asks for those of the next ones early.
  void look_ahead(std::size_t p, std::size_t last) const {
    constexpr std::size_t kAhead = 4;
    if (p + 4 * kAhead < last) prefetch(scene_.polygons[p + 4 * kAhead].loop.data());
    if (p + 2 * kAhead < last) {
      for (const VertexId v : scene_.polygons[p + 2 * kAhead].loop) {
        prefetch(&prepared_.vertex_of_input[v]);
      }
    }
    if (p + kAhead < last && grid_.is_narrow()) {
      for (const VertexId v : scene_.polygons[p + kAhead].loop) {
        prefetch(grid_.narrow_point(prepared_.vertex_of_input[v]));
      }
    }
  }

  Error error_at(std::uint32_t polygon, std::size_t ring, const std::string& what,
                 std::string expected) const {
    const std::string where = ring == 0 ? fmt::format("/polygons/{}/loop", polygon)
                                        : fmt::format("/polygons/{}/holes/{}", polygon, ring - 1);
    const std::string name = ring == 0 ? "the loop" : fmt::format("hole {}", ring - 1);
    Error error;
    error.code = ErrorCode::kGeometry;
    error.where.file = scene_.file;
    error.where.pointer = where;
    error.what = fmt::format("polygon '{}': {} {}", scene_.polygons[polygon].id, name, what);
    error.expected = std::move(expected);
    return error;
  }

  void note(std::uint32_t polygon, Repair repair, std::string detail) {
    run_.notes.push_back({polygon, repair, std::move(detail)});
  }

  void load(const std::vector<VertexId>& input, std::vector<Corner>& corners) const {
    corners.clear();
    for (const VertexId v : input) corners.push_back({prepared_.vertex_of_input[v], v});
  }

  void load_vertices_and_points(const std::vector<VertexId>& input) {
    workspace_.resize(input.size());
    points_.resize(input.size());
    for (std::size_t i = 0; i < input.size(); ++i) {
      workspace_[i] = prepared_.vertex_of_input[input[i]];
      points_[i] = point<Int>(grid_, workspace_[i]);
    }
  }

  void load_points(const std::vector<Corner>& corners, std::vector<Point>& points) const {
    points.clear();
    for (const Corner& corner : corners) points.push_back(point<Int>(grid_, corner.vertex));
  }

  /// Neither repeated nor collinear vertices.
  static bool is_clean(const std::vector<Point>& loop) {
    const std::size_t n = loop.size();
    Point last = loop[0] - loop[n - 1];
    for (std::size_t i = 0; i < n; ++i) {
      const Point next = loop[i + 1 == n ? 0 : i + 1] - loop[i];
      if (cross(last, next).is_zero()) return false;
      last = next;
    }
    return true;
  }

  std::optional<Error> add_polygon(std::uint32_t p) {
    const Polygon& polygon = scene_.polygons[p];
    // The usual case first: a strictly convex loop has neither repeated nor collinear vertices.
    load_vertices_and_points(polygon.loop);
    if (points_.size() >= 3 && polygon.holes.empty() && add_if_convex(p)) return std::nullopt;
    load(polygon.loop, loop_);
    if (points_.size() < 3 || !is_clean(points_)) {
      clean_and_note(p);
      if (loop_.size() < 3) return drop_without_area(p);
      load_points(loop_, points_);
      workspace_.clear();
      for (const Corner& corner : loop_) workspace_.push_back(corner.vertex);
      if (polygon.holes.empty() && add_if_convex(p)) return std::nullopt;
    }
    const Point area = area_vector(points_);
    if (area.is_zero()) return crosses_itself(p);
    return cut(p, area, lies_in_plane(points_, points_[0], area));
  }

  /// A loop on one line is dropped, with holes that are on it as well.
  std::optional<Error> drop_without_area(std::uint32_t p) {
    const auto& holes = scene_.polygons[p].holes;
    for (std::size_t h = 0; h < holes.size(); ++h) {
      std::vector<Corner> hole;
      load(holes[h], hole);
      clean_loop<Int>(grid_, hole);
      if (hole.size() < 3) continue;
      return error_at(p, h + 1, "leaves the loop, which has no area",
                      "holes inside the loop that do not overlap");
    }
    note(p, Repair::kZeroArea, "all vertices on one line");
    return std::nullopt;
  }

  /// Of a loop that runs as much clockwise as counter-clockwise: where it crosses itself, seen
  /// along the normal of three of its vertices.
  Error crosses_itself(std::uint32_t p) const {
    Point normal{0, 0, 0};
    for (std::size_t i = 2; i < points_.size() && normal.is_zero(); ++i) {
      normal = cross(points_[i - 1] - points_[0], points_[i] - points_[0]);
    }
    const bool planar = lies_in_plane(points_, points_[0], normal);
    const Outline outline{{loop_}, {0}, 0, planar};
    const auto parts = cut_into_convex_parts(projected(outline, normal).input);
    if (!parts) return problem_of(p, outline, parts.error(), projection_axis(normal));
    return error_at(p, 0, "crosses itself: it runs as much clockwise as counter-clockwise",
                    "a simple closed curve");
  }

  /// Adds the loop at hand, its vertices in `workspace_`, as it is, if it is planar and strictly
  /// convex.
  bool add_if_convex(std::uint32_t p) {
    Point area = area_vector(points_);
    if (area.is_zero() || !lies_in_plane(points_, points_[0], area) || !is_convex(points_, area)) {
      return false;
    }
    add_part(p, workspace_, std::move(area));
    return true;
  }

  void clean_and_note(std::uint32_t p) {
    const Cleaning done = clean_loop<Int>(grid_, loop_);
    if (done.repeated > 0) {
      note(p, Repair::kRepeatedVertices, fmt::format("{} repeated dropped", done.repeated));
    }
    if (done.collinear > 0) {
      note(p, Repair::kCollinearVertices, fmt::format("{} collinear dropped", done.collinear));
    }
  }

  /// A loop and those of its holes that have an area.
  struct Outline {
    std::vector<std::vector<Corner>> rings;
    std::vector<std::size_t> names;  // 0 for the loop, h + 1 for hole h
    Int hole_area = 0;               // twice that of all holes, in the projection
    bool planar = true;              // all of it, exactly
  };

  Outline outline_with_holes(std::uint32_t p, const Point& area, bool planar) {
    Outline outline{{loop_}, {0}, 0, planar};
    std::vector<Corner> hole;
    std::vector<Point> points;
    const auto& holes = scene_.polygons[p].holes;
    for (std::size_t h = 0; h < holes.size(); ++h) {
      load(holes[h], hole);
      const Cleaning done = clean_loop<Int>(grid_, hole);
      if (hole.size() < 3) {
        note(p, Repair::kHoles, fmt::format("hole {} has no area and is dropped", h));
        continue;
      }
      if (done.repeated + done.collinear > 0) {
        note(p, done.collinear > 0 ? Repair::kCollinearVertices : Repair::kRepeatedVertices,
             fmt::format("hole {}: {} dropped", h, done.repeated + done.collinear));
      }
      load_points(hole, points);
      outline.planar = outline.planar && lies_in_plane(points, points_[0], area);
      outline.hole_area += magnitude_along(area_vector(points), projection_axis(area));
      outline.rings.push_back(hole);
      outline.names.push_back(h + 1);
    }
    return outline;
  }

  static Int magnitude_along(const Point& vector, int axis) {
    return vector[axis] < 0 ? Int(-vector[axis]) : vector[axis];
  }

  /// The outline in the projection in which its loop is counter-clockwise.
  struct Projected {
    CutInput<Int> input;
    std::vector<VertexId> vertices;  // by the indices of the input
  };

  Projected projected(const Outline& outline, const Point& area) const {
    Projected result;
    CutInput<Int>& input = result.input;
    input.planar = outline.planar;
    std::unordered_map<VertexId, std::uint32_t> local;
    const int axis = projection_axis(area);
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (area[axis] < 0) std::swap(u, v);
    for (const auto& ring : outline.rings) {
      input.rings.emplace_back();
      for (const Corner& corner : ring) {
        const auto [entry, is_new] =
            local.emplace(corner.vertex, static_cast<std::uint32_t>(result.vertices.size()));
        const std::uint32_t i = entry->second;
        if (is_new) {
          result.vertices.push_back(corner.vertex);
          input.x.push_back(coordinate<Int>(grid_, corner.vertex, u));
          input.y.push_back(coordinate<Int>(grid_, corner.vertex, v));
          input.key.push_back(corner.input);
        }
        input.key[i] = std::min(input.key[i], corner.input);
        input.rings.back().push_back(i);
      }
    }
    return result;
  }

  std::optional<Error> cut(std::uint32_t p, const Point& area, bool loop_is_planar) {
    const Outline outline = outline_with_holes(p, area, loop_is_planar);
    Projected flat = projected(outline, area);
    if (outline.rings.size() == 1 && outline.planar && is_convex(points_, area)) {
      add_part(p, flat.vertices, area);  // all holes were empty
      return std::nullopt;
    }
    CutWatch watch(watch_, corners_of(scene_.polygons[p]));
    flat.input.watch = &watch;
    const auto parts = cut_into_convex_parts(std::move(flat.input));
    told_ = watch.told();
    const int axis = projection_axis(area);
    if (!parts) return problem_of(p, outline, parts.error(), axis);
    if (parts->empty() && magnitude_along(area, axis) == outline.hole_area) {
      note(p, Repair::kZeroArea, "its holes fill it");
      return std::nullopt;
    }
    note_cut(p, outline, parts->size());
    for (const auto& part : *parts) {
      workspace_.clear();
      for (const std::uint32_t i : part) workspace_.push_back(flat.vertices[i]);
      const Point a = point<Int>(grid_, workspace_[0]);
      add_part(p, workspace_,
               cross(point<Int>(grid_, workspace_[1]) - a, point<Int>(grid_, workspace_[2]) - a));
    }
    return std::nullopt;
  }

  Error problem_of(std::uint32_t p, const Outline& outline, const CutProblem& problem,
                   int axis) const {
    if (problem.stopped) return {ErrorCode::kInterrupted, {}, "interrupted", {}};
    std::string what = problem.what;
    if (!outline.planar) {
      what += fmt::format(" (the polygon is not planar, so this is in its projection along {})",
                          "xyz"[axis]);
    }
    return error_at(
        p, outline.names[problem.ring], what,
        problem.ring == 0 ? "a simple closed curve" : "holes inside the loop that do not overlap");
  }

  void note_cut(std::uint32_t p, const Outline& outline, std::size_t parts) {
    const std::string count = fmt::format("{} part{}", parts, parts == 1 ? "" : "s");
    const std::size_t holes = outline.rings.size() - 1;
    if (!outline.planar) {
      note(p, Repair::kNotPlanar,
           fmt::format("{:.3g} scene units off its plane; {}", off_plane(outline.rings), count));
    } else if (holes > 0) {
      note(p, Repair::kHoles, fmt::format("{} hole{}; {}", holes, holes == 1 ? "" : "s", count));
    } else {
      note(p, Repair::kNotConvex, count);
    }
  }

  /// Greatest distance, in scene units, of a vertex from the plane of the first three vertices of
  /// the loop, counted from its smallest index; for the message only.
  double off_plane(const std::vector<std::vector<Corner>>& rings) const {
    const auto& loop = rings[0];
    const std::size_t n = loop.size();
    std::size_t first = 0;
    for (std::size_t i = 1; i < n; ++i) {
      if (loop[i].input < loop[first].input) first = i;
    }
    const Point origin = point<Int>(grid_, loop[first].vertex);
    const Point normal = cross(point<Int>(grid_, loop[(first + 1) % n].vertex) - origin,
                               point<Int>(grid_, loop[(first + 2) % n].vertex) - origin);
    Int worst = 0;
    for (const auto& ring : rings) {
      for (const Corner& corner : ring) {
        const Int value = dot(normal, point<Int>(grid_, corner.vertex) - origin);
        const Int size = value < 0 ? Int(-value) : value;
        if (size > worst) worst = size;
      }
    }
    const mpz_class x = to_mpz(normal.x), y = to_mpz(normal.y), z = to_mpz(normal.z);
    const mpz_class w = to_mpz(worst);
    mpq_class square(w * w, x * x + y * y + z * z);
    square.canonicalize();
    square *= prepared_.geometry.step * prepared_.geometry.step;
    return std::sqrt(square.get_d());
  }

  /// The normal is that of the loop's front, of any length.
  void add_part(std::uint32_t p, const std::vector<VertexId>& loop, Point normal) {
    Part part;
    part.polygon = p;
    part.first = static_cast<std::uint32_t>(run_.loop_vertices.size());
    part.count = static_cast<std::uint32_t>(loop.size());
    part.two_sided = scene_.is_two_sided(scene_.polygons[p]);
    part.casts = scene_.polygons[p].casts;
    run_.parts.push_back(part);
    run_.keys.emplace_back(std::move(normal), point<Int>(grid_, loop[0]));
    run_.loop_vertices.insert(run_.loop_vertices.end(), loop.begin(), loop.end());
  }

  const Scene& scene_;
  SceneWatch& watch_;
  const PreparedScene& prepared_;
  const GridPositions& grid_;
  Run<Int> run_;
  std::uint64_t told_ = 0;    // corners of the polygon at hand that the watch has been told of
  std::vector<Corner> loop_;  // of the polygon at hand
  std::vector<Point> points_;
  std::vector<VertexId> workspace_;
};

/// Strings the runs together; their keys stay where they are.
template <class Int>
void join(std::vector<Run<Int>>& runs, std::size_t polygons, PreparedScene& out) {
  std::size_t parts = 0, corners = 0;
  for (const Run<Int>& run : runs) {
    parts += run.parts.size();
    corners += run.loop_vertices.size();
  }
  reserve_in_large_pages(out.parts, parts);
  reserve_in_large_pages(out.loop_vertices, corners);
  out.first_part.reserve(polygons + 1);
  for (Run<Int>& run : runs) {
    const auto first_corner = static_cast<std::uint32_t>(out.loop_vertices.size());
    for (Part& part : run.parts) {
      part.first += first_corner;
      const auto next = static_cast<std::uint32_t>(out.parts.size());
      out.first_part.resize(std::size_t{part.polygon} + 1, next);
      out.parts.push_back(part);
    }
    out.loop_vertices.insert(out.loop_vertices.end(), run.loop_vertices.begin(),
                             run.loop_vertices.end());
    std::move(run.notes.begin(), run.notes.end(), std::back_inserter(out.notes));
    run.parts = {};
    run.loop_vertices = {};
  }
  out.first_part.resize(polygons + 1, static_cast<std::uint32_t>(parts));
}

/// The parts of each plane, in order: those of plane p are parts[first[p]] .. parts[first[p + 1] -
/// 1].
struct Families {
  std::vector<std::uint32_t> first, parts;
};

Families families_of(const Numbering& planes, std::size_t parts) {
  Families families;
  resize_in_large_pages(families.first, std::size_t{planes.count()} + 1);
  resize_in_large_pages(families.parts, parts);
  for (std::size_t i = 0; i < parts; ++i) ++families.first[planes[i] + 1];
  for (std::size_t p = 0; p < planes.count(); ++p) families.first[p + 1] += families.first[p];
  std::vector<std::uint32_t> next(families.first.begin(), families.first.end() - 1);
  for (std::size_t i = 0; i < parts; ++i) {
    families.parts[next[planes[i]]++] = static_cast<std::uint32_t>(i);
  }
  return families;
}

/// The loop comes before the other one, both read from their smallest vertex.
bool loop_is_before(std::span<const VertexId> loop, std::span<const VertexId> other) {
  const auto start = [](std::span<const VertexId> ring) {
    return static_cast<std::size_t>(std::min_element(ring.begin(), ring.end()) - ring.begin());
  };
  const std::size_t i = start(loop), j = start(other);
  for (std::size_t k = 0; k < std::min(loop.size(), other.size()); ++k) {
    const VertexId v = loop[(i + k) % loop.size()], w = other[(j + k) % other.size()];
    if (v != w) return v < w;
  }
  return loop.size() < other.size();
}

/// Numbers planes in the order of the parts that lie in them. A plane has the orientation of the
/// part whose loop comes first by its vertices, and not of the part that comes first.
template <class Int>
void number_planes(const std::vector<Run<Int>>& runs, PreparedScene& out) {
  const auto key = [&](std::size_t i) -> const PlaneKey<Int>& {
    const std::size_t run = out.parts[i].polygon / kPieceOfPolygons;
    return runs[run].keys[i - out.first_part[run * kPieceOfPolygons]];
  };
  const Numbering planes(
      out.parts.size(), [&](std::size_t i) { return key(i).hash(); },
      [&](std::size_t i, std::size_t j) { return key(i).same_plane(key(j)); });
  const Families families = families_of(planes, out.parts.size());
  resize_in_large_pages(out.geometry.planes, planes.count());
  for_each_piece(planes.count(), kPieceOfPolygons, [&](std::size_t begin, std::size_t end) {
    std::vector<VertexId> vertices;
    for (std::size_t plane = begin; plane < end; ++plane) {
      const auto parts =
          std::span(families.parts)
              .subspan(families.first[plane], families.first[plane + 1] - families.first[plane]);
      vertices.clear();
      std::uint32_t front = parts[0];
      for (const std::uint32_t part : parts) {
        const auto loop = out.loop(out.parts[part]);
        vertices.insert(vertices.end(), loop.begin(), loop.end());
        if (part != front && loop_is_before(loop, out.loop(out.parts[front]))) front = part;
      }
      const PlaneKey<Int>& name = key(front);
      out.geometry.planes[plane] =
          support_triple(out.geometry.grid, vertices, name.normal, name.flipped);
      for (const std::uint32_t part : parts) {
        out.parts[part].plane = static_cast<PlaneId>(plane);
        out.parts[part].flipped = key(part).flipped != name.flipped;
      }
    }
  });
}

/// Numbers edges in the order of the loops that run along them.
void number_edges(PreparedScene& out) {
  const std::size_t corners = out.loop_vertices.size();
  std::vector<EdgeEnds> ends;
  resize_in_large_pages(ends, corners);
  for_each_index(out.parts.size(), [&](std::size_t i) {
    const Part& part = out.parts[i];
    const auto loop = out.loop(part);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const VertexId from = loop[k], to = loop[k + 1 == loop.size() ? 0 : k + 1];
      ends[part.first + k] = {std::min(from, to), std::max(from, to)};
    }
  });
  const Numbering edges(
      corners, [&](std::size_t i) { return mix(mix(0, ends[i].a), ends[i].b); },
      [&](std::size_t i, std::size_t j) { return ends[i] == ends[j]; });
  resize_in_large_pages(out.geometry.edges, edges.count());
  edges.for_each_first(
      [&](std::size_t i, std::size_t edge) { out.geometry.edges[edge] = ends[i]; });
  resize_in_large_pages(out.loop_edges, corners);
  for_each_index(corners, [&](std::size_t i) {
    out.loop_edges[i] = PlaneRef(edges[i], out.loop_vertices[i] != ends[i].a);
  });
}

}  // namespace

template <class Int>
std::optional<Error> make_parts(const Scene& scene, SceneWatch& watch, PreparedScene& out) {
  const std::size_t polygons = scene.polygons.size();
  {
    std::vector<Run<Int>> runs =
        map_pieces(polygons, kPieceOfPolygons, [&](std::size_t first, std::size_t last) {
          return RunMaker<Int>(scene, watch, out).make(first, last, false);
        });
    if (watch.stopped()) return Error{ErrorCode::kInterrupted, {}, "interrupted", {}};
    for (Run<Int>& run : runs) {
      if (!run.problems.empty()) return std::move(run.problems.front().error);
    }
    join(runs, polygons, out);
    number_planes(runs, out);
  }
  number_edges(out);
  return std::nullopt;
}

template <class Int>
std::vector<PolygonProblem> find_problems(const Scene& scene, SceneWatch& watch,
                                          const PreparedScene& out) {
  std::vector<PolygonProblem> all;
  for (Run<Int>&run : map_pieces(scene.polygons.size(), kPieceOfPolygons,
                                 [&](std::size_t first, std::size_t last) {
                                   return RunMaker<Int>(scene, watch, out).make(first, last, true);
                                 })) {
    std::move(run.problems.begin(), run.problems.end(), std::back_inserter(all));
  }
  return all;
}

template std::optional<Error> make_parts<std::int64_t>(const Scene&, SceneWatch&, PreparedScene&);
template std::vector<PolygonProblem> find_problems<std::int64_t>(const Scene&, SceneWatch&,
                                                                 const PreparedScene&);
template std::optional<Error> make_parts<Int128>(const Scene&, SceneWatch&, PreparedScene&);
template std::vector<PolygonProblem> find_problems<Int128>(const Scene&, SceneWatch&,
                                                           const PreparedScene&);
template std::optional<Error> make_parts<Int256>(const Scene&, SceneWatch&, PreparedScene&);
template std::vector<PolygonProblem> find_problems<Int256>(const Scene&, SceneWatch&,
                                                           const PreparedScene&);
template std::optional<Error> make_parts<mpz_class>(const Scene&, SceneWatch&, PreparedScene&);
template std::vector<PolygonProblem> find_problems<mpz_class>(const Scene&, SceneWatch&,
                                                              const PreparedScene&);

}  // namespace gnomon::scene_detail
