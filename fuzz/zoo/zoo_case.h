// SPDX-License-Identifier: GPL-3.0-or-later
// One scene with all that a mutant and its sound subject are asked against.
#ifndef GNOMON_FUZZ_ZOO_ZOO_CASE_H
#define GNOMON_FUZZ_ZOO_ZOO_CASE_H

#include <cstdint>
#include <string>

#include "fuzz/check/judged_scene.h"
#include "fuzz/check/pictures.h"
#include "fuzz/check/subject.h"
#include "fuzz/zoo/zoo.h"
#include "gnomon/algorithms/shading_mesh.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/oracle/mesh_check.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

class ZooCase {
 public:
  /// Keeps references to both.
  ZooCase(const ZooEntry& entry, const Scene& scene, PreparedScene prepared);
  ZooCase(const ZooCase&) = delete;
  ZooCase& operator=(const ZooCase&) = delete;

  const PreparedScene& prepared() const { return prepared_; }

  /// What the subject comes to with that mistake, its lights together if the entry is about them.
  /// Errors: those of compute_shadows().
  Expected<ShadowResult> shadows(Mistake mistake) const;
  Claims candidate_of(const ShadowResult& result, std::string name) const;
  oracle::Report certified(const Claims& candidate) const;
  /// The same by the visibility of points alone.
  oracle::Report certified_by_points(const Claims& candidate) const;
  bool claims_hold(const Claims& candidate) const;

  const Scene& scene() const { return scene_; }
  bool makes_pictures() const { return fuzz::makes_pictures(sound_); }
  /// A picture with wrong samples that the subject makes with that mistake, if it makes one.
  Expected<std::optional<WrongPicture>> picture(Mistake mistake) const {
    return wrong_picture(scene_, prepared_, sound_, mistake);
  }

  /// What the subject shows of the scene from a camera.
  Expected<TakenPicture> picture_from(const ExactCamera& camera, Mistake mistake) const {
    return take_picture(scene_, sound_, mistake, camera);
  }

  /// The illuminated mesh of the sound fragments of one light, made with that mistake.
  Expected<ShadingMesh> mesh(std::uint32_t light, Mistake mistake) const;
  oracle::MeshReport check(const ShadingMesh& mesh) const;

 private:
  const ZooEntry& entry_;
  const Scene& scene_;
  PreparedScene prepared_;
  JudgedScene judged_;
  Subject sound_;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_ZOO_ZOO_CASE_H
