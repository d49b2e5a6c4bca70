// SPDX-License-Identifier: LGPL-3.0-or-later
// The lights of a run by the contour method, one by one, each in the order of the scene that suits
// it.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_LIGHTS_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_LIGHTS_H

#include <tbb/task_arena.h>

#include <array>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include "algorithms/contour/by_contour.h"
#include "algorithms/contour/contour_run.h"
#include "algorithms/contour/lanes/simd_level.h"
#include "algorithms/contour/space_order.h"
#include "algorithms/partition/run_task.h"

namespace gnomon {

/// The numbers of a kernel: its own where it rounds, doubles with bounds where it decides about
/// input corners by their numbers alone, and rationals on other exact kernels or where exact shares
/// are asked for.
template <class Space, bool exact_shares>
struct ContourNumbersOf {
  static auto choose() {
    if constexpr (exact_shares || (Space::kExact && !KnowsInputSides<Space>)) {
      return ContourNumbers<mpq_class, Trust::kExact>();
    } else if constexpr (Space::kExact) {
      return ContourNumbers<double, Trust::kCertified>();
    } else if constexpr (requires(typename Space::Vertex v) {
                           requires std::is_floating_point_v<std::remove_cvref_t<decltype(v.x[0])>>;
                         }) {
      using T = std::remove_cvref_t<decltype(std::declval<typename Space::Vertex>().x[0])>;
      return ContourNumbers<T, Trust::kRounded>();
    } else {
      return ContourNumbers<double, Trust::kRounded, true>();
    }
  }
  using type = decltype(choose());
};

/// The scene in one order, and the run of the lights that are computed in it.
template <SectorSpaceModel Space, class Numbers>
class OrderedRun {
 public:
  OrderedRun(const RunTask& task, const Lanes& lanes, bool in_space)
      : order_(in_space ? std::make_unique<SpaceOrder>(task.scene, task.options.tuning.jobs)
                        : nullptr),
        scene_(order_ ? order_->scene() : task.scene),
        scene_space_(scene_.geometry, task.options.kernel.options()),
        run_(scene_, task.options, task.rules, scene_space_, lanes) {}
  OrderedRun(const OrderedRun&) = delete;
  OrderedRun& operator=(const OrderedRun&) = delete;

  RunOutcome run(std::uint32_t light, const std::function<void(double)>& progress) {
    return run_.run(light, progress);
  }
  LightResult finish() {
    LightResult found = run_.finish();
    if (order_) order_->restore(found);
    return found;
  }
  StageCounts stage_counts() const {
    StageCounts counts = run_.stage_counts();
    counts += scene_space_.stage_counts();
    return counts;
  }

 private:
  std::unique_ptr<SpaceOrder> order_;
  const PreparedScene& scene_;
  typename Space::SceneSpace scene_space_;
  ContourRun<Space, Numbers> run_;
};

template <SectorSpaceModel Space, class Numbers>
Expected<ShadowResult> compute_by_contour_here(const RunTask& task) {
  const ShadowOptions& options = task.options;
  const LightList& lights = task.lights;
  ShadowResult result = empty_result(options);
  const double start = cpu_seconds();
  const Expected<SimdLevel> level = chosen_simd_level();
  if (!level) return tl::unexpected<Error>(level.error());
  std::array<std::unique_ptr<OrderedRun<Space, Numbers>>, 2> runs;  // as in the file, in space
  for (std::size_t i = 0; i < lights.size(); ++i) {
    std::function<void(double)> progress;
    if (options.control.progress) {
      progress = [&](double share) {
        options.control.progress((static_cast<double>(i) + share) /
                                 static_cast<double>(lights.size()));
      };
    }
    // Rounded answers would depend on the order.
    const bool in_space =
        Space::kExact &&
        SpaceOrder::pays(task.scene, task.scene.lights[lights[i]].point.directional);
    auto& run = runs[in_space];
    if (!run) run = std::make_unique<OrderedRun<Space, Numbers>>(task, lanes(*level), in_space);
    const RunOutcome outcome = run->run(lights[i], progress);
    if (outcome != RunOutcome::kDone) return stopped_by(outcome, options);
    if (!put_light(options, run->finish(), result)) {
      return stopped_by(RunOutcome::kInterrupted, options);
    }
  }
  for (const auto& run : runs) {
    if (run) result.stages += run->stage_counts();
  }
  result.shadow_seconds = cpu_seconds() - start;
  return result;
}

template <class Kernel>
Expected<ShadowResult> ByContour<Kernel>::run(const RunTask& task) {
  tbb::task_arena arena(thread_count(task.options.tuning.jobs));
  return arena.execute([&] {
    return with_light_space<Kernel>(task.options.output.stage_counts, [&]<class Space>() {
      if constexpr (Space::kExact) {
        if (task.options.output.exact_fractions) {
          return compute_by_contour_here<Space, typename ContourNumbersOf<Space, true>::type>(task);
        }
      }
      return compute_by_contour_here<Space, typename ContourNumbersOf<Space, false>::type>(task);
    });
  });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_LIGHTS_H
