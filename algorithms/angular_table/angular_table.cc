// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/angular_table/angular_table.h"

#include <algorithm>
#include <utility>

#include "algorithms/angular_table/row_spans.h"
#include "gnomon/algorithms/facing_sides.h"

namespace gnomon {

TableOutline::TableOutline(const TableTask& task, const TableChart& chart)
    : mesh(task.scene, chart) {
  add_loops(task);
  make_rows(task.options.rows);
}

/// The facing polygons of each object make its ridge loops; they, or those that the light sees from
/// behind, tell distances.
void TableOutline::add_loops(const TableTask& task) {
  const std::vector<Side> facing = facing_sides(task.scene, task.signs);
  const bool hidden = task.options.depth == TableDepth::kHidden;
  for (const TableObject& object : task.objects) {
    ObjectLoops& own = loops.emplace_back();
    std::vector<EdgeLoop> chain;
    for (const std::uint32_t p : object.component.parts) {
      const Part& part = task.scene.parts[p];
      const bool faces = facing[p] != Side::kOn;
      // A polygon that the light sees edge-on tells nothing.
      if (!part.casts || task.signs[p] == Sign::kZero || !(faces || hidden)) continue;
      EdgeLoop loop = mesh.add(part, faces ? facing[p] : Side::kFront);
      if (loop.empty()) continue;
      if (faces) chain.push_back(loop);
      if (faces != hidden) own.faces.push_back({p, faces, std::move(loop)});
    }
    own.ridges = mesh.ridge_loops(chain);
  }
}

void TableOutline::make_rows(std::uint32_t count) {
  std::vector<bool> counts(mesh.vertices().size(), false);
  const auto add = [&](const EdgeLoop& loop) {
    for (const DirectedEdge edge : loop) counts[mesh.from(edge)] = true;
  };
  for (const ObjectLoops& object : loops) {
    for (const EdgeLoop& loop : object.ridges) add(loop);
    for (const FaceLoop& face : object.faces) add(face.loop);
  }
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < counts.size(); ++v) {
    if (counts[v]) used.push_back(v);
  }
  rows.emplace(mesh, used, count);
}

/// use(begin, end, low, high): the rows [low, high) cross the face between these two edges. A
/// convex loop goes up once and down once.
template <class Use>
void TableOutline::for_each_stretch(const FaceLoop& face, const Use& use) const {
  std::vector<RidgeCrossing> left, right;
  for (const RidgeCrossing& one : crossings_of(mesh, *rows, face.loop)) {
    // Loops of hidden faces turn the other way.
    ((one.sense > 0) == face.faces ? left : right).push_back(one);
  }
  std::ranges::sort(left, {}, &RidgeCrossing::low);
  std::ranges::sort(right, {}, &RidgeCrossing::low);
  for (std::size_t l = 0, r = 0; l < left.size() && r < right.size();) {
    const std::uint32_t low = std::max(left[l].low, right[r].low);
    const std::uint32_t high = std::min(left[l].high, right[r].high);
    if (low < high) use(left[l].edge, right[r].edge, low, high);
    if (left[l].high == high) ++l;
    if (right[r].high == high) ++r;
  }
}

std::vector<RidgeCrossing> TableOutline::crossings(const TableTask& task,
                                                   std::uint32_t object) const {
  const bool is_right = task.rules.crossings_pair_by_arcs && task.rules.holes_have_a_direction;
  std::vector<RidgeCrossing> crossings;
  for (const EdgeLoop& loop : loops[object].ridges) {
    std::vector<RidgeCrossing> own;
    if (!is_right) {
      own = misread_crossings(mesh, *rows, loop, task.rules);
    } else if (task.options.pairing == Pairing::kPeaks) {
      for (const RidgePair& pair : pairs_by_peaks(mesh, *rows, loop)) {
        own.push_back({pair.enter, 1, pair.low, pair.high});
        own.push_back({pair.leave, -1, pair.low, pair.high});
      }
    } else {
      own = crossings_of(mesh, *rows, loop);
    }
    crossings.insert(crossings.end(), own.begin(), own.end());
  }
  return crossings;
}

