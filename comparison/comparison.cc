// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "comparison/run_measurement.h"
#include "fuzz/process/address_space.h"
#include "fuzz/process/command.h"
#include "gnomon/algorithms/method.h"
#include "report/text/number_text.h"
#include "report/text/shell_word.h"

namespace gnomon::comparison {

namespace {

/// The last whole line that is a measurement; none before the clock has stopped.
std::optional<Measurement> last_measurement(const std::string& text) {
  std::optional<Measurement> last;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    auto parsed = parse_measurement(std::string_view(text).substr(begin, end - begin));
    if (parsed) last = std::move(*parsed);
  }
  return last;
}

bool ran_out_of_memory(const fuzz::CommandResult& result) {
  if (result.end == fuzz::CommandEnd::kExited) return result.status == kOutOfMemoryStatus;
  // GMP ends the program itself.
  return result.end == fuzz::CommandEnd::kSignal &&
         (result.errors.find("annot allocate memory") != std::string::npos ||
          result.errors.find("bad_alloc") != std::string::npos);
}

/// Puts into the measurement that a process did not come to its end.
void set_end(Measurement& measurement, const fuzz::CommandResult& result, const RunLimits& limits) {
  using fuzz::CommandEnd;
  if (ran_out_of_memory(result)) {
    measurement.end = RunEnd::kMemory;
    measurement.why = fmt::format("more than {} MB", limits.megabytes);
  } else if (result.end == CommandEnd::kTimeout) {
    measurement.end = RunEnd::kTime;
    measurement.why = fmt::format("no end within {} s", report::shortest(limits.seconds));
  } else {
    measurement.end = RunEnd::kCrashed;
    measurement.why = fuzz::how_it_ended(result);
  }
  if (measurement.timed()) {
    measurement.why += measurement.checksum.empty() ? ", for the answer" : ", while it was judged";
  }
}

/// What no size changes: the rows over which time grows.
using Series = std::tuple<std::string, std::string, std::string>;
Series series_of(const RunRequest& request) {
  return {request.scene, request.system, request.kernel};
}

bool too_much(const Measurement& measurement) {
  return !measurement.timed() &&
         (measurement.end == RunEnd::kTime || measurement.end == RunEnd::kMemory ||
          measurement.end == RunEnd::kLimit);
}

std::vector<Growth> growth_of(const std::vector<Row>& rows) {
  struct Points {
    std::vector<double> polygons, seconds;
    std::size_t last = 0;
  };
  std::map<Series, Points> series;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Measurement& measurement = rows[i].measurement;
    if (!rows[i].request.size || !measurement.timed() || measurement.seconds <= 0) continue;
    Points& points = series[series_of(rows[i].request)];
    const auto polygons = static_cast<double>(rows[i].polygons);
    if (!points.polygons.empty() && polygons > std::ranges::max(points.polygons)) points.last = i;
    if (points.polygons.empty()) points.last = i;
    points.polygons.push_back(polygons);
    points.seconds.push_back(measurement.seconds);
  }
  std::vector<Growth> growth;
  for (const auto& [name, points] : series) {
    if (points.polygons.size() < 2) continue;
    const auto& [scene, system, kernel] = name;
    growth.push_back({scene, system, kernel, growth_exponent(points.polygons, points.seconds),
                      points.polygons.size(), points.last});
  }
  std::ranges::sort(growth, {}, &Growth::last);
  return growth;
}

}  // namespace

std::vector<std::string> systems_for(LightsAsked lights) {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    const bool takes = lights == LightsAsked::kArea ? method.lights.area : method.lights.point;
    if (takes && method.chosen_by_name) names.emplace_back(method.name);
  }
  return names;
}

std::vector<std::string> contradictions_of(const std::vector<const Row*>& rows) {
  std::vector<std::string> found;
  std::map<std::tuple<std::string, std::optional<std::uint64_t>, LightsAsked>, const Row*> first;
  for (const Row* const each : rows) {
    const Row& row = *each;
    const Measurement& measurement = row.measurement;
    if (!measurement.exact || measurement.checksum.empty()) continue;
    if (measurement.judgement && !measurement.judgement->confirms) {
      found.push_back(row.request.kernel + '/' + row.request.system + " on " + row.request.scene +
                      ": " + measurement.judgement->verdict + "; " + row.command);
    }
    const Row*& other = first[{row.request.scene, row.request.size, row.request.lights}];
    if (other == nullptr) other = &row;
    if (other->measurement.checksum == measurement.checksum) continue;
    found.push_back(row.request.kernel + '/' + row.request.system + " on " + row.request.scene +
                    ": another answer than " + other->request.kernel + '/' + other->request.system +
                    "; " + row.command);
  }
  return found;
}

double growth_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / n;
    mean_y += std::log(y[i]) / n;
  }
  double covariance = 0, variance = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double from_mean = std::log(x[i]) - mean_x;
    covariance += from_mean * (std::log(y[i]) - mean_y);
    variance += from_mean * from_mean;
  }
  return covariance / variance;
}

Expected<void> for_each_scene(
    const std::vector<SceneSource>& scenes, std::vector<std::uint64_t> sizes, std::uint64_t seed,
    const std::function<void(const Scene& scene, const RunRequest& request)>& visit) {
  std::ranges::sort(sizes);
  for (const SceneSource& source : scenes) {
    std::vector<std::optional<std::uint64_t>> asked(sizes.begin(), sizes.end());
    if (!source.takes_size() || asked.empty()) asked = {std::nullopt};
    std::set<std::size_t> there;  // numbers of polygons
    for (const auto& size : asked) {
      const auto scene = source.make(size, seed);
      if (!scene) return tl::unexpected(scene.error());
      if (!there.insert(scene->polygons.size()).second) continue;
      if (scene->lights.empty()) {
        return fail(ErrorCode::kUsage, source.name() + ": there is no light", "a scene with one");
      }
      RunRequest request;
      request.scene = source.name();
      request.size = size;
      request.seed = seed;
      visit(*scene, request);
    }
  }
  return {};
}

