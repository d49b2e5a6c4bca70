// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/corpus_process.h"

#include <fmt/format.h>

#include <optional>

#include "fuzz/process/address_space.h"
#include "fuzz/process/command.h"
#include "scene/json/json_members.h"

namespace gnomon::fuzz {

namespace {

std::optional<Outcome> outcome_by_name(const std::string& name) {
  for (const Outcome outcome : {Outcome::kPass, Outcome::kDiffer, Outcome::kRejected,
                                Outcome::kCrash, Outcome::kTimeout, Outcome::kNotAsked}) {
    if (name_of(outcome) == name) return outcome;
  }
  return std::nullopt;
}

/// Nothing if that is no report of one file.
std::optional<ProcessVerdict> parse_report(const std::string& text,
                                           const std::vector<std::string>& names) {
  const auto document = parse_json_object(text, {});
  if (!document) return std::nullopt;
  JsonMembers report(*document, {}, {}, "a report of `gnomon certify --corpus`");
  std::vector<JsonMembers> files = report.objects("files");
  if (files.size() != 1) return std::nullopt;
  JsonMembers& file = files.front();
  JsonMembers outcomes = file.object("outcomes");
  JsonMembers reasons = file.object_if_there("reasons");
  ProcessVerdict verdict;
  file.read_if_there("oracle", verdict.oracle);
  for (const std::string& name : names) {
    std::string word;
    outcomes.read(name.c_str(), word);
    const auto outcome = outcome_by_name(word);
    if (!outcome) return std::nullopt;
    Judgement& judgement = verdict.judgements.emplace_back();
    judgement.outcome = *outcome;
    reasons.read_if_there(name.c_str(), judgement.why);
  }
  return verdict;
}

Judgement failed(const CommandResult& result) {
  const bool limit = result.end == CommandEnd::kTimeout || result.end == CommandEnd::kTooLong;
  return {limit ? Outcome::kTimeout : Outcome::kCrash, how_it_ended(result)};
}

}  // namespace

ProcessVerdict judge_in_process(const Fixture& fixture, const std::vector<std::string>& names,
                                const CorpusOptions& options) {
  CommandOptions limits;
  limits.arguments = {options.program,
                      "certify",
                      "--corpus",
                      fixture.file.string(),
                      "--in-process",
                      "--jobs",
                      "1",
                      "--tolerance",
                      fmt::format("{}", options.tolerance),
                      "--json",
                      "-"};
  for (const std::string& name : names) {
    limits.arguments.insert(limits.arguments.end(), {"--kernel", name});
  }
  limits.seconds = options.seconds * static_cast<double>(names.size());
  limits.megabytes = options.megabytes == 0 ? 0 : options.megabytes + (address_space_taken() >> 20);
  limits.interrupted = options.interrupted;
  const auto result = run_command("", limits);  // the program is the first argument
  if (!result)
    return {std::vector(names.size(), Judgement{Outcome::kCrash, result.error().what}), {}};
  if (result->end == CommandEnd::kExited) {
    if (auto verdict = parse_report(result->out, names)) return *verdict;
  }
  if (names.size() == 1) return {{failed(*result)}, {}};
  ProcessVerdict all;
  for (const std::string& name : names) {
    ProcessVerdict one = judge_in_process(fixture, {name}, options);
    all.judgements.push_back(std::move(one.judgements.front()));
    if (all.oracle.empty()) all.oracle = std::move(one.oracle);
  }
  return all;
}

}  // namespace gnomon::fuzz
