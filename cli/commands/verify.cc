// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon verify: check what a result says of itself (tiling, witnesses, fractions), claim by claim.
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "cli/common/scene_options.h"
#include "gnomon/oracle/prepared_check.h"
#include "gnomon/oracle/witness_check.h"
#include "gnomon/result/read_claims.h"
#include "report/json/json_writer.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::cli {

namespace {

struct VerifyOptions {
  SceneOptions scene;
  std::string result;
  double tolerance = 1e-9;
  std::optional<double> width;
  bool subset = false, strict = false;
  std::string json;
};

std::string findings_text(const VerifyOptions& options, const oracle::WitnessReport& report,
                          const std::vector<oracle::PreparedFinding>& scene_findings) {
  using report::grouped;
  using report::wrapped;
  constexpr std::size_t kWidth = report::TextTable::kWidth;
  std::string text;
  for (const oracle::PreparedFinding& finding : scene_findings) {
    text += wrapped("scene" + (finding.polygon.empty() ? "" : ", polygon " + finding.polygon) +
                        ": " + finding.text,
                    kWidth, 0, 4);
  }
  for (const oracle::WitnessFinding& finding : report.findings) {
    std::string place;
    if (finding.block != Block::kLights) place += name_of(finding.block);
    if (!finding.light.empty()) place += (place.empty() ? "" : ", ") + ("light " + finding.light);
    if (!finding.polygon.empty())
      place += (place.empty() ? "" : ", ") + ("polygon " + finding.polygon);
    if (finding.fragment) place += ", fragment " + std::to_string(*finding.fragment);
    text += wrapped((place.empty() ? "" : place + ": ") + finding.text, kWidth, 0, 4);
  }
  if (report.violations > report.findings.size()) {
    text += "... and " + grouped(report.violations - report.findings.size()) + " more\n";
  }
  text +=
      wrapped(options.result + ": " + grouped(report.polygons) + " polygon sides, " +
                  grouped(report.fragments) + " fragments (" + grouped(report.exact_fragments) +
                  " with exact loops), " + grouped(report.witnesses) + " witnesses checked" +
                  (report.rounded > 0 ? ", " + grouped(report.rounded) + " errors that are rounding"
                                      : std::string()) +
                  ": " +
                  (report.interrupted       ? "interrupted"
                   : report.violations == 0 ? "every claim holds"
                                            : grouped(report.violations) + " claims do not hold"),
              kWidth, 0, 4);
  return text;
}

void write_findings_json(report::TextSink& sink, const oracle::WitnessReport& report) {
  report::JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-verification");
  json.member("version", 1);
  json.member("holds", report.violations == 0 && !report.interrupted);
  if (report.interrupted) json.member("interrupted", true);
  json.member("polygon_sides", report.polygons);
  json.member("fragments", report.fragments);
  json.member("exact_fragments", report.exact_fragments);
  json.member("witnesses", report.witnesses);
  json.member("rounding", report.rounded);
  json.member("violations", report.violations);
  json.key("findings");
  json.begin_array();
  for (const oracle::WitnessFinding& finding : report.findings) {
    json.begin_object(report::JsonLayout::kInline);
    if (finding.block != Block::kLights) json.member("block", name_of(finding.block));
    json.member("light", finding.light);
    json.member("polygon", finding.polygon);
    if (finding.fragment) json.member("fragment", *finding.fragment);
    json.member("text", finding.text);
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.finish();
}

int run_verify(const VerifyOptions& options) {
  const ThreadLimit threads(options.scene.jobs);
  const auto loaded = load_scene(options.scene, true);
  if (!loaded) return report_error(loaded.error());
  const auto candidate = read_claims(options.result, loaded->scene);
  if (!candidate) return report_error(candidate.error());
  const auto scene_findings = oracle::check_prepared(loaded->scene, loaded->prepared);

  ProgressBar progress("verify");
  oracle::WitnessOptions witness_options;
  witness_options.tolerance = options.tolerance;
  witness_options.width = options.width;
  witness_options.strict = options.strict;
  // Lights left out by --light are not missed.
  witness_options.subset =
      options.subset || !options.scene.lights.empty() || !options.scene.eye.empty();
  witness_options.progress = progress.callback();
  witness_options.interrupted = &interrupted();
  const auto report =
      oracle::check_witnesses(loaded->scene, loaded->prepared, *candidate, witness_options);
  progress.clear();

  if (options.json != "-") {
    const auto done = write_output({}, findings_text(options, report, scene_findings));
    if (!done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    write_findings_json(*output, report);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  if (report.interrupted) return kInterruptedStatus;
  if (!scene_findings.empty()) return kDisagree;
  return report.violations == 0 ? kDone : kFailed;
}

}  // namespace

void add_verify_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App& command =
      *app.add_subcommand("verify", "Check a result's own claims: tiling, witnesses, fractions");
  command.footer(
      "With code that shares nothing with the algorithms; exactly where the result has exact "
      "loops.\nWhere it has none, what the rounding of vertices to doubles explains is excused.\n\n"
      "Example:\n"
      "  gnomon shadows room.json --exact-loops --exact-fractions -o room.result.json\n"
      "  gnomon verify room.json room.result.json");
  add_scene_options(command, options->scene);
  command.add_option("RESULT", options->result, "The result file, with fragments")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--eye", options->scene.eye,
                  "The eye of a result that gnomon visible wrote, as it was given there")
      ->type_name("x,y,z");
  command
      .add_option("--tolerance", options->tolerance,
                  "Share of a polygon that rounded loops may be wrong about")
      ->check(not_negative())
      ->type_name("F")
      ->default_str("1e-9");
  command
      .add_option("--width", options->width,
                  "How wide that may be, and how far off its plane a vertex, scene units "
                  "[1e-9 of the scene's diagonal]")
      ->check(not_negative())
      ->type_name("W");
  command.add_flag("--strict", options->strict,
                   "Rounded loops are judged as if they were exact: nothing is rounding");
  command.add_flag("--subset", options->subset, "Lights and polygons may be missing");
  command.add_option("--json", options->json, "Write the findings as JSON; - is standard output")
      ->type_name("FILE");
  command.callback([options, &action] { action = [options] { return run_verify(*options); }; });
}

}  // namespace gnomon::cli
