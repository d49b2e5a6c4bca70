// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a light reaches the point that a sample sees.
//
// Exactness: exact. Doubles with a bound decide where they can; what they leave open is asked of
// VisibilityTest, in rationals, at the exact point.
#ifndef GNOMON_ORACLE_IMAGE_LIT_SAMPLES_H
#define GNOMON_ORACLE_IMAGE_LIT_SAMPLES_H

#include <cstdint>
#include <memory>
#include <vector>

#include "gnomon/oracle/visibility.h"
#include "oracle/image/seen_parts.h"
#include "oracle/judge/made_once.h"
#include "oracle/visibility/light_index.h"

namespace gnomon::oracle {

/// The point that a sample sees, exactly, scene units.
RationalPoint seen_point(const SampledView& view, const CertifiedPlane& plane,
                         const SampleRay& ray);

class LitSamples {
 public:
  /// `light`: point or directional. Keeps references to both.
  LitSamples(const SampledView& view, const SeenParts& seen, const PreparedLight& light);

  /// Does the side of a part that is seen face the light?
  bool faces(std::uint32_t part) const { return front_[part] == (seen_.sees_back(part) ? -1 : 1); }
  /// At the point of a part that a ray sees; kShadow where the side that is seen does not face the
  /// light. Thread-safe.
  PointVisibility at(std::uint32_t part, const SampleRay& ray);

 private:
  struct Caster {
    std::uint32_t part = 0;
    CertifiedPlane plane;               // positive at the light, seen from the eye
    std::vector<CertifiedPlane> edges;  // through the light, positive inside the shadow volume
  };
  /// What a part needs to know of the light; made when it is first seen.
  struct Receiver {
    std::vector<std::uint32_t> casters;  // places in casters_ that may shadow some of it
  };

  static std::vector<std::int8_t> fronts(const SampledView& view, const PreparedLight& light);
  std::vector<std::uint32_t> facing_parts() const;
  Caster caster_of(std::uint32_t part) const;
  Receiver receiver_of(std::uint32_t part) const;

  const SampledView& view_;
  const SeenParts& seen_;
  const PreparedLight& light_;
  VisibilityTest exact_;
  std::vector<std::int8_t> front_;  // a part each: the sign of its front's plane at the light
  std::vector<Caster> casters_;
  std::vector<std::uint32_t> place_;  // of a part in casters_
  LightIndex index_;
  std::vector<std::unique_ptr<MadeOnce<Receiver>>> receivers_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_IMAGE_LIT_SAMPLES_H
