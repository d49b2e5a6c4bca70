// SPDX-License-Identifier: GPL-3.0-or-later
#include "area_check.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "exact_check.h"
#include "gnomon/oracle/witness_check.h"

namespace gnomon::test {
namespace {

std::string place_of(const Case& scene, const ShadowResult& result, std::uint32_t light,
                     const PartResult& part) {
  return fmt::format("{} by {}, light '{}', polygon '{}' {}", result.kernel, result.algorithm,
                     scene.scene().lights[scene.prepared().lights[light].light].id,
                     scene.scene().polygons[scene.prepared().parts[part.part].polygon].id,
                     part.side == Side::kBack ? "back" : "front");
}

bool holds(const Interval& interval, const mpq_class& exact) {
  return mpq_class(interval.lower) <= exact && exact <= mpq_class(interval.upper);
}

std::string check_sums(const Case& scene, const ShadowResult& result) {
  for (const LightResult& light : result.lights) {
    if (light.dropped_slivers != 0) return result.kernel + ": dropped slivers";
    const bool area = scene.is_area(light.light);
    if (area != (light.area_fractions.size() == light.parts.size())) {
      return result.kernel + ": not one penumbra and umbra a side";
    }
    for (std::size_t i = 0; i < light.parts.size(); ++i) {
      const PartResult& part = light.parts[i];
      static const AreaFractions kNone;
      const AreaFractions& fractions = area ? light.area_fractions[i] : kNone;
      const ExactFractions& exact = light.exact_fractions[i];
      const mpq_class sum = exact.lit + exact.shadow + exact.penumbra + exact.umbra;
      if (sum != 1 || exact.lit < 0 || exact.shadow < 0 || exact.penumbra < 0 || exact.umbra < 0 ||
          (area && exact.shadow != 0) || !holds(part.lit, exact.lit) ||
          !holds(part.shadow, exact.shadow) || !holds(fractions.penumbra, exact.penumbra) ||
          !holds(fractions.umbra, exact.umbra)) {
        return fmt::format("{}: lit {}, shadow {}, penumbra {}, umbra {}",
                           place_of(scene, result, light.light, part), exact.lit.get_str(),
                           exact.shadow.get_str(), exact.penumbra.get_str(), exact.umbra.get_str());
      }
    }
  }
  return {};
}

/// Bounds from doubles alone.
std::string check_bounds(const Case& scene, const ShadowResult& exact, ShadowOptions options) {
  options.output.exact_fractions = options.output.exact_points = false;
  const Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
  if (!result) return to_string(result.error());
  for (std::size_t l = 0; l < exact.lights.size(); ++l) {
    const LightResult &truth = exact.lights[l], &bounds = result->lights[l];
    for (std::size_t i = 0; i < truth.area_fractions.size(); ++i) {
      const ExactFractions& own = truth.exact_fractions[i];
      const AreaFractions& bound = bounds.area_fractions[i];
      if (!holds(bounds.parts[i].lit, own.lit) || !holds(bound.penumbra, own.penumbra) ||
          !holds(bound.umbra, own.umbra) || bound.penumbra.upper - bound.penumbra.lower > 1e-6 ||
          bound.umbra.upper - bound.umbra.lower > 1e-6) {
        return fmt::format("{}: penumbra {} is not in [{}, {}], or umbra {} not in [{}, {}]",
                           place_of(scene, exact, truth.light, truth.parts[i]),
                           own.penumbra.get_str(), bound.penumbra.lower, bound.penumbra.upper,
                           own.umbra.get_str(), bound.umbra.lower, bound.umbra.upper);
      }
    }
  }
  return {};
}

/// What contour tells of a class: all, none, or some of a side.
bool tells(const Interval& told, const mpq_class& exact) {
  if (exact == 0 || exact == 1) return told.lower == exact && told.upper == exact;
  return told.lower < told.upper && holds(told, exact);
}

/// Classes and shares by contour: every class is told for certain, and bounds hold.
std::string check_contour(const Case& scene, const ShadowResult& exact, ShadowOptions options) {
  options.output.exact_fractions = options.output.exact_points = options.output.points = false;
  options.method.area = MethodId::kContour;
  const Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
  if (!result) return to_string(result.error());
  for (std::size_t l = 0; l < exact.lights.size(); ++l) {
    const LightResult &truth = exact.lights[l], &told = result->lights[l];
    if (!scene.is_area(truth.light)) continue;
    if (truth.parts.size() != told.parts.size() || !told.fragments.empty()) {
      return result->algorithm + ": other sides, or fragments";
    }
    for (std::size_t i = 0; i < truth.parts.size(); ++i) {
      const PartResult& part = told.parts[i];
      const ExactFractions& own = truth.exact_fractions[i];
      const AreaFractions& bound = told.area_fractions[i];
      const bool same = part.part == truth.parts[i].part && part.side == truth.parts[i].side &&
                        part.reason == truth.parts[i].reason;
      if (!same || !tells(part.lit, own.lit) || !tells(bound.penumbra, own.penumbra) ||
          !tells(bound.umbra, own.umbra)) {
        return fmt::format("{}: lit {} in [{}, {}], penumbra {} in [{}, {}], umbra {} in [{}, {}]",
                           place_of(scene, *result, truth.light, part), own.lit.get_str(),
                           part.lit.lower, part.lit.upper, own.penumbra.get_str(),
                           bound.penumbra.lower, bound.penumbra.upper, own.umbra.get_str(),
                           bound.umbra.lower, bound.umbra.upper);
      }
    }
  }
  return {};
}

std::string compare_results(const Case& scene, const ShadowResult& a, const ShadowResult& b) {
  if (a.lights.size() != b.lights.size()) return "not the same lights";
  for (std::size_t l = 0; l < a.lights.size(); ++l) {
    const LightResult &one = a.lights[l], &two = b.lights[l];
    if (one.parts.size() != two.parts.size() ||
        one.area_fractions.size() != two.area_fractions.size()) {
      return a.algorithm + " and " + b.algorithm + " list different sides";
    }
    for (std::size_t i = 0; i < one.parts.size(); ++i) {
      const PartResult &p = one.parts[i], &q = two.parts[i];
      const ExactFractions &first = one.exact_fractions[i], &second = two.exact_fractions[i];
      const bool same = p.part == q.part && p.side == q.side && p.reason == q.reason &&
                        first.lit == second.lit && first.shadow == second.shadow &&
                        first.penumbra == second.penumbra && first.umbra == second.umbra;
      if (!same) {
        return fmt::format("{}: lit {}; {}: lit {}", place_of(scene, a, one.light, p),
                           first.lit.get_str(), place_of(scene, b, two.light, q),
                           second.lit.get_str());
      }
    }
  }
  return {};
}

std::string compare_with_oracle(const Case& scene, const ShadowResult& result) {
  const oracle::Report report = judge(scene, result);
  if (report.oracle_fault) return "the oracle contradicts itself: " + report.reason;
  if (report.verdict != oracle::Verdict::kIdentical) {
    std::string wrong = fmt::format("{} by {}: {}: {}", result.kernel, result.algorithm,
                                    oracle::name_of(report.verdict), report.reason);
    for (const std::string& problem : report.problems) wrong += "; " + problem;
    if (report.worst) {
      wrong += fmt::format("; light '{}', polygon '{}' {}, at ({}, {}, {})", report.worst->light,
                           report.worst->polygon, name_of(report.worst->side),
                           report.worst->point[0].get_str(), report.worst->point[1].get_str(),
                           report.worst->point[2].get_str());
    }
    return wrong;
  }
  oracle::WitnessOptions exactly;
  exactly.tolerance = 0;
  exactly.width = 0;
  const oracle::WitnessReport claims =
      oracle::check_witnesses(scene.scene(), scene.prepared(), claims_of(scene, result), exactly);
  if (claims.findings.empty()) return {};
  const oracle::WitnessFinding& finding = claims.findings.front();
  return fmt::format("{} by {}: claims, light '{}', polygon '{}': {}", result.kernel,
                     result.algorithm, finding.light, finding.polygon, finding.text);
}

/// Twice the area vector of a loop, as one number: coplanar loops of one orientation add up.
mpq_class signed_area(const std::array<mpq_class, 3>* points, std::size_t count) {
  std::array<mpq_class, 3> sum;
  for (std::size_t i = 2; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      sum[k] += (points[i - 1][u] - points[0][u]) * (points[i][v] - points[0][v]) -
                (points[i - 1][v] - points[0][v]) * (points[i][u] - points[0][u]);
    }
  }
  // Distinct weights, so that no plane but few hide their area.
  return sum[0] + 1009 * sum[1] + 917503 * sum[2];
}

/// In the pipeline of all lights, the area of what each light reaches is what it is alone.
std::string check_combined(const Case& scene, ShadowOptions options) {
  options.output.combined = true;
  const Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
  if (!result) return to_string(result.error());
  const PreparedScene& prepared = scene.prepared();
  for (std::size_t l = 0; l < result->lights.size(); ++l) {
    const LightResult& light = result->lights[l];
    for (std::size_t i = 0; i < light.parts.size(); ++i) {
      const PartResult& part = light.parts[i];
      if (part.reason != ShadowReason::kNone) continue;
      mpq_class lit = 0, penumbra = 0, all = 0;
      for (const CombinedFragment& fragment : result->combined) {
        if (fragment.part != part.part || fragment.side != part.side) continue;
        const mpq_class area =
            signed_area(result->combined_exact_points.data() + fragment.first, fragment.count);
        all += area;
        if ((fragment.lit_by >> l & 1) != 0) lit += area;
        if ((fragment.penumbra_of >> l & 1) != 0) penumbra += area;
      }
      if (all == 0) {
        std::vector<std::array<mpq_class, 3>> loop;
        for (const VertexId v : prepared.loop(prepared.parts[part.part])) {
          std::array<mpq_class, 3>& p = loop.emplace_back();
          for (int k = 0; k < 3; ++k)
            p[static_cast<std::size_t>(k)] = prepared.geometry.grid.at(v, k);
        }
        // A plane that the weights hide, which is no fault.
        if (signed_area(loop.data(), loop.size()) == 0) continue;
        return place_of(scene, *result, light.light, part) + ": no combined fragments";
      }
      const ExactFractions& alone = light.exact_fractions[i];
      if (lit / all != alone.lit || penumbra / all != alone.penumbra) {
        return fmt::format("{}: lit {} alone, {} combined",
                           place_of(scene, *result, light.light, part), alone.lit.get_str(),
                           mpq_class(lit / all).get_str());
      }
    }
  }
  // Each light by itself, and of the sets, one after another.
  const bool judged =
      options.method.area == MethodId::kMerged && options.kernel.id == KernelId::kPlane;
  return judged ? compare_with_oracle(scene, *result) : std::string();
}

/// A way to the shadows of a scene, and how much is asked of it besides its fractions. `bounds`:
/// from doubles alone, and by contour.
struct Variant {
  ShadowOptions options;
  bool oracle = false, combined = false, bounds = false;
};

/// The volume trees in all their ways.
void add_merged(ShadowOptions options, std::vector<Variant>& all) {
  const bool plane = options.kernel.id == KernelId::kPlane;
  options.tuning.jobs = 1;
  options.method.area = MethodId::kMerged;
  if (options.kernel.id != KernelId::kEpeck) {
    options.output.merge = false;
    all.push_back({options, !plane, true});
    options.output.merge = true;
  }
  options.method.options.interleaved = true;
  all.push_back({options, plane});
  options.method.options.interleaved = options.kernel.id == KernelId::kRational;
  options.method.options.caps = true;
  all.push_back({options});
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const KernelId kernel : kExactKernels) {
    ShadowOptions options = options_for(kernel);
    options.tuning.jobs = kernel == KernelId::kPlane ? 2 : 1;
    options.method.point = kernel == KernelId::kRational ? MethodId::kReceiver : MethodId::kSectors;
    const bool is_first = all.empty();
    all.push_back({options, is_first, is_first, is_first});
    add_merged(options, all);
  }
  return all;
}

}  // namespace

