// SPDX-License-Identifier: LGPL-3.0-or-later
#include "polygon_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

#include "index_table.h"
#include "loop_geometry.h"
#include "polygon_cut.h"

namespace gnomon::scene_detail {
namespace {

template <class Int>
class PartMaker {
 public:
  PartMaker(const Scene& scene, PreparedScene& out)
      : scene_(scene),
        out_(out),
        grid_(out.geometry.grid),
        planes_(scene.polygons.size()),
        edges_(2 * scene.polygons.size()) {}

  std::optional<Error> run() {
    std::size_t corners = 0;
    for (const Polygon& polygon : scene_.polygons) corners += polygon.loop.size();
    out_.parts.reserve(scene_.polygons.size());
    out_.first_part.reserve(scene_.polygons.size() + 1);
    out_.loop_vertices.reserve(corners);
    out_.loop_edges.reserve(corners);
    for (std::uint32_t p = 0; p < scene_.polygons.size(); ++p) {
      out_.first_part.push_back(static_cast<std::uint32_t>(out_.parts.size()));
      if (auto error = add_polygon(p)) return error;
    }
    out_.first_part.push_back(static_cast<std::uint32_t>(out_.parts.size()));
    return std::nullopt;
  }

 private:
  using Point = Vec3<Int>;

  struct PlaneKey {
    Point normal;  // primitive, first non-zero component positive
    Int offset;
    bool flipped;  // normal is opposite to that of the plane's support triple
  };

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
    out_.notes.push_back({polygon, repair, std::move(detail)});
  }

  void load(const std::vector<VertexId>& input, std::vector<Corner>& corners) const {
    corners.clear();
    for (const VertexId v : input) corners.push_back({out_.vertex_of_input[v], v});
  }

  void load_points(const std::vector<Corner>& corners, std::vector<Point>& points) const {
    points.clear();
    for (const Corner& corner : corners) points.push_back(point<Int>(grid_, corner.vertex));
  }

  /// Neither repeated nor collinear vertices: the usual case, seen without copying anything.
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
    load(polygon.loop, loop_);
    if (loop_.size() >= 3) load_points(loop_, points_);
    if (loop_.size() < 3 || !is_clean(points_)) {
      clean_and_note(p);
      if (loop_.size() < 3) {
        note(p, Repair::kZeroArea, "dropped: all vertices on one line");
        return std::nullopt;
      }
      load_points(loop_, points_);
    }
    const Point area = area_vector(points_);
    if (area.is_zero()) {
      return error_at(p, 0, "crosses itself: it runs as much clockwise as counter-clockwise",
                      "a simple closed curve");
    }
    const bool planar = lies_in_plane(points_, points_[0], area);
    if (planar && polygon.holes.empty() && is_convex(points_, area)) {
      scratch_.clear();
      for (const Corner& corner : loop_) scratch_.push_back(corner.vertex);
      add_part(p, scratch_);
      return std::nullopt;
    }
    return cut(p, area, planar);
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

  std::optional<Error> cut(std::uint32_t p, const Point& area, bool planar) {
    const Polygon& polygon = scene_.polygons[p];
    std::vector<std::vector<Corner>> rings{loop_};
    std::vector<std::size_t> ring_names{0};
    Int hole_area = 0;
    const int axis = projection_axis(area);
    std::vector<Corner> hole;
    std::vector<Point> hole_points;
    for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
      load(polygon.holes[h], hole);
      const Cleaning done = clean_loop<Int>(grid_, hole);
      if (hole.size() < 3) {
        note(p, Repair::kHoles, fmt::format("hole {} has no area and is dropped", h));
        continue;
      }
      if (done.repeated + done.collinear > 0) {
        note(p, done.collinear > 0 ? Repair::kCollinearVertices : Repair::kRepeatedVertices,
             fmt::format("hole {}: {} dropped", h, done.repeated + done.collinear));
      }
      load_points(hole, hole_points);
      planar = planar && lies_in_plane(hole_points, points_[0], area);
      const Int part = area_vector(hole_points)[axis];
      hole_area += part < 0 ? Int(-part) : part;
      rings.push_back(hole);
      ring_names.push_back(h + 1);
    }

