// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/year_options.h"

#include <charconv>
#include <utility>

#include "cli/common/algorithm_choice.h"
#include "cli/common/commands.h"
#include "gnomon/kernel/kernel_choice.h"

namespace gnomon::cli {

namespace {

void add_time_options(CLI::App& command, YearOptions& options) {
  command.add_option("--from", options.from, "First day, such as 06-21 or 2026-06-21")
      ->type_name("DAY");
  command.add_option("--to", options.to, "Last day")->type_name("DAY");
  command.add_option("--step", options.step, "Minutes of a step; they divide a day")
      ->type_name("MIN")
      ->capture_default_str();
}

void add_table_options(CLI::App& command, YearOptions& options) {
  command
      .add_option("-o,--output", options.output,
                  "The table of lit shares, a row a step: .csv, .nc (netCDF) or .npy (NumPy);\n"
                  "CSV on standard output if nothing else is asked for")
      ->type_name("FILE");
  command
      .add_option("--eplus-shading", options.shading,
                  "The table that EnergyPlus imports (Schedule:File:Shading): fronts alone")
      ->type_name("FILE.csv");
  command.add_option("--hours", options.hours, "Hours of sun of every side, by month")
      ->type_name("FILE.csv");
  add_report_options(command, options.report);
  command
      .add_option("--digits", options.digits,
                  ".nc: significant digits of shares; fewer make smaller files")
      ->check(CLI::Range(1, 7))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--gross", options.gross,
                   "Beside each wall with windows or doors in its holes a column WALL#gross, the\n"
                   "share of all of it, openings included");
  command
      .add_option("--db", options.database,
                  "Keep the rows here as they are done, and go on with those that are here")
      ->type_name("FILE");
  command
      .add_option("--shard", options.shard, "Only this share of the rows, such as 0/4; needs --db")
      ->type_name("K/N");
  repeatable(command.add_option("--merge", options.merge,
                                "Add the rows of this database to --db, and compute none\n"
                                "(repeatable)"))
      ->type_name("FILE");
  command.add_flag("--stats", options.stats, "Print times and memory to standard error");
}

}  // namespace

void add_sun_options(CLI::App& command, YearOptions& options) {
  command.add_option("--at", options.at, "The place: degrees, north and east positive; with --tz")
      ->type_name("LAT,LON");
  command
      .add_option("--tz", options.zone,
                  "Its standard time: hours from UTC, such as -7, 5.5 or +05:30")
      ->type_name("H");
  command.add_option("--epw", options.weather, "The place of this weather file instead")
      ->type_name("FILE");
  command.add_option("--elevation", options.elevation, "Metres above the sea")->type_name("M");
  command
      .add_option("--north", options.north,
                  "Degrees from north, clockwise, to where the scene's y axis points; of IDF and\n"
                  "epJSON their north axis, where the building was left in its own axes")
      ->type_name("DEG");
  command
      .add_option("--sun-model", options.sun_model,
                  "Whose sun: the IAU's (ERFA), or that of EnergyPlus, by which it must be judged")
      ->check(CLI::IsMember({"erfa", "energyplus"}))
      ->type_name("erfa|energyplus")
      ->capture_default_str();
  command
      .add_option("--average-days", options.average_days,
                  "energyplus: one sun for so many days, as EnergyPlus does by default with 20")
      ->check(CLI::Range(1, 366))
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--refraction", options.refraction, "The sun as air lifts it");
  command.add_option("--pressure", options.pressure, "Hectopascals; that of the height if absent")
      ->check(not_negative())
      ->type_name("HPA");
  command.add_option("--temperature", options.temperature, "Degrees Celsius; 10 if absent")
      ->check(CLI::Range(-90.0, 60.0))
      ->type_name("C");
  command
      .add_option("--year", options.year,
                  "The year of days without one; what a weather file says of "
                  "its years does not count")
      ->check(CLI::Range(1961, 2500))
      ->type_name("Y")
      ->capture_default_str();
  command.add_option("--sun-at", options.sun_at, "Where in its step the sun is looked at")
      ->check(CLI::IsMember({"start", "middle", "end"}))
      ->type_name("start|middle|end")
      ->capture_default_str();
}

void add_year_options(CLI::App& command, YearOptions& options) {
  options.scene.keep_axes = true;  // the sun is turned instead, so that geometry stays exact
  add_scene_file_options(command, options.scene);
  add_sun_options(command, options);
  add_time_options(command, options);
  add_table_options(command, options);
  command.add_option("--kernel", options.kernel, kernel_names(", ") + ", or exact")
      ->type_name("K")
      ->capture_default_str();
  add_algorithm_option(command, options.algorithm);
}

namespace {

Expected<void> wrong(std::string what, std::string expected) {
  return fail(ErrorCode::kUsage, std::move(what), std::move(expected));
}

}  // namespace

Expected<void> check_year_options(const YearOptions& options) {
  if (auto checked = suns::check_asked_suns(options); !checked) return checked;
  if (options.database.empty() && (!options.shard.empty() || !options.merge.empty())) {
    return wrong(options.shard.empty() ? "--merge without a database"
                                       : "--shard without a database to keep its rows in",
                 "--db FILE too");
  }
  if (!options.shard.empty() && !options.merge.empty()) {
    return wrong("--merge computes no rows, and --shard some", "one of them");
  }
  return {};
}

Expected<YearShard> parse_year_shard(const std::string& text) {
  YearShard shard;
  if (text.empty()) return shard;
  const char *at = text.data(), *end = at + text.size();
  auto read = std::from_chars(at, end, shard.index);
  bool is_shard = read.ec == std::errc() && read.ptr != end && *read.ptr == '/';
  if (is_shard) {
    read = std::from_chars(read.ptr + 1, end, shard.count);
    is_shard = read.ec == std::errc() && read.ptr == end && shard.index < shard.count;
  }
  if (is_shard) return shard;
  return fail(ErrorCode::kUsage, "--shard " + text + ": no share of the rows",
              "K/N with K from 0 to N-1, such as 0/4");
}

}  // namespace gnomon::cli
