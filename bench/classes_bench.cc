// SPDX-License-Identifier: GPL-3.0-or-later
// Crow 1977, "a comparison of the three classes", measured: what each needs besides the scene, what
// shadows add to a picture's time, how both grow, and how much code there is. A class whose method
// is not built yet has its row, and is filled in by this same table once it is.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "answers.h"
#include "gnomon/algorithms/pixels.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"
#include "views.h"

namespace gnomon::bench {
namespace {

struct ClassMethod {
  std::string_view of, method;
};
constexpr std::array<ClassMethod, 4> kClasses{
    {{"one", "scan-out"}, {"two", "two-pass"}, {"two", "blots"}, {"three", "shadow-polygons"}}};

std::optional<MethodId> built(std::string_view name) {
  for (const Domain domain : {Domain::kObjectSpace, Domain::kImageSpace}) {
    if (const auto id = method_by_name(name, domain)) return id;
  }
  return std::nullopt;
}

/// Lines of a method's room that are neither empty nor comment alone; 0 if the sources are not
/// where the program was built from.
std::uint64_t lines_of_code(std::string_view method) {
  std::string room(method);
  std::ranges::replace(room, '-', '_');
  const std::filesystem::path folder = std::filesystem::path(GNOMON_BENCH_ROOMS) / room;
  std::uint64_t count = 0;
  std::error_code none;
  for (const auto& file : std::filesystem::directory_iterator(folder, none)) {
    const std::string kind = file.path().extension().string();
    if (kind != ".h" && kind != ".cc") continue;
    std::ifstream source(file.path());
    for (std::string line; std::getline(source, line);) {
      const std::size_t first = line.find_first_not_of(" \t");
      count += first != std::string::npos && line.compare(first, 2, "//") != 0;
    }
  }
  return count;
}

/// Fragments with their corners as doubles; or what the method counts of its own memory.
std::uint64_t bytes_of(const PreparedView& view, const Method& method, const Pixels& pixels) {
  if (method.makes_fragments) {
    ShadowOptions options;
    options.kernel.id = KernelId::kDouble;
    options.method.point = method.id;
    options.output.points = true;
    std::uint64_t bytes = 0;
    for (const LightResult& light : shadows_or_stop(view.scene, options).lights) {
      bytes += light.fragments.size() * sizeof(Fragment) +
               light.points.size() * sizeof(light.points.front());
    }
    return bytes;
  }
  std::uint64_t bytes = 0;
  for (const Counter counter : method.counters) {
    if (counter_info(counter).name.ends_with("bytes")) bytes += pixels.work[counter];
  }
  return bytes;
}

struct Picture {
  Pixels pixels;
  double seconds = 0;  // CPU, the least of all rounds
};

Picture drawn(const PreparedView& view, MethodId method, int rounds) {
  PixelOptions options;
  options.kernel.id = KernelId::kDouble;
  options.method = method;
  options.jobs = 1;
  Picture picture{{}, std::numeric_limits<double>::infinity()};
  for (int round = 0; round < rounds; ++round) {
    Expected<Pixels> pixels = compute_pixels(view.scene, view.frame, options);
    if (!pixels) {
      fmt::print(stderr, "gnomon_bench: {}\n", to_string(pixels.error()));
      std::exit(2);
    }
    picture.seconds = std::min(picture.seconds, pixels->seconds);
    picture.pixels = std::move(*pixels);
  }
  return picture;
}

PreparedView view_or_stop(const Scene& scene, std::uint32_t size) {
  ExactCamera camera;
  Expected<PreparedView> view = view_from_a_corner(scene, size, camera);
  if (!view) {
    fmt::print(stderr, "gnomon_bench: {}\n", to_string(view.error()));
    std::exit(2);
  }
  return std::move(*view);
}

/// What a class needs on scenes of one family, by size.
struct Growth {
  std::vector<double> polygons, bytes, alone, with_shadows;  // seconds
};

Growth growth_of(MethodId method, const std::string& family, const std::vector<std::int64_t>& sizes,
                 std::uint32_t size, int rounds) {
  Growth growth;
  for (const std::int64_t n : sizes) {
    Scene scene = generated({family, {{"n", n}}});
    const PreparedView view = view_or_stop(scene, size);
    scene.lights.clear();
    const PreparedView dark = view_or_stop(scene, size);
    const Picture picture = drawn(view, method, rounds);
    growth.polygons.push_back(static_cast<double>(view.scene.parts.size()));
    growth.bytes.push_back(
        static_cast<double>(bytes_of(view, method_info(method), picture.pixels)));
    growth.alone.push_back(drawn(dark, MethodId::kZbuffer, rounds).seconds);
    growth.with_shadows.push_back(picture.seconds);
  }
  return growth;
}

std::vector<std::string> row_of(const ClassMethod& entry, const std::string& family,
                                const Growth& growth) {
  std::vector<double> added;
  for (std::size_t i = 0; i < growth.alone.size(); ++i) {
    added.push_back(growth.with_shadows[i] - growth.alone[i]);
  }
  const double polygons = growth.polygons.back(), bytes = growth.bytes.back();
  const std::uint64_t lines = lines_of_code(entry.method);
  return {std::string(entry.of),
          std::string(entry.method),
          fmt::format("{}, {:.0f}", family, polygons),
          bytes > 0 ? fmt::format("{:.0f}", bytes / polygons) : "-",
          bytes > 0 ? fmt::format("{:.2f}", growth_exponent(growth.polygons, growth.bytes)) : "-",
          short_number(1e3 * growth.alone.back()),
          short_number(1e3 * added.back()),
          fmt::format("{:.1f}", growth.with_shadows.back() / growth.alone.back()),
          fmt::format("{:.2f}", growth_exponent(growth.polygons, added)),
          lines == 0 ? "-" : std::to_string(lines)};
}

}  // namespace

bool run_classes(Extent extent) {
  const bool is_short = extent == Extent::kShort;
  const std::uint32_t size = is_short ? 32 : 128;
  const int rounds = is_short ? 1 : 3;
  fmt::print(
      "\nCrow 1977, the three classes: {0} x {0} samples, kernel double, one thread. Bytes that a "
      "class needs besides the scene,\na polygon, and their growth with polygons; milliseconds of "
      "CPU of the picture without lights, and what shadows add (least of\n{1} runs), their ratio "
      "and the growth of what is added; lines of code of the method's own room.\n",
      size, rounds);
  struct Family {
    const char* name;
    std::vector<std::int64_t> sizes;
  };
  const std::vector<Family> families =
      is_short ? std::vector<Family>{{"city", {5, 20}}}
               : std::vector<Family>{{"city", {10, 40, 160}}, {"quads", {50, 200, 800}}};
  Table table({"class", "method", "scene, polygons", "bytes", "growth", "alone, ms", "added, ms",
               "with / alone", "growth", "lines"});
  for (const ClassMethod& entry : kClasses) {
    const auto method = built(entry.method);
    if (!method) {
      table.add({std::string(entry.of), std::string(entry.method), "not built"});
      continue;
    }
    for (const auto& [family, sizes] : families) {
      table.add(row_of(entry, family, growth_of(*method, family, sizes, size, rounds)));
    }
  }
  table.print();
  return true;
}

}  // namespace gnomon::bench
