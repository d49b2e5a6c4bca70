// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon year: the lit shares of all sides under the suns of a year, or of any span of days.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cli/commands/year_database.h"
#include "cli/commands/year_options.h"
#include "cli/common/algorithm_choice.h"
#include "cli/common/commands.h"
#include "cli/common/exit_status.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/progress.h"
#include "cli/common/statistics.h"
#include "gnomon/kernel/kernel_choice.h"
#include "gnomon/scene/digest.h"
#include "report/page/scene_view.h"
#include "report/shares/gross_shares.h"
#include "report/text/number_text.h"
#include "report/year/row_sum.h"
#include "report/year/sun_hours.h"
#include "report/year/year_page.h"
#include "report/year/year_rows.h"
#include "report/year/year_writer.h"
#include "scene/base/output_file.h"

namespace gnomon::cli {

namespace {

/// Everything that rows are written to.
class Tables {
 public:
  /// Keeps a reference to the walls.
  static Expected<Tables> open(const YearOptions& options, const report::YearHead& head,
                               const report::GrossShares& gross);

  /// Shares of the sides; those of whole walls are added here.
  Expected<void> add(const suns::SunTime& sun, std::span<const double> sides) {
    row_.assign(sides.begin(), sides.end());
    row_.resize(sides.size() + gross_->size());
    gross_->read(sides, std::span(row_).subspan(sides.size()));
    const std::span<const double> lit = row_;
    sum_.add(sun, lit);
    if (hours_) hours_->add(sun, lit);
    if (page_) page_->add(sun, lit);
    for (const auto& writer : writers_) {
      if (auto done = writer->add(sun, lit); !done) return done;
    }
    return {};
  }
  Expected<void> finish() {
    for (const auto& writer : writers_) {
      if (auto done = writer->finish(sum_.text()); !done) return done;
    }
    if (!hours_) return {};
    if (auto written = hours_file_->write(hours_->text()); !written) return written;
    return hours_file_->commit();
  }
  std::string checksum() const { return sum_.text(); }
  /// Empty unless it was asked for.
  const std::optional<report::YearPage>& page() const { return page_; }

 private:
  std::vector<std::unique_ptr<report::YearWriter>> writers_;
  std::optional<report::SunHours> hours_;
  std::optional<OutputFile> hours_file_;
  std::optional<report::YearPage> page_;
  report::RowSum sum_;
  const report::GrossShares* gross_ = nullptr;
  std::vector<double> row_;
};

Expected<Tables> Tables::open(const YearOptions& options, const report::YearHead& head,
                              const report::GrossShares& gross) {
  Tables tables;
  tables.gross_ = &gross;
  const auto take = [&](auto writer) -> Expected<void> {
    if (!writer) return tl::unexpected(std::move(writer.error()));
    tables.writers_.push_back(*std::move(writer));
    return {};
  };
  const bool to_screen = !options.writes_tables() && options.database.empty();
  if (!options.output.empty() || to_screen) {
    const std::string file = to_screen ? "-" : options.output;
    if (auto done = take(report::open_year_table(file, head)); !done) {
      return tl::unexpected(std::move(done.error()));
    }
  }
  if (!options.shading.empty()) {
    if (auto done = take(report::open_shading_table(options.shading, head)); !done) {
      return tl::unexpected(std::move(done.error()));
    }
  }
  if (!options.hours.empty()) {
    tables.hours_.emplace(head.sides, head.suns.step);
    auto file = OutputFile::open(options.hours);
    if (!file) return tl::unexpected(std::move(file.error()));
    tables.hours_file_ = *std::move(file);
  }
  if (options.report.asked()) tables.page_.emplace(head);
  return tables;
}

/// What databases of one year have in common, a line each.
std::string identity_of(const report::YearHead& head, const Scene& scene,
                        const std::string& algorithm) {
  const suns::YearOptions& suns = head.suns;
  const auto number = [](double value) { return report::shortest(value); };
  return fmt::format(
      "geometry: {}\ntwo-sided polygons: {}\nkernel: {}\nalgorithm: {}\nlatitude: {}\nlongitude: "
      "{}\n"
      "elevation: {}\ntime zone: {}\nfirst day: {}\nlast day: {}\nstep: {}\nsun at: {}\nmodel: {}\n"
      "average days: {}\nrefraction: {}\nnorth: {}\n",
      head.geometry,
      std::ranges::count_if(scene.polygons,
                            [&](const Polygon& p) { return scene.is_two_sided(p); }),
      head.kernel, algorithm, number(suns.place.latitude), number(suns.place.longitude),
      number(suns.place.elevation), suns.place.zone.count(), suns.first.time_since_epoch().count(),
      suns.last.time_since_epoch().count(), suns.step.count(), static_cast<int>(suns.sun_at),
      suns::name_of(suns.model), suns.average_days,
      suns.refraction ? number(suns.air.pressure) + " hPa " + number(suns.air.temperature) + " C"
                      : "none",
      number(suns.north));
}

/// A year that is being computed.
class YearRun {
 public:
  YearRun(const YearOptions& options, ShadowOptions shadows, LoadedScene loaded,
          std::vector<suns::SunTime> times, report::SunsOfRows suns, report::YearHead head,
          std::optional<YearDatabase> database)
      : options_(options),
        shadows_(std::move(shadows)),
        loaded_(std::move(loaded)),
        times_(std::move(times)),
        suns_(std::move(suns)),
        columns_(loaded_.scene, loaded_.prepared),
        gross_(options.gross ? report::GrossShares(loaded_.scene, loaded_.prepared, columns_)
                             : report::GrossShares()),
        head_(std::move(head)),
        database_(std::move(database)) {
    head_.sides = columns_.names();
    for (std::string& name : gross_.names()) head_.sides.push_back(std::move(name));
  }

