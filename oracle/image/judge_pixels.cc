// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include "gnomon/oracle/image.h"
#include "oracle/image/lit_samples.h"
#include "oracle/image/seen_parts.h"
#include "oracle/image/wrong_clearance.h"
#include "oracle/judge/clearance.h"

namespace gnomon::oracle {
namespace {

/// Of so many wrong samples the clearance is found; of the rest only if it can excuse them.
constexpr std::uint64_t kMeasuredSamples = 2000;

class PixelJudge {
 public:
  PixelJudge(const PreparedView& view, const PixelClaims& claims, const ImageOptions& options)
      : claims_(claims), options_(options), view_(view, claims.camera), seen_(view_) {
    for (const std::uint32_t light : claims.lights) {
      const auto prepared = std::ranges::find(view.scene.lights, light, &PreparedLight::light);
      lights_.push_back(&*prepared);
      lit_.push_back(std::make_unique<LitSamples>(view_, seen_, *prepared));
    }
    report_.candidate = claims.name;
    report_.samples = std::uint64_t{claims.camera.width} * claims.camera.height;
    report_.wrong_of_light.assign(claims.lights.size(), 0);
    const std::uint64_t pairs =
        report_.samples * std::max<std::uint64_t>(1, view.scene.parts.size());
    report_.step = std::max<std::uint64_t>(
        1, (pairs + options.most_pairs - 1) / std::max<std::uint64_t>(1, options.most_pairs));
  }

  ImageReport judge() {
    tbb::parallel_for(std::uint32_t{0}, claims_.camera.height, [&](std::uint32_t j) { row(j); });
    conclude();
    return std::move(report_);
  }

 private:
  struct Counts {
    std::uint64_t judged = 0, boundary = 0, moved = 0, wrong = 0, wrong_polygon = 0, by_rows = 0,
                  ill_conditioned = 0;
    std::vector<std::uint64_t> wrong_of_light;
    std::vector<WrongSample> samples;  // the wrong ones
  };

  void row(std::uint32_t j) {
    if (options_.interrupted != nullptr && options_.interrupted->load()) {
      const std::lock_guard lock(mutex_);
      report_.interrupted = true;
      return;
    }
    Counts counts;
    counts.wrong_of_light.assign(claims_.lights.size(), 0);
    const std::uint64_t width = claims_.camera.width, first = j * width;
    // The multiples of the step that are in the row.
    for (std::uint64_t s = (first + report_.step - 1) / report_.step * report_.step;
         s < first + width; s += report_.step) {
      sample(static_cast<std::uint32_t>(s - first), j, s, counts);
    }
    add(std::move(counts));
  }

  /// What is true along a ray.
  struct Truth {
    Seen seen;
    bool boundary = false;
    std::uint64_t lit = 0;
    std::vector<std::optional<std::uint32_t>> casters;  // of each light
  };

  Truth truth_along(std::uint32_t i, std::uint32_t j, const SampleRay& ray) {
    Truth truth;
    truth.seen = seen_.at(i, j, ray);
    truth.boundary = truth.seen.boundary;
    truth.casters.resize(lit_.size());
    if (truth.seen.part == Seen::kNothing) return truth;
    for (std::size_t l = 0; l < lit_.size() && !truth.boundary; ++l) {
      const PointVisibility found = lit_[l]->at(truth.seen.part, ray);
      truth.boundary = found.visibility == Visibility::kBoundary;
      truth.casters[l] = found.caster;
      if (found.visibility == Visibility::kLit) truth.lit |= std::uint64_t{1} << l;
    }
    return truth;
  }

  void sample(std::uint32_t i, std::uint32_t j, std::size_t s, Counts& counts) {
    SampleRay ray = view_.ray(i, j);
    Truth truth = truth_along(i, j, ray);
    if (!truth.boundary) {
      ++counts.judged;
    } else {
      ++counts.boundary;
      if (!options_.moves_ties) return;
      ray = view_.moved_ray(i, j);
      truth = truth_along(i, j, ray);
      if (truth.boundary) return;
      ++counts.moved;
    }
    compare(i, j, s, truth, ray, counts);
  }

  void compare(std::uint32_t i, std::uint32_t j, std::size_t s, const Truth& truth,
               const SampleRay& ray, Counts& counts) {
    const Seen& seen = truth.seen;
    const bool right = is_right_polygon(seen, claims_.polygon[s]);
    const std::uint64_t differing = right ? truth.lit ^ claims_.lit_by[s] : 0;
    if (right && differing == 0) return;
    ++counts.wrong;
    WrongSample wrong = described(i, j, s, seen, ray);
    if (!right) {
      ++counts.wrong_polygon;
      if (is_measured()) wrong.clearance = clearance_of_view(view_, seen_, seen, ray);
      if (is_ill_conditioned(wrong)) ++counts.ill_conditioned;
      counts.samples.push_back(wrong);
      return;
    }
    bool by_rows = true, excused = true;
    for (std::size_t l = 0; l < lit_.size(); ++l) {
      if ((differing >> l & 1) == 0) continue;
      ++counts.wrong_of_light[l];
      wrong.light = claims_.lights[l];
      wrong.claimed_lit = (claims_.lit_by[s] >> l & 1) != 0;
      if (truth.casters[l]) wrong.caster = view_.scene().parts[*truth.casters[l]].polygon;
      wrong.by_rows = is_near_border(l, seen, ray);
      by_rows = by_rows && wrong.by_rows;
      wrong.clearance = wrong.by_rows ? std::nullopt : clearance_of_light(l, seen, ray);
      excused = excused && (wrong.by_rows || is_ill_conditioned(wrong));
      counts.samples.push_back(wrong);
    }
    if (by_rows) {
      ++counts.by_rows;
    } else if (excused) {
      ++counts.ill_conditioned;
    }
  }

