// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/workers/worker.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <charconv>
#include <cstdio>
#include <iostream>
#include <optional>
#include <sstream>
#include <utility>

#include "fuzz/check/failure_json.h"
#include "fuzz/generate/generator.h"
#include "fuzz/process/address_space.h"
#include "gnomon/scene/read.h"
#include "report/json/json_writer.h"
#include "report/text/number_text.h"

#ifdef __linux__
#include <sys/prctl.h>

#include <csignal>
#endif

namespace gnomon::fuzz {

namespace {

using report::JsonLayout;
using report::JsonWriter;

void write_failure(JsonWriter& json, const Failure& failure) {
  json.begin_object(JsonLayout::kInline);
  write_failure_members(json, failure);
  json.end_object();
}

constexpr std::string_view kAnswerWriter = "what a worker writes";

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// Lets the process have `megabytes` more than it has now, ends it with its parent, and leaves no
/// core files behind.
void confine(const Limits& limits) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (limits.megabytes == 0) return;
  const rlim_t most = address_space_taken() + (limits.megabytes << 20);
  const rlimit memory{most, most};
  setrlimit(RLIMIT_AS, &memory);
}

class Worker {
 public:
  Worker(const WorkerOptions& options, std::vector<Generator> generators)
      : options_(options), generators_(std::move(generators)) {}

  void serve() {
    std::string line;
    while (std::getline(std::cin, line)) {
      std::istringstream words(line);
      std::string what;
      words >> what;
      if (what == "case") {
        std::uint64_t index = 0, seed = 0, generator = 0;
        words >> index >> seed >> generator;
        check_case(seed, generator);
      } else if (what == "scene") {
        std::uint64_t seed = 0, length = 0;
        words >> seed >> length;
        std::string text(length, '\0');
        if (!std::cin.read(text.data(), static_cast<std::streamsize>(length))) return;
        check_text(seed, std::move(text));
      } else {
        return;
      }
    }
  }

 private:
  static void say(const std::string& line) {
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fflush(stdout);
  }
  static void tell(std::string_view stage) { say('@' + std::string(stage) + '\n'); }

  CheckOptions options_for(std::uint64_t seed) const {
    CheckOptions options = options_.check;
    options.seed = seed;
    options.stage = tell;
    if (!options_.in_turn) return options;
    std::vector<std::size_t> exact;
    for (std::size_t i = 0; i < options.subjects.size(); ++i) {
      if (options.subjects[i].exact()) exact.push_back(i);
    }
    if (exact.size() < 3) return options;
    // The upper half of the seed: the lower one chooses the relation.
    const std::size_t taken = exact[1 + (seed >> 32) % (exact.size() - 1)];
    // The claims, in rational numbers throughout, take longer than all else together, and equal
    // fractions say most of what the oracle would.
    constexpr std::uint64_t kThorough = 8;
    if ((seed >> 56) % kThorough != 0) options.brief = true;
    std::vector<Subject> subjects;
    for (std::size_t i = 0; i < options.subjects.size(); ++i) {
      if (!options.subjects[i].exact() || i == exact[0] || i == taken) {
        subjects.push_back(options.subjects[i]);
      }
    }
    options.subjects = std::move(subjects);
    return options;
  }

  void check_case(std::uint64_t seed, std::uint64_t generator) {
    tell("generator");
    MadeScene made = generators_.at(generator).make(seed);
    answer(check_scene(made.scene, options_for(seed)), std::move(made.recipe),
           std::move(made.kinds));
  }

  void check_text(std::uint64_t seed, std::string text) {
    tell("reading");
    const Expected<ReadResult> read = parse_scene(std::move(text), "scene.json");
    CaseReport report;
    if (read) {
      report = check_scene(read->scene, options_for(seed));
    } else {
      const bool limit = read.error().code == ErrorCode::kLimit;
      report.failures.push_back({limit ? Property::kBudget : Property::kRoundTrip,
                                 "scene",
                                 limit ? "memory" : "refused",
                                 {},
                                 {},
                                 to_string(read.error())});
    }
    answer(std::move(report), {}, {});
  }

  static void answer(CaseReport report, std::string recipe, std::vector<std::uint16_t> kinds) {
    say('=' + answer_text({std::move(report), std::move(recipe), std::move(kinds)}) + '\n');
  }

