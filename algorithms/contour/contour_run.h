// SPDX-License-Identifier: LGPL-3.0-or-later
// The contour method from a prepared scene to shares and classes of one light after another.
//
// Everything that does not depend on the number of the lights is kept from one to the next.
// Certified shares are sums of enclosures; polygons that the bounds leave open are found by exact
// subtraction, by the sectors method on them and their neighbours.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_RUN_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_RUN_H

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include "algorithms/contour/contour_walk.h"
#include "algorithms/contour/dark_polygons.h"
#include "algorithms/contour/light_charts.h"
#include "algorithms/contour/pair_search.h"
#include "algorithms/partition/in_parallel.h"
#include "algorithms/partition/run_task.h"
#include "algorithms/sectors/sector_run.h"
#include "kernel/concept/kernel_model.h"

namespace gnomon {

template <SectorSpaceModel Space, class Numbers>
class ContourRun {
 public:
  using T = typename Numbers::T;
  using SceneSpace = typename Space::SceneSpace;
  using Sides = InputSides<Space, Numbers>;
  using Sum = ContourSum<Numbers>;

  /// Call everything in an arena of `jobs` threads.
  ContourRun(const PreparedScene& scene, const ShadowOptions& options, const Rules& rules,
             SceneSpace& scene_space, const Lanes& lanes)
      : scene_(scene),
        options_(options),
        run_options_(run_options_of(options)),
        rules_(rules),
        scene_space_(scene_space),
        // Rounded sums would depend on which thread adds what.
        jobs_(Space::kParallel && Numbers::kTrust != Trust::kRounded ? options.tuning.jobs : 1),
        lanes_(lanes),
        pairs_(lanes) {
    if (KnowsInputSides<Space>) {
      memos_ = std::make_unique<SceneMemos>(scene.parts.size());
    }
  }

  /// Classifies one light; `progress` gets the share of the work that is done.
  RunOutcome run(std::uint32_t light, const std::function<void(double)>& progress);
  LightResult finish();
  const StageCounts& stage_counts() const { return stages_; }

 private:
  static constexpr std::uint32_t kGrain = 4096;  // polygons of one thread, where little is done
  // Looking for dark polygons pays where at least one of six is: a proof takes a sixth of what
  // walking along a dark one and meeting it costs.
  static constexpr std::uint32_t kFewestToSample = 512, kLeastNeighbours = 10, kLeastShare = 6;
  static constexpr std::uint32_t kSampleStride = 29;  // prime, as few patterns of files are

  /// The part of the progress that is told when all polygons have been walked along.
  static constexpr double kShareOfWalk = 0.9;

  /// What one thread works with.
  struct Worker {
    Worker(const ContourRun& run, const Sides& from, std::uint32_t count)
        : sides(from.fork()),
          sums(count),
          walk(run.rays_, run.polygons_, run.measure_, run.dark_, run.rules_, sides, run.lanes_,
               sums) {}
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    Sides sides;
    std::vector<Sum> sums;
    ContourWalk<Numbers, Sides> walk;
  };

  double thickness() const {
    if constexpr (requires { scene_space_.arithmetic().thickness(); } && !Numbers::kExact) {
      return static_cast<double>(scene_space_.arithmetic().thickness());
    } else {
      return 0;
    }
  }
  /// What the numbers decided, and what was remembered.
  void count_stages(std::uint64_t filtered, std::uint64_t remembered) {
    if (!options_.output.stage_counts) return;
    stages_.filter += filtered;
    stages_.identity += remembered;
  }
  bool find_pairs(const Space& space, const LightPoint& point);
  void find_dark(const Sides& sides);
  std::uint32_t prove_dark(const Sides& sides, std::uint32_t stride);
  RunOutcome walk_all(const Sides& sides, const std::function<void(double)>& progress);
  void measure(std::uint32_t begin, std::uint32_t end);
  void set_classes();
  void set_class(std::uint32_t i);
  RunOutcome find_open_ones(Space space, const std::function<void(double)>& progress);
  bool is_open(std::uint32_t i) const;
  Ball share_of(std::uint32_t i) const;

