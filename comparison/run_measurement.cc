// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/run_measurement.h"

#include <sys/resource.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "comparison/answer_checksum.h"
#include "comparison/scene_change.h"
#include "comparison/scene_source.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/kernel_choice.h"
#include "gnomon/oracle/exact_answer.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/scene/prepare.h"
#include "report/certificate/certificate.h"
#include "report/certificate/wrong_share.h"
#include "report/facts/facing.h"
#include "report/sides/claims_of.h"

namespace gnomon::comparison {

namespace {

/// The clock runs until this many seconds are full, but so many times at most, and at least.
constexpr double kEnoughSeconds = 0.2;
constexpr std::size_t kMostRuns = 25, kFewestRuns = 3;
/// What takes so long is measured once.
constexpr double kLongSeconds = 2;

std::uint64_t peak_bytes() {
  constexpr std::uint64_t kUnit = 1024;  // of ru_maxrss
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kUnit;
}

std::string worst_place(const oracle::Report& report) {
  if (!report.worst) return {};
  const auto name = [](const std::optional<LightState>& state) {
    return state ? std::string(name_of(*state)) : std::string("nothing");
  };
  return std::string(oracle::name_of(report.worst->kind)) + ": found " + name(report.worst->found) +
         ", true " + name(report.worst->truth);
}

class Run {
 public:
  Run(const RunRequest& request, const std::function<void(const Measurement&)>& told)
      : request_(request), told_(told) {}

  Measurement operator()() {
    if (!read() || !prepare_scene() || !time()) return done_;
    tell();
    if (!count_stages() || !answer() || !change()) return done_;
    tell();
    judge();
    return done_;
  }

 private:
  bool stop(const Error& error) {
    done_.end = error.code == ErrorCode::kLimit ? RunEnd::kLimit : RunEnd::kRefused;
    done_.why = error.what;
    return false;
  }
  void tell() const {
    if (told_) told_(done_);
  }

  bool read() {
    const auto kernel = parse_kernel_choice(request_.kernel);
    if (!kernel) return stop(kernel.error());
    const auto system = parse_method(request_.system);
    if (!system) return stop(system.error());
    done_.exact = kernel->exact();
    options_.kernel.id = kernel->kernel;
    options_.kernel.identity = kernel->identity;
    if (kernel->thin) options_.kernel.thickness = 0;
    if (request_.thickness) options_.kernel.thickness = *request_.thickness;
    options_.method.options = system->values;
    options_.tuning.jobs = 1;
    const LightKinds takes = method_info(system->id).lights;
    const bool area = request_.lights == LightsAsked::kArea;
    if (!(area ? takes.area : takes.point)) {
      return stop({ErrorCode::kUsage,
                   {},
                   area ? "it takes no area lights" : "it takes area lights alone",
                   {}});
    }
    (area ? options_.method.area : options_.method.point) = system->id;
    return true;
  }

  bool prepare_scene() {
    const auto source = SceneSource::parse(request_.scene);
    if (!source) return stop(source.error());
    auto scene = source->make(request_.size, request_.seed);
    if (!scene) return stop(scene.error());
    scene_ = std::move(*scene);
    auto prepared = prepare(scene_);
    if (!prepared) return stop(prepared.error());
    prepared_ = std::move(*prepared);
    done_.polygons = scene_.polygons.size();
    done_.parts = prepared_.parts.size();
    done_.position_bits = prepared_.position_bits;
    done_.direction_bits = prepared_.direction_bits;
    for (std::uint32_t i = 0; i < prepared_.lights.size(); ++i) {
      if (prepared_.lights[i].has_area() == (request_.lights == LightsAsked::kArea)) {
        options_.lights.push_back(i);
      }
    }
    done_.lights = options_.lights.size();
    if (options_.lights.empty()) return stop({ErrorCode::kUsage, {}, "there is no such light", {}});
    return true;
  }

  bool enough(const std::vector<double>& seconds, double total) const {
    if (request_.repeat > 0) return seconds.size() >= request_.repeat;
    if (total >= kLongSeconds || seconds.size() >= kMostRuns) return !seconds.empty();
    return seconds.size() >= kFewestRuns && total >= kEnoughSeconds;
  }

  bool time() {
    std::vector<double> seconds;
    double total = 0;
    do {
      const auto result = compute_shadows(prepared_, options_);
      if (!result) return stop(result.error());
      seconds.push_back(result->scene_bsp_seconds + result->shadow_seconds);
      total += seconds.back();
      if (seconds.size() > 1) continue;
      for (const LightResult& light : result->lights) {
        done_.fragments += light.fragment_total;
        done_.nodes += light.tree_nodes;
        done_.work += light.work;
      }
    } while (!enough(seconds, total));
    std::ranges::sort(seconds);
    done_.seconds = seconds[seconds.size() / 2];
    done_.runs = seconds.size();
    done_.peak_bytes = peak_bytes();
    return true;
  }