  bool is_right_polygon(const Seen& seen, std::uint32_t claimed) const {
    if (seen.part == Seen::kNothing) return claimed == PixelClaims::kNothing;
    const std::vector<Part>& parts = view_.scene().parts;
    return parts[seen.part].polygon == claimed ||
           std::ranges::any_of(seen.coplanar,
                               [&](std::uint32_t p) { return parts[p].polygon == claimed; });
  }

  WrongSample described(std::uint32_t i, std::uint32_t j, std::size_t s, const Seen& seen,
                        const SampleRay& ray) const {
    WrongSample wrong;
    wrong.i = i;
    wrong.j = j;
    wrong.claimed = claims_.polygon[s];
    if (seen.part == Seen::kNothing) return wrong;
    wrong.seen = view_.scene().parts[seen.part].polygon;
    const RationalPoint point = seen_point(view_, seen_.plane(seen.part), ray);
    for (std::size_t k = 0; k < 3; ++k) wrong.point[k] = point[k].get_d();
    return wrong;
  }

  bool is_ill_conditioned(const WrongSample& wrong) const {
    return wrong.clearance && *wrong.clearance < options_.clearance;
  }
  bool is_measured() { return options_.clearance > 0 || ++measured_ <= kMeasuredSamples; }
  /// Nothing can be measured where the side that is seen does not face the light.
  std::optional<double> clearance_of_light(std::size_t l, const Seen& seen, const SampleRay& ray) {
    if (!lit_[l]->faces(seen.part) || !is_measured()) return std::nullopt;
    const RationalPoint point = seen_point(view_, seen_.plane(seen.part), ray);
    return decide(view_.scene(), *lights_[l], seen.part, point).clearance;
  }

  bool is_near_border(std::size_t l, const Seen& seen, const SampleRay& ray) const {
    return options_.near_border &&
           options_.near_border(claims_.lights[l], seen_point(view_, seen_.plane(seen.part), ray));
  }

  void add(Counts counts) {
    const std::lock_guard lock(mutex_);
    report_.judged += counts.judged;
    report_.boundary += counts.boundary;
    report_.moved += counts.moved;
    report_.wrong += counts.wrong;
    report_.wrong_polygon += counts.wrong_polygon;
    report_.by_rows += counts.by_rows;
    report_.ill_conditioned += counts.ill_conditioned;
    for (std::size_t l = 0; l < counts.wrong_of_light.size(); ++l) {
      report_.wrong_of_light[l] += counts.wrong_of_light[l];
    }
    for (const WrongSample& wrong : counts.samples) add(wrong);
    ++rows_;
    if (options_.progress) {
      options_.progress(static_cast<double>(rows_) / claims_.camera.height);
    }
  }
  /// The worst is that of the largest clearance; of equals the first of the picture.
  void add(const WrongSample& wrong) {
    if (!wrong.by_rows && !is_ill_conditioned(wrong)) ++plain_;
    // Where all are measured, one without a clearance is beyond all that excuses.
    const double unknown = options_.clearance > 0 ? std::numeric_limits<double>::infinity() : -1;
    const auto key = [unknown](const WrongSample& w) {
      return std::tuple(w.by_rows, -w.clearance.value_or(unknown), w.j, w.i, w.light.value_or(0));
    };
    if (!report_.worst || key(wrong) < key(*report_.worst)) report_.worst = wrong;
  }

  void conclude() {
    if (report_.wrong > 0) {
      const bool excused = plain_ == 0 && !options_.strict;
      report_.verdict = excused ? Verdict::kWithinTolerance : Verdict::kFailed;
      if (!excused) report_.reason = std::to_string(report_.wrong) + " samples are wrong";
    } else if (report_.boundary_share() > options_.most_boundary) {
      report_.verdict = Verdict::kFailed;
      report_.reason = std::to_string(report_.boundary) + " of " +
                       std::to_string(report_.looked_at()) +
                       " samples lie on borders: too many for a verdict";
    }
    if (report_.interrupted && report_.reason.empty()) {
      report_.verdict = Verdict::kFailed;
      report_.reason = "interrupted: not all samples were looked at";
    }
  }

  const PixelClaims& claims_;
  const ImageOptions& options_;
  SampledView view_;
  SeenParts seen_;
  std::vector<const PreparedLight*> lights_;
  std::vector<std::unique_ptr<LitSamples>> lit_;
  ImageReport report_;
  std::uint64_t plain_ = 0;  // wrong claims that no clearance excuses
  std::uint32_t rows_ = 0;
  std::atomic<std::uint64_t> measured_ = 0;
  std::mutex mutex_;
};

}  // namespace

Expected<ImageReport> judge_pixels(const PreparedView& view, const PixelClaims& claims,
                                   const ImageOptions& options) {
  if (!(options.clearance >= 0)) {
    return fail(ErrorCode::kUsage, "a clearance that is negative or no number", "0 or more");
  }
  return PixelJudge(view, claims, options).judge();
}

}  // namespace gnomon::oracle
