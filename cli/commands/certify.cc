// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon certify: run kernels on a scene, or read a foreign result, and let the oracle judge each.
#include <algorithm>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "cli/commands/certify_corpus.h"
#include "cli/commands/certify_export.h"
#include "cli/commands/certify_pixels.h"
#include "cli/commands/certify_report.h"
#include "cli/commands/certify_samples.h"
#include "cli/commands/certify_table.h"
#include "cli/commands/table_options.h"
#include "cli/common/algorithm_choice.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/kernel_choices.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/pixel_method.h"
#include "cli/common/progress.h"
#include "cli/common/report_output.h"
#include "cli/common/scene_options.h"
#include "comparison/engine_tables/engine_table.h"
#include "comparison/samples/sample_file.h"
#include "gnomon/algorithms/explain.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/kernel_choice.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/result/read_claims.h"
#include "report/certificate/certificate.h"
#include "report/certificate/judging_limits.h"
#include "report/sides/claims_of.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

/// Regions of error that a report shows of each polygon side.
constexpr std::size_t kShownRegions = 30;
/// So many decisions are flipped without being asked for.
constexpr std::uint32_t kFlips = 30;

bool is_of_image_space(const std::string& algorithm) {
  const std::string name = algorithm.substr(0, algorithm.find(':'));
  return method_by_name(name, Domain::kImageSpace).has_value();
}

struct CertifyCommandOptions : report::JudgingLimits {
  SceneOptions scene;
  std::vector<std::string> kernels;
  std::string algorithm{kAutomaticName};
  std::vector<std::string> candidates;
  double thickness = kDefaultThickness;
  std::optional<std::uint32_t> flips;
  bool explain = false, times = false, combined = false;
  ReportOptions report;
  std::string json;
  std::vector<std::string> exports;
  CorpusCommandOptions corpus;  // what certify_corpus.h needs besides
  YearOptions suns;             // of candidates that are tables
  TableOptionRules table_rules;
  std::vector<std::string> samples;
  std::size_t misses = 10;  // of samples
  SampleOptionRules sample_rules;
  CameraOptions camera;  // for pictures
  std::vector<std::string> pixel_files;

  bool raster = false;  // options of a picture's samples were given

  /// --eye alone asks what is seen of each polygon; with a raster, or by a method of image space,
  /// it asks for samples.
  bool judges_pictures() const {
    return !pixel_files.empty() || (camera.given() && (raster || is_of_image_space(algorithm)));
  }
};

/// A candidate is judged alone unless kernels were named beside it.
Expected<std::vector<KernelChoice>> kernels_to_run(const CertifyCommandOptions& options,
                                                   std::size_t parts) {
  if (options.kernels.empty() && !options.candidates.empty()) return std::vector<KernelChoice>();
  return chosen_kernels(options.kernels, parts);
}

Expected<std::vector<AlgorithmChoice>> chosen_algorithms(const CertifyCommandOptions& options) {
  const NeedyOption combined{"--combined", options.combined, &Method::combines_lights};
  if (auto several = several_algorithms(options.algorithm, {combined}); !several.empty()) {
    return several;
  }
  const auto algorithm = parse_algorithm_choice(
      options.algorithm, {combined, {"--explain", options.explain, &Method::explains}},
      "both, all");
  if (!algorithm) return tl::unexpected(algorithm.error());
  return std::vector{*algorithm};
}

class CertifyRun {
 public:
  CertifyRun(const CertifyCommandOptions& options, const LoadedScene& loaded)
      : options_(options),
        loaded_(loaded),
        answer_(loaded.scene, loaded.prepared),
        progress_("certify") {
    certificate_ = report::certificate_of(loaded.scene, loaded.prepared, loaded.lights);
  }

  /// False on an interrupt. Errors: those of a candidate's file, and of options out of range.
  Expected<void> run_candidate(const std::string& file) {
    auto read = read_claims(file, loaded_.scene, SharesAlone::kTaken);
    if (!read) return tl::unexpected(read.error());
    report::JudgedRun run = report::foreign_run(file, *read);
    return judge(std::move(run), std::move(*read));
  }

