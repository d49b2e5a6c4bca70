// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "fuzz/corpus/corpus_judge.h"
#include "report/json/json_writer.h"
#include "report/text/csv_field.h"
#include "report/text/table.h"

namespace gnomon::fuzz {

namespace {

constexpr std::size_t kMostReasons = 20;

/// What did not pass, of one cell of the matrix.
struct Tally {
  std::array<std::uint64_t, 6> scored{}, recorded{};  // by outcome

  void add(const Fixture& fixture, bool exact, Outcome outcome) {
    const bool is_scored = exact || fixture.expectation != Expectation::kInform;
    ++(is_scored ? scored : recorded)[static_cast<std::size_t>(outcome)];
  }
  static std::uint64_t bad(const std::array<std::uint64_t, 6>& counts) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto outcome = static_cast<Outcome>(i);
      if (outcome != Outcome::kPass && outcome != Outcome::kNotAsked) sum += counts[i];
    }
    return sum;
  }
  std::uint64_t of(Outcome outcome) const {
    return scored[static_cast<std::size_t>(outcome)] + recorded[static_cast<std::size_t>(outcome)];
  }
  /// "." all passed; else how many did not, with "!" if some of them must.
  std::string text() const {
    const std::uint64_t failed = bad(scored), differed = bad(recorded);
    if (failed + differed == 0) return ".";
    return std::to_string(failed + differed) + (failed > 0 ? "!" : "");
  }
};

/// A program's command line, shortened in the middle: its end tells more than its path.
std::string shown_name(const Subject& subject, const std::string& name) {
  constexpr std::size_t kMost = 40, kStart = 12;
  if (!subject.foreign() || subject.command.size() <= kMost) {
    return subject.foreign() ? subject.command : name;
  }
  return subject.command.substr(0, kStart) + "..." +
         subject.command.substr(subject.command.size() - (kMost - kStart - 3));
}

