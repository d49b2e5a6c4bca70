// SPDX-License-Identifier: LGPL-3.0-or-later
// The sectors algorithm: shadows without any order of the polygons.
//
// Light space is cut by a tree of planes through the light: first into sectors of one chart each
// (for a point light the planes x = +-y and z = +- the larger of the two; a directional light has
// one chart), then by k-d splits. Polygons are clipped exactly to the cells. A polygon that covers
// a cell hides all that is behind its plane: that leaves the cell, whatever is there. In a leaf,
// from each receiver the nearer casters are subtracted, the largest first, until nothing is lit;
// the part of a caster that is nearer is cut off by the receiver's plane where the two cross. No
// order, no cycles, no coplanar groups: a polygon shadows another if it is nearer in some cell, and
// polygons of one plane are nowhere nearer than each other.
//
// Pieces of a polygon that have the same class and witness in both children of a cell are merged.
//
// Guarantee on exact kernels: the fragments tile the polygon and have the class and a witness of
// the definition (docs: semantics), whatever planes the heuristics choose. The result does not
// depend on the number of threads: cells down to a fixed size are made by one thread, everything
// below is independent, and sums are associative (fraction_sums.h). Explicit stack; memory is the
// items and loops of the cells on it, about 2.2 times those of the root. Reference: Slater, A
// comparison of three shadow volume algorithms (1992), for tiles; docs/algorithms.md.
#ifndef GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_H
#define GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_H

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algorithms/blots/blot_clipping.h"
#include "algorithms/partition/cone_clip.h"
#include "algorithms/partition/fraction_sums.h"
#include "algorithms/partition/import_export.h"
#include "algorithms/partition/light_region.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/piece_fractions.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/run_options.h"
#include "algorithms/partition/split.h"
#include "algorithms/sectors/sector_split.h"
#include "algorithms/two_pass/list_clipping.h"
#include "gnomon/algorithms/shadow_result.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// SectorState says what became of a polygon in a cell: the part that hides it, the number of parts
/// and the solid that does (LeafMethod::kBlots), or one of these.
using SectorState = std::uint32_t;
inline constexpr SectorState kAllLit = Fragment::kNoCaster;
inline constexpr SectorState kMixed = kAllLit - 1;  // pieces of several kinds, already put out
inline constexpr SectorState kUndecided = kAllLit - 2;

/// SectorOutput is what one task puts out. Outputs are concatenated in the order of tasks.
struct SectorOutput {
  struct Piece {
    std::uint32_t part;
    Fragment fragment;  // first: into the points of this output
  };
  std::vector<Piece> pieces;  // only if points are kept
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<mpq_class, 3>> exact_points;
  std::vector<std::vector<std::uint32_t>> caster_sets;         // of Fragment::casters
  std::vector<std::pair<std::uint32_t, mpq_class>> exact_lit;  // on request: part, lit fraction
  /// Of a piece behind `count` casters, its share of the part (LeafMethod::kCount).
  struct Counted {
    std::uint32_t part, count;
    Fraction share;
  };
  std::vector<Counted> counted;
  std::uint64_t piece_count = 0, nodes = 0, vanished = 0;
  WorkCounts work;
};

/// What is done in a leaf of the tree: the nearer casters subtracted from each receiver (sectors),
/// polygons clipped by each other in lists (two-pass), sub-objects by the outlines of those before
/// them (blots), or the nearer casters counted over each receiver. Then a SectorState is such a
/// number.
enum class LeafMethod : std::uint8_t { kSubtract, kTwoPass, kBlots, kCount };

