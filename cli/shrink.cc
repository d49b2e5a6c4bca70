// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon shrink: the smallest scene that still fails alike. What was reached is in the output file
// after every step, so that whatever stops the command, it goes on from there.
#include "gnomon/fuzz/shrink.h"

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

#include "commands.h"
#include "gnomon/fuzz/check.h"
#include "gnomon/fuzz/finding.h"
#include "gnomon/fuzz/still_fails.h"
#include "gnomon/report/json_writer.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "interrupt.h"
#include "messages.h"
#include "output.h"
#include "scene_options.h"

namespace gnomon::cli {

namespace {

using fuzz::CheckOptions;
using fuzz::Failure;
using fuzz::Property;
using fuzz::Subject;

struct ShrinkCommand {
  SceneOptions scene;
  std::vector<std::string> kernels;
  std::vector<std::string> commands;
  std::string property, disagreement;
  double tolerance = 1e-9;
  std::optional<double> width;
  bool strict = false;
  std::uint64_t seed = 1;
  double seconds = 0;
  std::string output;
  std::string findings;
};

/// Tried in this order where no subject is named.
constexpr std::array kUsualSubjects = {"double",       "double+thin", "double+identity",
                                       "float",        "longdouble",  "epick",
                                       "double/svbsp", "float/svbsp", "epick/svbsp"};

Expected<CheckOptions> check_options(const ShrinkCommand& options) {
  CheckOptions check;
  for (const std::string& name : options.kernels) {
    auto subject = fuzz::parse_subject(name);
    if (!subject) return tl::unexpected(subject.error());
    check.subjects.push_back(std::move(*subject));
  }
  for (const std::string& command : options.commands) {
    check.subjects.push_back({});
    check.subjects.back().command = command;
  }
  if (check.subjects.empty()) {
    for (const char* name : kUsualSubjects) check.subjects.push_back(*fuzz::parse_subject(name));
    for (Subject& subject : fuzz::exact_subjects()) check.subjects.push_back(std::move(subject));
  }
  if (!options.property.empty()) {
    const auto property = fuzz::property_by_id(options.property);
    if (!property) {
      std::string ids;
      for (const fuzz::PropertyInfo& info : fuzz::properties()) {
        ids += (ids.empty() ? "" : ", ") + std::string(info.id);
      }
      return fail(ErrorCode::kUsage, "--property " + options.property + ": no such property",
                  "one of: " + ids);
    }
    check.properties = {*property};
  }
  check.tolerance = options.tolerance;
  check.width = options.width;
  check.strict = options.strict;
  check.seed = options.seed;
  return check;
}

/// The first failure that is asked for, subject by subject: the next one need not run then.
std::optional<Failure> first_failure(const Scene& scene, const CheckOptions& all,
                                     const std::string& disagreement) {
  const auto search = [&](const CheckOptions& check) -> std::optional<Failure> {
    for (Failure& failure : fuzz::check_scene(scene, check).failures) {
      if (disagreement.empty() || failure.disagreement == disagreement) return std::move(failure);
    }
    return std::nullopt;
  };
  for (const Subject& subject : all.subjects) {
    CheckOptions one = all;
    one.subjects = {subject};
    if (auto failure = search(one)) return failure;
    if (interrupted()) return std::nullopt;
  }
  return search(all);  // what shows only where several are compared
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
class ProgressLine {
 public:
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { show({}, true); }

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
  ShrinkRun(const ShrinkCommand& options, Scene scene, CheckOptions check)
      : options_(options), origin_(std::move(scene)), check_(std::move(check)) {}

  int run() {
    const auto failure = first_failure(origin_, check_, options_.disagreement);
    if (interrupted()) return report_error({ErrorCode::kInterrupted, {}, "interrupted", {}});
    if (!failure) {
      say(fmt::format("{}: nothing to shrink: it does not fail ({})\n",
                      shown_name(options_.scene.scene), checked_in_words()));
      return kDone;
    }
    failure_ = *failure;
    task_ = task_text(origin_, failure_);
    say(fmt::format("{} fails: {}\n  {}\n  {}\n", shown_name(options_.scene.scene),
                    failure_.signature(), failure_.text,
                    fuzz::size_in_words(fuzz::size_of(origin_))));
    const fuzz::StillFails alike = fuzz::fails_like(failure_, check_);
    // A check that was cut short says nothing.
    const auto fails = [&](const Scene& scene) { return alike(scene) && !interrupted(); };
    Scene start = left_behind(fails).value_or(origin_);
    start.name = origin_.name;
    start.extra.clear();

    fuzz::ShrinkOptions shrinking;
    shrinking.interrupted = &interrupted();
    shrinking.seconds = options_.seconds;
    ProgressLine line;
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
    for (const Subject& subject : check_.subjects) {
      names += (names.empty() ? "" : ", ") + fuzz::name_of(subject);
    }
    std::string text = names;
    if (!options_.property.empty()) text += "; property " + options_.property;
    if (!options_.disagreement.empty()) text += "; class " + options_.disagreement;
    return text;
  }

  Expected<void> keep(const fuzz::ShrinkResult& result) const {
    fuzz::Finding finding;
    finding.scene = result.scene;
    finding.original = origin_;
    finding.failure = failure_;
    finding.check = check_;
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
  const CheckOptions check_;
  Failure failure_;
  std::string task_;
};

int run_shrink(const ShrinkCommand& options) {
  auto check = check_options(options);
  if (!check) return report_error(check.error());
  auto loaded = load_scene(options.scene, false);
  if (!loaded) return report_error(loaded.error());
  Scene scene = std::move(loaded->scene);
  if (!options.scene.lights.empty()) {
    std::vector<Light> lights;
    for (const std::uint32_t light : loaded->lights) lights.push_back(scene.lights[light]);
    scene.lights = std::move(lights);
  }
  return ShrinkRun(options, std::move(scene), std::move(*check)).run();
}

}  // namespace

void add_shrink_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<ShrinkCommand>();
  CLI::App& command = *app.add_subcommand("shrink", "The smallest scene that still fails alike");
  command.footer(
      "Alike: the same property, the same class of disagreement, the same subject. Without "
      "--kernel\n"
      "and --candidate-command the rounded kernels are tried, then the exact ones, and the first\n"
      "failure is shrunk. With -o FILE the best scene so far is always in FILE, and the same "
      "command\n"
      "goes on from there. A scene on which nothing fails is an answer: exit status 0.\n\n"
      "Examples:\n"
      "  gnomon shrink scene.json --kernel double+thin -o small.json\n"
      "  gnomon shrink scene.json --candidate-command './solver --json' --class misclassified");
  add_scene_options(command, options->scene);
  repeatable(
      command.add_option("--kernel", options->kernels,
                         "What is under test: KERNEL[+identity][+thin][/ALGORITHM] (repeatable)"))
      ->type_name("SUBJECT");
  repeatable(command.add_option("--candidate-command", options->commands,
                                "A foreign program under test: scene file as last argument, result "
                                "on standard output (repeatable)"))
      ->type_name("CMD");
  command.add_option("--property", options->property, "Only failures of this property")
      ->type_name("ID");
  command
      .add_option("--class", options->disagreement,
                  "Only failures of this class, such as misclassified, uncovered, refused")
      ->type_name("CLASS");
  command
      .add_option("--tolerance", options->tolerance, "Wrong share of a polygon that is tolerated")
      ->check(not_negative())
      ->type_name("F")
      ->capture_default_str();
  command
      .add_option("--width", options->width,
                  "Width of errors that is tolerated; 1e-9 of the scene's diagonal if absent")
      ->check(not_negative())
      ->type_name("W");
  command.add_flag("--strict", options->strict, "Tolerance and width 0");
  command.add_option("--seed", options->seed, "Of the metamorphic relation that is tried")
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--time", options->seconds, "Stop after so many seconds; 0: never")
      ->check(not_negative())
      ->type_name("SECONDS")
      ->capture_default_str();
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
