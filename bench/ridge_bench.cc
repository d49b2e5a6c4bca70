// SPDX-License-Identifier: GPL-3.0-or-later
// Thakur, Cheng & Miura, section 4, measured: the look-ups and times of their four objects, their
// cubes beside the trees and tiles of others, and what look-ups follow.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "answers.h"
#include "contest.h"
#include "gnomon/algorithms/pixels.h"
#include "gnomon/scene/camera.h"
#include "gnomon/scene/generate.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

/// What the paper prints of an object.
struct PrintedObject {
  const char* kind;  // of `gnomon generate closed`
  double polygons, table_ms, look_ups, look_up_ms;
};
constexpr std::array<PrintedObject, 4> kPrinted = {{{"block-on-block", 26, 25, 16229, 106},
                                                    {"letter", 330, 44, 21765, 135},
                                                    {"holed", 38, 40, 16834, 116},
                                                    {"coil3", 330, 54, 31552, 184}}};

[[noreturn]] void stop(const Error& error) {
  fmt::print(stderr, "gnomon_bench: {}\n", to_string(error));
  std::exit(2);
}

/// From beside the lamp and behind it, so that it sees everything ahead.
PreparedView view_past_the_lamp(const Scene& scene, std::uint32_t size) {
  const PreparedScene prepared = prepared_or_stop(scene);
  const std::array<double, 3> lamp = prepared.lights.front().point.nearest;
  CameraView view;
  for (const auto& x : prepared.geometry.polygon_positions()) {
    for (std::size_t k = 0; k < 3; ++k) {
      view.look_at[k] += x[k] / static_cast<double>(prepared.geometry.polygon_positions().size());
    }
  }
  Position eye;
  for (std::size_t k = 0; k < 3; ++k) {
    const double aside = k == 1 ? -0.2 : 0.1;
    const double way = lamp[k] - view.look_at[k];
    view.eye[k] = std::round(lamp[k] + 0.1 * way + aside * std::fabs(lamp[2] - view.look_at[2]));
    eye[k] = Number(view.eye[k]);
  }
  view.up = {0, 1, 0};
  view.width = view.height = size;
  view.field_of_view = fitting_field_of_view(prepared, view);
  const auto camera = make_camera(eye, view);
  if (!camera) stop(camera.error());
  auto prepared_view = prepare_view(scene, *camera);
  if (!prepared_view) stop(prepared_view.error());
  return *std::move(prepared_view);
}

struct Drawn {
  Pixels pixels;
  double seconds = std::numeric_limits<double>::infinity(), table = seconds, look_up = seconds;
};
/// The least of all rounds.
Drawn drawn(const PreparedView& view, const std::string& method, KernelId kernel, int rounds) {
  const MethodSelection selection = *parse_method(method, Domain::kImageSpace);
  PixelOptions options;
  options.kernel.id = kernel;
  options.method = selection.id;
  options.options = selection.values;
  options.jobs = 1;
  Drawn result;
  for (int round = 0; round < rounds; ++round) {
    auto pixels = compute_pixels(view.scene, view.frame, options);
    if (!pixels) stop(pixels.error());
    result.seconds = std::min(result.seconds, pixels->seconds);
    result.table = std::min(result.table, pixels->table_seconds);
    result.look_up = std::min(result.look_up, pixels->lookup_seconds);
    result.pixels = *std::move(pixels);
  }
  return result;
}
double look_ups(const Drawn& run) {
  return static_cast<double>(run.pixels.work[Counter::kLookUps]);
}

void objects(std::uint32_t size, int rounds) {
  fmt::print(
      "\nThakur, Cheng & Miura: four objects, 600 rows, {0} x {0} samples, kernel double. In "
      "parentheses: over the first object, ours and as printed.\n",
      size);
  Table table({"object", "polygons", "look-ups", "printed", "table, ms", "printed", "look-ups, ms",
               "printed", "us a look-up", "printed", "KiB"});
  Drawn first;
  for (const PrintedObject& printed : kPrinted) {
    const GeneratorInfo& info = *generator_by_name("closed");
    const Scene scene =
        generated({"closed", {{"kind", parameter_value(info, "kind", printed.kind).value()}}});
    const PreparedView view = view_past_the_lamp(scene, size);
    const Drawn run = drawn(view, "ridge-edges:order=file", KernelId::kDouble, rounds);
    if (&printed == kPrinted.data()) first = run;
    const auto both = [](double own, double own_first, double other, double other_first) {
      return std::array<std::string, 2>{
          fmt::format("{} ({:.2f})", short_number(own), own / own_first),
          fmt::format("{} ({:.2f})", short_number(other), other / other_first)};
    };
    const auto [fetched, fetched_printed] =
        both(look_ups(run), look_ups(first), printed.look_ups, kPrinted[0].look_ups);
    const auto [made, made_printed] =
        both(1e3 * run.table, 1e3 * first.table, printed.table_ms, kPrinted[0].table_ms);
    const auto [looked, looked_printed] =
        both(1e3 * run.look_up, 1e3 * first.look_up, printed.look_up_ms, kPrinted[0].look_up_ms);
    table.add(
        {printed.kind, grouped(view.scene.parts.size()), fetched, fetched_printed, made,
         made_printed, looked, looked_printed,
         fmt::format("{:.2f}", 1e6 * run.look_up / look_ups(run)),
         fmt::format("{:.2f}", 1e3 * printed.look_up_ms / printed.look_ups),
         fmt::format("{:.0f}", static_cast<double>(run.pixels.work[Counter::kTableBytes]) / 1024)});
  }
  table.print();
}

