// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of a finding: from where the wrong place can be seen, and with axes stretched where
// the scene would be a line else. Affine maps change no shadow, so what is painted is what is.
#ifndef GNOMON_FUZZ_FINDINGS_FINDING_PICTURE_H
#define GNOMON_FUZZ_FINDINGS_FINDING_PICTURE_H

#include <optional>
#include <string>
#include <vector>

#include "gnomon/algorithms/painters_order.h"
#include "gnomon/oracle/compare.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/pictures/picture.h"

namespace gnomon::fuzz {

class FindingPicture {
 public:
  /// `light`: index into PreparedScene::lights. `place`: what to look at; may be none.
  FindingPicture(const Scene& scene, std::uint32_t light,
                 const std::optional<oracle::Witness>& place);

  /// SVG of one answer; what it has otherwise than `truth`, if given, in a signal colour. Empty if
  /// the scene cannot be painted.
  std::string paint(const std::string& caption, const ClaimedLight& shown,
                    const ClaimedLight* truth) const;

 private:
  ClaimedLight stretched(const ClaimedLight& light) const;

  std::array<int, 3> exponents_{};  // axes are multiplied by 2^exponent
  Scene scene_;
  std::optional<PreparedScene> prepared_;
  std::uint32_t light_;
  std::optional<report::Mark> mark_;
  report::PictureOptions options_;
  std::vector<OrderedPiece> pieces_;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_FINDINGS_FINDING_PICTURE_H
