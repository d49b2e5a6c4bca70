// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/shading_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "algorithms/shading_mesh/contacts.h"
#include "algorithms/shading_mesh/edges.h"
#include "algorithms/shading_mesh/grid.h"
#include "algorithms/shading_mesh/mesh_by_rules.h"
#include "algorithms/shading_mesh/points.h"

namespace gnomon {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

enum class FaceClass : std::uint8_t { kLit, kPenumbra, kUmbra };

FaceClass class_of(const MeshFace& face) {
  if (face.penumbra_of != 0) return FaceClass::kPenumbra;
  return face.lit_by != 0 ? FaceClass::kLit : FaceClass::kUmbra;
}

/// A vertex on an oriented plane: what illumination depends on, whichever part of that plane it
/// belongs to, since coplanar polygons do not shadow each other. Where a caster touches the plane,
/// each face behind it has the vertex for itself.
struct NodeKey {
  static constexpr std::uint32_t kShared = 0xffffffffu;
  std::uint32_t vertex = 0;
  std::uint32_t plane = 0;         // 2 plane, + 1 for its back
  std::uint32_t inside = kShared;  // a face's own: the number of a point inside of it
  friend bool operator==(NodeKey, NodeKey) = default;
};
struct NodeHash {
  std::size_t operator()(NodeKey key) const {
    std::uint64_t hash = (std::uint64_t{key.vertex} << 32 | key.plane) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ key.inside) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash ^ hash >> 29);
  }
};

struct Node {
  std::uint32_t vertex = 0;
  std::uint32_t inside = NodeKey::kShared;  // of the face whose own it is
  std::uint32_t part = 0;
  Side side = Side::kFront;
  std::uint64_t lit_by = 0, penumbra_of = 0;        // classes of faces that meet in it
  std::uint64_t known_lit = 0, known_penumbra = 0;  // what its values were computed as
};

/// Vertices of one side of the mesh and their illumination, each computed once.
class NodeTable {
 public:
  NodeTable(const PreparedScene& scene, std::size_t lights) : scene_(scene), lights_(lights) {}

  /// The node of a vertex of this face, which now belongs to the face's classes too. `inside`: a
  /// point inside of the face if the node is to be its own, else kShared.
  std::uint32_t add(std::uint32_t vertex, const MeshFace& face, std::uint32_t inside) {
    const Part& part = scene_.parts[face.part];
    const bool back = part.flipped != (face.side == Side::kBack);
    const auto [at, is_new] =
        numbers_.emplace(NodeKey{vertex, 2 * part.plane + (back ? 1 : 0), inside},
                         static_cast<std::uint32_t>(nodes_.size()));
    if (is_new) {
      nodes_.push_back({vertex, inside, face.part, face.side, 0, 0, 0, 0});
      values_.resize(values_.size() + lights_, 0);
      errors_.resize(errors_.size() + lights_, 0);
    }
    Node& node = nodes_[at->second];
    node.lit_by |= face.lit_by;
    node.penumbra_of |= face.penumbra_of;
    return at->second;
  }

  std::size_t size() const { return nodes_.size(); }
  const Node& operator[](std::uint32_t node) const { return nodes_[node]; }
  double value(std::uint32_t node, std::size_t light) const {
    return values_[node * lights_ + light];
  }
  /// What a face of these classes has at this node.
  double shade(std::uint32_t node, const MeshFace& face) const {
    double sum = 0;
    const std::uint64_t shone_on = face.lit_by | face.penumbra_of;
    for (std::size_t light = 0; light < lights_; ++light) {
      if ((shone_on >> light & 1) != 0) sum += value(node, light);
    }
    return sum;
  }