  const PreparedScene& scene_;
  const ShadowOptions& options_;
  RunOptions run_options_;
  const Rules& rules_;
  SceneSpace& scene_space_;
  unsigned jobs_;
  std::unique_ptr<FacingParts> facing_;
  LightRays<Numbers> rays_;
  FacingPolygons<Numbers> polygons_;
  ContourMeasure<Numbers> measure_;
  std::vector<Sum> sums_;
  LightCharts charts_;
  std::unique_ptr<SceneMemos> memos_;  // of kernels that know inputs
  const Lanes& lanes_;
  PairSearch pairs_;
  std::vector<std::uint8_t> casts_;  // of each polygon
  DarkScene dark_scene_;
  std::vector<std::uint8_t> dark_;  // of each polygon: 1 if it is known to be
  StageCounts stages_;
  LightResult result_;
};

template <SectorSpaceModel Space, class Numbers>
void ContourRun<Space, Numbers>::measure(std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) {
    const FacingPolygon& p = polygons_.polygons[i];
    const Vector<T> corner = polygons_.corner(p, 0);
    T whole(0);
    double error = 0;
    for (std::uint32_t k = 1; k + 1 < p.count; ++k) {
      if constexpr (Numbers::kCertified) {
        if (!rays_.planes.empty()) {
          double value_error;
          whole += rays_.planes.value(polygons_.edge(p, k), polygons_.vertex(p, 0), value_error);
          error += value_error;
          continue;
        }
        error += rays_.proven(polygons_.error_of_line(p, k) * polygons_.reach[i]);
      }
      whole += dot_product(polygons_.line(p, k), corner);
    }
    measure_.relative_error[i] = 0;
    if (!(whole > 0)) {
      measure_.scale[i] = T(0);
      if (Numbers::kCertified) sums_[i].flags |= kContourOpen;
      continue;
    }
    measure_.scale[i] = T(1 / whole);
    if constexpr (Numbers::kCertified) {
      // Of n - 2 positive values all sums but the first, 0 and one of them, round by less than u of
      // their sum, and so does the quotient.
      measure_.relative_error[i] = 1.01 * (error * measure_.scale[i] + (p.count - 2) * Ball::kUnit);
      if (!(measure_.relative_error[i] <= rays_.rough())) {
        whole = error = 0;
        for (std::uint32_t k = 1; k + 1 < p.count; ++k) {
          double value_error;
          whole += rays_.sharp_value(polygons_.vertex(p, k), polygons_.vertex(p, k + 1),
                                     polygons_.vertex(p, 0), ContourBounds::kSharp, value_error);
          error += value_error;
        }
        whole *= rays_.unit();
        error *= rays_.unit();
        measure_.scale[i] = 1 / whole;
        measure_.relative_error[i] =
            1.01 * (error * measure_.scale[i] + ExactValues::kUnit + (p.count - 1) * Ball::kUnit);
      }
      if (!(measure_.relative_error[i] < 0x1p-20)) sums_[i].flags |= kContourOpen;
    }
  }
}

template <SectorSpaceModel Space, class Numbers>
RunOutcome ContourRun<Space, Numbers>::run(std::uint32_t light,
                                           const std::function<void(double)>& progress) {
  const LightPoint& point = scene_.lights[light].point;
  Space space(scene_space_, point, options_.kernel.options());
  facing_ = std::make_unique<FacingParts>(scene_, space, rules_);
  result_ = {};
  result_.light = light;
  result_.facing_parts = facing_->parts.size();
  result_.facing_edges = facing_->edges;
  if (!find_pairs(space, point)) return RunOutcome::kTooManyFragments;
  Sides sides(scene_, scene_space_, std::move(space), *facing_, polygons_, memos_.get());
  find_dark(sides);
  if (const RunOutcome outcome = walk_all(sides, progress); outcome != RunOutcome::kDone) {
    return outcome;
  }
  set_classes();
  return find_open_ones(std::move(sides.space()), progress);
}

// Lays the polygons out in the numbers of a light, and finds their neighbours.
template <SectorSpaceModel Space, class Numbers>
bool ContourRun<Space, Numbers>::find_pairs(const Space& space, const LightPoint& point) {
  if constexpr (Numbers::kCertified) {
    make_light_rays(space, scene_.geometry, point, jobs_, rays_);
  } else {
    make_light_rays(scene_.geometry, point, thickness(), rays_);
  }
  polygons_.lay_out(scene_, *facing_, jobs_);
  const std::uint32_t count = polygons_.size();
  sums_.assign(count, {});
  measure_.scale.resize(count);
  measure_.relative_error.resize(count);
  in_parallel(jobs_, count, 1024, [&](std::uint32_t begin, std::uint32_t end) {
    polygons_.fill(rays_, begin, end);
    measure(begin, end);
  });
  charts_.find(polygons_, rays_, jobs_);
  casts_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    casts_[i] = polygons_.polygons[i].casts;
    polygons_.polygons[i].depth = charts_.depths()[i];
  }
  return pairs_.run(charts_.charts(), count, {.casts = casts_, .jobs = jobs_});
}