  /// `full_name`: the run is named after its algorithm too.
  Expected<void> run_kernel(const KernelChoice& kernel, const AlgorithmChoice& algorithm,
                            bool full_name) {
    report::JudgedRun run;
    run.kernel = kernel.name();
    run.algorithm = algorithm.name(loaded_);
    run.name = full_name ? run.kernel + '/' + run.algorithm : run.kernel;
    run.exact = kernel.exact();
    // Single precision is in the default set to show what it costs: it fails on most real scenes,
    // which tells nothing of the others.
    run.counts = !options_.kernels.empty() || kernel.kernel != KernelId::kFloat;
    run.identity = kernel.identity;
    run.exact_decisions = !kernel_info(kernel.kernel).has_thickness;
    run.thickness = run.exact_decisions || kernel.thin ? 0 : options_.thickness;

    progress_.set_label("kernel " + run.name);
    ShadowOptions shadow_options = options_of(kernel, algorithm);
    std::optional<double> seconds;
    auto result = timed_run(shadow_options, seconds);
    progress_.clear();
    if (!result) {
      if (result.error().code == ErrorCode::kInterrupted) return tl::unexpected(result.error());
      // A kernel that cannot finish is a finding about that kernel.
      run.error = to_string(result.error());
      run.gave_up = result.error().code == ErrorCode::kLimit;
      limit_reached_ = limit_reached_ || (run.exact && result.error().code == ErrorCode::kLimit);
      certificate_.runs.push_back(std::move(run));
      return {};
    }
    run.cpu_seconds = *seconds;
    run.algorithm = result->algorithm;
    for (const LightResult& light : result->lights) {
      run.fragments += light.fragment_total;
      run.dropped_slivers += light.dropped_slivers;
    }
    auto candidate = report::claims_of(loaded_.scene, loaded_.prepared, *result, run.name, false);
    auto& together = algorithm.paints() ? candidate.overlay : candidate.combined;
    if (options_.combined && !together) together.emplace();  // no light reaches anything
    std::optional<ShadowOptions> explained;
    if (options_.explain && !kernel.exact()) explained = options_of(kernel, algorithm);
    return judge(std::move(run), std::move(candidate), explained);
  }

  void set_interrupted() { certificate_.interrupted = true; }
  const report::Certificate& certificate() const { return certificate_; }
  const oracle::ExactAnswer& answer() const { return answer_; }
  const std::vector<Claims>& kept() const { return kept_; }

  int status() const {
    bool failed = false, disagree = !certificate_.scene_findings.empty();
    for (const report::JudgedRun& run : certificate_.runs) {
      if (!run.report) {
        failed = failed || (!run.exact && run.counts);
        continue;
      }
      if (run.report->oracle_fault) disagree = true;
      if (run.report->interrupted) continue;
      if (run.exact && !run.report->confirms_exact()) disagree = true;
      if (!run.exact && run.counts && run.failed()) failed = true;
    }
    if (certificate_.interrupted) return kInterruptedStatus;
    if (disagree) return kDisagree;
    if (limit_reached_) return kLimitReached;
    return failed ? kFailed : kDone;
  }

 private:
  ShadowOptions options_of(const KernelChoice& kernel, const AlgorithmChoice& algorithm) {
    ShadowOptions shadow_options;
    algorithm.apply(shadow_options.method);
    shadow_options.tuning.jobs = options_.scene.jobs;
    shadow_options.kernel.id = kernel.kernel;
    shadow_options.kernel.identity = kernel.identity;
    shadow_options.kernel.thickness = kernel.thin ? 0 : options_.thickness;
    shadow_options.lights = loaded_.lights;
    shadow_options.control.progress = progress_.callback();
    shadow_options.control.interrupted = &interrupted();
    return shadow_options;
  }

  /// Times the kernel, then runs it with all that is judged. What one kernel has no memory for, the
  /// others may have.
  Expected<ShadowResult> timed_run(ShadowOptions& shadow_options, std::optional<double>& seconds) {
    try {
      const auto measured = cpu_time(shadow_options);
      if (!measured) return tl::unexpected(measured.error());
      seconds = *measured;
      shadow_options.output.exact_points = true;
      shadow_options.output.combined = options_.combined;
      return compute_shadows(loaded_.prepared, shadow_options);
    } catch (const std::bad_alloc&) {
      return fail(ErrorCode::kLimit, "gave up, out of memory");
    }
  }

