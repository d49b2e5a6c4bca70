// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/repair/snap.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "gnomon/scene/intent.h"
#include "gnomon/scene/unusable.h"
#include "scene/intent/near_vertices.h"

namespace gnomon::scene_detail {

namespace {

/// Twice the area vector of a loop.
RationalPoint area_of(const Scene& scene, const std::vector<VertexId>& loop) {
  const auto at = [&](VertexId vertex) {
    const Position& p = scene.vertices[vertex];
    return RationalPoint{p[0].exact(), p[1].exact(), p[2].exact()};
  };
  RationalPoint sum;
  const RationalPoint first = at(loop[0]);
  for (std::size_t i = 2; i < loop.size(); ++i) {
    sum = moved(sum, 1, cross_product(at(loop[i - 1]) - first, at(loop[i]) - first));
  }
  return sum;
}

class Snapping {
 public:
  Snapping(Scene& scene, const mpq_class& distance)
      : scene_(scene), distance_(distance), original_(scene.vertices) {}

  Expected<SnapReport> run() {
    constexpr std::size_t kMostRounds = 30;
    for (; report_.rounds < kMostRounds; ++report_.rounds) {
      auto moved = merge_vertices();
      if (!moved) return tl::unexpected(std::move(moved.error()));
      if (*moved) continue;
      moved = flatten();
      if (!moved) return tl::unexpected(std::move(moved.error()));
      if (*moved) continue;
      report_.settled = true;
      break;
    }
    return finish();
  }

 private:
  using Before = std::map<std::uint32_t, Position>;  // of vertices of the scene that moved

  Expected<std::unique_ptr<SnapRound>> next_round() {
    auto prepared = prepare(scene_);
    if (!prepared) return tl::unexpected(std::move(prepared.error()));
    positions_ = prepared->geometry.positions.size();
    if (first_positions_ == 0) first_positions_ = positions_;
    return std::make_unique<SnapRound>(scene_, *std::move(prepared));
  }

  bool is_pinned(const SnapRound& round, VertexId vertex) const {
    return std::ranges::any_of(round.inputs(vertex),
                               [&](std::uint32_t i) { return pinned_.contains(i); });
  }

  Expected<bool> merge_vertices() {
    auto next = next_round();
    if (!next) return tl::unexpected(std::move(next.error()));
    SnapRound& round = **next;
    const auto pairs =
        find_near_vertices(round.prepared(), round.points(), not_less_than(distance_));
    // The first of a cluster stays, and those near it come to it.
    std::map<VertexId, bool> stays;
    std::vector<std::pair<VertexId, VertexId>> merges;
    for (const NearlySharedVertices& pair : pairs) {
      VertexId to = pair.a, from = pair.b;
      if (is_pinned(round, from)) std::swap(to, from);
      if (is_pinned(round, from)) continue;
      if (stays.contains(from) || (stays.contains(to) && !stays[to])) continue;
      if (square_of(round.at(to) - round.at(from)) > distance_ * distance_) continue;
      stays[to] = true;
      stays[from] = false;
      merges.emplace_back(from, to);
    }
    Before before;
    for (const auto& [from, to] : merges) {
      const Position position = scene_.vertices[round.inputs(to)[0]];
      for (const std::uint32_t i : round.inputs(from)) put(i, position, before);
    }
    take_back_folds(round, before);
    return !before.empty();
  }

  Expected<bool> flatten() {
    auto next = next_round();
    if (!next) return tl::unexpected(std::move(next.error()));
    SnapRound& round = **next;
    const std::size_t planes = flatten_planes(round, distance_, pinned_);
    Before before;
    for (VertexId vertex = 0; vertex < round.prepared().geometry.positions.size(); ++vertex) {
      const Position& now = scene_.vertices[round.inputs(vertex)[0]];
      const RationalPoint& to = round.at(vertex);
      if (now[0].exact() == to[0] && now[1].exact() == to[1] && now[2].exact() == to[2]) continue;
      Position position;
      for (std::size_t k = 0; k < 3; ++k) position[k] = to_number(to[k], scene_.numbers);
      for (const std::uint32_t i : round.inputs(vertex)) put(i, position, before);
    }
    take_back_folds(round, before);
    if (!before.empty()) report_.planes += planes;
    return !before.empty();
  }

  void put(std::uint32_t vertex, const Position& position, Before& before) {
    before.emplace(vertex, scene_.vertices[vertex]);
    scene_.vertices[vertex] = position;
  }