    CutInput<Int> input;
    std::vector<VertexId> vertices;
    std::unordered_map<VertexId, std::uint32_t> local;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool swap = area[axis] < 0;
    for (const auto& ring : rings) {
      input.rings.emplace_back();
      for (const Corner& corner : ring) {
        const auto [entry, is_new] =
            local.emplace(corner.vertex, static_cast<std::uint32_t>(vertices.size()));
        const std::uint32_t i = entry->second;
        if (is_new) {
          vertices.push_back(corner.vertex);
          input.x.push_back(coordinate<Int>(grid_, corner.vertex, swap ? v : u));
          input.y.push_back(coordinate<Int>(grid_, corner.vertex, swap ? u : v));
          input.key.push_back(corner.input);
        }
        input.key[i] = std::min(input.key[i], corner.input);
        input.rings.back().push_back(i);
      }
    }
    input.planar = planar;
    if (rings.size() == 1 && planar && is_convex(points_, area)) {  // all holes were empty
      add_part(p, vertices);
      return std::nullopt;
    }
    const auto parts = cut_into_convex_parts(std::move(input));
    if (!parts) {
      const CutProblem& problem = parts.error();
      std::string what = problem.what;
      if (!planar) {
        what += fmt::format(" (the polygon is not planar, so this is in its projection along {})",
                            "xyz"[axis]);
      }
      return error_at(p, ring_names[problem.ring], what,
                      problem.ring == 0 ? "a simple closed curve"
                                        : "holes inside the loop that do not overlap");
    }
    const Int loop_area = area[axis] < 0 ? Int(-area[axis]) : area[axis];
    if (parts->empty() && loop_area == hole_area) {
      note(p, Repair::kZeroArea, "dropped: its holes fill it");
      return std::nullopt;
    }
    const std::string count =
        fmt::format("{} part{}", parts->size(), parts->size() == 1 ? "" : "s");
    if (!planar) {
      note(p, Repair::kNotPlanar,
           fmt::format("{:.3g} scene units off its plane; {}", off_plane(rings), count));
    } else if (rings.size() > 1) {
      note(p, Repair::kHoles,
           fmt::format("{} hole{}; {}", rings.size() - 1, rings.size() == 2 ? "" : "s", count));
    } else {
      note(p, Repair::kNotConvex, count);
    }
    for (const auto& part : *parts) {
      scratch_.clear();
      for (const std::uint32_t i : part) scratch_.push_back(vertices[i]);
      add_part(p, scratch_);
    }
    return std::nullopt;
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
    square *= out_.geometry.step * out_.geometry.step;
    return std::sqrt(square.get_d());
  }

  void add_part(std::uint32_t p, const std::vector<VertexId>& loop) {
    Part part;
    part.polygon = p;
    part.first = static_cast<std::uint32_t>(out_.loop_vertices.size());
    part.count = static_cast<std::uint32_t>(loop.size());
    part.two_sided = scene_.is_two_sided(scene_.polygons[p]);
    part.casts = scene_.polygons[p].casts;
    intern_plane(loop, part);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      out_.loop_vertices.push_back(loop[i]);
      out_.loop_edges.push_back(intern_edge(loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]));
    }
    out_.parts.push_back(part);
  }

  void intern_plane(const std::vector<VertexId>& loop, Part& part) {
    const Point a = point<Int>(grid_, loop[0]);
    PlaneKey key{cross(point<Int>(grid_, loop[1]) - a, point<Int>(grid_, loop[2]) - a), 0, false};
    Int common = gcd_of(gcd_of(key.normal.x, key.normal.y), key.normal.z);
    const Int& leading = key.normal.x != 0   ? key.normal.x
                         : key.normal.y != 0 ? key.normal.y
                                             : key.normal.z;
    key.flipped = leading < 0;
    if (key.flipped) common = -common;
    if (common != 1) {
      for (Int* component : {&key.normal.x, &key.normal.y, &key.normal.z}) {
        if (*component != 0) *component /= common;
      }
    }
    key.offset = dot(key.normal, a);
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) hash = hash_into(hash, key.normal[k]);
    hash = hash_into(hash, key.offset);

    const auto next = static_cast<std::uint32_t>(keys_.size());
    const std::uint32_t found = planes_.find_or_enter(hash, next, [&](std::uint32_t i) {
      const PlaneKey& other = keys_[i];
      return other.normal.x == key.normal.x && other.normal.y == key.normal.y &&
             other.normal.z == key.normal.z && other.offset == key.offset;
    });
    if (found == IndexTable::kNone) {
      part.plane = next;
      part.flipped = false;
      out_.geometry.planes.push_back({loop[0], loop[1], loop[2]});
      keys_.push_back(std::move(key));
    } else {
      part.plane = found;
      part.flipped = keys_[found].flipped != key.flipped;
    }
  }

  PlaneRef intern_edge(VertexId from, VertexId to) {
    const EdgeEnds ends{std::min(from, to), std::max(from, to)};
    auto& edges = out_.geometry.edges;
    const auto next = static_cast<std::uint32_t>(edges.size());
    const std::uint64_t hash = mix(mix(0, ends.a), ends.b) * 0x9e3779b97f4a7c15u;
    const std::uint32_t found =
        edges_.find_or_enter(hash, next, [&](std::uint32_t i) { return edges[i] == ends; });
    if (found == IndexTable::kNone) edges.push_back(ends);
    return PlaneRef(found == IndexTable::kNone ? next : found, from != ends.a);
  }

  const Scene& scene_;
  PreparedScene& out_;
  const GridPositions& grid_;
  IndexTable planes_, edges_;
  std::vector<PlaneKey> keys_;
  std::vector<Corner> loop_;  // of the polygon at hand
  std::vector<Point> points_;
  std::vector<VertexId> scratch_;
};

}  // namespace

template <class Int>
std::optional<Error> make_parts(const Scene& scene, PreparedScene& out) {
  return PartMaker<Int>(scene, out).run();
}

template std::optional<Error> make_parts<Int128>(const Scene&, PreparedScene&);
template std::optional<Error> make_parts<Int256>(const Scene&, PreparedScene&);
template std::optional<Error> make_parts<mpz_class>(const Scene&, PreparedScene&);

}  // namespace gnomon::scene_detail
