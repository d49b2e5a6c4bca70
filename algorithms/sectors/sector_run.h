// SPDX-License-Identifier: LGPL-3.0-or-later
// The sectors method from a prepared scene to a result, light by light, on several threads.
#ifndef GNOMON_ALGORITHMS_SECTORS_SECTOR_RUN_H
#define GNOMON_ALGORITHMS_SECTORS_SECTOR_RUN_H

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "algorithms/partition/run_task.h"
#include "algorithms/sectors/by_sectors.h"
#include "algorithms/sectors/sector_tree.inl.h"
#include "gnomon/algorithms/facing_chain.h"
#include "kernel/concept/kernel_model.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

/// The parts that take part in a run, in order, and which of them receive; the others only cast,
/// and the result says nothing of them. Nothing: all that face the light do both.
struct SectorSubset {
  std::span<const std::uint32_t> parts;
  std::span<const std::uint8_t> receives;
};

template <SectorSpaceModel Space>
class SectorRun {
 public:
  using SceneSpace = typename Space::SceneSpace;
  using Vertex = typename Space::Vertex;
  using Tree = SectorTree<Space>;

  /// Call everything in an arena of `jobs` threads.
  SectorRun(const PreparedScene& scene, const RunOptions& options, const Rules& rules,
            SceneSpace& scene_space, std::uint32_t light, Space space, FacingParts facing,
            LeafMethod leaf_method, Cover cover, const SectorSubset& subset = {})
      : leaf_method_(leaf_method),
        cover_(cover),
        scene_(scene),
        options_(options),
        rules_(rules),
        scene_space_(scene_space),
        light_(scene.lights[light].point),
        jobs_(Space::kParallel && options.tuning.jobs != 1 ? options.tuning.jobs : 1),
        space_(std::move(space)),
        facing_(std::move(facing)),
        charts_(charts_of(scene.geometry)),
        areas_(scene.parts.size()),
        pair_areas_(kHasPairs && !subset.parts.empty() ? scene.parts.size() : 0),
        sums_(scene.parts.size()),
        receives_(subset.receives) {
    if (!subset.parts.empty()) facing_.parts.assign(subset.parts.begin(), subset.parts.end());
    result_.light = light;
    result_.facing_parts = facing_.parts.size();
    result_.facing_edges = facing_.edges;
  }

  /// Cells are split by planes through edges of the contour of what casts, not at values of axes.
  /// Call it before run().
  void split_by_contour();
  /// LeafMethod::kBlots: the convex solids of the scene. Call it before run().
  void take_solids(std::span<const std::vector<std::uint32_t>> solids, Outlines outlines) {
    all_solids_ = solids;
    outlines_ = outlines;
  }
  /// Only in this region of the light's, by which the facing parts were chosen.
  void shine_in(LightRegion region) { region_ = std::move(region); }
  /// `progress` gets the share of the work that is done, from one thread at a time.
  RunOutcome run(const std::function<void(double)>& progress);
  LightResult finish();
  /// What there is in place of classes where casters are counted.
  CasterCounts count_shares();
  StageCounts stage_counts() const { return stages_; }

