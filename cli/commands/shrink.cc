// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon shrink: the smallest scene that still fails alike. What was reached is in the output file
// after every step, so that whatever stops the command, it goes on from there.
#include "fuzz/shrink/shrink.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands/isolated_check.h"
#include "cli/common/check_options.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/scene_options.h"
#include "fuzz/check/check.h"
#include "fuzz/findings/finding.h"
#include "fuzz/shrink/still_fails.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "report/json/json_writer.h"

namespace gnomon::cli {

namespace {

using fuzz::CheckOptions;
using fuzz::Failure;
using fuzz::Subject;

struct ShrinkCommand {
  SceneOptions scene;
  CheckCommandOptions check;
  std::string disagreement;
  std::uint64_t seed = 1;
  std::string time;
  std::string output;
  std::string findings;
  bool free_range = false;
};

/// Tried in this order where no subject is named.
constexpr std::array kUsualSubjects = {"double",       "double+thin", "double+identity",
                                       "float",        "longdouble",  "epick",
                                       "double/svbsp", "float/svbsp", "epick/svbsp"};

std::vector<Subject> usual_subjects() {
  std::vector<Subject> subjects;
  for (const char* name : kUsualSubjects) subjects.push_back(*fuzz::parse_subject(name));
  for (Subject& subject : fuzz::exact_subjects()) subjects.push_back(std::move(subject));
  return subjects;
}

/// The first failure that is asked for, subject by subject: the next one need not run then.
Expected<std::optional<Failure>> first_failure(const Scene& scene, const std::string& program,
                                               const fuzz::WorkerOptions& worker,
                                               const std::string& disagreement) {
  const auto search = [&](const CheckOptions& check) -> Expected<std::optional<Failure>> {
    const IsolatedCheck checker(program, check, worker.limits);
    for (Failure& failure : checker(scene).failures) {
      if (disagreement.empty() || failure.disagreement == disagreement) {
        return std::optional(std::move(failure));
      }
    }
    if (checker.error()) return tl::unexpected(*checker.error());
    return std::nullopt;
  };
  for (const Subject& subject : worker.check.subjects) {
    CheckOptions one = worker.check;
    one.subjects = {subject};
    auto failure = search(one);
    if (!failure || *failure) return failure;
  }
  // What shows only where several are compared.
  if (worker.check.subjects.size() < 2) return std::nullopt;
  return search(worker.check);
}

/// The top-level "extra" of the output: how it fails, and which scene it is a smaller one of. The
/// part that tells two tasks apart comes first.
std::string task_text(const Scene& origin, const Failure& failure) {
  report::StringSink sink;
  {
    report::JsonWriter json(sink);
    json.begin_object(report::JsonLayout::kInline);
    json.member("fails", failure.signature());
    json.member("shrunken_from", fuzz::fingerprint_of(origin));
    json.end_object();
  }
  std::string text = sink.text();
  text.pop_back();  // the closing brace
  return text;
}

std::string extra_text(const std::string& task, const std::string& sentence) {
  report::StringSink sink;
  {
    report::JsonWriter json(sink);
    json.begin_array(report::JsonLayout::kInline);
    json.value(sentence);
    json.end_array();
  }
  const std::string quoted = sink.text().substr(1, sink.text().size() - 2);
  return task + ", \"text\": " + quoted + "}";
}

/// One line on a terminal, rewritten in place.
class SizeLine {
 public:
  SizeLine() = default;
  SizeLine(const SizeLine&) = delete;
  SizeLine& operator=(const SizeLine&) = delete;
  ~SizeLine() { show({}, true); }

  void show(std::string text, bool now = false) {
    constexpr std::chrono::milliseconds kInterval{100};
    constexpr std::size_t kColumns = 100;
    const auto time = std::chrono::steady_clock::now();
    if (!terminal_ || (!now && time < next_) || (text.empty() && width_ == 0)) return;
    next_ = time + kInterval;
    text.resize(std::min(text.size(), kColumns));
    const std::size_t width = text.size();
    if (width < width_) text.append(width_ - width, ' ');
    width_ = width;
    std::fprintf(stderr, "\r%s%s", text.c_str(), width == 0 ? "\r" : "");
    std::fflush(stderr);
  }