/// SectorContext is what all threads share. Only its atomics change.
struct SectorContext {
  const PreparedScene& scene;
  const RunOptions& options;
  const Rules& rules;
  const FacingParts& facing;
  const PlaneCharts& charts;
  const LightPoint& light;
  std::span<const Ball> areas;           // twice the area of each part, by planar points
  std::span<const PairBall> pair_areas;  // the same in pairs, if the kernel has them
  FractionSums& sums;
  std::atomic<std::uint64_t>& pieces;  // so far
  std::atomic<bool>& stopped;          // interrupted, or too many pieces
  LeafMethod leaf_method = LeafMethod::kSubtract;
  /// Not empty: which planes of edges, by their numbers, are of the contour. They split cells then.
  std::span<const std::uint8_t> contour;
  const LightRegion* region = nullptr;    // null: everywhere
  bool all_cast = false;                  // parts that cast no shadow, too: the light is an eye
  const SolidsOfLight* solids = nullptr;  // LeafMethod::kBlots: its sub-objects
  Outlines outlines = Outlines::kPartial;

  bool casts(std::uint32_t part) const { return all_cast || scene.parts[part].casts; }
};

/// A cell of light space: which of the sector planes are still to come, and the chart after them.
struct SectorCell {
  friend bool operator==(const SectorCell&, const SectorCell&) = default;

  static constexpr int kChart = 4;
  int level = 0;  // 0: x = y, 1: x = -y, 2: z = s, 3: z = -s, s the larger of +-x, +-y
  bool above_first = false, above_second = false;
  LightChart chart;
};

template <SectorSpaceModel Space>
class SectorTree {
 public:
  using Vertex = typename Space::Vertex;
  /// The tree counts its pieces in SectorContext::pieces in batches of this size; whoever takes an
  /// output counts the last, incomplete batch.
  static constexpr std::uint64_t kPieceBatch = 1024;

  /// Task is a cell that one thread works off: its polygons are the items [begin, end) of the tree
  /// that made the task.
  struct Task {
    SectorCell cell;
    std::vector<PlaneRef> edges;  // planes of polygons' edges that bound the cell
    std::uint32_t begin = 0, end = 0;
    std::vector<SectorState> states;  // when done

    std::uint32_t size() const { return end - begin; }
  };

  SectorTree(const SectorContext& context, Space space)
      : context_(&context), space_(std::move(space)), is_far_(far_chart().has_value()) {}

  const SectorContext& context() const { return *context_; }
  Space& space() { return space_; }
  SectorOutput& output() { return output_; }
  LoopStore<Vertex>& loops() { return loops_; }

  /// The one chart of a far lamp, where the kernel has one.
  std::optional<LightChart> far_chart() const {
    if constexpr (requires { space_.far_chart(); }) {
      return space_.far_chart();
    } else {
      return std::nullopt;
    }
  }
  /// Adds the ten planes between the sectors. Call it once, before the space is forked.
  void add_sector_planes();
  /// Takes over the planes of another tree, whose space this tree's space is a fork of.
  void use_sector_planes(const SectorTree& other) {
    sector_planes_ = other.sector_planes_;
    first_cell_plane_ = other.first_cell_plane_;
  }

  /// The cell that holds a polygon as a whole, as far as the planes between the sectors tell.
  SectorCell cell_of(const LoopView<Vertex>& loop);
  /// Where the tree starts if nothing is known of its polygons.
  SectorCell root_cell() const;
  /// Finds the box and the depths of an item in the chart of a cell. Thread-safe.
  void locate(const LightChart& chart, SectorItem& item) const;
  /// Splits the cell that holds `items` (loops in loops()) down to cells of at most `task_size`,
  /// which become tasks. Call finish() when their states are known. `located`: items have boxes.
  std::vector<Task> plan(std::vector<SectorItem> items, const SectorCell& cell, bool located,
                         std::uint32_t task_size);
  void set_states(const Task& task);
  /// Joins the cells of plan() and returns the states of its items.
  std::span<const SectorState> finish();
  /// Puts out item i of plan() as a whole. Requires: finished, and its state is not kMixed.
  void emit_outside(const LoopRange& loop) {
    emit_inside(loop, Fragment::kNoCaster, ShadowReason::kOutsideRegion);
  }
  void emit_root(std::uint32_t i) {
    emit({items_[i].first, items_[i].count, items_[i].part}, states_[i]);
  }

  /// Does a task of another tree, leaving its states in it.
  void run(Task& task, const SectorTree& planner);