  /// Puts the vertices of polygons that fold back to where they were, and keeps them there.
  void take_back_folds(const SnapRound& round, Before& before) {
    while (!before.empty()) {
      const std::vector<std::uint32_t> folding = folding_polygons(round, before);
      if (folding.empty()) return;
      for (const std::uint32_t polygon : folding) {
        folding_.insert(polygon);
        for (const VertexId vertex : round.outline(polygon)) {
          for (const std::uint32_t i : round.inputs(vertex)) {
            pinned_.insert(i);
            const auto moved = before.find(i);
            if (moved == before.end()) continue;
            scene_.vertices[i] = std::move(moved->second);
            before.erase(moved);
          }
        }
      }
    }
  }

  /// Polygons with moved vertices that have turned over, lost their area or cross themselves.
  std::vector<std::uint32_t> folding_polygons(const SnapRound& round, const Before& before) const {
    std::set<std::uint32_t> touched;
    for (const auto& [vertex, position] : before) {
      const VertexId at = round.prepared().vertex_of_input[vertex];
      for (const std::uint32_t polygon : round.polygons_at(at)) touched.insert(polygon);
    }
    Scene part;
    part.vertices = scene_.vertices;
    std::vector<std::uint32_t> names, folding;
    for (const std::uint32_t polygon : touched) {
      const auto& first_part = round.prepared().first_part;
      if (first_part[polygon] == first_part[polygon + 1]) continue;  // had no area before
      if (turns_over(polygon, before)) {
        folding.push_back(polygon);
      } else {
        part.polygons.push_back(scene_.polygons[polygon]);
        names.push_back(polygon);
      }
    }
    if (const auto problems = unusable_polygons(part)) {
      for (const PolygonProblem& problem : *problems) folding.push_back(names[problem.polygon]);
    }
    return folding;
  }

  bool turns_over(std::uint32_t polygon, const Before& before) const {
    const std::vector<VertexId>& loop = scene_.polygons[polygon].loop;
    Scene earlier;
    std::vector<VertexId> indices;
    for (const VertexId vertex : loop) {
      const auto moved = before.find(vertex);
      indices.push_back(static_cast<VertexId>(earlier.vertices.size()));
      earlier.vertices.push_back(moved == before.end() ? scene_.vertices[vertex] : moved->second);
    }
    return dot_product(area_of(earlier, indices), area_of(scene_, loop)) <= 0;
  }

  Expected<SnapReport> finish() {
    auto last = next_round();
    if (!last) return tl::unexpected(std::move(last.error()));
    const Intent intent =
        find_intent(scene_, (*last)->prepared(), {.near = not_less_than(distance_)});
    report_.merged_vertices = first_positions_ - positions_;
    report_.pairs_left = intent.nearly_coplanar.size();
    report_.bent_left = intent.bent.size();
    for (const std::uint32_t polygon : folding_) {
      report_.folding.push_back(scene_.polygons[polygon].id);
    }
    mpq_class farthest = 0;
    for (std::size_t i = 0; i < original_.size(); ++i) {
      const Position &from = original_[i], &to = scene_.vertices[i];
      if (from == to) continue;
      RationalPoint way;
      for (std::size_t k = 0; k < 3; ++k) way[k] = to[k].exact() - from[k].exact();
      farthest = std::max(farthest, mpq_class(square_of(way)));
      ++report_.moved_vertices;
    }
    report_.largest_movement = std::sqrt(farthest.get_d());
    for (const Position& position : scene_.vertices) {
      for (const Number& number : position) {
        if (scene_.numbers == NumberMeaning::kDouble && !number.is_double()) {
          report_.became_decimal = true;
        }
      }
    }
    if (report_.became_decimal) scene_.numbers = NumberMeaning::kDecimal;
    return std::move(report_);
  }

  Scene& scene_;
  const mpq_class& distance_;
  const std::vector<Position> original_;
  std::set<std::uint32_t> pinned_;                   // vertices of the scene
  std::set<std::uint32_t> folding_;                  // polygons
  std::size_t first_positions_ = 0, positions_ = 0;  // distinct, of the first round and the last
  SnapReport report_;
};

}  // namespace

Expected<SnapReport> snap(Scene& scene, const mpq_class& distance) {
  return Snapping(scene, distance).run();
}

}  // namespace gnomon::scene_detail