  /// CPU seconds of the classification alone on one thread, without points for the oracle: the
  /// median of a few runs where one is short.
  Expected<double> cpu_time(ShadowOptions shadow_options) {
    shadow_options.tuning.jobs = 1;
    constexpr std::size_t kMostRuns = 5;
    constexpr double kEnough = 0.05;
    std::vector<double> seconds;
    double total = 0;
    while (seconds.size() < kMostRuns && total < kEnough) {
      const auto result = compute_shadows(loaded_.prepared, shadow_options);
      if (!result) return tl::unexpected(result.error());
      seconds.push_back(result->scene_bsp_seconds + result->shadow_seconds);
      total += seconds.back();
    }
    std::ranges::sort(seconds);
    return seconds[seconds.size() / 2];
  }

  /// `explained`: the run to explain, unless it is right.
  Expected<void> judge(report::JudgedRun run, Claims candidate,
                       const std::optional<ShadowOptions>& explained = std::nullopt) {
    oracle::CertifyOptions certify_options =
        report::certify_options(options_, loaded_.prepared, loaded_.lights);
    if (!options_.report.directory.empty()) certify_options.most_regions = kShownRegions;
    certify_options.progress = progress_.callback();
    certify_options.interrupted = &interrupted();
    if (judged_before_ && kept_.back().same_as(candidate)) {
      // As exact kernels claim that cut alike.
      run.report = certificate_.runs[*judged_before_].report;
      run.report->candidate = candidate.name;
    } else {
      progress_.set_label("judging " + run.name);
      auto report = oracle::certify(answer_, candidate, certify_options);
      progress_.clear();
      if (!report) return tl::unexpected(report.error());
      run.report = std::move(*report);
    }
    bool stopped = run.report->interrupted;
    if (explained && !stopped && run.report->verdict != oracle::Verdict::kIdentical) {
      explain_run(run, *explained);
      stopped = interrupted();
    }
    judged_before_ = certificate_.runs.size();
    certificate_.runs.push_back(std::move(run));
    if (options_.report.directory.empty()) kept_.clear();
    kept_.push_back(std::move(candidate));
    if (stopped) return fail(ErrorCode::kInterrupted, "interrupted");
    return {};
  }

  void explain_run(report::JudgedRun& run, const ShadowOptions& shadow_options) {
    progress_.set_label("explaining " + run.name);
    auto found = explain(loaded_.prepared, shadow_options,
                         {.flips = options_.flips.value_or(kFlips), .only_first = false});
    progress_.clear();
    if (!found) {
      run.explanation = to_string(found.error());
      return;
    }
    if (found->first) {
      std::vector<std::string> names;
      for (const Light& light : loaded_.scene.lights) names.push_back(light.id);
      run.explanation = to_sentence(*found->first, loaded_.prepared, run.kernel, names);
    } else {
      run.explanation = "every decision was right: only vertices were rounded";
    }
    run.decisions = std::move(*found);
  }

  const CertifyCommandOptions& options_;
  const LoadedScene& loaded_;
  oracle::ExactAnswer answer_;
  ProgressBar progress_;
  report::Certificate certificate_;
  std::vector<Claims> kept_;  // one a run that was judged, for the pictures; else the last one's
  std::optional<std::size_t> judged_before_;  // the place of that last one in certificate_.runs
  bool limit_reached_ = false;
};

int run_corpus(const CertifyCommandOptions& options) {
  CorpusCommandOptions corpus = options.corpus;
  corpus.kernels = options.kernels;
  corpus.tolerance = options.tolerance.value_or(corpus.tolerance);
  corpus.jobs = options.scene.jobs;
  corpus.json = options.json;
  corpus.report = options.report;
  return run_certify_corpus(corpus);
}

int run_tables(const CertifyCommandOptions& options) {
  return run_certify_tables({.scene = options.scene,
                             .suns = options.suns,
                             .tables = options.candidates,
                             .tolerance = options.tolerance,
                             .json = options.json,
                             .report = options.report},
                            options.table_rules);
}

int run_samples(const CertifyCommandOptions& options, std::vector<std::string> files) {
  return run_certify_samples({.scene = options.scene,
                              .files = std::move(files),
                              .tolerance = options.tolerance,
                              .width = options.width,
                              .clearance = options.clearance,
                              .strict = options.strict,
                              .misses = options.misses,
                              .json = options.json});
}

/// Those of --samples, and candidates that are samples too.
std::vector<std::string> sample_files(const CertifyCommandOptions& options) {
  std::vector<std::string> files = options.samples;
  std::ranges::copy_if(options.candidates, std::back_inserter(files),
                       [](const std::string& file) { return comparison::is_sample_file(file); });
  return files;
}

