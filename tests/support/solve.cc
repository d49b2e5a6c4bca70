// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "report/sides/claims_of.h"

namespace gnomon::test {
std::unique_ptr<Case> Case::make(Scene scene, std::string* why) {
  Expected<PreparedScene> prepared = prepare(scene);
  if (!prepared) {
    if (why != nullptr) *why = to_string(prepared.error());
    return nullptr;
  }
  return std::unique_ptr<Case>(new Case(std::move(scene), std::move(*prepared)));
}

ShadowOptions options_for(KernelId kernel) {
  ShadowOptions options;
  options.kernel.id = kernel;
  options.output.exact_points = true;
  options.output.exact_fractions = kernel_info(kernel).exact;
  return options;
}

Claims claims_of(const Case& scene, const ShadowResult& result) {
  return report::claims_of(scene.scene(), scene.prepared(), result, result.kernel, false);
}

oracle::Report judge(const Case& scene, const ShadowResult& result, bool strict) {
  oracle::CertifyOptions options;
  options.strict = strict;
  options.most_regions = 4;
  for (const LightResult& light : result.lights) options.lights.push_back(light.light);
  Expected<oracle::Report> report = scene.judged().judge(claims_of(scene, result), options);
  if (!report) throw std::runtime_error(to_string(report.error()));
  return std::move(*report);
}

ShadowOptions options_by_name(const std::string& name, MethodId algorithm) {
  const std::size_t at = name.find('@');
  std::string kernel = name.substr(0, at);
  const std::size_t plus = kernel.find("+identity");
  const bool identity = plus != std::string::npos;
  if (identity) kernel.resize(plus);
  const std::optional<KernelId> id = kernel_by_name(kernel);
  if (!id) throw std::runtime_error("no kernel " + name);
  ShadowOptions options = options_for(*id);
  options.method.point = algorithm;
  options.kernel.identity = identity;
  options.kernel.thickness = at == std::string::npos ? 0 : std::stod(name.substr(at + 1));
  return options;
}

std::string name_of(MethodId algorithm) { return std::string(method_info(algorithm).name); }

ShadowOptions with_small_cells(ShadowOptions options) {
  options.method.point = MethodId::kSectors;
  options.tuning.leaf_size = 1;
  options.tuning.task_size = 2;
  return options;
}

std::string text_of(const Scene& scene) {
  const Expected<WrittenScene> written = scene_to_text(scene, SceneFormat::kJson);
  return written ? written->text : to_string(written.error());
}

Scene regression_scene(const std::string& name) {
  namespace fs = std::filesystem;
  for (const auto& entry : fs::recursive_directory_iterator(GNOMON_REGRESSIONS)) {
    if (entry.path().filename() != name + ".json") continue;
    Expected<ReadResult> read = read_scene(entry.path());
    if (!read) throw std::runtime_error(to_string(read.error()));
    return std::move(read->scene);
  }
  throw std::runtime_error("no regression scene " + name);
}

}  // namespace gnomon::test