  /// Computes by one light what is not known yet. Values do not depend on each other, nor on the
  /// order in which they are computed.
  void illuminate(std::size_t light, const PointTable& points, const ShadeFunction& shade,
                  const std::function<bool(double)>& go_on) {
    const std::uint64_t bit = std::uint64_t{1} << light;
    std::vector<std::uint32_t> missing;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      const Node& node = nodes_[n];
      const bool lit = (node.lit_by & bit) != 0;
      const std::uint64_t known = lit ? node.known_lit : node.known_lit | node.known_penumbra;
      if ((known & bit) == 0 && ((node.lit_by | node.penumbra_of) & bit) != 0) missing.push_back(n);
    }
    // Pieces between two looks at the clock of progress and at interruption.
    constexpr std::size_t kPiece = 1024;
    for (std::size_t begin = 0; begin < missing.size(); begin += kPiece) {
      if (!go_on(static_cast<double>(begin) / static_cast<double>(missing.size()))) return;
      const std::size_t end = std::min(missing.size(), begin + kPiece);
      tbb::parallel_for(begin, end, [&](std::size_t i) {
        Node& node = nodes_[missing[i]];
        const bool lit = (node.lit_by & bit) != 0;
        std::array<mpq_class, 3> inside;
        if (node.inside != NodeKey::kShared) inside = points.exact(node.inside).rational();
        const PointShade result = shade({static_cast<std::uint32_t>(light), node.part, node.side,
                                         points.exact(node.vertex).rational(), lit,
                                         node.inside == NodeKey::kShared ? nullptr : &inside});
        values_[missing[i] * lights_ + light] = result.value;
        errors_[missing[i] * lights_ + light] = result.error_bound;
        (lit ? node.known_lit : node.known_penumbra) |= bit;
      });
    }
  }

  /// Of all lights together.
  double largest_shade() const {
    double largest = 0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      double sum = 0;
      for (std::size_t light = 0; light < lights_; ++light) sum += values_[n * lights_ + light];
      largest = std::max(largest, sum);
    }
    return largest;
  }

  double largest_error(std::size_t light) const {
    double largest = 0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      largest = std::max(largest, errors_[n * lights_ + light]);
    }
    return largest;
  }

 private:
  const PreparedScene& scene_;
  std::size_t lights_;
  std::vector<Node> nodes_;
  std::vector<double> values_, errors_;  // of node n by light i: [n * lights_ + i]
  std::unordered_map<NodeKey, std::uint32_t, NodeHash> numbers_;
};

class MeshMaker {
 public:
  MeshMaker(const PreparedScene& scene, const ShadowResult& result, const ShadeFunction& shade,
            const ShadingOptions& options, const Rules& rules)
      : scene_(scene),
        result_(result),
        shade_(shade),
        options_(options),
        rules_(rules),
        contacts_(scene),
        nodes_(scene, result.lights.size()) {}