/// Figure 29: cubes in one hemisphere of the lamp.
bool cubes(const std::vector<std::int64_t>& counts, std::uint32_t size, int rounds) {
  fmt::print(
      "\nTheir cubes: CPU milliseconds, kernel double, {0} x {0} samples, polygons drawn near to "
      "far, as in the file (far to near) and far to near;\nbeside the same picture without light, "
      "and the classes of all polygons by svbsp and tiling.\n",
      size);
  Table table({"cubes", "table", "near", "file", "far", "look-ups, near", "far", "no light",
               "svbsp", "tiling"});
  bool right = true;
  std::vector<double> polygons, near_times, far_times, tree_times, tile_times, table_times;
  for (const std::int64_t n : counts) {
    Scene scene = generated({"cubes", {{"n", n}}});
    const PreparedView view = view_past_the_lamp(scene, size);
    const Drawn near = drawn(view, "ridge-edges:order=near", KernelId::kDouble, rounds);
    const Drawn file = drawn(view, "ridge-edges:order=file", KernelId::kDouble, rounds);
    const Drawn far = drawn(view, "ridge-edges:order=far", KernelId::kDouble, rounds);
    right = right && near.pixels.lit_by == far.pixels.lit_by && look_ups(near) <= look_ups(far);
    Contest contest(view.scene);
    contest.enter(options_for(MethodId::kSvbsp, KernelId::kDouble));
    contest.enter(options_for(MethodId::kTiling, KernelId::kDouble));
    contest.run(rounds);
    PixelOptions dark;
    dark.kernel.id = KernelId::kDouble;
    dark.jobs = 1;
    PreparedView unlit = view;
    unlit.scene.lights.clear();
    const auto alone = compute_pixels(unlit.scene, unlit.frame, dark);
    if (!alone) stop(alone.error());
    polygons.push_back(static_cast<double>(view.scene.parts.size()));
    near_times.push_back(near.seconds);
    far_times.push_back(far.seconds);
    table_times.push_back(near.table);
    tree_times.push_back(contest.cpu(0));
    tile_times.push_back(contest.cpu(1));
    const auto ms = [](double seconds) { return short_number(1e3 * seconds); };
    table.add({grouped(static_cast<std::uint64_t>(n)), ms(near.table), ms(near.seconds),
               ms(file.seconds), ms(far.seconds), grouped(near.pixels.work[Counter::kLookUps]),
               grouped(far.pixels.work[Counter::kLookUps]), ms(alone->seconds), ms(contest.cpu(0)),
               ms(contest.cpu(1))});
  }
  const auto exponent = [&](const std::vector<double>& times) {
    return fmt::format("{:.2f}", growth_exponent(polygons, times));
  };
  table.add({"growth", exponent(table_times), exponent(near_times), "", exponent(far_times), "", "",
             "", exponent(tree_times), exponent(tile_times)});
  table.print();
  return right;
}

/// One receiver under a small caster, tilted along the rows of the picture.
bool slopes(std::uint32_t size) {
  fmt::print(
      "\nLook-ups follow the picture: one polygon that slopes along the picture's rows, {0} x {0} "
      "samples.\n",
      size);
  Table table({"slope", "look-ups", "samples a look-up"});
  double before = 0;
  bool right = true;
  for (const std::int64_t slope : {0, 1, 2, 4}) {
    Scene scene;
    const auto add = [&](const char* id, std::vector<std::array<double, 3>> loop) {
      Polygon polygon;
      polygon.id = id;
      for (const auto& x : loop) {
        polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
        scene.vertices.push_back({Number(x[0]), Number(x[1]), Number(x[2])});
      }
      scene.polygons.push_back(std::move(polygon));
    };
    const double rise = 2.0 * static_cast<double>(slope);
    add("receiver",
        {{-8, -8, -rise - 16}, {8, -8, rise - 16}, {8, 8, rise - 16}, {-8, 8, -rise - 16}});
    add("caster", {{-2, -6, 0}, {2, -6, 0}, {2, 6, 0}, {-2, 6, 0}});
    Light lamp;
    lamp.id = "lamp";
    lamp.position = {Number(0.0), Number(3.0), Number(16.0)};
    scene.lights.push_back(lamp);
    const PreparedView view = view_past_the_lamp(scene, size);
    const Drawn run = drawn(view, "ridge-edges:depth=facing", KernelId::kPlane, 1);
    const double fetched = look_ups(run);
    right = right && fetched >= before;
    before = fetched;
    table.add(
        {std::to_string(slope), grouped(run.pixels.work[Counter::kLookUps]),
         fmt::format("{:.1f}", static_cast<double>(run.pixels.work[Counter::kSamples]) / fetched)});
  }
  table.print();
  return right;
}

}  // namespace

bool run_ridge(Extent extent) {
  const bool is_short = extent == Extent::kShort;
  const int rounds = is_short ? 1 : 3;
  objects(is_short ? 64 : 512, rounds);
  const std::vector<std::int64_t> counts =
      is_short ? std::vector<std::int64_t>{1, 20}
               : std::vector<std::int64_t>{1, 10, 50, 100, 500, 1000, 2000};
  const bool ordered = cubes(counts, is_short ? 64 : 512, rounds);
  return slopes(is_short ? 64 : 512) && ordered;
}

}  // namespace gnomon::bench
