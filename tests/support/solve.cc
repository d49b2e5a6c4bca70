// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"

namespace gnomon::test {
namespace {

oracle::ExactPoint scene_point(const Geometry& geometry, VertexId vertex) {
  oracle::ExactPoint point;
  for (int k = 0; k < 3; ++k) {
    point[k] = geometry.origin[k] + geometry.step * mpq_class(geometry.grid.at(vertex, k));
  }
  return point;
}

const char* name_of(ShadowReason reason) {
  switch (reason) {
    case ShadowReason::kNone:
      return "";
    case ShadowReason::kFacesAway:
      return "faces-away";
    case ShadowReason::kLightInPlane:
      return "light-in-plane";
    case ShadowReason::kBehindLight:
      return "behind-light";
  }
  return "";
}

oracle::ShadeClass shade_of(LightState state) {
  switch (state) {
    case LightState::kLit:
      return oracle::ShadeClass::kLit;
    case LightState::kShadow:
      return oracle::ShadeClass::kShadow;
    case LightState::kPenumbra:
      return oracle::ShadeClass::kPenumbra;
    case LightState::kUmbra:
      return oracle::ShadeClass::kUmbra;
  }
  return oracle::ShadeClass::kLit;
}

}  // namespace

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
  options.kernel = kernel;
  options.keep_exact_points = true;
  options.exact_fractions = kernel_info(kernel).exact;
  return options;
}

oracle::Candidate candidate_of(const Case& scene, const ShadowResult& result) {
  const PreparedScene& prepared = scene.prepared();
  oracle::Candidate candidate;
  candidate.name = result.kernel;
  const auto id_of_part = [&](std::uint32_t part) {
    return scene.scene().polygons[prepared.parts[part].polygon].id;
  };
  for (const LightResult& light : result.lights) {
    oracle::CandidateLight found;
    found.id = scene.scene().lights[prepared.lights[light.light].light].id;
    const bool area = scene.is_area(light.light);
    found.per_caster_umbra = area;
    // The results of each part: one, or one for each side that sees an area light.
    std::vector<std::vector<const PartResult*>> results(prepared.parts.size());
    for (const PartResult& part : light.parts) results[part.part].push_back(&part);
    for (std::uint32_t polygon = 0; polygon < scene.scene().polygons.size(); ++polygon) {
      const std::uint32_t begin = prepared.first_part[polygon];
      const std::uint32_t end = prepared.first_part[polygon + 1];
      if (begin == end) continue;
      std::set<Side, std::greater<>> sides;  // front first
      for (std::uint32_t part = begin; part < end; ++part) {
        for (const PartResult* own : results[part]) {
          if (own->reason == ShadowReason::kNone) sides.insert(own->side);
        }
      }
      if (sides.empty()) sides.insert(Side::kFront);
      for (const Side side : sides) {
        oracle::CandidatePolygon entry;
        entry.id = scene.scene().polygons[polygon].id;
        entry.side = side == Side::kBack ? oracle::PolygonSide::kBack : oracle::PolygonSide::kFront;
        for (std::uint32_t part = begin; part < end; ++part) {
          const PartResult* own = nullptr;
          for (const PartResult* one : results[part]) {
            if (one->reason == ShadowReason::kNone && one->side == side) own = one;
          }
          if (own == nullptr) {
            // A part that sees nothing of an area light has the reason of its front; no light is
            // behind either if the part lies behind the light.
            const PartResult& dark = *results[part].front();
            ShadowReason reason = dark.reason;
            if (area && dark.side != side && reason == ShadowReason::kFacesAway) {
              reason = ShadowReason::kBehindLight;
            }
            oracle::CandidateFragment whole;
            whole.shade = area ? oracle::ShadeClass::kUmbra : oracle::ShadeClass::kShadow;
            whole.reason = reason == ShadowReason::kNone ? "faces-away" : name_of(reason);
            for (const VertexId vertex : prepared.loop(prepared.parts[part])) {
              whole.loop.push_back(scene_point(prepared.geometry, vertex));
            }
            entry.fragments.push_back(std::move(whole));
            continue;
          }
          for (std::uint32_t i = 0; i < own->fragment_count; ++i) {
            const Fragment& fragment = light.fragments[own->first_fragment + i];
            oracle::CandidateFragment piece;
            piece.shade = shade_of(fragment.state);
            piece.reason = name_of(fragment.reason);
            if (fragment.caster != Fragment::kNoCaster) piece.caster = id_of_part(fragment.caster);
            piece.loop.assign(light.exact_points.begin() + fragment.first,
                              light.exact_points.begin() + fragment.first + fragment.count);
            entry.fragments.push_back(std::move(piece));
          }
        }
        found.polygons.push_back(std::move(entry));
      }
    }
    candidate.lights.push_back(std::move(found));
  }
  return candidate;
}

oracle::Report judge(const Case& scene, const ShadowResult& result, bool strict) {
  oracle::CertifyOptions options;
  options.strict = strict;
  options.threads = 1;
  options.most_regions = 4;
  for (const LightResult& light : result.lights) options.lights.push_back(light.light);
  const oracle::Candidate candidate = candidate_of(scene, result);
  Expected<oracle::Report> report = oracle::certify(scene.answer(), candidate, options);
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
  options.algorithm = algorithm;
  options.identity = identity;
  options.thickness = at == std::string::npos ? 0 : std::stod(name.substr(at + 1));
  return options;
}

std::string name_of(MethodId algorithm) {
  return algorithm == MethodId::kSvbsp ? "svbsp" : "sectors";
}

ShadowOptions with_small_cells(ShadowOptions options) {
  options.algorithm = MethodId::kSectors;
  options.leaf_size = 1;
  options.task_size = 2;
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