  Expected<void> run();

 private:
  Expected<void> compute(const report::YearRows::Take& take, std::size_t& done);
  Expected<void> compute_into_tables();
  Expected<void> compute_into_database();
  Expected<void> write_from_database();
  Expected<void> finish(Tables& tables);
  Expected<void> write_page(const report::YearPage& page) const;
  void tell(const Tables& tables) const;
  /// What has passed since the last call was for one of the phases.
  void passed(Seconds& phase) { phase += stopwatch_.lap(); }

  const YearOptions& options_;
  ShadowOptions shadows_;
  LoadedScene loaded_;
  std::vector<suns::SunTime> times_;
  report::SunsOfRows suns_;
  report::ShareColumns columns_;
  report::GrossShares gross_;
  report::YearHead head_;
  std::optional<YearDatabase> database_;
  Stopwatch stopwatch_;
  PhaseTimes phases_;
};

/// Computes the rows that are asked for. Errors: those of taking a row; kInterrupted.
Expected<void> YearRun::compute(const report::YearRows::Take& take, std::size_t& done) {
  report::YearRows rows(suns_, columns_, take);
  ProgressBar progress("year");
  const auto show = [&] {
    done = rows.done();
    progress.show(static_cast<double>(done) /
                  static_cast<double>(std::max<std::size_t>(1, suns_.rows.size())));
  };
  bool goes_on = rows.advance();
  passed(phases_.output);
  if (goes_on && !suns_.lights.empty()) {
    shadows_.lights.clear();
    for (std::uint32_t i = 0; i < suns_.lights.size(); ++i) shadows_.lights.push_back(i);
    shadows_.control.interrupted = &interrupted();
    shadows_.control.light_done = [&](LightResult&& light) {
      passed(phases_.shadows);
      goes_on = rows.add(light);
      show();
      passed(phases_.output);
      return goes_on;
    };
    auto computed = compute_shadows(loaded_.prepared, shadows_);
    passed(phases_.shadows);
    if (!computed) {
      done = rows.done();
      return tl::unexpected(std::move(computed.error()));
    }
  }
  done = rows.done();
  return {};
}

Expected<void> YearRun::compute_into_tables() {
  auto tables = Tables::open(options_, head_, gross_);
  if (!tables) return tl::unexpected(std::move(tables.error()));
  Expected<void> added;
  std::size_t done = 0;
  auto computed = compute(
      [&](std::size_t row, std::span<const double> lit) {
        added = tables->add(times_[row], lit);
        return added.has_value();
      },
      done);
  if (!added) return added;
  if (!computed && computed.error().code != ErrorCode::kInterrupted) return computed;
  if (done == 0 && !computed) return computed;
  if (auto finished = finish(*tables); !finished) return finished;
  if (done < suns_.rows.size()) {
    return fail(ErrorCode::kInterrupted,
                fmt::format("interrupted: the tables have {} of {} rows", done, suns_.rows.size()));
  }
  tell(*tables);
  return {};
}

Expected<void> YearRun::compute_into_database() {
  Expected<void> put;
  std::size_t done = 0;
  auto computed = compute(
      [&](std::size_t row, std::span<const double> lit) {
        put = database_->put(row, lit);
        return put.has_value();
      },
      done);
  if (!put) return put;
  if (auto kept = database_->flush(); !kept) return kept;
  if (computed || computed.error().code != ErrorCode::kInterrupted) return computed;
  return fail(ErrorCode::kInterrupted,
              fmt::format("interrupted: {} of {} rows were done; the same command goes on", done,
                          suns_.rows.size()));
}

Expected<void> YearRun::write_from_database() {
  auto rows = database_->rows();
  if (!rows) return tl::unexpected(std::move(rows.error()));
  if (rows->size() < times_.size()) {
    fmt::print("{}: {} of {} rows are done{}\n", options_.database, report::grouped(rows->size()),
               report::grouped(times_.size()),
               options_.writes_tables() ? "; no table is written before all are" : "");
    return {};
  }
  auto tables = Tables::open(options_, head_, gross_);
  if (!tables) return tl::unexpected(std::move(tables.error()));
  for (const std::size_t row : *rows) {
    if (interrupted()) return fail(ErrorCode::kInterrupted, "interrupted");
    auto lit = database_->get(row);
    if (!lit) return tl::unexpected(std::move(lit.error()));
    if (row >= times_.size() || lit->size() != columns_.size()) {
      return fail(ErrorCode::kFile,
                  options_.database + ": row " + std::to_string(row) + " is damaged");
    }
    if (auto added = tables->add(times_[row], *lit); !added) return added;
  }
  if (auto finished = finish(*tables); !finished) return finished;
  tell(*tables);
  return {};
}

Expected<void> YearRun::finish(Tables& tables) {
  if (auto finished = tables.finish(); !finished) return finished;
  return tables.page() ? write_page(*tables.page()) : Expected<void>();
}

Expected<void> YearRun::write_page(const report::YearPage& page) const {
  const auto json = [&](report::TextSink& sink) { page.write(sink); };
  Report report;
  report.command = "year";
  report.scene = head_.scene;
  report.cases.push_back(
      {"year." + head_.scene, report::grouped(page.rows()) + " rows", {}, {}, {}});
  report.files = {{"hours.csv", [&](report::TextSink& sink) { sink.write(page.hours_csv()); }},
                  {"year.json", json}};
  if (page.rows() < times_.size()) {
    report.notes.push_back(
        fmt::format("The run was interrupted: it has {} of {} rows.", page.rows(), times_.size()));
  }
  report.documents = {{"year", json}, {"view", [&](report::TextSink& sink) {
                                         report::write_scene_view(sink, loaded_.scene,
                                                                  loaded_.prepared, {});
                                       }}};
  return write_report(options_.report, report);
}

/// One line, so that shards and machines can be compared; not where the table itself is printed.
void YearRun::tell(const Tables& tables) const {
  const auto day = std::ranges::count_if(times_, &suns::SunTime::is_day);
  const std::string text =
      fmt::format("{} rows, {} with the sun up, of {} sides; checksum {}\n",
                  report::grouped(times_.size()), report::grouped(static_cast<std::uint64_t>(day)),
                  report::grouped(head_.sides.size()), tables.checksum());
  const bool table_on_screen =
      options_.output == "-" || (!options_.writes_tables() && options_.database.empty());
  std::fwrite(text.data(), 1, text.size(), table_on_screen ? stderr : stdout);
}

Expected<void> YearRun::run() {
  stopwatch_.lap();
  auto done = database_ ? compute_into_database() : compute_into_tables();
  if (done && database_) done = write_from_database();
  passed(phases_.output);
  if (options_.stats) {
    const std::string text = times_text(loaded_, phases_);
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
  return done;
}

Expected<std::vector<std::size_t>> rows_to_compute(const YearOptions& options, std::size_t count,
                                                   const std::optional<YearDatabase>& database) {
  auto shard = parse_year_shard(options.shard);
  if (!shard) return tl::unexpected(std::move(shard.error()));
  std::vector<std::size_t> done;
  if (database) {
    auto rows = database->rows();
    if (!rows) return rows;
    done = *std::move(rows);
  }
  std::vector<std::size_t> wanted;
  for (std::size_t row = 0; row < count && options.merge.empty(); ++row) {
    if (shard->has(row) && !std::ranges::binary_search(done, row)) wanted.push_back(row);
  }
  return wanted;
}

Expected<void> compute_year(const YearOptions& options) {
  if (auto checked = check_year_options(options); !checked) return checked;
  auto kernel = parse_kernel_choice(options.kernel);
  if (!kernel) return tl::unexpected(std::move(kernel.error()));
  auto algorithm = parse_algorithm_choice(options.algorithm);
  if (!algorithm) return tl::unexpected(std::move(algorithm.error()));

  // The scene tells the place, the place the suns, and the database which of them are missing.
  report::YearHead head;
  std::vector<suns::SunTime> times;
  std::optional<report::SunsOfRows> suns;
  std::optional<YearDatabase> database;
  auto loaded = load_scene_under(options.scene, [&](Scene& scene) -> Expected<void> {
    auto asked = suns::suns_asked(options, scene);
    if (!asked) return tl::unexpected(std::move(asked.error()));
    head.suns = *std::move(asked);
    auto found = suns::year_of_suns(head.suns);
    if (!found) return tl::unexpected(std::move(found.error()));
    times = *std::move(found);
    head.scene = scene.name;
    head.geometry = geometry_digest(scene);
    head.kernel = kernel->name();
    head.rows = times.size();
    head.digits = options.digits;
    if (!options.database.empty()) {
      const std::string identity = identity_of(head, scene, options.algorithm);
      auto opened = YearDatabase::open(options.database, identity);
      if (!opened) return tl::unexpected(std::move(opened.error()));
      database = *std::move(opened);
      for (const std::string& file : options.merge) {
        if (auto merged = database->merge(file, identity); !merged) return merged;
      }
    }
    auto rows = rows_to_compute(options, times.size(), database);
    if (!rows) return tl::unexpected(std::move(rows.error()));
    suns.emplace(times, *std::move(rows), head.suns.place.zone);
    scene.lights = suns->lights;
    return {};
  });
  if (!loaded) return tl::unexpected(std::move(loaded.error()));
  warn_of_intent(*loaded);
  ShadowOptions shadows;
  shadows.kernel.id = kernel->kernel;
  shadows.kernel.identity = kernel->identity;
  if (kernel->thin) shadows.kernel.thickness = 0;
  // Left alone, compute_shadows() takes the method that is best for shares alone.
  if (options.algorithm != kAutomaticName) algorithm->apply(shadows.method);
  shadows.tuning.jobs = options.scene.jobs;
  YearRun run(options, std::move(shadows), *std::move(loaded), std::move(times), *std::move(suns),
              std::move(head), std::move(database));
  return run.run();
}

}  // namespace

void add_year_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<YearOptions>();
  CLI::App& command = *app.add_subcommand(
      "year", "The suns of a year: the lit share of every surface, hour by hour");
  command.footer(
      "Examples:\n"
      "  gnomon year house.idf --epw phoenix.epw -o house.nc --hours house-hours.csv\n"
      "  gnomon year city.city.json --at=51.99,4.35 --tz 1 --from 06-01 --to 06-30 -o june.csv");
  add_year_options(command, *options);
  command.callback([options, &action] {
    action = [options] {
      const ThreadLimit threads(options->scene.jobs);
      const auto done = compute_year(*options);
      return done ? kDone : report_error(done.error());
    };
  });
}

}  // namespace gnomon::cli