 private:
  /// Calls body(begin, end) for ranges of [0, n), on as many threads as asked for.
  template <class Body>
  void in_parallel(std::uint32_t n, const Body& body) const {
    if (jobs_ == 1) {
      body(std::uint32_t{0}, n);
      return;
    }
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, n, 4096),
                      [&](const auto& range) { body(range.begin(), range.end()); });
  }
  std::vector<SectorItem> import(LoopStore<Vertex>& loops);
  /// The number, in its part, of an edge of an imported loop (import_loop).
  static std::uint32_t input_edge(const SectorItem& item, bool reversed, std::uint32_t k) {
    return reversed ? (2 * item.count - 2 - k) % item.count : k;
  }
  /// A kernel that has planar points of its own needs no charts.
  static PlaneCharts charts_of(const Geometry& geometry) {
    if constexpr (requires(const Space& space, const Corner<Vertex>& corner) {
                    space.planar_point(corner);
                  }) {
      return {};
    } else {
      return PlaneCharts(geometry);
    }
  }
  /// Twice the area of a whole part, good for fractions of it.
  Ball enclosed_area(const LoopView<Vertex>& loop) const { return enclosed_area_of(space_, loop); }
  Ball enclosed_area_of(const Space& space, const LoopView<Vertex>& loop) const {
    constexpr double kNarrow = PartMeasure<Space>::kWidest / 16;
    const Ball area = twice_area(space, charts_, loop, std::numeric_limits<double>::infinity());
    if (area.radius < kNarrow * area.middle) return area;
    return twice_area(space, charts_, loop, 0);
  }
  /// The same in pairs of doubles, of kernels that have their points in them.
  static constexpr bool kHasPairs = requires(const Space& space, const Corner<Vertex>& corner) {
    space.pair_planar_point(corner);
  };
  PairBall enclosed_pair_area(const LoopView<Vertex>& loop) const {
    return twice_pair_area(loop,
                           [&](const auto& corner) { return space_.pair_planar_point(corner); });
  }
  void put_out_dropped(Tree& planner);
  SectorCell common_cell(Tree& planner, std::span<const SectorItem> items);

  LeafMethod leaf_method_;
  Cover cover_;
  const PreparedScene& scene_;
  const RunOptions& options_;
  const Rules& rules_;
  SceneSpace& scene_space_;
  const LightPoint& light_;
  unsigned jobs_;
  Space space_;
  FacingParts facing_;
  LightRegion region_;
  PlaneCharts charts_;
  std::vector<Ball> areas_;
  std::vector<PairBall> pair_areas_;
  FractionSums sums_;
  /// If cells are split there: by plane of an edge, whether it is of the contour.
  std::vector<std::uint8_t> contour_;
  std::span<const std::vector<std::uint32_t>> all_solids_;
  SolidsOfLight solids_;
  Outlines outlines_ = Outlines::kPartial;
  std::span<const std::uint8_t> receives_;  // of facing_.parts; empty: all do
  std::vector<SectorState> states_;         // of facing_.parts
  std::vector<SectorOutput> outputs_;
  StageCounts stages_;
  LightResult result_;
};

template <SectorSpaceModel Space>
void SectorRun<Space>::split_by_contour() {
  std::vector<Side> sides;
  for (const Facing& facing : facing_.facing) {
    sides.push_back(facing.faces() ? facing.side : Side::kOn);
  }
  contour_.assign(scene_.geometry.edges.size(), 0);
  for (const ContourEdge& edge : facing_chain(scene_, sides).contour) {
    contour_[edge.edge.index()] = 1;
  }
}

/// Facing parts as loops and items, in order.
template <SectorSpaceModel Space>
std::vector<SectorItem> SectorRun<Space>::import(LoopStore<Vertex>& loops) {
  const auto count = static_cast<std::uint32_t>(facing_.parts.size());
  std::vector<SectorItem> items(count);
  std::uint32_t first = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t part = facing_.parts[i];
    items[i].part = part;
    items[i].first = first;
    items[i].count = scene_.parts[part].count;
    items[i].receives = receives_.empty() || receives_[i] != 0;
    first += items[i].count;
  }
  loops.resize(first);
  const auto import_range = [&](std::uint32_t begin, std::uint32_t end) {
    LoopStore<typename SceneSpace::Vertex> whole;
    for (std::uint32_t i = begin; i < end; ++i) {
      const SectorItem& item = items[i];
      const bool reversed = facing_.facing[item.part].side == Side::kBack;
      import_loop(space_, part_loop(scene_space_, scene_, item.part, whole), reversed, loops,
                  item.first);
      if (!space_.knows_identity()) {  // planes of edges are computed here, once a polygon
        for (std::uint32_t k = 0; k < item.count; ++k) {
          PlaneRef& edge = loops.edge(item.first + k);
          const bool of_contour =
              !contour_.empty() &&
              contour_[scene_.edges(scene_.parts[item.part])[input_edge(item, reversed, k)]
                           .index()] != 0;
          edge = space_.shadow_plane(edge, loops.vertex(item.first + k),
                                     loops.vertex(item.first + (k + 1 == item.count ? 0 : k + 1)));
          if (of_contour) {
            contour_.resize(std::max<std::size_t>(contour_.size(), edge.index() + 1));
            contour_[edge.index()] = 1;
          }
        }
      }
      const LoopView<Vertex> loop =
          loops.view({item.first, item.count, item.part}, scene_.parts[item.part].plane);
      areas_[item.part] = enclosed_area(loop);
      if constexpr (kHasPairs) {
        if (!pair_areas_.empty() && item.receives)
          pair_areas_[item.part] = enclosed_pair_area(loop);
      }
    }
  };
  // Of a few parts, each edge's plane is made when it is met.
  if (space_.knows_identity() && receives_.empty()) {
    in_parallel(
        static_cast<std::uint32_t>(scene_.geometry.edges.size()),
        [&](std::uint32_t begin, std::uint32_t end) { space_.make_edge_planes(begin, end); });
    in_parallel(count, import_range);
  } else {
    import_range(0, count);
  }
  return items;
}