std::string check_area_exact(const Case& scene) {
  ShadowResult first;
  for (const Variant& variant : variants()) {
    Expected<ShadowResult> result = compute_shadows(scene.prepared(), variant.options);
    if (!result) return to_string(result.error());
    const bool is_first = first.kernel.empty();
    std::string wrong = check_sums(scene, *result);
    if (wrong.empty() && !is_first) wrong = compare_results(scene, first, *result);
    if (wrong.empty() && variant.oracle) wrong = compare_with_oracle(scene, *result);
    if (wrong.empty() && variant.bounds) wrong = check_bounds(scene, *result, variant.options);
    if (wrong.empty() && variant.bounds) wrong = check_contour(scene, *result, variant.options);
    if (wrong.empty() && variant.combined) wrong = check_combined(scene, variant.options);
    if (!wrong.empty()) return wrong;
    if (is_first) first = std::move(*result);
  }
  return {};
}

std::string check_area_contour(const Case& scene) {
  const ShadowOptions options = options_for(KernelId::kPlane);
  const Expected<ShadowResult> exact = compute_shadows(scene.prepared(), options);
  return exact ? check_contour(scene, *exact, options) : to_string(exact.error());
}

Fractions3 area_fractions_of(const Case& scene, const ShadowOptions& options,
                             const std::string& light, const std::string& polygon, Side side) {
  const Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  for (const LightResult& own : result->lights) {
    if (scene.scene().lights[scene.prepared().lights[own.light].light].id != light) continue;
    for (std::size_t i = 0; i < own.parts.size(); ++i) {
      const PartResult& part = own.parts[i];
      const std::uint32_t owner = scene.prepared().parts[part.part].polygon;
      if (scene.scene().polygons[owner].id != polygon || part.side != side) continue;
      const ExactFractions& fractions = own.exact_fractions[i];
      return {fractions.lit, fractions.penumbra, fractions.umbra};
    }
  }
  throw std::runtime_error("no light '" + light + "' or no such side of '" + polygon + "'");
}

}  // namespace gnomon::test