/// Every method that can be sampled, or the one that is named; zbuffer for `auto`.
Expected<std::vector<MethodSelection>> picture_methods(const CertifyCommandOptions& options) {
  if (options.algorithm == kAllName) return all_pixel_methods();
  const auto method =
      parse_pixel_method(options.algorithm == kAutomaticName ? "zbuffer" : options.algorithm);
  if (!method) return tl::unexpected(method.error());
  return std::vector{*method};
}

/// What says nothing of pictures.
Expected<void> check_picture_options(const CertifyCommandOptions& options) {
  for (const auto& [name, given] :
       {std::pair("--candidate", !options.candidates.empty()),
        std::pair("--explain", options.explain), std::pair("--combined", options.combined),
        std::pair("--report or --junit", options.report.asked()),
        std::pair("--export", !options.exports.empty()),
        std::pair("--leaks", options.leaks.has_value()),
        std::pair("--width", options.width.has_value()),
        std::pair("--tolerance", options.tolerance.has_value())}) {
    if (!given) continue;
    return fail(ErrorCode::kUsage, std::string(name) + " says nothing of pictures",
                "--clearance, or no --eye and no --pixels");
  }
  if (!options.camera.given() && !options.kernels.empty()) {
    return fail(ErrorCode::kUsage, "--kernel without a camera to run it with", "--eye x,y,z");
  }
  return {};
}

int run_pictures(const CertifyCommandOptions& options) {
  PictureCommandOptions pictures;
  pictures.camera = options.camera;
  pictures.files = options.pixel_files;
  pictures.float_counts = !options.kernels.empty();
  pictures.thickness = options.thickness;
  pictures.clearance = options.strict ? 0 : options.clearance;
  pictures.strict = options.strict;
  pictures.jobs = options.scene.jobs;
  pictures.json = options.json;
  pictures.times = options.times;
  if (options.camera.given()) {
    auto methods = picture_methods(options);
    if (!methods) return report_error(methods.error());
    pictures.methods = *std::move(methods);
  }
  const ThreadLimit threads(options.scene.jobs);
  const auto loaded = load_scene(options.scene, false);
  if (!loaded) return report_error(loaded.error());
  auto kernels = kernels_to_run(options, loaded->prepared.parts.size());
  if (!kernels) return report_error(kernels.error());
  pictures.kernels = *std::move(kernels);
  return run_certify_pixels(pictures, *loaded);
}

