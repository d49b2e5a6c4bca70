// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/zoo/zoo_case.h"

#include <utility>
#include <vector>

#include "fuzz/mistakes/compute.h"
#include "gnomon/algorithms/illumination.h"
#include "gnomon/oracle/witness_check.h"
#include "report/sides/claims_of.h"

namespace gnomon::fuzz {

namespace {

constexpr std::uint64_t kMostFragments = 20'000;

oracle::CertifyOptions certify_options() {
  oracle::CertifyOptions options;
  options.most_regions = 1;
  return options;
}

}  // namespace

ZooCase::ZooCase(const ZooEntry& entry, const Scene& scene, PreparedScene prepared)
    : entry_(entry),
      scene_(scene),
      prepared_(std::move(prepared)),
      judged_(scene_, prepared_),
      sound_(*parse_subject(entry.sound)) {}

Expected<ShadowResult> ZooCase::shadows(Mistake mistake) const {
  ShadowOptions options = shadow_options(sound_);
  options.limits.fragments = kMostFragments;
  options.output.combined = is_of_lights_together(entry_.mistake);
  return compute_shadows(prepared_, options, mistake);
}

Claims ZooCase::candidate_of(const ShadowResult& result, std::string name) const {
  return report::claims_of(scene_, prepared_, result, std::move(name), sound_.kernel.exact());
}

oracle::Report ZooCase::certified(const Claims& candidate) const {
  return *judged_.judge(candidate, certify_options());
}

oracle::Report ZooCase::certified_by_points(const Claims& candidate) const {
  oracle::CertifyOptions options = certify_options();
  options.most_pairs = 0;
  return *judged_.judge(candidate, options);
}

bool ZooCase::claims_hold(const Claims& candidate) const {
  oracle::WitnessOptions options;
  options.most = 1;
  return oracle::check_witnesses(scene_, prepared_, candidate, options).violations == 0;
}

Expected<ShadingMesh> ZooCase::mesh(std::uint32_t light, Mistake mistake) const {
  ShadowOptions options = shadow_options(sound_);
  options.limits.fragments = kMostFragments;
  options.lights = {light};
  const auto result = compute_shadows(prepared_, options);
  if (!result) return tl::unexpected(result.error());
  const Illuminator illuminator(prepared_, light, 1);
  return make_shading_mesh(
      prepared_, *result,
      [&](const ShadeRequest& asked) {
        const Illumination found =
            illuminator.at(asked.part, asked.side, asked.point, asked.unobstructed, asked.inwards);
        return PointShade{found.value, found.error_bound};
      },
      ShadingOptions{}, mistake);
}

oracle::MeshReport ZooCase::check(const ShadingMesh& mesh) const {
  std::vector<oracle::MeshFaceClaim> faces;
  for (const MeshFace& face : mesh.faces) {
    oracle::MeshFaceClaim claim;
    claim.polygon = scene_.polygons[prepared_.parts[face.part].polygon].id;
    claim.side = face.side;
    claim.dark = face.lit_by == 0 && face.penumbra_of == 0;
    for (const MeshCorner& corner : mesh.loop(face)) {
      claim.loop.push_back(mesh.exact_points[corner.vertex].rational());
      claim.shades.push_back(mesh.shade(corner.sample));
    }
    faces.push_back(std::move(claim));
  }
  return oracle::check_mesh(faces, 1);
}

}  // namespace gnomon::fuzz