std::string plural(std::uint64_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// A row for each scene: a letter for each subject, a capital where it is scored.
std::string letter(const Fixture& fixture, bool exact, Outcome outcome) {
  constexpr std::string_view kRecorded = ".drct-", kScored = ".DRCT-";
  const bool scored = exact || fixture.expectation != Expectation::kInform;
  return std::string(1, (scored ? kScored : kRecorded)[static_cast<std::size_t>(outcome)]);
}

std::vector<std::string> header(const CorpusReport& report, std::string_view first) {
  std::vector<std::string> titles{std::string(first)};
  for (std::size_t s = 0; s < report.subjects.size(); ++s) {
    titles.push_back(std::to_string(s + 1));
  }
  return titles;
}

/// Columns are as wide as what they hold.
std::string lines_of(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 2);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t k = 1; k < row.size(); ++k) line += fmt::format(" {:>{}}", row[k], widths[k]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

std::string matrix_by_kind(const CorpusReport& report) {
  std::map<std::string, std::vector<Tally>> kinds;
  std::map<std::string, std::uint64_t> scenes;
  std::vector<Tally> all(report.subjects.size());
  for (std::size_t i = 0; i < report.judgements.size(); ++i) {
    const Fixture& fixture = (*report.fixtures)[i];
    std::vector<Tally>& row = kinds.try_emplace(fixture.kind, all.size()).first->second;
    ++scenes[fixture.kind];
    for (std::size_t s = 0; s < report.subjects.size(); ++s) {
      const bool exact = report.subjects[s].exact();
      row[s].add(fixture, exact, report.judgements[i][s].outcome);
      all[s].add(fixture, exact, report.judgements[i][s].outcome);
    }
  }
  std::vector<std::vector<std::string>> rows{header(report, "kind")};
  rows[0].insert(rows[0].begin() + 1, "files");
  for (const auto& [kind, tallies] : kinds) {
    std::vector<std::string> row{kind, std::to_string(scenes[kind])};
    for (const Tally& tally : tallies) row.push_back(tally.text());
    rows.push_back(std::move(row));
  }
  std::vector<std::string> row{"all", std::to_string(report.judgements.size())};
  for (const Tally& tally : all) row.push_back(tally.text());
  rows.push_back(std::move(row));
  return lines_of(rows) +
         "\n.  all pass;  2  so many differ where that is recorded and not scored;  2!  some of "
         "them must pass\n";
}

std::string matrix_by_scene(const CorpusReport& report) {
  std::vector<std::vector<std::string>> rows{header(report, "scene")};
  for (std::size_t i = 0; i < report.judgements.size(); ++i) {
    const Fixture& fixture = (*report.fixtures)[i];
    std::vector<std::string> row{fixture.name};
    for (std::size_t s = 0; s < report.subjects.size(); ++s) {
      row.push_back(letter(fixture, report.subjects[s].exact(), report.judgements[i][s].outcome));
    }
    rows.push_back(std::move(row));
  }
  return lines_of(rows) +
         "\n.  pass;  d differ  r rejected  c crash  t timeout  - not asked;  a capital: scored\n";
}

std::string totals(const CorpusReport& report) {
  std::vector<std::vector<std::string>> rows{
      {"", "subject", "pass", "differ", "rejected", "crash", "timeout", "failures"}};
  for (std::size_t s = 0; s < report.subjects.size(); ++s) {
    Tally tally;
    for (std::size_t i = 0; i < report.judgements.size(); ++i) {
      tally.add((*report.fixtures)[i], report.subjects[s].exact(), report.judgements[i][s].outcome);
    }
    std::vector<std::string> row{std::to_string(s + 1),
                                 shown_name(report.subjects[s], report.names[s])};
    for (const Outcome outcome : {Outcome::kPass, Outcome::kDiffer, Outcome::kRejected,
                                  Outcome::kCrash, Outcome::kTimeout}) {
      row.push_back(std::to_string(tally.of(outcome)));
    }
    row.push_back(std::to_string(Tally::bad(tally.scored)));
    rows.push_back(std::move(row));
  }
  // The names are text: to the left.
  std::size_t width = 0;
  for (const auto& row : rows) width = std::max(width, row[1].size());
  for (auto& row : rows) {
    row[0] = fmt::format("{:>2}  {:<{}}", row[0], row[1], width);
    row.erase(row.begin() + 1);
  }
  return lines_of(rows);
}

/// Foreign programs: everything that did not pass, for whoever works on one. Our own rounded
/// kernels: what must pass.
std::string reasons(const CorpusReport& report) {
  std::string text;
  std::size_t told = 0, more = 0;
  const auto tell = [&](const Fixture& fixture, const std::string& who, const std::string& what) {
    if (told == kMostReasons) {
      ++more;
      return;
    }
    ++told;
    text += report::wrapped(fmt::format("{}: {}: {}", fixture.name, who, what),
                            report::TextTable::kWidth, 0, 2);
    text += report::wrapped("(" + fixture.shows + ")", report::TextTable::kWidth, 2, 2);
  };
  for (std::size_t i = 0; i < report.judgements.size(); ++i) {
    const Fixture& fixture = (*report.fixtures)[i];
    if (!report.oracle_findings[i].empty()) tell(fixture, "oracle", report.oracle_findings[i]);
    for (std::size_t s = 0; s < report.subjects.size(); ++s) {
      const Judgement& own = report.judgements[i][s];
      if (own.outcome == Outcome::kPass || own.outcome == Outcome::kNotAsked) continue;
      const Subject& subject = report.subjects[s];
      const bool scored = subject.exact() || fixture.expectation != Expectation::kInform;
      if (!scored && !subject.foreign()) continue;
      std::string outcome(name_of(own.outcome));
      if (!scored) outcome += ", not scored";
      tell(fixture, shown_name(subject, report.names[s]), fmt::format("{}: {}", outcome, own.why));
    }
  }
  if (more > 0) text += fmt::format("... and {} more: see --json\n", more);
  return text;
}

std::string_view expectation_name(Expectation expectation) {
  switch (expectation) {
    case Expectation::kAgree:
      return "agree";
    case Expectation::kInform:
      return "inform";
    case Expectation::kReject:
      return "reject";
  }
  return "";
}

}  // namespace