/// The sector that holds all polygons, as for a lamp outside the scene; else where the tree starts.
template <SectorSpaceModel Space>
SectorCell SectorRun<Space>::common_cell(Tree& planner, std::span<const SectorItem> items) {
  const auto count = static_cast<std::uint32_t>(items.size());
  const auto view = [&](std::uint32_t i) {
    const SectorItem& item = items[i];
    return planner.loops().view({item.first, item.count, item.part}, scene_.parts[item.part].plane);
  };
  if (count == 0) return planner.root_cell();
  const SectorCell cell = planner.cell_of(view(0));
  if (cell.level < SectorCell::kChart) return planner.root_cell();
  std::atomic<bool> all = true;
  const auto test = [&](Tree& tree, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end && all.load(std::memory_order_relaxed); ++i) {
      if (tree.cell_of(view(i)) != cell) all.store(false, std::memory_order_relaxed);
    }
  };
  // Without identity a fork has to copy the planes of all edges. With it, decisions are a fork's
  // and not counted: how many there are depends on the threads.
  const auto test_in_fork = [&](std::uint32_t begin, std::uint32_t end) {
    Tree tree(planner.context(), planner.space().fork());
    tree.use_sector_planes(planner);
    test(tree, begin, end);
  };
  if (!planner.space().knows_identity()) {
    test(planner, 1, count);
  } else if (jobs_ == 1) {
    test_in_fork(1, count);
  } else {
    constexpr std::uint64_t kRanges = 16;
    tbb::parallel_for(std::uint64_t{0}, kRanges, [&](std::uint64_t range) {
      test_in_fork(static_cast<std::uint32_t>(count * range / kRanges),
                   static_cast<std::uint32_t>(count * (range + 1) / kRanges));
    });
  }
  return all ? cell : planner.root_cell();
}

template <SectorSpaceModel Space>
RunOutcome SectorRun<Space>::run(const std::function<void(double)>& progress) {
  // Cells of this size are worked off by one thread; the same whatever the number of threads.
  constexpr std::uint32_t kSmallestTask = 256, kLargestTask = 16384, kTasks = 128;
  std::atomic<std::uint64_t> pieces = 0;
  std::atomic<bool> stopped = false, no_ieee = false;
  LoopStore<Vertex> loops;
  std::vector<SectorItem> items = import(loops);
  if (!all_solids_.empty()) {
    solids_ = solids_of_light(scene_, all_solids_, facing_, std::span(std::as_const(items)), loops);
  }
  const SectorContext context{scene_,
                              options_,
                              rules_,
                              facing_,
                              charts_,
                              light_,
                              areas_,
                              pair_areas_,
                              sums_,
                              pieces,
                              stopped,
                              leaf_method_,
                              contour_,
                              region_.is_everywhere() ? nullptr : &region_,
                              scene_.lights[result_.light].is_eye,
                              &solids_,
                              outlines_};
  Tree planner(context, std::move(space_));
  planner.add_sector_planes();
  planner.loops() = std::move(loops);
  const auto total = static_cast<std::uint32_t>(items.size());
  const std::uint32_t task_size = options_.tuning.task_size != 0
                                      ? options_.tuning.task_size
                                      : std::clamp(total / kTasks, kSmallestTask, kLargestTask);
  const SectorCell cell = common_cell(planner, items);
  const bool located = cell.level == SectorCell::kChart;
  if (located) {
    in_parallel(total, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) planner.locate(cell.chart, items[i]);
    });
  }
  auto tasks = planner.plan(std::move(items), cell, located, task_size);

  std::uint64_t work = 1, done = 0;
  for (const auto& task : tasks) work += task.size();
  std::mutex progress_mutex;
  outputs_.resize(tasks.size() + 1);
  tbb::enumerable_thread_specific<std::unique_ptr<Tree>> trees;
  const auto count_rest = [&](const SectorOutput& output) {
    pieces += output.piece_count % Tree::kPieceBatch;
    if (pieces > options_.limits.fragments) stopped.store(true, std::memory_order_relaxed);
  };
  const auto run_task = [&](std::size_t i) {
    if (stopped.load(std::memory_order_relaxed)) return;
    std::unique_ptr<Tree>& tree = trees.local();
    if (!tree) {
      if (!check_fp_environment()) {
        no_ieee.store(true);
        stopped.store(true);
        return;
      }
      tree = std::make_unique<Tree>(context, planner.space().fork());
      tree->use_sector_planes(planner);
    }
    tree->run(tasks[i], planner);
    outputs_[i] = std::exchange(tree->output(), {});
    count_rest(outputs_[i]);
    if (!progress) return;
    const std::lock_guard lock(progress_mutex);
    done += tasks[i].size();
    progress(static_cast<double>(done) / static_cast<double>(work));
  };
  if (jobs_ == 1) {
    for (std::size_t i = 0; i < tasks.size(); ++i) run_task(i);
  } else {
    tbb::parallel_for(std::size_t{0}, tasks.size(), run_task);
  }
  if (stopped) {
    if (no_ieee) return RunOutcome::kNoIeee;
    return pieces > options_.limits.fragments ? RunOutcome::kTooManyFragments
                                              : RunOutcome::kInterrupted;
  }
  for (const auto& task : tasks) planner.set_states(task);
  const auto states = planner.finish();
  states_.assign(states.begin(), states.end());
  for (const std::unique_ptr<Tree>& tree : trees) stages_ += tree->space().stage_counts();
  stages_ += planner.space().stage_counts();
  // A part with one class and caster is put out as it came in (1989, sec. 6).
  for (std::uint32_t i = 0; i < states_.size(); ++i) {
    if (!receives_.empty() && receives_[i] == 0) states_[i] = kUndecided;
    if (leaf_method_ == LeafMethod::kCount) continue;  // count_shares() has them
    if (states_[i] != kMixed && states_[i] != kUndecided) planner.emit_root(i);
    // Its pieces are put out as what they are in the region.
    if (region_.place(facing_.parts[i]) != RegionPlace::kInside) states_[i] = kMixed;
  }
  put_out_dropped(planner);
  outputs_.back() = std::move(planner.output());
  count_rest(outputs_.back());
  return pieces > options_.limits.fragments ? RunOutcome::kTooManyFragments : RunOutcome::kDone;
}