  const WorkerOptions& options_;
  std::vector<Generator> generators_;
};

}  // namespace

WorkerCommand worker_command(std::string program, const WorkerOptions& options) {
  WorkerCommand command{std::move(program), {"worker"}};
  const auto add = [&](std::string name, std::string value) {
    command.arguments.push_back(std::move(name));
    command.arguments.push_back(std::move(value));
  };
  for (const std::string& generator : options.generators) add("--generator", generator);
  for (const Subject& subject : options.check.subjects) add("--kernel", name_of(subject));
  for (const Property property : options.check.properties) {
    add("--property", std::string(id_of(property)));
  }
  add("--tolerance", report::shortest(options.check.tolerance));
  if (options.check.share_tolerance) {
    add("--share-tolerance", report::shortest(*options.check.share_tolerance));
  }
  if (options.check.width) add("--width", report::shortest(*options.check.width));
  if (options.check.strict) command.arguments.emplace_back("--strict");
  if (options.in_turn) command.arguments.emplace_back("--in-turn");
  add("--fragments", std::to_string(options.check.max_fragments));
  add("--seconds", report::shortest(options.limits.seconds));
  add("--megabytes", std::to_string(options.limits.megabytes));
  return command;
}

std::string failure_text(const Failure& failure) {
  report::StringSink sink;
  {
    JsonWriter json(sink);
    write_failure(json, failure);
  }
  return one_line(sink.text());
}

Expected<Failure> parse_failure(std::string_view text) {
  const auto document = parse_json_object(text, {});
  if (!document) return tl::unexpected(document.error());
  JsonMembers members(*document, {}, {}, kAnswerWriter);
  Failure failure = read_failure(members);
  if (members.error()) return tl::unexpected(*members.error());
  return failure;
}

std::string answer_text(const WorkerAnswer& answer) {
  report::StringSink sink;
  {
    JsonWriter json(sink);
    json.begin_object(JsonLayout::kInline);
    json.member("digest", answer.report.digest);
    json.member("polygons", answer.report.polygons);
    json.member("lights", answer.report.lights);
    json.member("area_lights", answer.report.area_lights);
    json.member("fragments", answer.report.fragments);
    json.member("claims_checked", answer.report.claims_checked);
    json.member("recipe", answer.recipe);
    json.key("kinds");
    json.begin_array(JsonLayout::kInline);
    for (const std::uint16_t kind : answer.kinds) json.value(kind);
    json.end_array();
    json.key("subjects");
    json.begin_array(JsonLayout::kInline);
    for (const std::string& subject : answer.report.subjects) json.value(subject);
    json.end_array();
    json.key("failures");
    json.begin_array(JsonLayout::kInline);
    for (const Failure& failure : answer.report.failures) write_failure(json, failure);
    json.end_array();
    json.end_object();
  }
  return one_line(sink.text());
}

Expected<WorkerAnswer> parse_answer(std::string_view text) {
  const auto document = parse_json_object(text, {});
  if (!document) return tl::unexpected(document.error());
  WorkerAnswer answer;
  CaseReport& report = answer.report;
  JsonMembers members(*document, {}, {}, kAnswerWriter);
  members.read("digest", report.digest);
  members.read("polygons", report.polygons);
  members.read("lights", report.lights);
  members.read("area_lights", report.area_lights);
  members.read("fragments", report.fragments);
  members.read("claims_checked", report.claims_checked);
  members.read("recipe", answer.recipe);
  members.read("kinds", answer.kinds);
  members.read("subjects", report.subjects);
  for (JsonMembers& failure : members.objects("failures")) {
    report.failures.push_back(read_failure(failure));
    if (failure.error()) return tl::unexpected(*failure.error());
  }
  if (members.error()) return tl::unexpected(*members.error());
  return answer;
}

Expected<void> run_worker(const WorkerOptions& options) {
  std::vector<Generator> generators;
  for (const std::string& name : options.generators) {
    Expected<Generator> generator = Generator::parse(name);
    if (!generator) return tl::unexpected(generator.error());
    generators.push_back(std::move(*generator));
  }
  confine(options.limits);
  Worker(options, std::move(generators)).serve();
  return {};
}

}  // namespace gnomon::fuzz
