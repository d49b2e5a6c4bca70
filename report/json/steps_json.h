// SPDX-License-Identifier: GPL-3.0-or-later
// The results of several steps in one file (docs/formats.md, "Steps"): where lights have moved to,
// what was done for it, and a whole result each.
#ifndef GNOMON_REPORT_JSON_STEPS_JSON_H
#define GNOMON_REPORT_JSON_STEPS_JSON_H

#include <cstdint>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/json/json_writer.h"
#include "report/json/result_json.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

class StepsJson {
 public:
  /// All of them must outlive it.
  StepsJson(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
            const ResultJsonOptions& options);

  /// Adds a step. `moved`: lights that are not where they were at the first, as indices into the
  /// prepared lights.
  void add(const ShadowResult& result, const std::vector<std::uint32_t>& moved);
  void finish();

 private:
  JsonWriter json_;
  const Scene& scene_;
  const PreparedScene& prepared_;
  const ResultJsonOptions& options_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_JSON_STEPS_JSON_H
