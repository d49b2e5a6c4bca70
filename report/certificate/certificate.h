// SPDX-License-Identifier: GPL-3.0-or-later
// A certificate: what ran, under which policy, and what the oracle said of it, for people and for
// programs.
#ifndef GNOMON_REPORT_CERTIFICATE_CERTIFICATE_H
#define GNOMON_REPORT_CERTIFICATE_CERTIFICATE_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/explain.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

struct JudgedRun {
  std::string name;  // "double+identity", "plane/svbsp", or the file of a foreign result
  std::string kernel, algorithm;  // "double+identity", "svbsp"; empty if foreign
  bool foreign = false;           // not one of our kernels
  bool counts = true;             // for the status: false if nobody asked for this kernel
  bool exact = false;             // an exact kernel: anything but `identical` is a bug of ours
  bool per_caster_umbra = true;   // else umbra that is called penumbra is a cost, and told
  bool identity = false;
  bool exact_decisions = false;  // rounds points alone (epick): no thickness
  double thickness = 0;          // rounded kernels only
  std::uint64_t fragments = 0;
  std::uint64_t dropped_slivers = 0;
  double cpu_seconds = 0;
  std::string error;     // why there is no report; empty if there is one
  bool gave_up = false;  // the error is a stated limit: fragments, memory
  std::optional<oracle::Report> report;
  std::string explanation;               // the first decision that went another way, if asked for
  std::optional<Explanation> decisions;  // all of them, and what each changes

  bool failed() const { return !report || report->verdict == oracle::Verdict::kFailed; }
};

/// What all runs were judged on.
struct Certificate {
  const Scene* scene = nullptr;
  const PreparedScene* prepared = nullptr;
  std::string geometry_digest;
  std::vector<std::string> lights;          // judged
  double facing_area = 0;                   // scene units squared, of all lights together
  std::vector<std::string> scene_findings;  // what is wrong with the prepared scene: bugs of ours
  std::vector<JudgedRun> runs;
  bool interrupted = false;  // runs that were not reached are missing
};

/// Of a scene on which nothing was judged yet. `lights`: indices into both scenes' lights. Keeps
/// references to the scenes.
Certificate certificate_of(const Scene& scene, const PreparedScene& prepared,
                           std::span<const std::uint32_t> lights);
/// What others claim, before it is judged. `name`: of its file.
JudgedRun foreign_run(std::string name, const Claims& claims);

/// For people: a head that names scene and tolerances, a table of at most 110 columns, the worst
/// place of every run that failed below its row.
std::string certificate_text(const Certificate& certificate);

/// For programs: stable, in the order of the runs; CPU times only if asked for.
void write_certificate_json(TextSink& sink, const Certificate& certificate, bool times);

/// For spreadsheets: a line a run.
std::string certificate_csv(const Certificate& certificate);

/// "light sun, polygon floor (front), at (1, 2, 0): found lit, true shadow, by caster table".
std::string place_in_words(const oracle::Witness& witness);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_CERTIFICATE_CERTIFICATE_H
