// SPDX-License-Identifier: GPL-3.0-or-later
// A classified scene as Python holds it: shares by light and side, fragments as arrays, the file
// that gnomon shadows writes.
#ifndef GNOMON_PYTHON_BINDING_SHADOWS_H
#define GNOMON_PYTHON_BINDING_SHADOWS_H

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/result/claims.h"
#include "python/binding/loaded_scene.h"
#include "python/binding/run_options.h"

namespace gnomon::python {

/// Fragments of all lights one after the other; fragment i has the corners offsets[i] ..
/// offsets[i + 1] - 1.
struct FragmentArrays {
  std::vector<double> points;  // (n, 3), scene units
  std::vector<std::int64_t> offsets;
  std::vector<std::int32_t> light, polygon;
  std::vector<std::int32_t> caster;  // a polygon, or -1
  std::vector<std::uint8_t> back, state;
};

class Shadows {
 public:
  /// Errors: those of lights, of the kernel and the method; kInterrupted.
  static Expected<Shadows> compute(const LoadedScenePtr& scene, const AskedLights& lights,
                                   bool fragments, bool exact, const RunNames& names,
                                   const std::atomic<bool>& stop);

  std::vector<std::string> lights() const;
  std::vector<std::string> sides() const;
  std::size_t light_count() const { return result_.lights.size(); }
  const std::string& kernel() const { return result_.kernel; }
  const std::string& algorithm() const { return result_.algorithm; }
  bool has_fragments() const { return fragments_; }
  bool is_exact() const { return exact_; }

  /// Row by row, of each light a share of every side.
  std::vector<double> shares(LightState state) const;
  /// The same as texts, as exact_shares() has them. Requires: exact.
  std::vector<std::string> exact_shares(LightState state) const;
  /// Requires: fragments.
  FragmentArrays fragments() const;
  /// Coordinates of all points of fragments as "p/q". Requires: fragments, exact.
  std::vector<std::string> exact_points() const;
  /// What gnomon shadows writes.
  std::string json() const;
  /// For the oracle. Requires: fragments.
  Claims claims() const;
  const LoadedScenePtr& scene() const { return scene_; }
  const std::vector<std::uint32_t>& asked() const { return asked_; }

 private:
  LoadedScenePtr scene_;
  std::vector<std::uint32_t> asked_;  // indices of lights
  ShadowResult result_;
  bool fragments_ = false, exact_ = false;
};

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_SHADOWS_H