  bool judged() const { return request_.points || done_.polygons <= request_.certify_up_to; }

  /// Who decides, in a run that is asked for no more than the one that was timed.
  bool count_stages() {
    if (!request_.stages || !done_.exact) return true;
    ShadowOptions options = options_;
    options.output.stage_counts = true;
    const auto result = compute_shadows(prepared_, options);
    if (!result) return stop(result.error());
    done_.decided_by = {result->stages.identity, result->stages.filter};
    std::ranges::copy(result->stages.by_width(), done_.decided_by.begin() + 2);
    return true;
  }

  bool answer() {
    ShadowOptions options = options_;
    options.output.exact_fractions = done_.exact;
    options.output.exact_points = judged();
    auto result = compute_shadows(prepared_, options);
    if (!result) return stop(result.error());
    result_ = std::move(*result);
    done_.checksum = done_.exact ? exact_checksum(result_) : rounded_checksum(result_);
    return true;
  }

  /// The same of the changed scene, beside this answer.
  bool change() {
    if (request_.change.empty()) return true;
    const SceneChange* change = change_by_name(request_.change);
    if (change == nullptr) return stop({ErrorCode::kUsage, {}, "there is no such change", {}});
    const Scene scene = change->make(scene_);
    const auto prepared = prepare(scene);
    if (!prepared) return stop(prepared.error());
    ShadowOptions options = options_;
    options.output.exact_fractions = done_.exact;
    const auto result = compute_shadows(*prepared, options);
    if (!result) return stop(result.error());
    done_.difference = difference_of(shares_of(scene_, prepared_, result_, done_.exact),
                                     shares_of(scene, *prepared, *result, done_.exact));
    return true;
  }

  void judge() {
    if (!judged()) return;
    const Claims claims =
        report::claims_of(scene_, prepared_, result_, request_.system, done_.exact);
    const oracle::ExactAnswer truth(scene_, prepared_);
    oracle::CertifyOptions options;
    options.lights = options_.lights;
    options.threads = 1;
    if (done_.polygons > request_.certify_up_to) options.most_pairs = 0;
    const auto report = oracle::certify(truth, claims, options);
    if (!report) {
      done_.why = "not judged: " + report.error().what;
      return;
    }
    Judgement& judgement = done_.judgement.emplace();
    judgement.verdict = oracle::name_of(report->verdict);
    judgement.confirms = report->confirms_exact();
    judgement.by_points = report->by_points;
    const double area = report::facing_area(prepared_, options_.lights);
    if (std::isnormal(area)) {
      judgement.wrong = report->totals.misclassified.upper / area;
    } else {
      report::Certificate scale;
      scale.scene = &scene_;
      scale.prepared = &prepared_;
      for (const std::uint32_t light : options_.lights) {
        scale.lights.push_back(scene_.lights[prepared_.lights[light].light].id);
      }
      judgement.wrong = report::WrongShare(scale).of(*report);
    }
    const oracle::ComparisonTotals& totals = report->totals;
    judgement.worst_share = std::max({totals.worst_misclassified, totals.worst_uncovered,
                                      totals.worst_overlapping, totals.worst_outside});
    judgement.width = totals.width.upper;
    judgement.diagonal = report->diagonal;
    judgement.invented = totals.invented;
    judgement.lost = totals.lost;
    if (report->verdict != oracle::Verdict::kIdentical) judgement.breaks = worst_place(*report);
    judgement.reason = report->oracle_fault ? "the oracle contradicts itself" : report->reason;
  }

  const RunRequest& request_;
  const std::function<void(const Measurement&)>& told_;
  ShadowOptions options_;
  Scene scene_;
  PreparedScene prepared_;
  ShadowResult result_;
  Measurement done_;
};

}  // namespace

Measurement measure(const RunRequest& request,
                    const std::function<void(const Measurement&)>& told) {
  return Run(request, told)();
}

int measurement_main(std::string_view request) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const auto read = parse_request(request);
  if (!read) {
    std::fprintf(stderr, "gnomon: %s\n", to_string(read.error()).c_str());
    return 2;
  }
  const auto print = [](const Measurement& measurement) {
    const std::string line = measurement_text(measurement) + '\n';
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fflush(stdout);
  };
  try {
    print(measure(*read, print));
  } catch (const std::bad_alloc&) {
    std::fputs("gnomon: out of memory\n", stderr);  // nothing that would need memory again
    return kOutOfMemoryStatus;
  }
  return 0;
}

}  // namespace gnomon::comparison