std::string corpus_text(const CorpusReport& report, bool by_scene) {
  std::array<std::uint64_t, 3> counts{};
  for (const Fixture& fixture : *report.fixtures) {
    ++counts[static_cast<std::size_t>(fixture.expectation)];
  }
  std::string text = fmt::format(
      "{}: {} must pass, {} must be rejected, {} recorded and not scored; tolerance {:g}, of the "
      "kernel float {:g}\n\n",
      plural(report.fixtures->size(), "file"), counts[0], counts[2], counts[1], report.tolerance,
      std::max(report.tolerance, kFloatTolerance));
  text += by_scene ? matrix_by_scene(report) : matrix_by_kind(report);
  text += '\n' + totals(report);
  const std::string told = reasons(report);
  if (!told.empty()) text += '\n' + told;
  return text;
}

std::string corpus_csv(const CorpusReport& report) {
  std::string text;
  report::append_csv_line(text, {"file", "kind", "expected", "subject", "outcome", "why"});
  for (std::size_t i = 0; i < report.judgements.size(); ++i) {
    const Fixture& fixture = (*report.fixtures)[i];
    for (std::size_t s = 0; s < report.subjects.size(); ++s) {
      const Judgement& judgement = report.judgements[i][s];
      report::append_csv_line(
          text, {fixture.name, fixture.kind, std::string(expectation_name(fixture.expectation)),
                 report.names[s], std::string(name_of(judgement.outcome)), judgement.why});
    }
  }
  return text;
}

void write_corpus_json(report::TextSink& sink, const CorpusReport& report) {
  report::JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-corpus-report");
  json.member("version", 1);
  json.member("tolerance", report.tolerance);
  json.key("subjects");
  json.begin_array();
  for (std::size_t s = 0; s < report.subjects.size(); ++s) {
    Tally tally;
    for (std::size_t i = 0; i < report.judgements.size(); ++i) {
      tally.add((*report.fixtures)[i], report.subjects[s].exact(), report.judgements[i][s].outcome);
    }
    json.begin_object(report::JsonLayout::kInline);
    json.member("name", report.names[s]);
    json.member("exact", report.subjects[s].exact());
    for (std::size_t k = 0; k < tally.scored.size(); ++k) {
      const auto outcome = static_cast<Outcome>(k);
      std::string key(name_of(outcome));
      std::ranges::replace(key, ' ', '_');
      json.member(key, tally.of(outcome));
    }
    json.member("failures", Tally::bad(tally.scored));
    json.end_object();
  }
  json.end_array();
  json.key("files");
  json.begin_array();
  for (std::size_t i = 0; i < report.judgements.size(); ++i) {
    const Fixture& fixture = (*report.fixtures)[i];
    json.begin_object();
    json.member("name", fixture.name);
    json.member("kind", fixture.kind);
    json.member("expected", expectation_name(fixture.expectation));
    if (!report.oracle_findings[i].empty()) json.member("oracle", report.oracle_findings[i]);
    json.key("outcomes");
    json.begin_object(report::JsonLayout::kInline);
    for (std::size_t s = 0; s < report.subjects.size(); ++s) {
      json.member(report.names[s], name_of(report.judgements[i][s].outcome));
    }
    json.end_object();
    json.key("reasons");
    json.begin_object();
    for (std::size_t s = 0; s < report.subjects.size(); ++s) {
      const Judgement& own = report.judgements[i][s];
      if (!own.why.empty()) json.member(report.names[s], own.why);
    }
    json.end_object();
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.finish();
}

}  // namespace gnomon::fuzz