/// Parts that were left out, since they are outside of the region with all of their shadow.
template <SectorSpaceModel Space>
void SectorRun<Space>::put_out_dropped(Tree& planner) {
  if (region_.is_everywhere()) return;
  LoopStore<typename SceneSpace::Vertex> whole;
  for (std::uint32_t part = 0; part < scene_.parts.size(); ++part) {
    if (!region_.is_dropped(part)) continue;
    LoopStore<Vertex>& loops = planner.loops();
    const LoopRange range{loops.size(), scene_.parts[part].count, part};
    loops.resize(range.first + range.count);
    const bool reversed = facing_.facing[part].side == Side::kBack;
    import_loop(planner.space(), part_loop(scene_space_, scene_, part, whole), reversed, loops,
                range.first);
    areas_[part] = enclosed_area_of(planner.space(), loops.view(range, scene_.parts[part].plane));
    planner.emit_outside(range);
    loops.truncate(range.first);
  }
}

template <SectorSpaceModel Space>
LightResult SectorRun<Space>::finish() {
  std::vector<FractionSum> exact(options_.output.exact_fractions ? scene_.parts.size() : 0);
  for (SectorOutput& output : outputs_) {
    result_.fragment_total += output.piece_count;
    result_.tree_nodes += output.nodes;
    result_.dropped_slivers += output.vanished;
    result_.work += output.work;
    for (auto& [part, lit] : output.exact_lit) exact[part].add({Ball(), std::move(lit), true});
  }
  std::vector<SectorState> states(scene_.parts.size(), kUndecided);
  for (std::uint32_t i = 0; i < states_.size(); ++i) states[facing_.parts[i]] = states_[i];

  if (cover_ == Cover::kOverlay) {
    // What is lit lies over polygons in shadow: details of their surface (Atherton, Weiler &
    // Greenberg 1978).
    result_.cover = Cover::kOverlay;
    result_.background = LightState::kShadow;
    result_.fragment_total -= result_.work[Counter::kShadowPolygons];
    for (SectorOutput& output : outputs_) {
      std::erase_if(output.pieces, [](const SectorOutput::Piece& piece) {
        return piece.fragment.state == LightState::kShadow;
      });
      output.caster_sets.clear();
    }
  }

  // Counting sort of the pieces by part, points one after another.
  std::vector<std::uint32_t> start(scene_.parts.size() + 1, 0);
  for (const SectorOutput& output : outputs_) {
    for (const SectorOutput::Piece& piece : output.pieces) ++start[piece.part + 1];
  }
  for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
  result_.fragments.resize(start.back());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (SectorOutput& output : outputs_) {
    const auto base = static_cast<std::uint32_t>(
        options_.output.points ? result_.points.size() : result_.exact_points.size());
    const auto first_set = static_cast<std::uint32_t>(result_.caster_sets.size());
    for (const SectorOutput::Piece& piece : output.pieces) {
      Fragment& fragment = result_.fragments[next[piece.part]++];
      fragment = piece.fragment;
      fragment.first += base;
      if (fragment.casters != Fragment::kNoCaster) fragment.casters += first_set;
    }
    std::move(output.caster_sets.begin(), output.caster_sets.end(),
              std::back_inserter(result_.caster_sets));
    result_.points.insert(result_.points.end(), output.points.begin(), output.points.end());
    std::move(output.exact_points.begin(), output.exact_points.end(),
              std::back_inserter(result_.exact_points));
    output = {};
  }

  result_.parts.resize(scene_.parts.size());
  if (options_.output.exact_fractions) result_.exact_fractions.resize(scene_.parts.size());
  for (std::uint32_t index = 0; index < scene_.parts.size(); ++index) {
    PartResult& part = result_.parts[index];
    part.part = index;
    part.side = facing_.facing[index].side;
    part.reason = facing_.facing[index].reason;
    part.first_fragment = start[index];
    part.fragment_count = start[index + 1] - start[index];
    const SectorState state = states[index];
    if (state == kMixed) {
      if constexpr (Space::kExact) {
        part.lit = sums_.enclosure(index);
        part.shadow = sums_.rest(index);
      } else {
        const double lit = sums_.rounded(index, true), shadow = sums_.rounded(index, false);
        part.lit = {lit, lit};
        part.shadow = {shadow, shadow};
      }
    } else {
      part.lit = state == kAllLit ? Interval{1, 1} : Interval{0, 0};
      part.shadow = state == kAllLit ? Interval{0, 0} : Interval{1, 1};
    }
    if (!options_.output.exact_fractions) continue;
    ExactFractions& fractions = result_.exact_fractions[index];
    fractions.lit = state == kMixed ? exact[index].exact() : mpq_class(state == kAllLit ? 1 : 0);
    fractions.shadow = 1 - fractions.lit;
  }
  return std::move(result_);
}

