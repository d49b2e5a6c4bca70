// SPDX-License-Identifier: GPL-3.0-or-later
// A scene and its fragments as a page draws them: positions rounded to single precision about the
// centre of the scene, which is enough for pixels and decides nothing. What the page says in
// numbers comes from the other documents.
#ifndef GNOMON_REPORT_PAGE_SCENE_VIEW_H
#define GNOMON_REPORT_PAGE_SCENE_VIEW_H

#include <cstdint>
#include <span>
#include <string>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

/// The fragments of one light as one run has them.
struct ViewLayer {
  std::string run;  // "exact", or as the certificate names it
  const ClaimedLight* light = nullptr;
};

/// Points of fragments in one page: some 100 MB of text, which a browser opens in seconds. Layers
/// that do not fit are named without fragments, and the page says so.
inline constexpr std::uint64_t kMostViewPoints = 6'000'000;

/// "format": "gnomon-view" (docs/report.md).
void write_scene_view(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                      std::span<const ViewLayer> layers,
                      std::uint64_t most_points = kMostViewPoints);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PAGE_SCENE_VIEW_H