 private:
  /// Cells of so many times the size of a leaf that no k-d plane splits are split by edges of their
  /// polygons.
  static constexpr std::uint32_t kLargeLeaf = 4;

  struct Frame {
    SectorCell cell;
    std::uint32_t begin = 0, end = 0;  // items
    bool located = false;              // items have boxes
    int stage = 0;                     // 0: new; 1: front done; 2: both done
    std::uint32_t children = 0, middle = 0, children_end = 0;
    std::uint32_t loops_mark = 0, planes_mark = 0;
    PlaneRef edge;  // whose plane splits it, if one does
    SectorCell front_cell, back_cell;
  };
  struct Range {
    std::uint32_t begin, end;
  };
  struct BlotCell;
  /// LitPiece is a piece of a receiver that is lit so far; its box is made when it is needed.
  struct LitPiece {
    LoopRange loop;
    bool located = false;
    ChartBox box;
  };
  /// A piece of a receiver, and how many casters have been found to hide it.
  struct CountedPiece {
    LoopRange loop;
    std::uint32_t count = 0;
    bool located = false;
    ChartBox box;
  };
  enum class Relation : std::uint8_t { kNone, kBehind, kCrossing };

  bool is_small(std::uint32_t items) const { return items <= context_->options.tuning.leaf_size; }
  /// Blots have boxes, and boxes need a chart.
  bool wants_chart(const SectorCell& cell) const {
    return context_->leaf_method == LeafMethod::kBlots && cell.level < SectorCell::kChart;
  }
  void enter(SectorCell cell, Range items, bool located);
  void descend(std::uint32_t task_size, std::vector<Task>* tasks);
  bool stopped() const {
    const std::atomic<bool>* interrupted = context_->options.interrupted;
    if (interrupted != nullptr && interrupted->load(std::memory_order_relaxed)) {
      context_->stopped.store(true, std::memory_order_relaxed);
    }
    return context_->stopped.load(std::memory_order_relaxed);
  }
  /// Pieces that are not put out yet, as many as fragments may be, or their vertices: only a
  /// rounded kernel comes to that, whose cuts may go on for ever. Stops the run.
  bool gives_up(std::size_t open_pieces) {
    constexpr std::uint64_t kVerticesAFragment = 32;
    const std::uint64_t most = context_->options.limits.fragments;
    if (open_pieces <= most && loops_.size() / kVerticesAFragment <= most) return false;
    context_->pieces.fetch_add(most + 1, std::memory_order_relaxed);
    context_->stopped.store(true, std::memory_order_relaxed);
    return true;
  }
  LoopView<Vertex> view(const LoopRange& range) const {
    return loops_.view(range, context_->scene.parts[range.part].plane);
  }
  LoopView<Vertex> view(const SectorItem& item) const {
    return view(LoopRange{item.first, item.count, item.part});
  }
  /// Whether it bounds the cell at hand: a plane that was made for cells, or that of an edge which
  /// has split one.
  bool is_cell_plane(PlaneRef edge) const {
    return edge.index() >= first_cell_plane_ ||
           (edge.index() < bounds_cell_.size() && bounds_cell_[edge.index()] != 0);
  }
  bool is_of_contour(PlaneRef edge) const {
    const std::span<const std::uint8_t> contour = context_->contour;
    return edge.index() < contour.size() && contour[edge.index()] != 0;
  }
  void set_bounds_cell(PlaneRef edge, bool does) {
    if (edge.index() >= bounds_cell_.size()) bounds_cell_.resize(first_cell_plane_);
    bounds_cell_[edge.index()] = does ? 1 : 0;
  }