 private:
  const bool terminal_ = ::isatty(STDERR_FILENO) != 0;
  std::chrono::steady_clock::time_point next_{};
  std::size_t width_ = 0;
};

class ShrinkRun {
 public:
  ShrinkRun(const ShrinkCommand& options, Scene scene, std::string program,
            fuzz::WorkerOptions worker)
      : options_(options),
        origin_(std::move(scene)),
        program_(std::move(program)),
        worker_(std::move(worker)) {}

  int run() {
    const auto found = first_failure(origin_, program_, worker_, options_.disagreement);
    if (!found) return report_error(found.error());
    if (!*found) {
      say(fmt::format("{}: nothing to shrink: it does not fail ({})\n",
                      shown_name(options_.scene.scene), checked_in_words()));
      return kDone;
    }
    failure_ = **found;
    task_ = task_text(origin_, failure_);
    say(fmt::format("{} fails: {}\n  {}\n  {}\n", shown_name(options_.scene.scene),
                    failure_.signature(), failure_.text,
                    fuzz::size_in_words(fuzz::size_of(origin_))));
    const IsolatedCheck checker(program_, fuzz::narrowed(worker_.check, failure_), worker_.limits);
    const fuzz::StillFails alike = fuzz::fails_like(failure_, checker);
    // A check that was cut short says nothing.
    const auto fails = [&](const Scene& scene) { return alike(scene) && !interrupted(); };
    Scene start = left_behind(fails).value_or(origin_);
    start.name = origin_.name;
    start.extra.clear();

    fuzz::ShrinkOptions shrinking;
    shrinking.interrupted = &interrupted();
    shrinking.free_range = options_.free_range;
    shrinking.range_of = &origin_;
    if (!options_.time.empty()) shrinking.seconds = duration_seconds(options_.time);
    SizeLine line;
    std::optional<Error> unwritten;
    shrinking.progress = [&](const fuzz::ShrinkProgress& progress) {
      line.show(fmt::format("{}; {} tries, {}", fuzz::size_in_words(progress.size), progress.tries,
                            progress.pass));
      if (!progress.improved || !has_file() || unwritten) return;
      if (auto done = write(progress.best); !done) unwritten = done.error();
    };
    const auto begin = std::chrono::steady_clock::now();
    const fuzz::ShrinkResult result = fuzz::shrink(std::move(start), fails, shrinking);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    line.show({}, true);
    if (unwritten) return report_error(*unwritten);
    if (checker.error() && !interrupted()) return report_error(*checker.error());
    if (auto done = write(result.scene); !done) return report_error(done.error());
    say(fmt::format("shrunken to {} in {} tries ({} accepted), {:.1f} s\n",
                    fuzz::size_in_words(result.after), result.tries, result.accepted,
                    took.count()));
    if (result.locally_minimal) {
      say("locally minimal: no step of the list makes it smaller\n");
    } else if (has_file()) {
      say("stopped before it was locally minimal; the same command goes on from " +
          options_.output + "\n");
    } else {
      say("stopped before it was locally minimal\n");
    }
    if (!options_.findings.empty() && !interrupted()) {
      if (auto done = keep(result); !done) return report_error(done.error());
    }
    return interrupted() ? kInterruptedStatus : kDone;
  }

 private:
  bool has_file() const { return !options_.output.empty() && options_.output != "-"; }
  static std::string shown_name(const std::string& file) { return file == "-" ? "<stdin>" : file; }

  /// To people: where the scene does not go.
  void say(const std::string& text) const {
    std::FILE* stream = has_file() ? stdout : stderr;
    std::fputs(text.c_str(), stream);
    std::fflush(stream);
  }

  std::string checked_in_words() const {
    std::string names;
    for (const Subject& subject : worker_.check.subjects) {
      names += (names.empty() ? "" : ", ") + fuzz::name_of(subject);
    }
    std::string text = names;
    for (const std::string& id : options_.check.properties) text += "; property " + id;
    if (!options_.disagreement.empty()) text += "; class " + options_.disagreement;
    return text;
  }