int run_certify(const CertifyCommandOptions& options) {
  if (!options.corpus.corpus.empty()) return run_corpus(options);
  if (options.scene.scene.empty()) {
    return report_usage("neither a scene nor a corpus", "SCENE, or --corpus DIR");
  }
  const std::vector<std::string> samples = sample_files(options);
  const auto checked_samples = options.sample_rules.check(
      samples.size(), options.samples.size() + options.candidates.size());
  if (!checked_samples) return report_error(checked_samples.error());
  if (!samples.empty()) return run_samples(options, samples);
  if (options.judges_pictures()) {
    if (auto checked = check_picture_options(options); !checked) {
      return report_error(checked.error());
    }
    return run_pictures(options);
  }
  const auto tables = static_cast<std::size_t>(std::ranges::count_if(
      options.candidates,
      [](const std::string& file) { return comparison::is_engine_table(file); }));
  if (auto checked = options.table_rules.check(tables, options.candidates.size()); !checked) {
    return report_error(checked.error());
  }
  if (tables > 0) return run_tables(options);
  if (auto checked = check_certify_exports(options.exports); !checked) {
    return report_error(checked.error());
  }
  auto algorithms = chosen_algorithms(options);
  if (!algorithms) return report_error(algorithms.error());
  const ThreadLimit threads(options.scene.jobs);
  SceneOptions scene = options.scene;
  scene.eye = options.camera.eye;
  auto loaded = load_scene(scene, true);
  if (!loaded) return report_error(loaded.error());
  // Lights are judged beside the eye only where fragments tell of all of them together.
  if (options.camera.given() && !options.combined) choose_eye(*loaded);
  warn_of_intent(*loaded);
  drop_repeats(*algorithms, *loaded);
  const auto kernels = kernels_to_run(options, loaded->prepared.parts.size());
  if (!kernels) return report_error(kernels.error());

  CertifyRun run(options, *loaded);
  for (const std::string& file : options.candidates) {
    if (auto done = run.run_candidate(file); !done) {
      if (done.error().code != ErrorCode::kInterrupted) return report_error(done.error());
      run.set_interrupted();
      break;
    }
  }
  for (const AlgorithmChoice& algorithm : *algorithms) {
    for (const KernelChoice& kernel : *kernels) {
      if (interrupted()) run.set_interrupted();
      if (run.certificate().interrupted) break;
      if (auto done = run.run_kernel(kernel, algorithm, algorithms->size() > 1); !done) {
        if (done.error().code != ErrorCode::kInterrupted) return report_error(done.error());
        run.set_interrupted();
      }
    }
  }

  if (options.json != "-") {
    const std::string text = report::certificate_text(run.certificate());
    if (auto done = write_output({}, text); !done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    report::write_certificate_json(*output, run.certificate(), options.times);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  if (auto done = write_certify_exports(options.exports, *loaded, run.certificate()); !done) {
    return report_error(done.error());
  }
  if (options.report.asked()) {
    const auto done = write_certificate_report(options.report, *loaded, run.certificate(),
                                               run.kept(), options.times);
    if (!done) return report_error(done.error());
  }
  return run.status();
}

/// Options that --corpus does not go with, and those that go with nothing else.
struct CorpusOptionRules {
  std::vector<const CLI::Option*> excluded, needing;

  Expected<void> check(bool corpus) const {
    for (const CLI::Option* option : corpus ? excluded : needing) {
      if (option->count() == 0) continue;
      return fail(ErrorCode::kUsage, corpus
                                         ? option->get_name() + " and --corpus do not go together"
                                         : option->get_name() + " needs --corpus");
    }
    return {};
  }
};

/// --corpus takes the place of SCENE, and few of the other options make sense with it.
CorpusOptionRules add_corpus_options(CLI::App& command, CertifyCommandOptions& options,
                                     CLI::Option* scene) {
  CorpusOptionRules rules;
  scene->required(false);
  const std::vector<std::string> common = {"--help", "--help-all", "--kernel", "--tolerance",
                                           "--json", "--jobs",     "--report", "--junit"};
  for (const CLI::Option* other : command.get_options()) {
    const bool is_common = std::ranges::any_of(
        common, [&](const std::string& name) { return other->check_name(name); });
    if (!is_common) rules.excluded.push_back(other);
  }
  command
      .add_option("--corpus", options.corpus.corpus,
                  "Instead of a scene: judge by a folder of scenes with recorded answers, by\n"
                  "default all kernels under all policies; --kernel also takes algorithms, as in\n"
                  "double/svbsp")
      ->type_name("DIR");
  rules.needing = {
      repeatable(command.add_option("--candidate-command", options.corpus.commands,
                                    "With --corpus: judge a program, which the shell runs with a\n"
                                    "scene's file as its last argument (repeatable)"))
          ->type_name("CMD"),
      command
          .add_option("--seconds", options.corpus.seconds,
                      "With --corpus: time that a program or kernel has for each scene")
          ->check(not_negative())
          ->type_name("S")
          ->default_str("10"),
      command
          .add_option("--megabytes", options.corpus.megabytes,
                      "With --corpus: address space that it has; 0: no limit")
          ->type_name("M")
          ->default_str("2048"),
      command.add_flag("--by-scene", options.corpus.by_scene,
                       "With --corpus: a row a scene instead of a row a kind"),
      command.add_flag("--in-process", options.corpus.in_process,
                       "With --corpus: kernels in this process, not each scene in its own"),
      command.add_flag("--record", options.corpus.record,
                       "With --corpus: judge nothing, write the exact fractions into its scenes,\n"
                       "and into i_ ones which kernels differ"),
  };
  return rules;
}

}  // namespace

void add_certify_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<CertifyCommandOptions>();
  CLI::App& command = *app.add_subcommand(
      "certify", "Judge kernels, or a foreign result, against the exact answer");
  command.footer(
      "Without --kernel and --candidate, every kernel that suits the size of the scene is run;\n"
      "float is then shown and does not count for the exit status.\n"
      "Verdicts: identical; within tolerance; shares agree, of a candidate that tells shares\n"
      "without fragments; samples agree, of --samples; failed, with the worst place as a "
      "witness.\n\n"
      "Examples:\n"
      "  gnomon certify room.json\n"
      "  gnomon certify room.json --kernel double --kernel double+identity --explain\n"
      "  gnomon certify room.json --kernel plane --algorithm both\n"
      "  gnomon certify room.json --candidate other.result.json --tolerance 1e-6 --report out\n"
      "  gnomon certify house.idf --candidate eplusshading.csv --epw phoenix.epw \\\n"
      "    --sun-model energyplus --average-days 20\n"
      "  gnomon certify room.json --samples rays.csv --tolerance 0.02\n"
      "  gnomon certify room.json --pixels other.pixels.json\n"
      "  gnomon certify room.json --eye 9,-7,6\n"
      "  gnomon certify room.json --eye 9,-7,6 --algorithm zbuffer\n"
      "  gnomon certify --corpus tests/regressions --candidate-command ./my-shadows");
  CLI::Option* scene = add_scene_options(command, options->scene);
  add_kernels_option(command, options->kernels);
  add_algorithm_option(command, options->algorithm, "How kernels find shadows.",
                       "both: sectors and receiver, then svbsp and merged; all: every method;\n"
                       "auto: sectors and receiver");
  repeatable(command.add_option("--candidate", options->candidates,
                                "A result file to judge instead, or a table of shares by surface\n"
                                "and time, .csv (repeatable)"))
      ->type_name("RESULT");
  command
      .add_option(
          "--tolerance", options->tolerance,
          "Wrong share of a polygon that is tolerated; of shares told alone, half a unit of\n"
          "the last digit unless this is given")
      ->check(not_negative())
      ->type_name("F")
      ->default_str("1e-9");
  command
      .add_option("--width", options->width,
                  "Width of a region of error that is tolerated, scene units "
                  "[1e-9 of the scene's diagonal]")
      ->check(not_negative())
      ->type_name("W");
  command.add_flag("--strict", options->strict, "Tolerance and width 0: identical or failed");
  command.add_flag(
      "--measure", options->measure,
      "Measure all error, on scenes of more than " + std::to_string(report::kSmallScene) +
          " parts too, where else\nsuccess is proven by borders and small error bounded");
  command
      .add_option("--clearance", options->clearance,
                  "Errors that moving one vertex by this much would undo are apart, not failures")
      ->check(not_negative())
      ->type_name("C");
  command
      .add_option("--leaks", options->leaks, "Fail with more invented and lost regions than this")
      ->type_name("N");
  command.add_flag("--combined", options->combined,
                   "Also judge each kernel's fragments of all lights together\n(" +
                       methods_that(&Method::combines_lights) + ")");
  command.add_flag("--subset", options->subset,
                   "A candidate need not have all lights and polygons");
  command
      .add_option(
          "--thickness", options->thickness,
          "Rounded kernels: half the thickness of a plane, relative to the scene's diagonal")
      ->check(not_negative())
      ->type_name("F")
      ->default_str(report::shortest(kDefaultThickness));
  CLI::Option* explain_option = command.add_flag(
      "--explain", options->explain,
      "Say which decisions of a kernel that is not identical differ from the exact ones, and\n"
      "which change the result (" +
          methods_that(&Method::explains) + ")");
  command
      .add_option("--flips", options->flips,
                  "Decisions that --explain flips one by one, largest first [30]")
      ->needs(explain_option)
      ->type_name("N");
  add_report_options(command, options->report);
  command.add_option("--json", options->json, "Write the verdicts as JSON; - is standard output")
      ->type_name("FILE");
  add_certify_export_option(command, options->exports);
  repeatable(command.add_option("--pixels", options->pixel_files,
                                "A file gnomon-pixels to judge, sample by sample (repeatable)"))
      ->type_name("FILE");
  const std::vector<CLI::Option*> raster =
      add_camera_options(command, options->camera, "--columns", "--rows");
  command.add_flag("--times", options->times, "CPU times in the JSON, which then is not stable");
  options->sample_rules.add(command, options->samples, options->misses);
  options->table_rules.add(command, options->suns);
  const CorpusOptionRules rules = add_corpus_options(command, *options, scene);
  command.callback([options, rules, raster, &action] {
    options->raster = std::ranges::any_of(raster, [](auto* option) { return option->count() > 0; });
    action = [options, rules]() -> int {
      const auto checked = rules.check(!options->corpus.corpus.empty());
      return checked ? run_certify(*options) : report_error(checked.error());
    };
  });
}

}  // namespace gnomon::cli
