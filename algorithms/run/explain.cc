// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/explain.h"

#include <array>
#include <charconv>

#include "algorithms/run/compute.h"
#include "algorithms/run/explain_on.h"
#include "algorithms/run/on_every_kernel.h"

namespace gnomon {
namespace {

const char* name(Side side) {
  switch (side) {
    case Side::kFront:
      return "in front";
    case Side::kBack:
      return "behind";
    case Side::kOn:
      return "on it";
  }
  return "?";
}

std::string text(const std::array<double, 3>& point) {
  std::string result = "(";
  for (int k = 0; k < 3; ++k) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), point[k]).ptr;
    result.append(buffer.data(), end);
    result += k < 2 ? ", " : ")";
  }
  return result;
}

}  // namespace

Expected<std::optional<FirstDifference>> explain(const PreparedScene& scene,
                                                 const ShadowOptions& options) {
  if (kernel_info(options.kernel.id).exact) {
    return fail(ErrorCode::kUsage,
                "kernel " + std::string(kernel_info(options.kernel.id).name) + " is exact",
                "a rounded kernel: only those differ from the exact answer");
  }
  auto lights = select_lights(scene, options);
  if (!lights) return tl::unexpected<Error>(lights.error());
  // Lock-step runs walk the SVBSP algorithm, which area lights have no part in.
  std::erase_if(*lights, [&](std::uint32_t light) { return scene.lights[light].has_area(); });
  if (lights->empty()) return std::nullopt;
  static constexpr auto kExplain = on_every_kernel<ExplainOn, CompiledFor::kRoundedKernels>();
  const auto explain_on = kExplain[static_cast<std::size_t>(options.kernel.id)];
  if (explain_on == nullptr) {
    return fail(ErrorCode::kUsage,
                "kernel " + std::string(kernel_info(options.kernel.id).name) + " was not built",
                "another kernel, or a build with GNOMON_CGAL_KERNELS");
  }
  return explain_on({scene, options, Rules{}, *lights, {}});
}

std::string to_sentence(const FirstDifference& difference, const PreparedScene& scene,
                        const std::string& kernel, const std::vector<std::string>& light_names) {
  const DifferingDecision& decision = difference.decision;
  std::string where = "building the scene BSP";
  if (difference.light) {
    where = "light " + light_names[scene.lights[*difference.light].light];
  }
  std::string sentence =
      "Decision " + std::to_string(decision.decisions + 1) + " (" + where + "): " + decision.vertex;
  if (decision.vertex != "the light") sentence += ", at " + text(decision.position) + ",";
  sentence += " is asked against " + decision.plane + ". " + kernel + " says " +
              name(decision.tested) + ", exact says " + name(decision.exact) + ".";
  if (decision.vertex != "the light" && decision.tested_position != decision.position) {
    sentence += " " + kernel + " has the vertex at " + text(decision.tested_position) + ".";
  }
  return sentence;
}

}  // namespace gnomon