template <SectorSpaceModel Space>
CasterCounts SectorRun<Space>::count_shares() {
  std::map<std::pair<std::uint32_t, std::uint32_t>, FractionSum> sums;  // by part and count
  for (SectorOutput& output : outputs_) {
    for (SectorOutput::Counted& piece : output.counted) {
      sums[{piece.part, piece.count}].add(std::move(piece.share));
    }
  }
  CasterCounts result{result_.light, {}};
  for (const auto& [key, sum] : sums) {
    CasterCount& share = result.shares.emplace_back();
    share.part = key.first;
    share.count = key.second;
    share.share = sum.interval(Space::kExact);
    if (options_.output.exact_fractions) share.exact = sum.exact();
  }
  for (std::uint32_t i = 0; i < states_.size(); ++i) {
    if (states_[i] == kMixed || states_[i] == kUndecided) continue;
    result.shares.push_back({facing_.parts[i], states_[i], {1, 1}, 1});
  }
  std::ranges::sort(result.shares, [](const CasterCount& a, const CasterCount& b) {
    return std::pair(a.part, a.count) < std::pair(b.part, b.count);
  });
  return result;
}

/// A size of leaves and tasks by which everything is one leaf.
inline constexpr std::uint32_t kOneCell = std::numeric_limits<std::int32_t>::max();

/// What is done in the leaves, and how large these are.
inline LeafMethod leaf_method_of(const MethodChoice& method, ShadowTuning& tuning) {
  // Blots are of use where several sub-objects share a cell.
  constexpr std::uint32_t kBlotsInLeaf = 8;
  const auto one_cell = [&] { tuning.leaf_size = tuning.task_size = kOneCell; };
  if (method.point == MethodId::kTwoPass) {
    if (!method.options.cells) one_cell();
    return LeafMethod::kTwoPass;
  }
  if (method.point == MethodId::kBlots) {
    if (method.options.sectors) {
      tuning.leaf_size *= kBlotsInLeaf;
    } else {
      one_cell();
    }
    return LeafMethod::kBlots;
  }
  return LeafMethod::kSubtract;
}

