// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/extras.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "gnomon/algorithms/caster_counts.h"
#include "gnomon/algorithms/form_factor.h"
#include "gnomon/scene/groups.h"
#include "gnomon/scene/number.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

using report::SideFactor;

const std::string& light_id(const LoadedScene& loaded, std::uint32_t light) {
  return loaded.scene.lights[loaded.prepared.lights[light].light].id;
}

Expected<std::array<double, 3>> parse_up(const std::string& text) {
  std::array<double, 3> up{0, 0, 1};
  if (text.empty()) return up;
  std::size_t begin = 0;
  bool all_zero = true;
  for (std::size_t k = 0; k < up.size(); ++k) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto number = Number::parse(text.substr(begin, end - begin), NumberMeaning::kDouble);
    const bool last = end == text.size();
    if (!number || last != (k == 2)) {
      return fail(ErrorCode::kUsage, "--up '" + text + "' is no direction", "x,y,z");
    }
    up[k] = number->nearest();
    all_zero = all_zero && up[k] == 0;
    begin = end + 1;
  }
  if (all_zero) return fail(ErrorCode::kUsage, "--up is 0,0,0", "a direction");
  return up;
}

Expected<std::uint32_t> polygon_of(const LoadedScene& loaded, const std::string& id) {
  const auto& polygons = loaded.scene.polygons;
  const auto found = std::ranges::find(polygons, id, &Polygon::id);
  if (found == polygons.end()) {
    return fail(ErrorCode::kUsage, "--view-factor: there is no polygon \"" + id + "\"",
                "the id of a polygon");
  }
  return static_cast<std::uint32_t>(found - polygons.begin());
}

bool was_dropped(const LoadedScene& loaded, std::uint32_t polygon) {
  return loaded.prepared.first_part[polygon] == loaded.prepared.first_part[polygon + 1];
}

/// An entry for each side of a polygon that receives.
void add_sides(const LoadedScene& loaded, std::uint32_t polygon, std::uint32_t to,
               std::vector<SideFactor>& factors) {
  if (was_dropped(loaded, polygon)) return;
  factors.push_back({polygon, Side::kFront, to, {}});
  if (loaded.scene.is_two_sided(loaded.scene.polygons[polygon])) {
    factors.push_back({polygon, Side::kBack, to, {}});
  }
}

/// Finds all factors, on all threads. The first error ends it.
template <class Find>
Expected<void> find_factors(std::vector<SideFactor>& factors, const Find& find) {
  std::vector<std::optional<Error>> errors(factors.size());
  tbb::parallel_for(std::size_t{0}, factors.size(), [&](std::size_t i) {
    auto found = find(factors[i]);
    if (found) {
      factors[i].factor = *found;
    } else {
      errors[i] = found.error();
    }
  });
  for (const std::optional<Error>& error : errors) {
    if (error) return tl::unexpected<Error>(*error);
  }
  const auto wide = std::ranges::count_if(
      factors, [](const SideFactor& one) { return !one.factor.within_tolerance; });
  if (wide > 0) {
    warn(std::to_string(wide) + " of " + std::to_string(factors.size()) +
         " form factors have wider bounds than --factor-tolerance; more --factor-cells");
  }
  return {};
}

Expected<void> find_form_factors(const ExtrasOptions& options, const LoadedScene& loaded,
                                 report::ResultExtras& extras) {
  FormFactorOptions factor;
  factor.tolerance = options.tolerance;
  factor.most_cells = options.most_cells;
  factor.interrupted = &interrupted();
  auto up = parse_up(options.up);
  if (!up) return tl::unexpected(std::move(up.error()));
  factor.up = extras.up = *up;
  for (const auto& [from, to] : options.view_factors) {
    const auto first = polygon_of(loaded, from), second = polygon_of(loaded, to);
    if (!first) return tl::unexpected(first.error());
    if (!second) return tl::unexpected(second.error());
    if (was_dropped(loaded, *first)) {
      return fail(ErrorCode::kUsage, "--view-factor: polygon \"" + from + "\" was dropped",
                  "a polygon of positive area");
    }
    add_sides(loaded, *first, *second, extras.view_factors);
  }
  if (options.sky) {
    for (std::uint32_t i = 0; i < loaded.scene.polygons.size(); ++i) {
      add_sides(loaded, i, 0, extras.sky);
    }
    auto done = find_factors(extras.sky, [&](const SideFactor& one) {
      return sky_factor(loaded.prepared, one.polygon, one.side, factor);
    });
    if (!done) return done;
  }
  return find_factors(extras.view_factors, [&](const SideFactor& one) {
    return view_factor(loaded.prepared, one.polygon, one.side, one.to, factor);
  });
}

}  // namespace

