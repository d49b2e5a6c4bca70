// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/shading_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "algorithms/shading_mesh/edges.h"
#include "algorithms/shading_mesh/fragment_faces.h"
#include "algorithms/shading_mesh/grid.h"
#include "algorithms/shading_mesh/mesh_by_rules.h"
#include "algorithms/shading_mesh/nodes.h"
#include "algorithms/shading_mesh/points.h"
#include "algorithms/shading_mesh/samples.h"

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

class MeshMaker {
 public:
  MeshMaker(const PreparedScene& scene, const ShadowResult& result, const ShadeFunction& shade,
            const ShadingOptions& options, const Rules& rules)
      : scene_(scene),
        result_(result),
        shade_(shade),
        options_(options),
        rules_(rules),
        nodes_(scene, result.lights.size(), points_) {}

  Expected<ShadingMesh> make() {
    if (auto done = check_result(result_); !done) return tl::unexpected(std::move(done.error()));
    for (const LightResult& light : result_.lights) {
      LightShadingStats stats;
      stats.light = light.light;
      mesh_.lights.push_back(light.light);
      mesh_.stats.lights.push_back(stats);
    }
    mesh_.ambient = options_.ambient;
    auto start = Clock::now();
    loops_ = fragment_faces(scene_, result_, points_);
    mesh_.stats.fragments = loops_.faces.size();
    if (is_interrupted()) return stopped();
    if (rules_.neighbour_vertices_are_in_the_face) loops_ = fit_edges(loops_, points_);
    if (auto done = regular_grid(); !done) return tl::unexpected(std::move(done.error()));
    mesh_.stats.grid_seconds += seconds_since(start);
    if (options_.tolerance > 0) {
      if (auto done = refine(); !done) return tl::unexpected(std::move(done.error()));
    }
    nodes_.find_contacts(loops_, {});
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      for (const std::uint32_t vertex : loops_.loop(loops_.faces[f])) node(vertex, f);
    }
    if (!illuminate()) return stopped();
    finish();
    return std::move(mesh_);
  }

 private:
  bool is_interrupted() const {
    return options_.interrupted != nullptr && options_.interrupted->load(std::memory_order_relaxed);
  }
  static tl::unexpected<Error> stopped() {
    return fail(ErrorCode::kInterrupted, "interrupted while shading");
  }
  void progress(double fraction) const {
    if (options_.progress) options_.progress(fraction);
  }

  std::uint32_t node(std::uint32_t vertex, std::uint32_t f) {
    return nodes_.node(vertex, loops_, f);
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

  /// A step of adaptive subdivision: the faces that are open, and the points where they are tested.
  struct Tested {
    std::vector<std::uint32_t> faces;
    EdgeList edges;                      // of those faces
    std::vector<std::uint32_t> middles;  // of those edges
    std::vector<std::uint32_t> centres;  // of those faces
  };

  Tested test_points(const std::vector<std::uint8_t>& open) {
    Tested tested{{}, EdgeList(loops_, [&](std::size_t f) { return open[f] != 0; }), {}, {}};
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      if (open[f] != 0) tested.faces.push_back(f);
    }
    const EdgeList& edges = tested.edges;
    std::vector<NewPoint> made(edges.size());
    tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t edge) {
      made[edge] =
          new_point(middle(points_.exact(edges.from(edge)), points_.exact(edges.to(edge))));
    });
    for (NewPoint& point : made) tested.middles.push_back(points_.insert(std::move(point)));
    std::unordered_map<PlaneId, MeshPlane> planes;
    for (const std::uint32_t f : tested.faces) {
      const PlaneId plane = scene_.parts[loops_.faces[f].part].plane;
      if (!planes.contains(plane)) planes.emplace(plane, mesh_plane(scene_, plane));
    }
    std::vector<NewPoint> centres(tested.faces.size());
    tbb::parallel_for(std::size_t{0}, tested.faces.size(), [&](std::size_t i) {
      const MeshFace& face = loops_.faces[tested.faces[i]];
      centres[i] = centre(face, planes.at(scene_.parts[face.part].plane));
    });
    for (NewPoint& point : centres) tested.centres.push_back(points_.insert(std::move(point)));
    return tested;
  }

  /// Asks for the nodes of every face that has a tested edge: where a lit face meets a penumbra
  /// face, the middle of their edge is lit for both.
  void add_test_nodes(const Tested& tested) {
    std::vector<std::uint32_t> others = tested.middles;
    others.insert(others.end(), tested.centres.begin(), tested.centres.end());
    nodes_.find_contacts(loops_, std::move(others));
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      const auto loop = loops_.loop(loops_.faces[f]);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::size_t edge = tested.edges.find(loop[i], loop[(i + 1) % loop.size()]);
        if (edge == EdgeList::kNone) continue;
        node(loop[i], f);
        node(loop[(i + 1) % loop.size()], f);
        node(tested.middles[edge], f);
      }
    }
    for (std::size_t i = 0; i < tested.faces.size(); ++i) node(tested.centres[i], tested.faces[i]);
  }

  /// Whether interpolation of its corners is good enough in the middles of a face and of its edges.
  /// `least`: what counts as the face's brightest corner if none is brighter.
  bool is_flat(const Tested& tested, std::size_t i, double least) {
    const std::uint32_t f = tested.faces[i];
    const MeshFace& face = loops_.faces[f];
    const auto loop = loops_.loop(face);
    const auto shade = [&](std::uint32_t vertex) { return nodes_.shade(node(vertex, f), face); };
    double sum = 0, brightest = least;
    for (const std::uint32_t vertex : loop) {
      const double value = shade(vertex);
      sum += value;
      brightest = std::max(brightest, value);
    }
    const double allowed = options_.tolerance * brightest;
    const double mean = sum / static_cast<double>(loop.size());
    if (!(std::fabs(shade(tested.centres[i]) - mean) <= allowed)) return false;
    for (std::size_t c = 0; c < loop.size(); ++c) {
      const std::uint32_t next = loop[(c + 1) % loop.size()];
      const double ends = (shade(loop[c]) + shade(next)) / 2;
      const std::uint32_t between = tested.middles[tested.edges.find(loop[c], next)];
      if (!(std::fabs(shade(between) - ends) <= allowed)) return false;
    }
    return true;
  }

  /// Closes the open faces on which linear interpolation is good enough. False: interrupted.
  bool test(std::vector<std::uint8_t>& open) {
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      if (class_of(loops_.faces[f]) == FaceClass::kUmbra) open[f] = 0;
    }
    const Tested tested = test_points(open);
    if (is_interrupted()) return false;
    add_test_nodes(tested);
    if (!illuminate()) return false;
    const double least = nodes_.largest_shade() * ShadingOptions::kDark;
    for (std::size_t i = 0; i < tested.faces.size(); ++i) {
      if (is_flat(tested, i, least)) open[tested.faces[i]] = 0;
    }
    return true;
  }

  // ---- illumination

  /// False: interrupted.
  bool illuminate() {
    const auto lights = static_cast<double>(mesh_.lights.size());
    for (std::size_t light = 0; light < mesh_.lights.size(); ++light) {
      const auto start = Clock::now();
      nodes_.illuminate(light, shade_, [&](double fraction) {
        if (is_interrupted()) return false;
        progress((static_cast<double>(light) + fraction) / lights);
        return true;
      });
      mesh_.stats.lights[light].seconds += seconds_since(start);
      if (is_interrupted()) return false;
    }
    return true;
  }

  void finish() {
    number_corners(loops_, points_, nodes_, mesh_);
    mesh_.stats.faces = mesh_.faces.size();
    mesh_.stats.vertices = mesh_.points.size();
  }

  const PreparedScene& scene_;
  const ShadowResult& result_;
  const ShadeFunction& shade_;
  const ShadingOptions& options_;
  const Rules& rules_;
  PointTable points_;
  FaceLoops loops_;
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
  // A mesh has a face a fragment, and nothing where no fragment is.
  const bool painted = std::ranges::any_of(
      result.lights, [](const LightResult& light) { return light.cover == Cover::kOverlay; });
  if (painted) {
    return fail(ErrorCode::kUsage, "shadows painted over polygons cannot be shaded",
                "fragments that tile them: cover=partition");
  }
  return MeshMaker(scene, result, shade, options, rules).make();
}

Expected<ShadingMesh> make_shading_mesh(const PreparedScene& scene, const ShadowResult& result,
                                        const ShadeFunction& shade, const ShadingOptions& options) {
  return make_shading_mesh_by(scene, result, shade, options, Rules{});
}

}  // namespace gnomon