// Which polygons are dark, before anything is walked along. In a large scene first a sample is
// looked at, and the others only where enough of it is dark: the same for every number of threads.
template <SectorSpaceModel Space, class Numbers>
void ContourRun<Space, Numbers>::find_dark(const Sides& sides) {
  const std::uint32_t count = polygons_.size();
  dark_.assign(count, 0);
  if constexpr (Numbers::kCertified) {
    if (!charts_.is_one()) return;
    const bool is_large = count >= kFewestToSample;
    if (is_large && pairs_.neighbours().size() < kLeastNeighbours * count) return;
    dark_scene_.make(polygons_, charts_, scene_.geometry.edges.size(), jobs_);
    std::uint64_t& found = result_.work[Counter::kDarkPolygons];
    if (is_large) {
      found = prove_dark(sides, kSampleStride);
      if (found * kSampleStride * kLeastShare < count) return;
    }
    found = prove_dark(sides, 1);
  }
}

// Looks at every so-manieth polygon; how many are dark.
template <SectorSpaceModel Space, class Numbers>
std::uint32_t ContourRun<Space, Numbers>::prove_dark(const Sides& sides, std::uint32_t stride) {
  std::atomic<std::uint32_t> found = 0;
  std::mutex stages_mutex;
  const std::uint32_t count = (polygons_.size() + stride - 1) / stride;
  in_parallel(jobs_, count, 512, [&](std::uint32_t begin, std::uint32_t end) {
    Sides mine = sides.fork();
    DarkProof<Numbers, Sides> proof(dark_scene_, rays_, polygons_, charts_, pairs_, mine, lanes_);
    std::uint32_t here = 0;
    for (std::uint32_t i = stride * begin; i < stride * end && i < polygons_.size(); i += stride) {
      dark_[i] = proof.is_dark(i);
      here += dark_[i];
    }
    found += here;
    const std::lock_guard lock(stages_mutex);
    stages_ += mine.space().stage_counts();
    count_stages(proof.filtered(), mine.remembered());
  });
  return found;
}

template <SectorSpaceModel Space, class Numbers>
RunOutcome ContourRun<Space, Numbers>::walk_all(const Sides& sides,
                                                const std::function<void(double)>& progress) {
  constexpr std::uint32_t kChunk = 64, kChunkOfOne = 4096;  // of several threads, of one
  const std::uint32_t count = polygons_.size();
  tbb::enumerable_thread_specific<std::unique_ptr<Worker>> workers;
  std::atomic<bool> no_ieee = false, stopped = false;
  std::mutex progress_mutex;
  std::uint32_t done = 0;
  const auto walk_range = [&](std::uint32_t begin, std::uint32_t end) {
    if (stopped.load(std::memory_order_relaxed)) return;
    std::unique_ptr<Worker>& worker = workers.local();
    if (!worker) {
      if (!check_fp_environment()) {
        no_ieee = stopped = true;
        return;
      }
      worker = std::make_unique<Worker>(*this, sides, count);
    }
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::atomic<bool>* interrupted = options_.control.interrupted;
      if (interrupted != nullptr && interrupted->load(std::memory_order_relaxed)) {
        stopped = true;
        return;
      }
      if (dark_[i] == 0) worker->walk.walk(i, pairs_.neighbours(i));
    }
    if (!progress) return;
    const std::lock_guard lock(progress_mutex);
    done += end - begin;
    progress(kShareOfWalk * done / count);
  };
  if (jobs_ == 1) {
    for (std::uint32_t i = 0; i < count; i += kChunkOfOne) {
      walk_range(i, std::min(count, i + kChunkOfOne));
    }
  } else {
    in_parallel(jobs_, count, kChunk, walk_range);
  }
  if (stopped) return no_ieee ? RunOutcome::kNoIeee : RunOutcome::kInterrupted;
  for (const std::unique_ptr<Worker>& worker : workers) {
    in_parallel(jobs_, count, kGrain, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) sums_[i] += worker->sums[i];
    });
    stages_ += worker->sides.space().stage_counts();
    count_stages(worker->walk.filtered(), worker->sides.remembered());
    result_.work[Counter::kIntervals] += worker->walk.intervals();
    result_.work[Counter::kSegments] += worker->walk.segments();
  }
  return RunOutcome::kDone;
}

template <SectorSpaceModel Space, class Numbers>
LightResult ContourRun<Space, Numbers>::finish() {
  return std::move(result_);
}

}  // namespace gnomon

#include "algorithms/contour/contour_classes.h"

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_RUN_H
