// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate of candidates that are no results (tables of an engine, samples): what is told of
// the scene once, and a run a candidate.
#ifndef GNOMON_COMPARISON_VERDICTS_JSON_H
#define GNOMON_COMPARISON_VERDICTS_JSON_H

#include <algorithm>
#include <vector>

#include "gnomon/scene/scene.h"
#include "report/json/json_writer.h"

namespace gnomon::comparison {

/// `write_run(json, verdict)` writes one run. Requires: at least one verdict, all of one scene.
template <class Verdict, class WriteRun>
void write_verdicts_json(report::TextSink& sink, const std::vector<Verdict>& verdicts,
                         const WriteRun& write_run) {
  report::JsonWriter json(sink);
  const Verdict& first = verdicts.front();
  json.begin_object();
  json.member("format", "gnomon-certificate");
  json.member("version", 1);
  json.member("scene", first.scene);
  json.member("geometry", first.geometry_digest);
  json.member("numbers", first.numbers == NumberMeaning::kDecimal ? "decimal" : "double");
  json.member("polygons", first.polygons);
  json.member("parts", first.parts);
  if (std::ranges::any_of(verdicts, &Verdict::interrupted)) json.member("interrupted", true);
  json.key("runs");
  json.begin_array();
  for (const Verdict& verdict : verdicts) write_run(json, verdict);
  json.end_array();
  json.end_object();
  json.finish();
}

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_VERDICTS_JSON_H