Expected<std::vector<Planned>> planned_runs(const ComparePlan& plan) {
  std::vector<Planned> all;
  const auto add = [&](const Scene& scene, RunRequest request) {
    const bool area = std::ranges::all_of(scene.lights, &Light::has_area);
    request.lights = area ? LightsAsked::kArea : LightsAsked::kPoint;
    request.repeat = plan.repeat;
    request.certify_up_to = plan.certify_up_to;
    for (const std::string& system :
         plan.systems.empty() ? systems_for(request.lights) : plan.systems) {
      for (const std::string& kernel : plan.kernels) {
        const auto most = plan.most_polygons.find(kernel);
        if (most != plan.most_polygons.end() && scene.polygons.size() > most->second) continue;
        request.system = system;
        request.kernel = kernel;
        all.push_back({request, scene.polygons.size()});
      }
    }
  };
  if (auto done = for_each_scene(plan.scenes, plan.sizes, plan.seed, add); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  return all;
}

RunRequest reference_of(const RunRequest& request) {
  RunRequest reference = request;
  reference.system = request.lights == LightsAsked::kArea ? "receiver" : "svbsp";
  reference.kernel = "double";
  return reference;
}

Expected<Measurement> run_in_process(const RunProgram& program, const RunRequest& request,
                                     const RunLimits& limits,
                                     const std::atomic<bool>* interrupted) {
  fuzz::CommandOptions options;
  options.arguments = {program.program};
  options.arguments.insert(options.arguments.end(), program.arguments.begin(),
                           program.arguments.end());
  options.arguments.push_back(request_text(request));
  options.seconds = limits.seconds;
  options.megabytes =
      limits.megabytes == 0 ? 0 : limits.megabytes + (fuzz::address_space_taken() >> 20);
  options.interrupted = interrupted;
  const auto result = fuzz::run_command("", options);  // the program is the first argument
  if (!result) return tl::unexpected(result.error());
  if (result->end == fuzz::CommandEnd::kNotFound) {
    return fail(ErrorCode::kFile, program.program + ": " + fuzz::how_it_ended(*result));
  }
  std::optional<Measurement> told = last_measurement(result->out);
  if (result->succeeded() && told) return std::move(*told);
  Measurement measurement = told.value_or(Measurement{});
  set_end(measurement, *result, limits);
  return measurement;
}

std::string command_of(const RunRequest& request, const RunLimits& limits) {
  const RunLimits usual;
  std::string text = "gnomon compare " + report::shell_word(request.scene);
  if (request.size) text += " --size " + std::to_string(*request.size);
  if (request.seed != 1) text += " --seed " + std::to_string(request.seed);
  text += " --algorithm " + report::shell_word(request.system) + " --kernel " +
          report::shell_word(request.kernel);
  if (request.repeat > 0) text += " --repeat " + std::to_string(request.repeat);
  if (request.certify_up_to != kCertifyUpTo) {
    text += " --certify-up-to " + std::to_string(request.certify_up_to);
  }
  if (limits.seconds != usual.seconds) text += " --time " + report::shortest(limits.seconds);
  if (limits.megabytes != usual.megabytes) text += " --memory " + std::to_string(limits.megabytes);
  return text;
}

Expected<Comparison> compare(const ComparePlan& plan, const RunProgram& program,
                             const CompareControl& control) {
  const auto all = planned_runs(plan);
  if (!all) return tl::unexpected(all.error());
  Comparison comparison;
  std::map<std::string, Measurement> done;  // by the request's text
  std::map<Series, std::uint64_t> stopped;  // the size that was too much
  const auto run = [&](const RunRequest& request) -> Expected<Measurement> {
    const std::string key = request_text(request);
    if (const auto before = done.find(key); before != done.end()) return before->second;
    if (control.progress) control.progress(request, comparison.rows.size(), all->size());
    const auto too_large = stopped.find(series_of(request));
    if (request.size && too_large != stopped.end() && *request.size > too_large->second) {
      Measurement measurement;
      measurement.end = RunEnd::kNotRun;
      measurement.why = "too much at size " + std::to_string(too_large->second) + " already";
      return measurement;
    }
    auto measurement = run_in_process(program, request, plan.limits, control.interrupted);
    if (!measurement) return measurement;
    if (request.size && too_much(*measurement)) stopped[series_of(request)] = *request.size;
    done[key] = *measurement;
    return measurement;
  };
  for (const auto& [request, polygons] : *all) {
    RunRequest reference = reference_of(request);
    // A reference that is no row itself is not judged.
    if (std::ranges::find(*all, reference, &Planned::request) == all->end())
      reference.certify_up_to = 0;
    const auto base = run(reference);
    auto measured = base ? run(request) : base;
    if (!measured) {
      if (measured.error().code != ErrorCode::kInterrupted) {
        return tl::unexpected(measured.error());
      }
      comparison.interrupted = true;
      break;
    }
    Row row{request, polygons, std::move(*measured), {}, command_of(request, plan.limits)};
    if (base->timed() && base->seconds > 0 && row.measurement.timed()) {
      row.ratio = row.measurement.seconds / base->seconds;
    }
    comparison.rows.push_back(std::move(row));
  }
  comparison.growth = growth_of(comparison.rows);
  std::vector<const Row*> rows;
  for (const Row& row : comparison.rows) rows.push_back(&row);
  comparison.contradictions = contradictions_of(rows);
  return comparison;
}

}  // namespace gnomon::comparison