/// Every light, by sectors, or by two passes or blots in the same cells, one after another.
template <SectorSpaceModel Space>
Expected<ShadowResult> compute_by_sectors_here(const RunTask& task) {
  const PreparedScene& scene = task.scene;
  const ShadowOptions& options = task.options;
  const LightList& lights = task.lights;
  ShadowResult result = empty_result(options);
  const double start = cpu_seconds();
  const KernelOptions kernel_options = options.kernel.options();
  RunOptions run_options = run_options_of(options);
  const LeafMethod leaf_method = leaf_method_of(options.method, run_options.tuning);
  const Cover cover =
      leaf_method == LeafMethod::kSubtract ? Cover::kPartition : options.method.options.cover;
  typename Space::SceneSpace scene_space(scene.geometry, kernel_options);
  // Of blots, for a light, and for an eye, before which all polygons hide.
  std::array<std::optional<std::vector<std::vector<std::uint32_t>>>, 2> solids;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    Space space(scene_space, scene.lights[lights[i]].point, kernel_options);
    FacingParts facing(scene, space, task.rules);
    LightRegion region(scene, lights[i], space, scene_space, facing, RegionCull::kDrop);
    SectorRun<Space> run(scene, run_options, task.rules, scene_space, lights[i], std::move(space),
                         std::move(facing), leaf_method, cover);
    if (options.method.options.split == CellSplit::kContour) run.split_by_contour();
    if (leaf_method == LeafMethod::kBlots) {
      const bool is_eye = scene.lights[lights[i]].is_eye;
      auto& own = solids[is_eye ? 1 : 0];
      if (!own) own = convex_solids(scene, is_eye);
      run.take_solids(*own, options.method.options.outlines);
    }
    run.shine_in(std::move(region));
    std::function<void(double)> progress;
    if (options.control.progress) {
      progress = [&](double share) {
        options.control.progress((static_cast<double>(i) + share) /
                                 static_cast<double>(lights.size()));
      };
    }
    const RunOutcome outcome = run.run(progress);
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, options);
    result.stages += run.stage_counts();
    if (!put_light(options, run.finish(), result)) {
      return stopped_by(RunOutcome::kInterrupted, options);
    }
  }
  result.stages += scene_space.stage_counts();
  result.shadow_seconds = cpu_seconds() - start;
  return result;
}

/// How many casters every light has before each part.
template <SectorSpaceModel Space>
Expected<std::vector<CasterCounts>> count_by_sectors_here(const RunTask& task) {
  const PreparedScene& scene = task.scene;
  const KernelOptions kernel_options = task.options.kernel.options();
  const RunOptions run_options = run_options_of(task.options);
  typename Space::SceneSpace scene_space(scene.geometry, kernel_options);
  std::vector<CasterCounts> result;
  for (const std::uint32_t light : task.lights) {
    Space space(scene_space, scene.lights[light].point, kernel_options);
    FacingParts facing(scene, space, task.rules);
    SectorRun<Space> run(scene, run_options, task.rules, scene_space, light, std::move(space),
                         std::move(facing), LeafMethod::kCount, Cover::kPartition);
    std::function<void(double)> progress;
    if (task.options.control.progress) {
      progress = [&](double share) {
        task.options.control.progress((static_cast<double>(result.size()) + share) /
                                      static_cast<double>(task.lights.size()));
      };
    }
    const RunOutcome outcome = run.run(progress);
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, task.options);
    result.push_back(run.count_shares());
  }
  return result;
}

template <class Kernel>
Expected<std::vector<CasterCounts>> BySectors<Kernel>::count(const RunTask& task) {
  tbb::task_arena arena(thread_count(task.options.tuning.jobs));
  return arena.execute([&] {
    return with_light_space<Kernel>(
        false, [&]<class Space>() { return count_by_sectors_here<Space>(task); });
  });
}

/// Classes and shares, on as many threads as asked for.
template <class Kernel>
Expected<ShadowResult> BySectors<Kernel>::run(const RunTask& task) {
  tbb::task_arena arena(thread_count(task.options.tuning.jobs));
  return arena.execute([&] {
    return with_light_space<Kernel>(task.options.output.stage_counts, [&]<class Space>() {
      return compute_by_sectors_here<Space>(task);
    });
  });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SECTORS_SECTOR_RUN_H