void add_extras_options(CLI::App& command, ExtrasOptions& options) {
  command.add_flag(
      "--counts", options.counts,
      "Also areas by the number of casters between them and the light, for shades that\n"
      "let some of it through (point and directional lights)");
  command.add_flag("--centroids", options.centroids, "Also the centroid of the lit part");
  command.add_flag("--groups", options.groups,
                   "Also sums of groups of polygons: an OBJ file's, or those that the scene's\n"
                   "\"extra\" names");
  CLI::Option* sky = command.add_flag(
      "--sky", options.sky,
      "Also the form factor of each polygon to the sky, with bounds; needs no light");
  command.add_option("--up", options.up, "Where the sky is [0,0,1]")
      ->needs(sky)
      ->type_name("x,y,z");
  command
      .add_option(
          "--view-factor", options.view_factors,
          "Also the form factor from a polygon to another, what is between them hidden, with\n"
          "bounds; needs no light (repeatable)")
      ->type_name("FROM TO");
  command
      .add_option("--factor-tolerance", options.tolerance,
                  "How far apart the bounds of a form factor may be")
      ->check(not_negative())
      ->type_name("F")
      ->default_str(report::shortest(options.tolerance));
  command
      .add_option("--factor-cells", options.most_cells,
                  "Into how many triangles a polygon is cut at most for that")
      ->check(CLI::PositiveNumber)
      ->type_name("N")
      ->capture_default_str();
}

Expected<void> ask_for_extras(const ExtrasOptions& options, const LoadedScene& loaded,
                              ShadowOptions& shadows) {
  if (options.counts) {
    for (const std::uint32_t light : loaded.lights) {
      if (!loaded.prepared.lights[light].has_area()) continue;
      return fail(ErrorCode::kUsage,
                  "--counts: light " + light_id(loaded, light) +
                      " has an area, and each point of it other casters before it",
                  "point and directional lights; --light chooses some");
    }
  }
  if (options.centroids) {
    if (shadows.method.options.cover == Cover::kOverlay) {
      return fail(ErrorCode::kUsage, "--centroids: with cover=overlay fragments do not tile",
                  "cover=partition");
    }
    (kernel_info(shadows.kernel.id).exact ? shadows.output.exact_points : shadows.output.points) =
        true;
  }
  return {};
}

Expected<report::ResultExtras> find_extras(const ExtrasOptions& options, const LoadedScene& loaded,
                                           const ShadowOptions& shadows) {
  report::ResultExtras extras;
  extras.centroids = options.centroids;
  if (options.groups) {
    auto groups = polygon_groups(loaded.scene);
    if (!groups) return tl::unexpected(std::move(groups.error()));
    if (groups->empty()) {
      return fail(ErrorCode::kUsage, "--groups: " + loaded.scene.file + " names no groups",
                  "g or o lines in an OBJ file, or \"extra\": {\"groups\": {name: [ids]}}");
    }
    extras.groups = std::move(*groups);
  }
  if (options.counts) {
    auto counts = count_casters(loaded.prepared, shadows);
    if (!counts) return tl::unexpected(std::move(counts.error()));
    extras.counts = std::move(*counts);
  }
  if (auto done = find_form_factors(options, loaded, extras); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  return extras;
}

}  // namespace gnomon::cli
