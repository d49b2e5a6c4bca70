// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/binding/shadows.h"

#include <algorithm>
#include <utility>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/digest.h"
#include "report/json/result_json.h"
#include "report/shares/share_columns.h"
#include "report/sides/claims_of.h"
#include "report/sides/polygon_sides.h"
#include "report/text/number_text.h"
#include "report/text/text_sink.h"

namespace gnomon::python {

namespace {

/// Calls take(light, part, fragment) for every fragment, light by light and part by part.
template <class Take>
void for_each_fragment(const ShadowResult& result, const Take& take) {
  for (const LightResult& light : result.lights) {
    for (const PartResult& part : light.parts) {
      for (std::uint32_t i = 0; i < part.fragment_count; ++i) {
        take(light, part, light.fragments[part.first_fragment + i]);
      }
    }
  }
}

}  // namespace

Expected<Shadows> Shadows::compute(const LoadedScenePtr& scene, const AskedLights& lights,
                                   bool fragments, bool exact, const RunNames& names,
                                   const std::atomic<bool>& stop) {
  auto options = shadow_options(names, stop);
  if (!options) return tl::unexpected(std::move(options.error()));
  if (exact && !kernel_info(options->kernel.id).exact) {
    return fail(ErrorCode::kUsage, "--exact-fractions: kernel " + names.kernel + " rounds",
                "an exact kernel: plane, rational or epeck");
  }
  if (fragments && names.algorithm != "auto" &&
      !method_info(options->method.point).makes_fragments &&
      options->method.point != MethodId::kAutomatic) {
    return fail(ErrorCode::kUsage, "--fragments needs sectors, not " + names.algorithm,
                "--algorithm sectors, or auto");
  }
  auto of_call = lights_of_call(scene, lights, names.jobs, stop);
  if (!of_call) return tl::unexpected(std::move(of_call.error()));
  Shadows shadows;
  shadows.scene_ = std::move(of_call->scene);
  shadows.asked_ = std::move(of_call->lights);
  shadows.fragments_ = fragments;
  shadows.exact_ = exact;
  options->lights = shadows.asked_;
  options->output.points = fragments;
  options->output.exact_points = fragments && exact;
  options->output.exact_fractions = exact;
  auto result = compute_shadows(shadows.scene_->prepared, *options);
  if (!result) return tl::unexpected(std::move(result.error()));
  shadows.result_ = *std::move(result);
  return shadows;
}

std::vector<std::string> Shadows::lights() const {
  std::vector<std::string> names;
  for (const LightResult& light : result_.lights) {
    names.push_back(report::light_name(scene_->scene, scene_->prepared, light));
  }
  return names;
}

std::vector<std::string> Shadows::sides() const {
  return report::ShareColumns(scene_->scene, scene_->prepared).names();
}

std::vector<double> Shadows::shares(LightState state) const {
  const report::ShareColumns columns(scene_->scene, scene_->prepared);
  std::vector<double> values;
  values.reserve(result_.lights.size() * columns.size());
  for (const LightResult& light : result_.lights) {
    for (std::size_t column = 0; column < columns.size(); ++column) {
      values.push_back(report::share_of(columns.shares(light, column), state).middle());
    }
  }
  return values;
}

std::vector<std::string> Shadows::exact_shares(LightState state) const {
  const report::ShareColumns columns(scene_->scene, scene_->prepared);
  const report::PartWeights weights(scene_->prepared);
  std::vector<std::string> values;
  for (const LightResult& light : result_.lights) {
    const bool area = scene_->prepared.lights[light.light].has_area();
    const LightState dark = area ? LightState::kUmbra : LightState::kShadow;
    for (std::size_t column = 0; column < columns.size(); ++column) {
      // Of a side that polygon_sides() does not list, all is dark.
      std::string& text = values.emplace_back(state == dark ? "1" : "0");
      for (const report::ClassifiedSide& side :
           report::polygon_sides(scene_->prepared, light, columns.polygon(column), true, weights)) {
        if (side.side != columns.side(column)) continue;
        const auto& exact = report::exact_share_of(side, state);
        text = exact ? exact->get_str() : report::shortest(report::share_of(side, state).middle());
      }
    }
  }
  return values;
}

FragmentArrays Shadows::fragments() const {
  FragmentArrays arrays;
  arrays.offsets.push_back(0);
  const std::vector<Part>& parts = scene_->prepared.parts;
  for_each_fragment(
      result_, [&](const LightResult& light, const PartResult& part, const Fragment& fragment) {
        for (std::uint32_t i = 0; i < fragment.count; ++i) {
          const auto& point = light.points[fragment.first + i];
          arrays.points.insert(arrays.points.end(), point.begin(), point.end());
        }
        arrays.offsets.push_back(static_cast<std::int64_t>(arrays.points.size() / 3));
        arrays.light.push_back(static_cast<std::int32_t>(&light - result_.lights.data()));
        arrays.polygon.push_back(static_cast<std::int32_t>(parts[part.part].polygon));
        arrays.back.push_back(part.side == Side::kBack ? 1 : 0);
        arrays.state.push_back(static_cast<std::uint8_t>(fragment.state));
        arrays.caster.push_back(fragment.caster == Fragment::kNoCaster
                                    ? -1
                                    : static_cast<std::int32_t>(parts[fragment.caster].polygon));
      });
  return arrays;
}

std::vector<std::string> Shadows::exact_points() const {
  std::vector<std::string> texts;
  for_each_fragment(result_,
                    [&](const LightResult& light, const PartResult&, const Fragment& fragment) {
                      for (std::uint32_t i = 0; i < fragment.count; ++i) {
                        for (const mpq_class& value : light.exact_points[fragment.first + i]) {
                          texts.push_back(value.get_str());
                        }
                      }
                    });
  return texts;
}

std::string Shadows::json() const {
  report::ResultJsonOptions options;
  options.geometry_digest = geometry_digest(scene_->scene);
  options.fragments = fragments_;
  options.exact_fractions = exact_;
  options.exact_loops = fragments_ && exact_;
  report::StringSink sink;
  report::write_result_json(sink, scene_->scene, scene_->prepared, result_, options);
  return sink.text();
}

Claims Shadows::claims() const {
  return report::claims_of(scene_->scene, scene_->prepared, result_, result_.kernel, exact_);
}

}  // namespace gnomon::python
