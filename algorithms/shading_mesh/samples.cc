// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/shading_mesh/samples.h"

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

class CornerNumbering {
 public:
  CornerNumbering(const FaceLoops& loops, PointTable& points, NodeTable& nodes, ShadingMesh& mesh)
      : loops_(loops),
        points_(points),
        nodes_(nodes),
        mesh_(mesh),
        lights_(mesh.lights.size()),
        vertex_numbers_(points.size(), kNone),
        umbra_(nodes.size(), 0) {}

  void run() {
    for (std::uint32_t f = 0; f < loops_.faces.size(); ++f) {
      add_face(f);
      count_corners(loops_.faces[f]);
    }
    for (const std::uint32_t vertex : numbered_) {
      mesh_.exact_points.push_back(std::move(points_.exact_points()[vertex]));
    }
    for (std::size_t light = 0; light < lights_; ++light) count_nodes(light);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using SampleKey = std::pair<std::uint32_t, std::uint64_t>;  // a node, and the lights that it sees
  struct SampleHash {
    std::size_t operator()(const SampleKey& key) const {
      const std::uint64_t hash = (key.second ^ key.first) * 0x9e3779b97f4a7c15u + key.first;
      return static_cast<std::size_t>(hash ^ hash >> 31);
    }
  };

  void add_face(std::uint32_t f) {
    const MeshFace& face = loops_.faces[f];
    const std::uint64_t shone_on = face.lit_by | face.penumbra_of;
    const std::uint64_t all = lights_ == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << lights_) - 1;
    MeshFace copy = face;
    copy.first = static_cast<std::uint32_t>(mesh_.corners.size());
    for (const std::uint32_t vertex : loops_.loop(face)) {
      const std::uint32_t node = nodes_.node(vertex, loops_, f);
      umbra_[node] |= all & ~shone_on;
      const std::uint32_t number = vertex_number(vertex);
      mesh_.corners.push_back({number, sample_number(number, node, shone_on)});
    }
    mesh_.faces.push_back(copy);
  }

  std::uint32_t vertex_number(std::uint32_t vertex) {
    std::uint32_t& number = vertex_numbers_[vertex];
    if (number == kNone) {
      number = static_cast<std::uint32_t>(mesh_.points.size());
      mesh_.points.push_back(points_.nearest(vertex));
      numbered_.push_back(vertex);
    }
    return number;
  }

  std::uint32_t sample_number(std::uint32_t vertex, std::uint32_t node, std::uint64_t shone_on) {
    const auto [at, is_new] = samples_.emplace(SampleKey(node, shone_on),
                                               static_cast<std::uint32_t>(mesh_.samples.size()));
    if (is_new) {
      mesh_.samples.push_back({vertex, nodes_[node].part, nodes_[node].side});
      for (std::size_t light = 0; light < lights_; ++light) {
        mesh_.values.push_back((shone_on >> light & 1) != 0 ? nodes_.value(node, light) : 0);
      }
    }
    return at->second;
  }

  void count_corners(const MeshFace& face) {
    for (std::size_t light = 0; light < lights_; ++light) {
      LightShadingStats& stats = mesh_.stats.lights[light];
      ((face.lit_by >> light & 1) != 0        ? stats.lit
       : (face.penumbra_of >> light & 1) != 0 ? stats.penumbra
                                              : stats.umbra) += face.count;
    }
  }

  /// Values for tests of adaptive subdivision count too: they were computed.
  void count_nodes(std::size_t light) {
    LightShadingStats& stats = mesh_.stats.lights[light];
    const std::uint64_t bit = std::uint64_t{1} << light;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if ((nodes_[n].known_lit & bit) != 0) {
        ++stats.illuminated_lit;
      } else if ((nodes_[n].known_penumbra & bit) != 0) {
        ++stats.illuminated_penumbra;
      }
      if ((umbra_[n] & bit) != 0) ++stats.illuminated_umbra;
    }
    stats.largest_error = nodes_.largest_error(light);
  }

  const FaceLoops& loops_;
  PointTable& points_;
  NodeTable& nodes_;
  ShadingMesh& mesh_;
  std::size_t lights_;
  std::vector<std::uint32_t> vertex_numbers_;  // by point; kNone: of no corner so far
  std::vector<std::uint32_t> numbered_;        // points by vertex number
  std::vector<std::uint64_t> umbra_;           // by node: lights in whose umbra some face has it
  std::unordered_map<SampleKey, std::uint32_t, SampleHash> samples_;
};

}  // namespace

void number_corners(const FaceLoops& loops, PointTable& points, NodeTable& nodes,
                    ShadingMesh& mesh) {
  CornerNumbering(loops, points, nodes, mesh).run();
}

}  // namespace gnomon
