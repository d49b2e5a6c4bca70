// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "gnomon/oracle/witness_check.h"
#include "method_variants.h"
#include "witness_check.h"

namespace gnomon::test {
namespace {

std::string polygon_of(const Case& scene, std::uint32_t part) {
  return scene.scene().polygons[scene.prepared().parts[part].polygon].id;
}

std::string name_of(const ShadowResult& result) {
  return result.kernel + " by " + result.algorithm;
}

std::string light_of(const Case& scene, std::uint32_t light) {
  return scene.scene().lights[scene.prepared().lights[light].light].id;
}

/// Facing and fractions of each group of coplanar parts against the oracle.
std::string compare_with_oracle(const Case& scene, const ShadowResult& result) {
  for (const LightResult& light : result.lights) {
    for (const oracle::AnswerEntry& entry : scene.answer().entries(light.light)) {
      for (const oracle::ReceiverGroup& group : entry.groups) {
        if (group.optional) continue;
        mpq_class lit = 0, shadow = 0;  // of the group's area
        mpq_class whole = 0;
        std::vector<mpq_class> areas;
        for (const std::uint32_t part : group.parts) {
          const PartResult& own = light.parts[part];
          const std::string place =
              fmt::format("{}, light '{}', polygon '{}'", name_of(result),
                          light_of(scene, light.light), polygon_of(scene, part));
          const bool faces = own.reason == ShadowReason::kNone;
          const bool in_plane = own.reason == ShadowReason::kLightInPlane;
          if (faces != group.faces || in_plane != group.light_in_plane ||
              (faces && own.side != entry.side)) {
            return place + ": faces otherwise than the oracle says";
          }
          // Coplanar parts: areas are in the ratio of any component of their area vectors.
          const Part& prepared = scene.prepared().parts[part];
          const auto loop = scene.prepared().loop(prepared);
          const GridPositions& grid = scene.prepared().geometry.grid;
          std::array<mpz_class, 3> area;
          for (std::size_t i = 2; i < loop.size(); ++i) {
            for (int k = 0; k < 3; ++k) {
              const int u = (k + 1) % 3, v = (k + 2) % 3;
              area[k] += (grid.at(loop[i - 1], u) - grid.at(loop[0], u)) *
                             (grid.at(loop[i], v) - grid.at(loop[0], v)) -
                         (grid.at(loop[i - 1], v) - grid.at(loop[0], v)) *
                             (grid.at(loop[i], u) - grid.at(loop[0], u));
            }
          }
          mpq_class weight = 0;
          for (const mpz_class& component : area) weight += abs(component);
          lit += weight * light.exact_fractions[part].lit;
          shadow += weight * light.exact_fractions[part].shadow;
          whole += weight;
        }
        lit /= whole;
        shadow /= whole;
        const oracle::TrueFractions truth =
            scene.answer().group_fractions(light.light, group, true);
        if (!truth.lit.exact || !truth.shadow.exact) return "the oracle gave no exact fraction";
        if (*truth.lit.exact != lit || *truth.shadow.exact != shadow) {
          return fmt::format("{}, light '{}', polygon '{}': lit {}, but the oracle says {}",
                             name_of(result), light_of(scene, light.light),
                             polygon_of(scene, group.parts[0]), lit.get_str(),
                             truth.lit.exact->get_str());
        }
      }
    }
  }
  return {};
}

std::string check_sums(const Case& scene, const ShadowResult& result) {
  for (const LightResult& light : result.lights) {
    if (light.dropped_slivers != 0) return name_of(result) + ": dropped slivers";
    for (std::size_t i = 0; i < light.parts.size(); ++i) {
      const PartResult& part = light.parts[i];
      const ExactFractions& exact = light.exact_fractions[i];
      const auto outside = [](const Interval& interval, const mpq_class& value) {
        return mpq_class(interval.lower) > value || mpq_class(interval.upper) < value;
      };
      if (exact.lit + exact.shadow != 1 || exact.lit < 0 || exact.shadow < 0 ||
          outside(part.lit, exact.lit) || outside(part.shadow, exact.shadow)) {
        return fmt::format(
            "{}, light '{}', polygon '{}': lit {} in [{}, {}], shadow {} in [{}, {}]",
            name_of(result), light_of(scene, light.light), polygon_of(scene, part.part),
            exact.lit.get_str(), part.lit.lower, part.lit.upper, exact.shadow.get_str(),
            part.shadow.lower, part.shadow.upper);
      }
    }
  }
  return {};
}

/// The same without exact fractions: the bounds then come from arithmetic in doubles, and must
/// hold. A method without fragments owes narrow ones, and classes that are proven: 1 and 0 where
/// that is the truth, and nowhere else.
std::string check_bounds(const Case& scene, const ShadowResult& exact, ShadowOptions options) {
  options.output.exact_fractions = options.output.exact_points = false;
  const Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
  if (!result) return to_string(result.error());
  for (std::size_t l = 0; l < exact.lights.size(); ++l) {
    for (std::size_t i = 0; i < exact.lights[l].parts.size(); ++i) {
      const ExactFractions& truth = exact.lights[l].exact_fractions[i];
      const PartResult& bounds = result->lights[l].parts[i];
      const bool fragments = method_info(options.method.point).makes_fragments;
      const auto holds = [&](const Interval& interval, const mpq_class& value) {
        return mpq_class(interval.lower) <= value && value <= mpq_class(interval.upper) &&
               interval.upper - interval.lower < (fragments ? 1e-6 : 0x1p-26);
      };
      const bool classes = (bounds.lit.lower == 1) == (truth.lit == 1) &&
                           (bounds.lit.upper == 0) == (truth.lit == 0);
      if (!holds(bounds.lit, truth.lit) || !holds(bounds.shadow, truth.shadow) ||
          !(fragments || classes)) {
        return fmt::format("{}, light '{}', polygon '{}': lit {} is not in [{}, {}]",
                           name_of(exact), light_of(scene, exact.lights[l].light),
                           polygon_of(scene, bounds.part), truth.lit.get_str(), bounds.lit.lower,
                           bounds.lit.upper);
      }
    }
  }
  return {};
}

std::string compare_results(const Case& scene, const ShadowResult& a, const ShadowResult& b) {
  if (a.lights.size() != b.lights.size()) return "not the same lights";
  for (std::size_t l = 0; l < a.lights.size(); ++l) {
    for (std::size_t p = 0; p < a.lights[l].parts.size(); ++p) {
      const PartResult &one = a.lights[l].parts[p], &two = b.lights[l].parts[p];
      const ExactFractions& first = a.lights[l].exact_fractions[p];
      const ExactFractions& second = b.lights[l].exact_fractions[p];
      if (first.lit != second.lit || first.shadow != second.shadow || one.reason != two.reason ||
          one.side != two.side) {
        return fmt::format("light '{}', polygon '{}': {} says lit {}, {} says {}",
                           light_of(scene, a.lights[l].light), polygon_of(scene, one.part),
                           name_of(a), first.lit.get_str(), name_of(b), second.lit.get_str());
      }
    }
  }
  return {};
}

/// The fragments laid over the oracle's exact regions.
std::string compare_fragments(const Case& scene, const ShadowResult& result) {
  const oracle::Report report = judge(scene, result);
  if (report.oracle_fault) return "the oracle contradicts itself: " + report.reason;
  if (report.verdict == oracle::Verdict::kIdentical) return {};
  std::string wrong =
      fmt::format("{}: {}: {}", name_of(result), oracle::name_of(report.verdict), report.reason);
  for (const std::string& problem : report.problems) wrong += "; " + problem;
  if (report.worst) wrong += "; " + report.worst->text;
  return wrong;
}

/// The oracle's own check of claims by rays.
std::string check_claims(const Case& scene, const ShadowResult& result) {
  oracle::WitnessOptions exactly;
  exactly.tolerance = 0;
  exactly.width = 0;
  exactly.subset = result.lights.size() != scene.prepared().lights.size();
  const oracle::WitnessReport report =
      oracle::check_witnesses(scene.scene(), scene.prepared(), claims_of(scene, result), exactly);
  if (report.findings.empty()) return {};
  const oracle::WitnessFinding& finding = report.findings.front();
  return fmt::format("{}: claims, light '{}', polygon '{}': {}", name_of(result), finding.light,
                     finding.polygon, finding.text);
}

/// All ways to the same answer, the first of them with default options.
std::vector<ShadowOptions> variants(const Case& scene) {
  std::vector<ShadowOptions> all;
  for (const KernelId kernel : kExactKernels) {
    ShadowOptions options = options_for(kernel);
    for (std::uint32_t light = 0; light < scene.prepared().lights.size(); ++light) {
      if (!scene.is_area(light)) options.lights.push_back(light);
    }
    options.method.point = MethodId::kSectors;
    options.tuning.jobs = 1;
    if (kernel == KernelId::kPlane) all.push_back(options);
    all.push_back(with_small_cells(options));
    if (kernel == KernelId::kPlane) all.back().tuning.jobs = 2;
    options.method.point = MethodId::kSvbsp;
    options.output.merge = options.method.prefix = kernel != KernelId::kRational;
    options.method.seed = 1 + static_cast<std::uint64_t>(kernel);
    all.push_back(options);
    options.method.point = MethodId::kContour;
    all.push_back(options);
    if (kernel != KernelId::kPlane) continue;
    options.method.point = MethodId::kReceiver;  // as area lights are found
    all.push_back(options);
  }
  return all;
}

}  // namespace

std::string check_exact(const Case& scene) {
  ShadowResult first;
  for (const ShadowOptions& options : variants(scene)) {
    if (options.lights.empty()) return {};
    Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
    if (!result) return to_string(result.error());
    const bool is_first = first.kernel.empty();
    std::string wrong = check_sums(scene, *result);
    if (wrong.empty()) wrong = check_bounds(scene, *result, options);
    if (wrong.empty()) wrong = find_false_witness(scene, *result);
    if (wrong.empty() && is_first) wrong = compare_with_oracle(scene, *result);
    if (wrong.empty() && !is_first) wrong = compare_results(scene, first, *result);
    if (wrong.empty() && options.kernel.id == KernelId::kPlane) {
      wrong = compare_fragments(scene, *result);
    }
    if (wrong.empty() && is_first) wrong = check_claims(scene, *result);
    if (!wrong.empty()) {
      return fmt::format("leaves of {}, tasks of {}: {}", options.tuning.leaf_size,
                         options.tuning.task_size, wrong);
    }
    if (is_first) first = std::move(*result);
  }
  return {};
}

std::string check_methods(const Case& scene) {
  ShadowOptions usual;
  for (std::uint32_t light = 0; light < scene.prepared().lights.size(); ++light) {
    if (!scene.is_area(light)) usual.lights.push_back(light);
  }
  if (usual.lights.empty()) return {};
  const bool has_region = std::ranges::any_of(
      scene.prepared().lights,
      [](const PreparedLight& light) { return light.is_eye || !light.region.empty(); });
  ShadowResult first;
  for (const KernelId kernel : kExactKernels) {
    for (const MethodSelection& method : method_variants()) {
      // Contour knows no regions.
      if (has_region && !method_info(method.id).makes_fragments) continue;
      ShadowOptions options = with_method(options_for(kernel), method);
      options.lights = usual.lights;
      options.tuning.jobs = 1;
      // The cells of methods that have any: as small as can be on one kernel, as usual on another.
      if (kernel == KernelId::kPlane) {
        options.tuning.leaf_size = 1;
        options.tuning.task_size = 2;
      }
      Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
      if (!result) return text_of(method) + ": " + to_string(result.error());
      const bool is_first = first.kernel.empty();
      std::string wrong = check_sums(scene, *result);
      if (wrong.empty()) wrong = find_false_witness(scene, *result);
      if (wrong.empty() && is_first) wrong = compare_with_oracle(scene, *result);
      if (wrong.empty() && !is_first) wrong = compare_results(scene, first, *result);
      if (wrong.empty() && kernel == KernelId::kPlane) {
        wrong = check_bounds(scene, *result, options);
        if (wrong.empty()) wrong = compare_fragments(scene, *result);
        // Sets of casters, and what is outside of a region, are told by no other check.
        const bool has_sets = std::ranges::any_of(
            result->lights, [](const LightResult& light) { return !light.caster_sets.empty(); });
        if (wrong.empty() && (has_sets || has_region)) wrong = check_claims(scene, *result);
      }
      if (!wrong.empty()) return text_of(method) + ": " + wrong;
      if (is_first) first = std::move(*result);
    }
  }
  return {};
}

/// Whether printed shares, the middles of the bounds that are found without exact numbers, are
/// within 1e-14 of the polygon's area of what is true.
std::string check_printed(const Case& scene, const ShadowResult& exact, ShadowOptions options) {
  constexpr double kMost = 1e-14;
  options.output.exact_fractions = false;
  const Expected<ShadowResult> found = compute_shadows(scene.prepared(), options);
  if (!found) return to_string(found.error());
  for (std::size_t i = 0; i < exact.lights.size(); ++i) {
    for (std::size_t j = 0; j < exact.lights[i].parts.size(); ++j) {
      const PartResult& part = found->lights[i].parts[j];
      const ExactFractions& truth = exact.lights[i].exact_fractions[j];
      const mpq_class lit = abs(mpq_class(part.lit.middle()) - truth.lit);
      const mpq_class shadow = abs(mpq_class(part.shadow.middle()) - truth.shadow);
      if (lit <= kMost && shadow <= kMost) continue;
      return "printed shares of " + polygon_of(scene, part.part) + " are off by " +
             std::to_string(1e15 * std::max(lit, shadow).get_d()) + "e-15";
    }
  }
  return {};
}

std::string check_contour(const Case& scene) {
  ShadowOptions usual = options_for(KernelId::kPlane);
  usual.tuning.jobs = 1;
  for (std::uint32_t light = 0; light < scene.prepared().lights.size(); ++light) {
    if (!scene.is_area(light)) usual.lights.push_back(light);
  }
  if (usual.lights.empty()) return {};
  usual.method.point = MethodId::kSectors;
  const Expected<ShadowResult> first = compute_shadows(scene.prepared(), usual);
  if (!first) return to_string(first.error());
  for (const KernelId kernel : kExactKernels) {
    ShadowOptions options = usual;
    options.kernel.id = kernel;
    options.method.point = MethodId::kContour;
    const Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
    if (!result) return to_string(result.error());
    std::string wrong = check_sums(scene, *result);
    if (wrong.empty()) wrong = compare_results(scene, *first, *result);
    if (wrong.empty()) wrong = check_bounds(scene, *first, options);
    if (wrong.empty()) wrong = check_printed(scene, *first, options);
    if (!wrong.empty()) return std::string(kernel_info(kernel).name) + " by contour: " + wrong;
  }
  return {};
}

std::vector<mpq_class> lit_fractions(const Case& scene, const ShadowOptions& options) {
  const Expected<ShadowResult> result = compute_shadows(scene.prepared(), options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  std::vector<mpq_class> fractions;
  for (const LightResult& light : result->lights) {
    for (const ExactFractions& part : light.exact_fractions) fractions.push_back(part.lit);
  }
  return fractions;
}

mpq_class lit_fraction_of(const Case& scene, const ShadowOptions& options, const std::string& light,
                          const std::string& polygon) {
  const PreparedScene& prepared = scene.prepared();
  const Expected<ShadowResult> result = compute_shadows(prepared, options);
  if (!result) throw std::runtime_error(to_string(result.error()));
  for (const LightResult& own : result->lights) {
    if (light_of(scene, own.light) != light) continue;
    for (std::size_t i = 0; i < own.parts.size(); ++i) {
      const std::uint32_t part = own.parts[i].part;
      if (polygon_of(scene, part) != polygon) continue;
      const std::uint32_t owner = prepared.parts[part].polygon;
      if (prepared.first_part[owner + 1] - prepared.first_part[owner] != 1) {
        throw std::runtime_error("polygon '" + polygon + "' has several parts");
      }
      return own.exact_fractions[i].lit;
    }
  }
  throw std::runtime_error("no light '" + light + "' or no polygon '" + polygon + "'");
}

}  // namespace gnomon::test