AngularTable::AngularTable(const TableTask& task, const TableChart& chart) : outline_(task, chart) {
  for (const auto& object : outline_.loops) ridge_loops_ += object.ridges.size();
  if (rows().is_exact()) {
    fill_slabs(task);
  } else {
    fill_rows(task);
  }
  outline_.loops = {};
}

void AngularTable::fill_rows(const TableTask& task) {
  std::vector<TableInterval> spans, stretches;
  std::vector<std::uint32_t> row_of_span, row_of_stretch;
  std::vector<std::vector<RowCrossing>> crossings(rows().count());
  std::vector<std::uint32_t> used;
  for (std::uint32_t o = 0; o < outline_.loops.size(); ++o) {
    for (const RidgeCrossing& one : outline_.crossings(task, o)) {
      for (std::uint32_t k = one.low; k < one.high; ++k) {
        if (crossings[k].empty()) used.push_back(k);
        crossings[k].push_back({one.edge, one.sense});
      }
    }
    for (const std::uint32_t k : used) {
      sort_along(RowOrder(mesh(), rows().middle(k)), crossings[k]);
      for_each_span(std::span<const RowCrossing>(crossings[k]),
                    [&](std::uint32_t begin, std::uint32_t end) {
                      spans.push_back({begin, end, o});
                      row_of_span.push_back(k);
                    });
      crossings[k].clear();
    }
    used.clear();
    for (const TableOutline::FaceLoop& face : outline_.loops[o].faces) {
      outline_.for_each_stretch(
          face, [&](std::uint32_t begin, std::uint32_t end, std::uint32_t low, std::uint32_t high) {
            for (std::uint32_t k = low; k < high; ++k) {
              stretches.push_back({begin, end, face.part});
              row_of_stretch.push_back(k);
            }
          });
    }
  }
  spans_.emplace(mesh(), rows(), spans, row_of_span);
  stretches_.emplace(mesh(), rows(), stretches, row_of_stretch);
}

void AngularTable::fill_slabs(const TableTask& task) {
  crossings_in_.emplace(rows().count());
  stretches_in_.emplace(rows().count());
  for (std::uint32_t o = 0; o < outline_.loops.size(); ++o) {
    for (const RidgeCrossing& one : outline_.crossings(task, o)) {
      crossings_in_->add(static_cast<std::uint32_t>(crossings_.size()), one.low, one.high);
      crossings_.push_back({one, o});
    }
    for (const TableOutline::FaceLoop& face : outline_.loops[o].faces) {
      outline_.for_each_stretch(
          face, [&](std::uint32_t begin, std::uint32_t end, std::uint32_t low, std::uint32_t high) {
            stretches_in_->add(static_cast<std::uint32_t>(stretch_runs_.size()), low, high);
            stretch_runs_.push_back({begin, end, face.part});
          });
    }
  }
}

void AngularTable::count(WorkCounts& work) const {
  work[Counter::kRidgeLoops] += ridge_loops_;
  work[Counter::kTableRows] += rows().count();
  std::uint64_t bytes = mesh().bytes();
  if (rows().is_exact()) {
    // Two crossings make a span.
    work[Counter::kTableSpans] += crossings_.size() / 2;
    work[Counter::kTableStretches] += stretch_runs_.size();
    bytes += crossings_.size() * sizeof(TableCrossing) +
             stretch_runs_.size() * sizeof(TableInterval) + crossings_in_->bytes() +
             stretches_in_->bytes();
  } else {
    work[Counter::kTableSpans] += spans_->size();
    work[Counter::kTableStretches] += stretches_->size();
    bytes += spans_->bytes() + stretches_->bytes();
  }
  work[Counter::kTableBytes] += bytes;
}

}  // namespace gnomon
