// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "gnomon/oracle/prepared_check.h"
#include "gnomon/scene/digest.h"
#include "report/certificate/certificate.h"
#include "report/facts/facing.h"

namespace gnomon::report {

Certificate certificate_of(const Scene& scene, const PreparedScene& prepared,
                           std::span<const std::uint32_t> lights) {
  Certificate certificate;
  certificate.scene = &scene;
  certificate.prepared = &prepared;
  certificate.geometry_digest = geometry_digest(scene);
  certificate.facing_area = facing_area(prepared, {lights.begin(), lights.end()});
  for (const oracle::PreparedFinding& finding : oracle::check_prepared(scene, prepared)) {
    certificate.scene_findings.push_back(
        (finding.polygon.empty() ? "" : "polygon " + finding.polygon + ": ") + finding.text);
  }
  for (const std::uint32_t light : lights) certificate.lights.push_back(scene.lights[light].id);
  return certificate;
}

JudgedRun foreign_run(std::string name, const Claims& claims) {
  JudgedRun run;
  run.name = std::move(name);
  run.foreign = true;
  for (const ClaimedLight& light : claims.lights) {
    if (!light.per_caster_umbra) run.per_caster_umbra = false;
    for (const ClaimedPolygon& polygon : light.polygons) {
      // Those that a tree made: what is in shadow as a whole for a reason is none.
      run.fragments += static_cast<std::uint64_t>(std::ranges::count_if(
          polygon.fragments, [](const auto& fragment) { return fragment.reason.empty(); }));
    }
  }
  return run;
}

}  // namespace gnomon::report
