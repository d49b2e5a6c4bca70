// SPDX-License-Identifier: LGPL-3.0-or-later
// The angular table of one light and one chart (Thakur, Cheng & Miura, section 3): in every row the
// spans of shadow of each object, from the crossings of its ridge loops, and the stretches of the
// faces that tell how far away it is.
//
// A span is where the sum of an object's crossings is more than zero: so many of its polygons face
// the light there. A stretch is one convex face between the two edges that cross the row, in
// duplicate with its neighbours' as section 3.3 has it.
//
// The same on every kernel, by integers: a kernel decides where samples are (table_look_up.h).
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_ANGULAR_TABLE_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_ANGULAR_TABLE_H

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/angular_table/ridge_pairs.h"
#include "algorithms/angular_table/table_intervals.h"
#include "algorithms/angular_table/table_objects.h"
#include "algorithms/partition/rules.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/work_counts.h"

namespace gnomon {

/// A crossing of an object's outline with the slabs [low, high) of a table without rows.
struct TableCrossing {
  RidgeCrossing crossing;
  std::uint32_t object = 0;
};

/// What a table is made for.
struct TableTask {
  const PreparedScene& scene;
  const std::vector<TableObject>& objects;
  std::span<const Sign> signs;  // of the parts' fronts at the light
  const MethodOptionValues& options;
  const Rules& rules;
};

/// The loops of all objects in a chart, and the rows that they are in: a table before it has
/// entries.
struct TableOutline {
  struct FaceLoop {
    std::uint32_t part = 0;
    bool faces = false;
    EdgeLoop loop;
  };
  struct ObjectLoops {
    std::vector<EdgeLoop> ridges;
    std::vector<FaceLoop> faces;  // that tell distances
  };

  TableOutline(const TableTask& task, const TableChart& chart);

  /// Of an object's ridge loops with the rows, paired as the options say.
  std::vector<RidgeCrossing> crossings(const TableTask& task, std::uint32_t object) const;
  template <class Use>
  void for_each_stretch(const FaceLoop& face, const Use& use) const;

  TableMesh mesh;
  std::vector<ObjectLoops> loops;
  std::optional<TableRows> rows;

 private:
  void add_loops(const TableTask& task);
  void make_rows(std::uint32_t count);
};

class AngularTable {
 public:
  AngularTable(const TableTask& task, const TableChart& chart);

  const TableMesh& mesh() const { return outline_.mesh; }
  const TableRows& rows() const { return *outline_.rows; }
  /// Of a table of rows: spans of objects, and stretches of parts.
  const IntervalRows& spans() const { return *spans_; }
  const IntervalRows& stretches() const { return *stretches_; }
  /// Of a table without rows, through a slab: crossings by objects, and stretches of parts.
  const std::vector<TableCrossing>& crossings() const { return crossings_; }
  const std::vector<TableInterval>& stretch_runs() const { return stretch_runs_; }
  const SlabRuns& crossings_in() const { return *crossings_in_; }
  const SlabRuns& stretches_in() const { return *stretches_in_; }

  void count(WorkCounts& work) const;

 private:
  void fill_rows(const TableTask& task);
  void fill_slabs(const TableTask& task);

  TableOutline outline_;  // its loops until the table is made
  std::optional<IntervalRows> spans_, stretches_;
  std::vector<TableCrossing> crossings_;
  std::vector<TableInterval> stretch_runs_;
  std::optional<SlabRuns> crossings_in_, stretches_in_;
  std::uint64_t ridge_loops_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_ANGULAR_TABLE_H
