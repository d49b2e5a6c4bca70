// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/certify_table.h"

#include <algorithm>
#include <memory>
#include <unordered_map>
#include <utility>

#include "cli/common/exit_status.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "comparison/engine_tables/engine_table.h"
#include "comparison/engine_tables/table_columns.h"
#include "comparison/engine_tables/table_judge.h"
#include "comparison/engine_tables/table_verdict.h"
#include "comparison/engine_tables/true_share.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/digest.h"
#include "report/shares/gross_shares.h"
#include "report/shares/share_columns.h"
#include "report/year/year_rows.h"

namespace gnomon::cli {

namespace {

using comparison::EngineTable;
using comparison::TableForm;
using comparison::TableVerdict;

/// What rows of truth hold: the sides, then walls with their windows.
struct TrueColumns {
  TrueColumns(const Scene& scene, const PreparedScene& prepared)
      : sides(scene, prepared), gross(scene, prepared, sides) {}

  report::ShareColumns sides;
  report::GrossShares gross;
};

/// A table that is being judged.
class TableRun {
 public:
  TableRun(const TableCommandOptions& options, const TableOptionRules& rules, std::string file)
      : options_(options), rules_(rules), file_(std::move(file)), progress_("reading " + file_) {}

  /// Errors: those of reading, and of a kernel; an interruption is none once rows were judged.
  Expected<TableVerdict> run();

 private:
  Expected<void> read(Scene& scene);
  Expected<std::vector<std::uint32_t>> choose(const EngineTable& head, const Scene& scene);
  Expected<void> find_suns();
  Expected<void> suns_of_place();
  void suns_of_table();
  void find_shares(const TrueColumns& truth, const Scene& scene);
  Expected<void> judge(const PreparedScene& prepared, const TrueColumns& truth,
                       comparison::TableJudge& judge);
  TableVerdict verdict_of(const LoadedScene& loaded, const comparison::TableJudge& judge);
  void explain(const LoadedScene& loaded, TableVerdict& verdict);
  std::string time_text(std::size_t row) const;