  Expected<ShadingMesh> make() {
    if (auto done = check(); !done) return tl::unexpected(std::move(done.error()));
    for (const LightResult& light : result_.lights) {
      LightShadingStats stats;
      stats.light = light.light;
      mesh_.lights.push_back(light.light);
      mesh_.stats.lights.push_back(stats);
    }
    mesh_.ambient = options_.ambient;
    auto start = Clock::now();
    take_fragments();
    mesh_.stats.fragments = loops_.faces.size();
    if (is_interrupted()) return stopped();
    if (rules_.neighbour_vertices_are_in_the_face) loops_ = fit_edges(loops_, points_);
    if (auto done = regular_grid(); !done) return tl::unexpected(std::move(done.error()));
    mesh_.stats.grid_seconds += seconds_since(start);
    if (options_.tolerance > 0) {
      if (auto done = refine(); !done) return tl::unexpected(std::move(done.error()));
    }
    find_contacts({});
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      for (const std::uint32_t vertex : loops_.loop(loops_.faces[f])) node(vertex, f);
    }
    if (!illuminate()) return stopped();
    finish();
    return std::move(mesh_);
  }

 private:
  Expected<void> check() const {
    if (!result_.exact) {
      return fail(ErrorCode::kUsage,
                  "kernel " + result_.kernel + " rounds: its fragments do not fit",
                  "the result of an exact kernel");
    }
    if (result_.lights.empty() || result_.lights.size() > 64) {
      return fail(ErrorCode::kUsage, std::to_string(result_.lights.size()) + " lights to shade by",
                  "1 to 64");
    }
    const bool has_points =
        result_.lights.size() > 1 || !result_.combined.empty()
            ? !result_.combined_exact_points.empty()
            : result_.lights[0].fragments.empty() || !result_.lights[0].exact_points.empty();
    if (!has_points) {
      return fail(ErrorCode::kUsage,
                  "the result has no exact points of fragments that are shared "
                  "by all lights",
                  "ShadowOptions::keep_exact_points, and combined for several lights");
    }
    return {};
  }

  bool is_interrupted() const {
    return options_.interrupted != nullptr && options_.interrupted->load(std::memory_order_relaxed);
  }
  static tl::unexpected<Error> stopped() {
    return fail(ErrorCode::kInterrupted, "interrupted while shading");
  }
  void progress(double fraction) const {
    if (options_.progress) options_.progress(fraction);
  }

  // ---- fragments

  struct Given {
    MeshFace face;
    std::span<const std::array<mpq_class, 3>> loop;  // empty: the part's own
  };

  std::vector<Given> given_fragments() const {
    std::vector<Given> given;
    if (result_.lights.size() > 1 || !result_.combined.empty()) {
      for (const CombinedFragment& fragment : result_.combined) {
        given.push_back(
            {{fragment.part, fragment.side, fragment.lit_by, fragment.penumbra_of, 0, 0},
             {result_.combined_exact_points.data() + fragment.first, fragment.count}});
      }
    } else {
      const LightResult& light = result_.lights[0];
      for (const PartResult& part : light.parts) {
        if (part.reason != ShadowReason::kNone) continue;
        for (std::uint32_t i = 0; i < part.fragment_count; ++i) {
          const Fragment& fragment = light.fragments[part.first_fragment + i];
          given.push_back({{part.part, part.side, fragment.state == LightState::kLit ? 1u : 0u,
                            fragment.state == LightState::kPenumbra ? 1u : 0u, 0, 0},
                           {light.exact_points.data() + fragment.first, fragment.count}});
        }
      }
    }
    // Sides that no light shines on.
    std::vector<std::uint8_t> seen(2 * scene_.parts.size(), 0);
    for (const Given& one : given) {
      seen[2 * one.face.part + (one.face.side == Side::kBack ? 1 : 0)] = 1;
    }
    for (std::uint32_t part = 0; part < scene_.parts.size(); ++part) {
      if (seen[2 * part] == 0) given.push_back({{part, Side::kFront, 0, 0, 0, 0}, {}});
      if (scene_.parts[part].two_sided && seen[2 * part + 1] == 0) {
        given.push_back({{part, Side::kBack, 0, 0, 0, 0}, {}});
      }
    }
    std::stable_sort(given.begin(), given.end(), [](const Given& a, const Given& b) {
      if (a.face.part != b.face.part) return a.face.part < b.face.part;
      return a.face.side != b.face.side && a.face.side == Side::kFront;
    });
    return given;
  }

  std::vector<ExactPoint> exact_loop(const Given& given) const {
    std::vector<ExactPoint> loop;
    if (!given.loop.empty()) {
      for (const auto& point : given.loop) loop.push_back(exact_point(point));
      return loop;
    }
    const Geometry& geometry = scene_.geometry;
    for (const VertexId vertex : scene_.loop(scene_.parts[given.face.part])) {
      std::array<mpq_class, 3> point;
      for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        point[axis] = geometry.origin[axis] + geometry.step * geometry.grid.at(vertex, k);
      }
      loop.push_back(exact_point(point));
    }
    if (given.face.side == Side::kBack) std::reverse(loop.begin(), loop.end());
    return loop;
  }

  void take_fragments() {
    const std::vector<Given> given = given_fragments();
    std::vector<std::vector<NewPoint>> made(given.size());
    tbb::parallel_for(std::size_t{0}, given.size(), [&](std::size_t i) {
      for (ExactPoint& point : exact_loop(given[i])) made[i].push_back(new_point(std::move(point)));
    });
    std::vector<std::uint32_t> loop;
    for (std::size_t i = 0; i < given.size(); ++i) {
      loop.clear();
      for (NewPoint& point : made[i]) loop.push_back(points_.insert(std::move(point)));
      loops_.add(given[i].face, loop);
    }
  }

  // ---- nodes

  /// Finds where casters touch the penumbra faces, at their corners and at other points. To be
  /// called whenever there are new faces, before their nodes are asked for.
  void find_contacts(std::vector<std::uint32_t> vertices) {
    insides_.assign(loops_.faces.size(), NodeKey::kShared);
    for (const MeshFace& face : loops_.faces) {
      if (face.penumbra_of == 0) continue;
      const auto loop = loops_.loop(face);
      vertices.insert(vertices.end(), loop.begin(), loop.end());
    }
    contacts_.find(points_, vertices);
  }

  /// The node of a point of a face. Lit faces need no node of their own: they are lit whatever
  /// touches them.
  std::uint32_t node(std::uint32_t vertex, std::uint32_t f) {
    const MeshFace& face = loops_.faces[f];
    if (face.penumbra_of == 0 || !contacts_.touches(vertex, face)) {
      return nodes_.add(vertex, face, NodeKey::kShared);
    }
    if (insides_[f] == NodeKey::kShared) {
      insides_[f] = points_.insert(new_point(inner_point(loops_.loop(face), points_)));
    }
    const bool own = contacts_.is_behind(vertex, face, points_.exact(insides_[f]));
    return nodes_.add(vertex, face, own ? insides_[f] : NodeKey::kShared);
  }

  // ---- subdivision

  Expected<void> regular_grid() {
    if (sgn(options_.lit_step) <= 0 && sgn(options_.penumbra_step) <= 0) return {};
    return cut(options_.lit_step, options_.penumbra_step, nullptr);
  }

  /// Cuts the faces that are open, or all if `open` is null; new faces inherit it.
  Expected<void> cut(const mpq_class& lit_step, const mpq_class& penumbra_step,
                     std::vector<std::uint8_t>* open) {
    const std::array<GridLines, GridRequest::kMostGrids> grids = {
        sgn(lit_step) > 0 ? GridLines(lit_step, options_.round_lines) : GridLines(),
        sgn(penumbra_step) > 0 ? GridLines(penumbra_step, options_.round_lines) : GridLines()};
    std::vector<std::uint8_t> grid_of(loops_.faces.size(), kNoGrid);
    for (std::size_t f = 0; f < loops_.faces.size(); ++f) {
      if (open != nullptr && (*open)[f] == 0) continue;
      const FaceClass state = class_of(loops_.faces[f]);
      if (state == FaceClass::kUmbra) continue;
      const std::uint8_t grid = state == FaceClass::kLit ? 0 : 1;
      if (!grids[grid].empty()) grid_of[f] = grid;
    }
    GridRequest request;
    request.grids = grids;
    request.grid_of = grid_of;
    request.max_faces = options_.max_faces;
    request.interrupted = options_.interrupted;
    auto result = cut_by_grids(scene_, loops_, request, points_);
    if (!result) return tl::unexpected(std::move(result.error()));
    if (open != nullptr) {
      std::vector<std::uint8_t> inherited;
      for (const std::uint32_t from : result->origins) inherited.push_back((*open)[from]);
      *open = std::move(inherited);
    }
    loops_ = std::move(result->loops);
    return {};
  }

  /// A power of two near 1/8 of the scene's diagonal: lines at numbers of few bits.
  mpq_class first_step() const {
    std::array<double, 3> low{INFINITY, INFINITY, INFINITY};
    std::array<double, 3> high{-INFINITY, -INFINITY, -INFINITY};
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], points_.nearest(p)[k]);
        high[k] = std::max(high[k], points_.nearest(p)[k]);
      }
    }
    const double diagonal = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    return std::ldexp(1.0, std::ilogb(std::max(diagonal, 0x1p-1000)) - 3);
  }

  Expected<void> refine() {
    mpq_class lit_step = options_.lit_step, penumbra_step = options_.penumbra_step;
    // What was gridded is halved; what was not begins with the default step.
    if (sgn(lit_step) <= 0) lit_step = 2 * first_step();
    if (sgn(penumbra_step) <= 0) penumbra_step = 2 * first_step();
    std::vector<std::uint8_t> open(loops_.faces.size(), 1);
    for (unsigned depth = 0; depth < options_.max_depth; ++depth) {
      if (!test(open)) return stopped();
      if (std::find(open.begin(), open.end(), 1) == open.end()) break;
      const auto start = Clock::now();
      const std::size_t before = loops_.faces.size();
      lit_step /= 2;
      penumbra_step /= 2;
      if (auto done = cut(lit_step, penumbra_step, &open); !done) return done;
      if (loops_.faces.size() != before) mesh_.stats.depth = depth + 1;
      mesh_.stats.grid_seconds += seconds_since(start);
    }
    return {};
  }

  /// Where a face is tested besides the middles of its edges: near the mean of its vertices, on its
  /// plane, at coordinates of few bits.
  NewPoint centre(const MeshFace& face, const MeshPlane& plane) const {
    const auto loop = loops_.loop(face);
    std::array<mpq_class, 3> point;
    for (const int axis : plane.axes) {
      const auto k = static_cast<std::size_t>(axis);
      double low = INFINITY, high = -INFINITY, mean = 0;
      for (const std::uint32_t vertex : loop) {
        const double at = points_.nearest(vertex)[k];
        low = std::min(low, at);
        high = std::max(high, at);
        mean += (at - points_.nearest(loop[0])[k]) / static_cast<double>(loop.size());
      }
      mean += points_.nearest(loop[0])[k];
      // 2^-24 of the face's size is less than any tolerance.
      const int unit = high > low ? std::ilogb(high - low) - 24 : std::ilogb(mean) - 52;
      const double rounded = std::ldexp(std::nearbyint(std::ldexp(mean, -unit)), unit);
      point[k] = std::isfinite(rounded) ? rounded : mean;
    }
    const auto i = static_cast<std::size_t>(plane.axes[0]);
    const auto j = static_cast<std::size_t>(plane.axes[1]);
    const auto k = static_cast<std::size_t>(plane.dropped());
    point[k] = (plane.d - plane.n[i] * point[i] - plane.n[j] * point[j]) / plane.n[k];
    return new_point(exact_point(point));
  }

  /// Closes the open faces on which linear interpolation is good enough. False: interrupted.
  bool test(std::vector<std::uint8_t>& open) {
    std::vector<std::uint32_t> tested;
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      if (class_of(loops_.faces[f]) == FaceClass::kUmbra) open[f] = 0;
      if (open[f] != 0) tested.push_back(f);
    }
    // The middle of every edge of a tested face, each made once.
    const EdgeList edges(loops_, [&](std::size_t f) { return open[f] != 0; });
    std::vector<NewPoint> made(edges.size());
    tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t edge) {
      made[edge] =
          new_point(middle(points_.exact(edges.from(edge)), points_.exact(edges.to(edge))));
    });
    std::vector<std::uint32_t> middles(edges.size(), 0);
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
      middles[edge] = points_.insert(std::move(made[edge]));
    }
    std::unordered_map<PlaneId, MeshPlane> planes;
    for (const std::uint32_t f : tested) {
      const PlaneId plane = scene_.parts[loops_.faces[f].part].plane;
      if (!planes.contains(plane)) planes.emplace(plane, mesh_plane(scene_, plane));
    }
    std::vector<NewPoint> centres(tested.size());
    tbb::parallel_for(std::size_t{0}, tested.size(), [&](std::size_t i) {
      const MeshFace& face = loops_.faces[tested[i]];
      centres[i] = centre(face, planes.at(scene_.parts[face.part].plane));
    });
    if (is_interrupted()) return false;

    // Nodes of every face that has a tested edge: where a lit face meets a penumbra face, its
    // middle is lit for both.
    std::vector<std::uint32_t> centre_points;
    centre_points.reserve(centres.size());
    for (NewPoint& point : centres) centre_points.push_back(points_.insert(std::move(point)));
    std::vector<std::uint32_t> others = middles;
    others.insert(others.end(), centre_points.begin(), centre_points.end());
    find_contacts(std::move(others));
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      const auto loop = loops_.loop(loops_.faces[f]);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::size_t edge = edges.find(loop[i], loop[(i + 1) % loop.size()]);
        if (edge == EdgeList::kNone) continue;
        node(loop[i], f);
        node(loop[(i + 1) % loop.size()], f);
        node(middles[edge], f);
      }
    }
    std::vector<std::uint32_t> centre_nodes;
    for (std::size_t i = 0; i < tested.size(); ++i) {
      centre_nodes.push_back(node(centre_points[i], tested[i]));
    }
    if (!illuminate()) return false;

    const double least = nodes_.largest_shade() * ShadingOptions::kDark;
    for (std::size_t i = 0; i < tested.size(); ++i) {
      const MeshFace& face = loops_.faces[tested[i]];
      const auto loop = loops_.loop(face);
      double sum = 0, brightest = least;
      for (const std::uint32_t vertex : loop) {
        const double value = nodes_.shade(node(vertex, tested[i]), face);
        sum += value;
        brightest = std::max(brightest, value);
      }
      const double allowed = options_.tolerance * brightest;
      bool good = std::fabs(nodes_.shade(centre_nodes[i], face) -
                            sum / static_cast<double>(loop.size())) <= allowed;
      for (std::size_t c = 0; c < loop.size() && good; ++c) {
        const std::uint32_t next = loop[(c + 1) % loop.size()];
        const double a = nodes_.shade(node(loop[c], tested[i]), face);
        const double b = nodes_.shade(node(next, tested[i]), face);
        const std::uint32_t between = node(middles[edges.find(loop[c], next)], tested[i]);
        good = std::fabs(nodes_.shade(between, face) - (a + b) / 2) <= allowed;
      }
      if (good) open[tested[i]] = 0;
    }
    return true;
  }

  // ---- illumination

  /// False: interrupted.
  bool illuminate() {
    const auto lights = static_cast<double>(mesh_.lights.size());
    for (std::size_t light = 0; light < mesh_.lights.size(); ++light) {
      const auto start = Clock::now();
      nodes_.illuminate(light, points_, shade_, [&](double fraction) {
        if (is_interrupted()) return false;
        progress((static_cast<double>(light) + fraction) / lights);
        return true;
      });
      mesh_.stats.lights[light].seconds += seconds_since(start);
      if (is_interrupted()) return false;
    }
    return true;
  }

  /// Numbers the vertices that faces have, and gives each corner its sample.
  void finish() {
    const std::size_t lights = mesh_.lights.size();
    constexpr std::uint32_t kNone = 0xffffffffu;
    std::vector<std::uint32_t> vertex_numbers(points_.size(), kNone);
    std::vector<std::uint32_t> numbered;
    struct SampleHash {
      std::size_t operator()(const std::pair<std::uint32_t, std::uint64_t>& key) const {
        const std::uint64_t hash = (key.second ^ key.first) * 0x9e3779b97f4a7c15u + key.first;
        return static_cast<std::size_t>(hash ^ hash >> 31);
      }
    };
    std::unordered_map<std::pair<std::uint32_t, std::uint64_t>, std::uint32_t, SampleHash> samples;
    std::vector<std::uint64_t> umbra(nodes_.size(), 0);
    const std::uint64_t all = lights == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << lights) - 1;
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      const MeshFace& face = loops_.faces[f];
      MeshFace copy = face;
      copy.first = static_cast<std::uint32_t>(mesh_.corners.size());
      const std::uint64_t shone_on = face.lit_by | face.penumbra_of;
      for (const std::uint32_t vertex : loops_.loop(face)) {
        const std::uint32_t at_vertex = node(vertex, f);
        umbra[at_vertex] |= all & ~shone_on;
        std::uint32_t& number = vertex_numbers[vertex];
        if (number == kNone) {
          number = static_cast<std::uint32_t>(mesh_.points.size());
          mesh_.points.push_back(points_.nearest(vertex));
          numbered.push_back(vertex);
        }
        const auto [at, is_new] = samples.emplace(std::pair(at_vertex, shone_on),
                                                  static_cast<std::uint32_t>(mesh_.samples.size()));
        if (is_new) {
          mesh_.samples.push_back({number, nodes_[at_vertex].part, nodes_[at_vertex].side});
          for (std::size_t light = 0; light < lights; ++light) {
            mesh_.values.push_back((shone_on >> light & 1) != 0 ? nodes_.value(at_vertex, light)
                                                                : 0);
          }
        }
        mesh_.corners.push_back({number, at->second});
      }
      mesh_.faces.push_back(copy);
      for (std::size_t light = 0; light < lights; ++light) {
        LightShadingStats& stats = mesh_.stats.lights[light];
        ((face.lit_by >> light & 1) != 0        ? stats.lit
         : (face.penumbra_of >> light & 1) != 0 ? stats.penumbra
                                                : stats.umbra) += face.count;
      }
    }
    for (const std::uint32_t vertex : numbered) {
      mesh_.exact_points.push_back(std::move(points_.exact_points()[vertex]));
    }
    mesh_.stats.faces = mesh_.faces.size();
    mesh_.stats.vertices = mesh_.points.size();
    for (std::size_t light = 0; light < lights; ++light) {
      LightShadingStats& stats = mesh_.stats.lights[light];
      const std::uint64_t bit = std::uint64_t{1} << light;
      for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
        // Values for tests count too: they were computed.
        if ((nodes_[n].known_lit & bit) != 0) {
          ++stats.illuminated_lit;
        } else if ((nodes_[n].known_penumbra & bit) != 0) {
          ++stats.illuminated_penumbra;
        }
        if ((umbra[n] & bit) != 0) ++stats.illuminated_umbra;
      }
      stats.largest_error = nodes_.largest_error(light);
    }
  }

  const PreparedScene& scene_;
  const ShadowResult& result_;
  const ShadeFunction& shade_;
  const ShadingOptions& options_;
  const Rules& rules_;
  PointTable points_;
  FaceLoops loops_;
  std::vector<std::uint32_t> insides_;  // of faces, or kShared if not asked for yet
  Contacts contacts_;
  NodeTable nodes_;
  ShadingMesh mesh_;
};

}  // namespace

double ShadingMesh::shade(std::uint32_t sample) const {
  double sum = ambient;
  for (std::size_t light = 0; light < lights.size(); ++light) {
    sum += values[sample * lights.size() + light];
  }
  return sum;
}

Expected<ShadingMesh> make_shading_mesh_by(const PreparedScene& scene, const ShadowResult& result,
                                           const ShadeFunction& shade,
                                           const ShadingOptions& options, const Rules& rules) {
  return MeshMaker(scene, result, shade, options, rules).make();
}

Expected<ShadingMesh> make_shading_mesh(const PreparedScene& scene, const ShadowResult& result,
                                        const ShadeFunction& shade, const ShadingOptions& options) {
  return make_shading_mesh_by(scene, result, shade, options, Rules{});
}

}  // namespace gnomon