  ChartBox box_of(const LightChart& chart, const LoopView<Vertex>& loop) const;
  ChartPoint chart_point(const LightChart& chart, const Corner<Vertex>& corner) const {
    if constexpr (requires { space_.far_chart_point(chart, corner); }) {
      if (is_far_) return space_.far_chart_point(chart, corner);
    }
    return space_.chart_point(chart, corner);
  }
  PlaneRef add_split_plane(const ChartSplit& split, const LightChart& chart);
  std::uint32_t cull(std::uint32_t begin, std::uint32_t end);
  std::uint32_t move_decided_last(std::uint32_t begin, std::uint32_t end);
  bool covers(const SectorItem& item) const;
  bool is_behind(const SectorItem& item, std::uint32_t part);
  Relation relation(const SectorItem& receiver, const SectorItem& caster);
  bool split(Frame& frame, std::uint32_t open_end);
  bool split_by_sector_plane(Frame& frame, std::uint32_t open_end);
  PlaneRef next_sector_plane(const SectorCell& cell, SectorCell& above, SectorCell& below) const;
  std::vector<PlaneRef> splitting_edges() const;
  bool split_by_axis(Frame& frame, std::uint32_t open_end);
  bool split_by_edge(Frame& frame, std::uint32_t open_end, bool of_contour);
  PlaneRef choose_edge_plane(std::uint32_t begin, std::uint32_t end, bool of_contour);
  void partition(Frame& frame, std::uint32_t open_end, PlaneRef plane, const ChartSplit* split);
  /// `chart`: of the cell; null if it has none.
  void leaf(std::uint32_t begin, std::uint32_t end, const LightChart* chart);
  void subtract_casters(std::uint32_t receiver, std::span<const std::uint32_t> casters,
                        bool nearest_first, const LightChart* chart);
  void clip_lists(std::uint32_t begin, std::uint32_t end);
  void list_pieces(std::uint32_t begin, std::uint32_t end);
  void put_out_clipped();
  typename ListClipping<Space>::Setting list_setting() {
    return {space_,          context_->scene, context_->facing,  loops_,
            context_->rules, output_.work,    context_->all_cast};
  }
  void clip_by_blots(std::uint32_t begin, std::uint32_t end, const LightChart* chart);
  std::vector<std::uint32_t> faces_hiding(const LoopRange& loop, std::uint32_t solid);
  void name_caster(const LoopRange& loop, SectorState state, Fragment& fragment);
  void planes_between(const SectorItem& receiver, const SectorItem& caster, Relation how);
  void count_casters(std::uint32_t receiver, std::span<const std::uint32_t> casters,
                     const LightChart* chart);
  void put_counted(const LoopRange& loop, std::uint32_t count);
  void join(Range children);
  void emit(const LoopRange& loop, SectorState state);
  void emit_inside(const LoopRange& loop, SectorState state,
                   ShadowReason reason = ShadowReason::kNone);
  PairBall fraction_of(const LoopView<Vertex>& loop) const;
  void emit_area(const LoopRange& loop, bool lit);

  const SectorContext* context_;
  Space space_;
  bool is_far_;  // a far lamp, whose chart is far_chart()
  SectorOutput output_;
  std::array<PlaneRef, 10> sector_planes_;
  std::uint32_t first_cell_plane_ = 0;
  std::vector<std::uint8_t> bounds_cell_;  // by plane of an edge; empty: none does
  LoopStore<Vertex> loops_;
  std::vector<SectorItem> items_;
  std::vector<SectorState> states_;
  std::size_t root_size_ = 0;
  std::vector<Range> joins_;  // of plan(), children before parents
  std::vector<Frame> stack_;
  SplitChooser chooser_;
  std::unordered_map<std::uint32_t, mpq_class> exact_areas_;  // of parts, as needed
  // Workspace, kept to save allocations.
  SplitRecord record_;
  ConeClip<Space> clip_;
  RegionClip<Space> region_clip_;
  ListClipping<Space> lists_;
  BlotClipping<Space> blots_;
  std::vector<Vertex> crossings_;
  std::vector<SectorItem> front_items_;
  std::vector<std::uint32_t> order_;
  std::vector<LitPiece> lit_, still_lit_;
  std::vector<CountedPiece> counted_, next_counted_;
  std::vector<PlaneRef> caster_planes_;
  std::vector<ListPiece> pieces_;
  std::vector<ClippedPiece> clipped_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_SECTOR_TREE_H