  const TableCommandOptions& options_;
  const TableOptionRules& rules_;
  std::string file_;
  ProgressBar progress_;
  comparison::TableColumns columns_;
  std::vector<std::size_t> shares_;  // of a row of truth, by matched column
  EngineTable table_;
  std::optional<suns::YearOptions> asked_;  // none: the table has its suns
  suns::Minutes zone_{0};
  std::vector<suns::SunTime> times_;  // of each row
  std::unique_ptr<report::SunsOfRows> suns_;
  std::string geometry_digest_;
};

Expected<std::vector<std::uint32_t>> TableRun::choose(const EngineTable& head, const Scene& scene) {
  columns_ = comparison::match_columns(head.names, scene);
  if (columns_.matched.empty()) {
    return fail(ErrorCode::kUsage,
                head.file + ": none of its " + std::to_string(head.names.size()) +
                    " columns, such as '" + head.names.front() + "', names a surface of the scene",
                scene.polygons.empty() ? "a scene with polygons"
                                       : "names such as '" + scene.polygons.front().id + "'");
  }
  std::vector<std::uint32_t> kept;
  for (const comparison::TableColumn& column : columns_.matched) kept.push_back(column.column);
  return kept;
}

Expected<void> TableRun::read(Scene& scene) {
  comparison::TableReading reading;
  reading.year = std::chrono::year(options_.suns.year);
  reading.choose = [&](const EngineTable& head) -> Expected<std::vector<std::uint32_t>> {
    if (head.form == TableForm::kSuns) {
      if (auto checked = rules_.check_own_suns(file_); !checked) {
        return tl::unexpected(std::move(checked.error()));
      }
    } else {
      // What is wrong with it is told before a long table is read.
      auto asked = suns::suns_asked(options_.suns, scene);
      if (!asked) return tl::unexpected(std::move(asked.error()));
      asked_ = *std::move(asked);
    }
    return choose(head, scene);
  };
  reading.progress = [&](double done) {
    progress_.show(done);
    return !interrupted();
  };
  auto read = comparison::read_engine_table(file_, reading);
  if (!read) return tl::unexpected(std::move(read.error()));
  table_ = *std::move(read);
  geometry_digest_ = geometry_digest(scene);
  if (auto found = find_suns(); !found) return found;
  std::vector<std::size_t> rows(table_.rows.size());
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = row;
  suns_ = std::make_unique<report::SunsOfRows>(times_, std::move(rows), zone_);
  scene.lights = suns_->lights;
  return {};
}

Expected<void> TableRun::find_suns() {
  if (asked_) return suns_of_place();
  suns_of_table();
  return {};
}

void TableRun::suns_of_table() {
  zone_ = table_.zone;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    suns::SunTime sun;
    sun.end = sun.at = table_.rows[row].time;
    sun.direction = table_.rows[row].direction;
    // A sun this low is up or not by the model that the table was made with.
    constexpr std::int32_t kNight = 10;
    bool all_dark = true;
    if (sun.direction[2] > 0 && sun.direction[2] < kNight) {
      for (std::size_t i = 0; i < table_.kept.size(); ++i) {
        all_dark = all_dark && table_.value(row, i).value == 0;
      }
    }
    sun.is_day = sun.direction[2] >= kNight || (sun.direction[2] > 0 && !all_dark);
    times_.push_back(sun);
  }
}

Expected<void> TableRun::suns_of_place() {
  constexpr std::chrono::seconds kInStep{1};
  asked_->first = suns::day_of(table_.rows.front().time - kInStep);
  asked_->last = suns::day_of(table_.rows.back().time - kInStep);
  asked_->step = std::chrono::duration_cast<suns::Minutes>(table_.step);
  if (!rules_.sun_at_given()) {
    // As EnergyPlus has it: half an hour before the end of an hour, else at the end of a step.
    asked_->sun_at =
        asked_->step == std::chrono::hours(1) ? suns::SunAt::kMiddle : suns::SunAt::kEnd;
  }
  auto all = suns::year_of_suns(*asked_);
  if (!all) {
    all.error().what = table_.file + ": " + all.error().what;
    return tl::unexpected(std::move(all.error()));
  }
  for (const comparison::TableRow& row : table_.rows) {
    const auto since = row.time - suns::CivilTime(asked_->first);
    if (since % asked_->step != std::chrono::seconds(0)) {
      return fail(ErrorCode::kFormat,
                  table_.file + ": '" + suns::end_of_step_text(row.time) + "' ends no step of " +
                      std::to_string(asked_->step.count()) + " minutes, the least between two rows",
                  "times in equal steps from midnight");
    }
    times_.push_back((*all)[static_cast<std::size_t>(since / asked_->step) - 1]);
  }
  zone_ = asked_->place.zone;
  return {};
}

/// And leaves out untold sides that have no area.
void TableRun::find_shares(const TrueColumns& truth, const Scene& scene) {
  std::unordered_map<std::string, std::size_t> known;
  for (std::string& name : truth.sides.names()) known.emplace(std::move(name), known.size());
  for (std::string& name : truth.gross.names()) known.emplace(std::move(name), known.size());
  for (const comparison::TableColumn& column : columns_.matched) {
    const auto place = known.find(comparison::side_name(scene, column));
    shares_.push_back(place == known.end() ? comparison::TableJudge::kNoShare : place->second);
  }
  std::erase_if(columns_.untold, [&](const comparison::TableSide& side) {
    return !known.contains(comparison::side_name(scene, side));
  });
}

/// Errors: those of the kernel; kInterrupted.
Expected<void> TableRun::judge(const PreparedScene& prepared, const TrueColumns& truth,
                               comparison::TableJudge& judge) {
  std::vector<double> shares(truth.sides.size() + truth.gross.size());
  report::YearRows rows(*suns_, truth.sides, [&](std::size_t row, std::span<const double> lit) {
    std::ranges::copy(lit, shares.begin());
    truth.gross.read(lit, std::span(shares).subspan(lit.size()));
    judge.add(row, shares, times_[row].is_day);
    return !interrupted();
  });
  progress_.set_label("judging " + file_);
  if (!rows.advance()) return fail(ErrorCode::kInterrupted, "interrupted");
  if (suns_->lights.empty()) return {};
  ShadowOptions shadows;
  shadows.tuning.jobs = options_.scene.jobs;
  shadows.control.interrupted = &interrupted();
  shadows.control.light_done = [&](LightResult&& light) {
    const bool goes_on = rows.add(light);
    progress_.show(static_cast<double>(rows.done()) / static_cast<double>(times_.size()));
    return goes_on;
  };
  auto computed = compute_shadows(prepared, shadows);
  if (!computed) return tl::unexpected(std::move(computed.error()));
  return {};
}

std::string TableRun::time_text(std::size_t row) const {
  const suns::CivilTime time = table_.rows[row].time;
  return table_.form == TableForm::kEnergyPlus ? suns::end_of_step_text(time)
                                               : suns::iso_text(time, zone_);
}

TableVerdict TableRun::verdict_of(const LoadedScene& loaded, const comparison::TableJudge& judge) {
  TableVerdict verdict;
  verdict.file = table_.file;
  verdict.geometry_digest = geometry_digest_;
  verdict.scene = loaded.scene.name.empty() ? loaded.scene.file : loaded.scene.name;
  verdict.polygons = loaded.scene.polygons.size();
  verdict.parts = loaded.prepared.parts.size();
  verdict.numbers = loaded.scene.numbers;
  verdict.form = table_.form;
  verdict.first = time_text(0);
  verdict.last = time_text(table_.rows.size() - 1);
  verdict.rows = table_.rows.size();
  verdict.judged_rows = judge.rows();
  verdict.columns = table_.names.size();
  verdict.step = std::chrono::duration_cast<suns::Minutes>(table_.step);
  verdict.suns = asked_;
  verdict.suns_up = static_cast<std::size_t>(std::ranges::count_if(times_, &suns::SunTime::is_day));
  verdict.tolerance = options_.tolerance;
  verdict.decimals = table_.values.digits().most_decimals();
  verdict.doubles = judge.are_doubles();
  verdict.values = judge.values();
  verdict.wrong = judge.wrong();
  verdict.interrupted = judge.rows() < table_.rows.size();
  for (const comparison::TableSide& side : columns_.untold) {
    verdict.untold.push_back(comparison::side_name(loaded.scene, side));
  }
  for (const std::uint32_t column : columns_.unknown) {
    verdict.unknown.push_back(table_.names[column]);
  }
  std::vector<std::size_t> surface_of(columns_.matched.size());
  for (std::size_t i = 0; i < columns_.matched.size(); ++i) {
    const comparison::TableColumn& column = columns_.matched[i];
    surface_of[i] = verdict.surfaces.size();
    if (shares_[i] == comparison::TableJudge::kNoShare) {
      verdict.unknown.push_back(table_.names[column.column]);
      continue;
    }
    verdict.surfaces.push_back({comparison::side_name(loaded.scene, column),
                                loaded.scene.polygons[column.polygon].id, column.side, column.gross,
                                judge.wrong_of_columns()[i], judge.sums()[i]});
  }
  for (const comparison::WrongValue& value : judge.worst()) {
    comparison::TableWitness witness;
    const suns::SunTime& sun = times_[value.row];
    witness.surface = surface_of[value.column];
    witness.time = time_text(value.row);
    witness.sun_time = suns::iso_text(sun.at, zone_);
    witness.sun = sun.direction;
    witness.is_day = sun.is_day;
    witness.value = value;
    verdict.worst.push_back(std::move(witness));
  }
  return verdict;
}

/// Asks the oracle for the worst values, and whether it agrees with the kernel.
void TableRun::explain(const LoadedScene& loaded, TableVerdict& verdict) {
  const oracle::ExactAnswer answer(loaded.scene, loaded.prepared);
  progress_.set_label("explaining " + file_);
  for (comparison::TableWitness& witness : verdict.worst) {
    if (interrupted()) return;
    const comparison::TableColumn& column = columns_.matched[witness.value.column];
    if (!witness.is_day || column.gross) continue;
    witness.truth = comparison::true_share(answer, suns_->light[witness.value.row], column.polygon,
                                           column.side);
    // The kernel's shares are within 1e-14; far more than that is a fault of one of the two.
    constexpr double kRounding = 1e-12;
    verdict.oracle_fault = verdict.oracle_fault ||
                           witness.value.truth < witness.truth->lit.lower - kRounding ||
                           witness.value.truth > witness.truth->lit.upper + kRounding;
  }
}

Expected<TableVerdict> TableRun::run() {
  SceneOptions as_year_has_it = options_.scene;
  as_year_has_it.keep_axes = true;
  auto loaded = load_scene_under(as_year_has_it, [&](Scene& scene) { return read(scene); });
  if (!loaded) return tl::unexpected(std::move(loaded.error()));
  warn_of_intent(*loaded);
  const TrueColumns truth(loaded->scene, loaded->prepared);
  find_shares(truth, loaded->scene);
  comparison::TableJudge judge_of_rows(table_, shares_, options_.tolerance);
  auto judged = judge(loaded->prepared, truth, judge_of_rows);
  if (!judged && judged.error().code != ErrorCode::kInterrupted) {
    return tl::unexpected(std::move(judged.error()));
  }
  TableVerdict verdict = verdict_of(*loaded, judge_of_rows);
  if (!verdict.interrupted) explain(*loaded, verdict);
  progress_.clear();
  return verdict;
}

int status_of_tables(const std::vector<TableVerdict>& verdicts) {
  if (std::ranges::any_of(verdicts, &TableVerdict::interrupted)) return kInterruptedStatus;
  if (std::ranges::any_of(verdicts, &TableVerdict::oracle_fault)) return kDisagree;
  return std::ranges::any_of(verdicts, &TableVerdict::failed) ? kFailed : kDone;
}

Expected<void> report_tables(const ReportOptions& options,
                             const std::vector<TableVerdict>& verdicts, const std::string& text) {
  using report::JUnitOutcome;
  Report report;
  report.command = "certify";
  report.scene = verdicts.front().scene;
  for (const TableVerdict& verdict : verdicts) {
    for (const comparison::JudgedSurface& surface : verdict.surfaces) {
      const std::uint64_t wrong = surface.wrong.all();
      report.cases.push_back({"certify." + verdict.file,
                              surface.name,
                              wrong > 0 ? JUnitOutcome::kFailed : JUnitOutcome::kPassed,
                              std::to_string(wrong) + " values are wrong",
                              {}});
    }
    if (verdict.oracle_fault) {
      report.cases.push_back({"certify." + verdict.file,
                              "oracle",
                              JUnitOutcome::kFailed,
                              "kernel and oracle differ: a bug of ours",
                              {}});
    }
  }
  const auto json = [&](report::TextSink& sink) {
    comparison::write_table_verdicts_json(sink, verdicts);
  };
  report.files = {{"table.txt", [&](report::TextSink& sink) { sink.write(text); }},
                  {"verdict.json", json},
                  {"surfaces.csv", [&](report::TextSink& sink) {
                     sink.write(comparison::table_verdicts_csv(verdicts));
                   }}};
  report.documents = {{"tables", json}};
  return write_report(options, report);
}

}  // namespace

int run_certify_tables(const TableCommandOptions& options, const TableOptionRules& rules) {
  if (auto checked = suns::check_asked_suns(options.suns); !checked) {
    return report_error(checked.error());
  }
  const ThreadLimit threads(options.scene.jobs);
  std::vector<TableVerdict> verdicts;
  for (const std::string& file : options.tables) {
    if (!verdicts.empty() && verdicts.back().interrupted) break;
    auto verdict = TableRun(options, rules, file).run();
    if (!verdict) return report_error(verdict.error());
    verdicts.push_back(*std::move(verdict));
  }
  std::string text;
  for (const TableVerdict& verdict : verdicts) {
    text += (text.empty() ? "" : "\n") + comparison::table_verdict_text(verdict);
  }
  if (options.json != "-") {
    if (auto done = write_output({}, text); !done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    comparison::write_table_verdicts_json(*output, verdicts);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  if (options.report.asked()) {
    if (auto done = report_tables(options.report, verdicts, text); !done) {
      return report_error(done.error());
    }
  }
  return status_of_tables(verdicts);
}

}  // namespace gnomon::cli