  Expected<void> keep(const fuzz::ShrinkResult& result) const {
    fuzz::Finding finding;
    finding.scene = result.scene;
    finding.original = origin_;
    finding.failure = failure_;
    finding.check = worker_.check;
    finding.seconds = worker_.limits.seconds;
    finding.megabytes = worker_.limits.megabytes;
    finding.locally_minimal = result.locally_minimal;
    const auto place = fuzz::write_finding(options_.findings, finding);
    if (!place) return tl::unexpected(place.error());
    say("finding: " + place->string() + "\n");
    return {};
  }

  Expected<void> write(const Scene& best) const {
    Scene scene = best;
    scene.extra = extra_text(task_, failure_.text);
    const auto written = scene_to_text(scene, SceneFormat::kJson);
    if (!written) return tl::unexpected(written.error());
    return write_output(options_.output, written->text);
  }

  /// What an earlier run of the same task left in the output file.
  template <class Fails>
  std::optional<Scene> left_behind(const Fails& fails) const {
    if (!has_file() || !std::filesystem::exists(options_.output)) return std::nullopt;
    ReadOptions json;
    json.format = SceneFormat::kJson;
    auto read = read_scene(options_.output, json);
    if (!read || !read->scene.extra.starts_with(task_) || !fails(read->scene)) return std::nullopt;
    say(fmt::format("going on from {}: {}\n", options_.output,
                    fuzz::size_in_words(fuzz::size_of(read->scene))));
    return std::move(read->scene);
  }

  const ShrinkCommand& options_;
  const Scene origin_;
  const std::string program_;
  const fuzz::WorkerOptions worker_;
  Failure failure_;
  std::string task_;
};

int run_shrink(const ShrinkCommand& options) {
  auto worker = worker_options(options.check, usual_subjects());
  if (!worker) return report_error(worker.error());
  worker->check.seed = options.seed;
  auto program = own_program();
  if (!program) return report_error(program.error());
  auto loaded = load_scene(options.scene, false);
  if (!loaded) return report_error(loaded.error());
  Scene scene = std::move(loaded->scene);
  if (!options.scene.lights.empty()) {
    std::vector<Light> lights;
    for (const std::uint32_t light : loaded->lights) lights.push_back(scene.lights[light]);
    scene.lights = std::move(lights);
  }
  return ShrinkRun(options, std::move(scene), std::move(*program), std::move(*worker)).run();
}

}  // namespace

void add_shrink_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<ShrinkCommand>();
  CLI::App& command = *app.add_subcommand("shrink", "The smallest scene that still fails alike");
  command.footer(
      "Alike: the same property, the same class of disagreement, the same subject, the same cause\n"
      "(near-coplanar, grazing, far, ...). Without --kernel\n"
      "and --candidate-command the rounded kernels are tried, then the exact ones, and the first\n"
      "failure is shrunk. With -o FILE the best scene so far is always in FILE, and the same "
      "command\n"
      "goes on from there. A scene on which nothing fails is an answer: exit status 0.\n\n"
      "Examples:\n"
      "  gnomon shrink scene.json --kernel double+thin -o small.json\n"
      "  gnomon shrink scene.json --candidate-command './solver --json' --class misclassified");
  add_scene_options(command, options->scene);
  add_check_options(command, options->check);
  command
      .add_option("--class", options->disagreement,
                  "Only failures of this class, such as misclassified, uncovered, refused")
      ->type_name("CLASS");
  command.add_flag("--free-range", options->free_range,
                   "Coordinates may leave the range that the scene has on each axis");
  command.add_option("--seed", options->seed, "Of the metamorphic relation that is tried")
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--time", options->time, "Stop after that long: 90, 90s, 5m, 2h")
      ->check(duration())
      ->type_name("T");
  command
      .add_option("-o,--output", options->output,
                  "Scene file, written after every improvement; standard output if absent")
      ->type_name("FILE");
  command
      .add_option("--findings", options->findings,
                  "Also write it as a finding, a folder below DIR: pictures, verdict, first "
                  "differing decision")
      ->type_name("DIR");
  command.callback([options, &action] { action = [options] { return run_shrink(*options); }; });
}

}  // namespace gnomon::cli
