// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/hidden_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "algorithms/hidden_lines/edge_survey.h"
#include "algorithms/hidden_lines/edge_to_viewer.h"
#include "algorithms/hidden_lines/seen_surface.h"

namespace gnomon {

namespace {

/// The edges that start or end in each vertex, as places in the list that was asked for.
class EdgesAtVertices {
 public:
  EdgesAtVertices(const Geometry& geometry, std::span<const EdgeId> edges)
      : first_(geometry.grid.size() + 1, 0), places_(2 * edges.size()) {
    for (const EdgeId edge : edges) {
      ++first_[geometry.edges[edge].a + 1];
      ++first_[geometry.edges[edge].b + 1];
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      places_[next[geometry.edges[edges[i]].a]++] = i;
      places_[next[geometry.edges[edges[i]].b]++] = i;
    }
  }
  std::span<const std::uint32_t> at(VertexId vertex) const {
    return {places_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }

 private:
  std::vector<std::uint32_t> first_, places_;
};

std::vector<LinePart> parts_of(const EdgeSurvey& survey, BothSides count) {
  std::vector<LinePart> parts;
  std::uint32_t hidden_by = count.larger();
  for (const Breakpoint& breakpoint : survey.breakpoints) {
    count += breakpoint.change;
    const std::uint32_t next = count.larger();
    if (next == hidden_by) continue;
    parts.push_back({breakpoint.parameter(), hidden_by});
    hidden_by = next;
  }
  parts.push_back({1, hidden_by});
  return parts;
}

/// Counts at the start of an edge, once for each connected piece of the drawing, and hands the
/// count on over the vertices.
class CountWalk {
 public:
  CountWalk(const SeenSurface& surface, std::span<const EdgeId> edges,
            const std::vector<std::optional<EdgeSurvey>>& surveys, const HiddenLineOptions& options,
            HiddenLines& result)
      : surface_(surface),
        edges_(edges),
        surveys_(surveys),
        options_(options),
        result_(result),
        at_(surface.scene().geometry, edges),
        is_clear_(surface.scene().geometry.grid.size(), true),
        in_front_(is_clear_.size()),
        is_done_(edges.size(), false) {
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      if (!surveys[i]) {
        is_done_[i] = true;
        continue;
      }
      const EdgeEnds ends = surface.ends(edges[i]);
      if (!surveys[i]->is_start_clear) is_clear_[ends.a] = false;
      if (!surveys[i]->is_end_clear) is_clear_[ends.b] = false;
    }
  }

  void walk() {
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
      if (is_done_[i]) continue;
      start_anew(i);
      while (!reached_.empty()) {
        const VertexId vertex = reached_.back();
        reached_.pop_back();
        hand_on(vertex);
      }
    }
  }

 private:
  void start_anew(std::uint32_t place) {
    ++result_.counted;
    finish(place, count_at_start(surface_, surface_.ends(edges_[place])));
  }

  /// All edges of a vertex begin with what is in front of it, and with those polygons of the vertex
  /// that hide what comes next.
  void hand_on(VertexId vertex) {
    const BothSides in_front{*in_front_[vertex], *in_front_[vertex]};
    for (const std::uint32_t place : at_.at(vertex)) {
      if (is_done_[place]) continue;
      if (options_.count_every_start) {
        start_anew(place);
        continue;
      }
      ++result_.handed_on;
      const EdgeSurvey& survey = *surveys_[place];
      finish(place, surface_.ends(edges_[place]).a == vertex
                        ? in_front + survey.at_start
                        : in_front + survey.at_end - change_along(survey));
    }
  }

  static BothSides change_along(const EdgeSurvey& survey) {
    BothSides change;
    for (const Breakpoint& breakpoint : survey.breakpoints) change += breakpoint.change;
    return change;
  }

  void finish(std::uint32_t place, BothSides start) {
    is_done_[place] = true;
    const EdgeSurvey& survey = *surveys_[place];
    result_.lines[place].parts = parts_of(survey, start);
    const EdgeEnds ends = surface_.ends(edges_[place]);
    reach(ends.a, start - survey.at_start);
    reach(ends.b, start + change_along(survey) - survey.at_end);
  }

  void reach(VertexId vertex, BothSides in_front) {
    if (!is_clear_[vertex] || in_front_[vertex]) return;
    in_front_[vertex] = in_front.left;  // as on the right, since the vertex is clear
    reached_.push_back(vertex);
  }

  const SeenSurface& surface_;
  std::span<const EdgeId> edges_;
  const std::vector<std::optional<EdgeSurvey>>& surveys_;
  const HiddenLineOptions& options_;
  HiddenLines& result_;
  EdgesAtVertices at_;
  std::vector<bool> is_clear_;                         // by vertex
  std::vector<std::optional<std::int64_t>> in_front_;  // by vertex: polygons that do not hold it
  std::vector<bool> is_done_;                          // by place
  std::vector<VertexId> reached_;                      // whose edges are to be looked at
};

}  // namespace

Expected<HiddenLines> hidden_lines(const PreparedScene& scene, const PreparedLight& light,
                                   std::span<const EdgeId> edges,
                                   const HiddenLineOptions& options) {
  const SeenSurface surface(scene, light);
  HiddenLines result;
  result.facing_polygons = surface.parts().size();
  result.contour_edges = surface.contour().size();
  result.lines.resize(edges.size());
  const auto stopped = [&] { return options.interrupted != nullptr && *options.interrupted; };
  std::vector<std::optional<EdgeSurvey>> surveys(edges.size());
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    if (stopped()) return;
    const EdgeEnds ends = surface.ends(edges[i]);
    result.lines[i].edge = edges[i];
    if (surface.signs().is_towards_viewer(ends.a, ends.b)) {
      result.lines[i].parts = parts_to_viewer(surface, ends, light);
    } else {
      surveys[i] = survey_edge(surface, ends);
    }
  });
  if (stopped()) return fail(ErrorCode::kInterrupted, "interrupted");
  CountWalk(surface, edges, surveys, options, result).walk();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    result.breakpoints += result.lines[i].parts.size() - 1;
    if (!surveys[i]) continue;
    result.contour_tests += surveys[i]->contour_tests;
    result.polygon_tests += surveys[i]->polygon_tests;
  }
  return result;
}

}  // namespace gnomon
