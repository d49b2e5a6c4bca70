// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of a scene from seven eyes by a subject of image space, judged sample by sample.
#ifndef GNOMON_FUZZ_CHECK_PICTURES_H
#define GNOMON_FUZZ_CHECK_PICTURES_H

#include <optional>
#include <string>

#include "fuzz/check/subject.h"
#include "gnomon/oracle/image.h"
#include "gnomon/result/pixel_claims.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

/// A picture with wrong samples.
struct WrongPicture {
  std::string eye;  // which of the seven
  PixelClaims claims;
  oracle::ImageReport report;

  /// "wrong polygon seen" or "wrong light".
  std::string disagreement() const;
  /// One sentence that names the worst sample.
  std::string text(const Scene& scene) const;
};

/// Whether a subject works in the picture.
bool makes_pictures(const Subject& subject);

/// A scene as a camera sees it.
struct TakenPicture {
  PreparedView view;
  PixelClaims claims;
};
/// By all point and directional lights. Errors: those of prepare_view() and compute_pixels().
Expected<TakenPicture> take_picture(const Scene& scene, const Subject& subject, Mistake mistake,
                                    const ExactCamera& camera);

/// The first wrong one; none if all are right. Samples on boundaries count where the numbers are
/// exact: ties are defined. Of rounded kernels, what moving a vertex by a billionth of the scene
/// would undo does not count. Errors: those of prepare_view() and compute_pixels().
Expected<std::optional<WrongPicture>> wrong_picture(const Scene& scene,
                                                    const PreparedScene& prepared,
                                                    const Subject& subject, Mistake mistake);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_PICTURES_H
