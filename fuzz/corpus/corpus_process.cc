// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/corpus_process.h"

#include <fmt/format.h>
#include <rapidjson/document.h>

#include <optional>

#include "fuzz/process/address_space.h"
#include "fuzz/process/command.h"

namespace gnomon::fuzz {

namespace {

using Json = rapidjson::Value;

std::string text_of(const Json& object, const char* key) {
  const auto place = object.FindMember(key);
  if (place == object.MemberEnd() || !place->value.IsString()) return {};
  return {place->value.GetString(), place->value.GetStringLength()};
}

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
  rapidjson::Document document;
  document.Parse<rapidjson::kParseIterativeFlag>(text.data(), text.size());
  if (document.HasParseError() || !document.IsObject() || !document.HasMember("files")) {
    return std::nullopt;
  }
  const Json& files = document["files"];
  if (!files.IsArray() || files.Size() != 1 || !files[0].IsObject()) return std::nullopt;
  const Json& file = files[0];
  if (!file.HasMember("outcomes") || !file["outcomes"].IsObject()) return std::nullopt;
  ProcessVerdict verdict;
  verdict.oracle = text_of(file, "oracle");
  for (const std::string& name : names) {
    const auto outcome = outcome_by_name(text_of(file["outcomes"], name.c_str()));
    if (!outcome) return std::nullopt;
    Judgement& judgement = verdict.judgements.emplace_back();
    judgement.outcome = *outcome;
    if (file.HasMember("reasons") && file["reasons"].IsObject()) {
      judgement.why = text_of(file["reasons"], name.c_str());
    }
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
