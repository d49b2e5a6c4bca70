// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/findings/finding_text.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "fuzz/check/failure_json.h"
#include "fuzz/shrink/shrink.h"
#include "fuzz/shrink/still_fails.h"
#include "report/certificate/certificate.h"
#include "report/json/json_writer.h"
#include "report/text/number_text.h"
#include "report/text/text_sink.h"

namespace gnomon::fuzz {

namespace {

using report::JsonLayout;
using report::JsonWriter;

constexpr std::string_view kFormatName = "gnomon-finding";
constexpr int kVersion = 1;

const Subject* subject_of(const Finding& finding) {
  for (const Subject& subject : finding.check.subjects) {
    if (name_of(subject) == finding.failure.subject) return &subject;
  }
  return nullptr;
}

void write_witness(JsonWriter& json, const oracle::Witness& witness) {
  json.begin_object(JsonLayout::kInline);
  json.member("light", witness.light);
  json.member("polygon", witness.polygon);
  json.member("side", std::string_view(name_of(witness.side)));
  json.member("kind", std::string_view(name_of(witness.kind)));
  json.key("point");
  json.begin_array(JsonLayout::kInline);
  for (const mpq_class& coordinate : witness.point) json.value(coordinate.get_str());
  json.end_array();
  json.key("nearest");
  json.begin_array(JsonLayout::kInline);
  for (const double coordinate : witness.nearest) json.value(coordinate);
  json.end_array();
  json.key("found");
  if (witness.found) {
    json.value(std::string_view(name_of(*witness.found)));
  } else {
    json.null();
  }
  json.key("true");
  if (witness.truth) {
    json.value(std::string_view(name_of(*witness.truth)));
  } else {
    json.null();
  }
  json.member("caster", witness.caster);
  json.member("width", witness.width.upper);
  json.end_object();
}

void write_size(JsonWriter& json, std::string_view key, const Scene& scene) {
  const SceneSize size = size_of(scene);
  json.key(key);
  json.begin_object(JsonLayout::kInline);
  json.member("polygons", size.polygons);
  json.member("lights", size.lights);
  json.member("vertices", size.vertices);
  json.member("bits", size.bits);
  json.member("fingerprint", fingerprint_of(scene));
  json.end_object();
}

}  // namespace

std::string short_verdict(const Failure& failure) {
  report::StringSink sink;
  {
    JsonWriter json(sink);
    json.begin_object(JsonLayout::kInline);
    json.member("fails", failure.signature());
    json.member("text", failure.text);
    json.end_object();
  }
  return sink.text();
}

std::string verdict_text(const Finding& finding, const Evidence& evidence) {
  report::StringSink sink;
  JsonWriter json(sink);
  const Failure& failure = evidence.failure;
  json.begin_object();
  json.member("format", kFormatName);
  json.member("version", kVersion);
  json.member("gnomon", GNOMON_VERSION);
  json.key("failure");
  json.begin_object();
  write_failure_members(json, failure);
  json.member("shown_again", evidence.shown_again);
  json.end_object();
  json.key("check");
  json.begin_object();
  json.key("subjects");
  json.begin_array(JsonLayout::kInline);
  for (const Subject& subject : finding.check.subjects) json.value(name_of(subject));
  json.end_array();
  json.member("tolerance", finding.check.tolerance);
  if (finding.check.share_tolerance) {
    json.member("share_tolerance", *finding.check.share_tolerance);
  }
  json.key("width");
  if (finding.check.width) {
    json.value(*finding.check.width);
  } else {
    json.null();
  }
  json.member("strict", finding.check.strict);
  json.member("seed", finding.check.seed);
  json.member("max_fragments", finding.check.max_fragments);
  json.member("command_seconds", finding.check.command_seconds);
  json.member("command_megabytes", finding.check.command_megabytes);
  json.member("seconds", finding.seconds);
  json.member("megabytes", finding.megabytes);
  json.end_object();
  json.key("origin");
  json.begin_object(JsonLayout::kInline);
  json.member("generator", finding.generator);
  json.member("recipe", finding.recipe);
  json.member("campaign_seed", finding.campaign_seed);
  json.member("case_index", finding.case_index);
  json.member("case_seed", finding.case_seed);
  json.end_object();
  json.member("locally_minimal", finding.locally_minimal);
  write_size(json, "scene", finding.scene);
  write_size(json, "original", finding.original);
  json.key("witness");
  if (evidence.witness) {
    write_witness(json, *evidence.witness);
  } else {
    json.null();
  }
  json.member("first_decision", evidence.decision);
  json.member("note", evidence.decision_note);
  json.end_object();
  json.finish();
  return sink.text();
}

std::string readme_text(const Finding& finding, const Evidence& evidence, const std::string& name) {
  const Failure& failure = evidence.failure;
  const Subject* subject = subject_of(finding);
  const PropertyInfo& property = properties()[static_cast<std::size_t>(failure.property)];
  std::string text = fmt::format("# {}: {}\n\n{}\n\n| | |\n|---|---|\n", failure.subject,
                                 failure.disagreement, failure.text);
  const auto row = [&](std::string_view key, const std::string& value) {
    text += fmt::format("| {} | {} |\n", key, value);
  };
  row("property", fmt::format("`{}`: {}", property.id, property.meaning));
  row("class", failure.disagreement);
  row("subject", fmt::format("`{}`", failure.subject));
  if (evidence.witness) {
    row("worst place", report::place_in_words(*evidence.witness));
  } else if (!failure.light.empty() || !failure.polygon.empty()) {
    row("where", fmt::format("light {}, polygon {}", failure.light, failure.polygon));
  }
  if (failure.share > 0) {
    row("wrong", fmt::format("{} of the polygon; widest region of error {} scene units",
                             report::percent(failure.share), report::rounded(failure.width)));
  }
  row("scene",
      fmt::format("[scene.json](scene.json): {}{}", size_in_words(size_of(finding.scene)),
                  finding.locally_minimal ? "; locally minimal" : "; not yet locally minimal"));
  row("found as",
      fmt::format("[original.json](original.json): {}", size_in_words(size_of(finding.original))));
  if (!finding.generator.empty()) {
    row("made by",
        fmt::format("generator `{}`, recipe `{}`; campaign seed {}, case {}, its seed {}",
                    finding.generator, finding.recipe, finding.campaign_seed, finding.case_index,
                    finding.case_seed));
  }
  row("checked with", fmt::format("gnomon {}; tolerance {}, width {}{}", GNOMON_VERSION,
                                  report::shortest(finding.check.tolerance),
                                  finding.check.width ? report::shortest(*finding.check.width)
                                                      : "1e-9 of the scene's diagonal",
                                  finding.check.strict ? ", strict" : ""));
  if (!evidence.shown_again && subject != nullptr && evidence.no_candidate.empty()) {
    text += "\nIt did not show again when this was written.\n";
  }

  text += "\n## What it says, and what is true\n\n";
  if (!evidence.candidate_svg.empty()) {
    text += fmt::format("![The answer of {}](candidate.svg)\n", failure.subject);
  } else if (!evidence.no_candidate.empty()) {
    text += fmt::format("There is no picture of its answer: {}.\n\n", evidence.no_candidate);
  }
  if (!evidence.exact_svg.empty()) text += "![The exact answer](exact.svg)\n";
  if (evidence.witness) {
    text +=
        "\nThe ring marks the worst place; what is wrong is in the signal colour where it is wide "
        "enough to be seen.\n";
  }

  text += "\n## The first decision that differs\n\n";
  if (!evidence.decision.empty()) text += evidence.decision + "\n";
  if (!evidence.decision_note.empty()) {
    text += (evidence.decision.empty() ? "" : "\n") + evidence.decision_note + "\n";
  }

  text += fmt::format("\n## Again\n\n```\ngnomon replay {}\n", name);
  if (failure.property == Property::kOracle && subject != nullptr) {
    if (subject->foreign()) {
      text += fmt::format("gnomon certify {}/scene.json --candidate {}/result.json\n", name, name);
    } else if (subject->mistake == Mistake::kNone) {
      text +=
          fmt::format("gnomon certify {}/scene.json --kernel {}{}\n", name, subject->kernel.name(),
                      subject->algorithm == MethodId::kSvbsp ? " --algorithm svbsp" : "");
    }
  }
  text += "```\n";
  if (!evidence.fixture.empty()) {
    text +=
        "\n[fixture.json](fixture.json) is the scene with the exact fractions of every polygon "
        "side, for a corpus.\n";
  } else if (!evidence.no_fixture.empty()) {
    text += fmt::format("\nThere is no fixture: {}.\n", evidence.no_fixture);
  }
  return text;
}

Expected<Finding> parse_verdict(const std::string& text, const std::string& file) {
  const auto document = parse_json_object(text, file);
  if (!document) return tl::unexpected(document.error());
  JsonMembers root(*document, file, {}, "a verdict as `gnomon fuzz` writes it");
  std::string format;
  std::uint64_t version = 0;
  root.read("format", format);
  root.read("version", version);
  if (root.error()) return tl::unexpected(*root.error());
  if (format != kFormatName || version != kVersion) {
    return fail(ErrorCode::kFormat, "not a finding of version 1",
                "\"format\": \"gnomon-finding\", \"version\": 1", {file, 0, 0, {}});
  }

  Finding finding;
  JsonMembers failure = root.object("failure");
  JsonMembers check = root.object("check");
  JsonMembers origin = root.object("origin");
  root.read("locally_minimal", finding.locally_minimal);
  finding.failure = read_failure(failure);
  std::vector<std::string> subjects;
  check.read("subjects", subjects);
  check.read("tolerance", finding.check.tolerance);
  check.read_if_there("share_tolerance", finding.check.share_tolerance);
  check.read("width", finding.check.width);
  check.read("strict", finding.check.strict);
  check.read("seed", finding.check.seed);
  check.read("max_fragments", finding.check.max_fragments);
  check.read("command_seconds", finding.check.command_seconds);
  check.read("command_megabytes", finding.check.command_megabytes);
  check.read("seconds", finding.seconds);
  check.read("megabytes", finding.megabytes);
  origin.read("generator", finding.generator);
  origin.read("recipe", finding.recipe);
  origin.read("campaign_seed", finding.campaign_seed);
  origin.read("case_index", finding.case_index);
  origin.read("case_seed", finding.case_seed);
  for (const JsonMembers* members : {&root, &failure, &check, &origin}) {
    if (members->error()) return tl::unexpected(*members->error());
  }
  finding.check.properties = {finding.failure.property};
  for (const std::string& name : subjects) {
    auto subject = parse_subject(name);
    if (!subject) return tl::unexpected(subject.error());
    finding.check.subjects.push_back(std::move(*subject));
  }
  return finding;
}

}  // namespace gnomon::fuzz
