// SPDX-License-Identifier: GPL-3.0-or-later
// A shadow result as a file (docs/formats.md, "Result"), one fragment a line.
//
// Guarantees: the same result gives the same bytes; doubles read back to the same value; what a
// rounded kernel could not compute (NaN, infinity) is null and named under "findings".
#ifndef GNOMON_REPORT_JSON_RESULT_JSON_H
#define GNOMON_REPORT_JSON_RESULT_JSON_H

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/algorithms/deep_umbra.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/sides/polygon_sides.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

struct ResultExtras;  // extras_json.h
class JsonWriter;     // json_writer.h

struct ResultJsonOptions {
  std::string geometry_digest;   // "sha256:..."
  bool fragments = false;        // loops of nearest doubles; needs LightResult::points
  bool exact_fractions = false;  // "p/q" instead of numbers; needs LightResult::exact_fractions
  bool exact_loops = false;      // needs LightResult::exact_points
  bool combined = false;         // all lights together; needs ShadowResult::combined
  bool overlay = false;          // shadows painted on shadows; needs ShadowResult::overlay
  /// For each light the bounds that deep_umbra_bounds() has of it, none for other lights; empty: do
  /// not write them.
  std::vector<std::vector<DeepUmbraBounds>> deep_umbra;
  /// List fragments of this class alone; kShadow: all not lit. Not of a light whose fragments are
  /// painted over each other or have a background: they mean something together.
  std::optional<LightState> only;
  /// Of the same result and with exact shares if exact_fractions, where someone has them already;
  /// else they are computed polygon by polygon.
  const SidesByLight* sides = nullptr;
  /// What else was asked for; null: nothing. Needs exact_fractions where these are to be exact.
  const ResultExtras* extras = nullptr;
  /// Once true, polygons are left off: what has been written is then no result.
  const std::atomic<bool>* interrupted = nullptr;
};

void write_result_json(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                       const ShadowResult& result, const ResultJsonOptions& options);

/// The same object as a value within a larger document.
void write_result_object(JsonWriter& json, const Scene& scene, const PreparedScene& prepared,
                         const ShadowResult& result, const ResultJsonOptions& options);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_JSON_RESULT_JSON_H
