// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict on an engine's table, for people and for programs.
#ifndef GNOMON_COMPARISON_ENGINE_TABLES_TABLE_VERDICT_H
#define GNOMON_COMPARISON_ENGINE_TABLES_TABLE_VERDICT_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "comparison/engine_tables/engine_table.h"
#include "comparison/engine_tables/table_judge.h"
#include "comparison/engine_tables/true_share.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/text/text_sink.h"
#include "suns/year/year_of_suns.h"

namespace gnomon::comparison {

/// A side that is judged.
struct JudgedSurface {
  std::string name, polygon;
  Side side = Side::kFront;
  bool gross = false;
  WrongCounts wrong;
  SunSum hours;
};

struct TableWitness {
  std::size_t surface = 0;  // of TableVerdict::surfaces
  std::string time;         // as the table has it
  std::string sun_time;     // when the sun was looked at
  suns::Direction sun{};
  bool is_day = false;
  WrongValue value;
  std::optional<TrueShare> truth;  // by day, of a side alone, unless interrupted
};

struct TableVerdict {
  std::string file, geometry_digest;
  std::size_t polygons = 0, parts = 0;  // of the scene
  std::string scene;
  NumberMeaning numbers = NumberMeaning::kDouble;
  TableForm form = TableForm::kEnergyPlus;
  std::string first, last;  // times
  std::size_t rows = 0, judged_rows = 0, columns = 0;
  suns::Minutes step{60};
  std::optional<suns::YearOptions> suns;  // none: the table's own
  std::size_t suns_up = 0;                // rows
  std::optional<double> tolerance;        // none: by digits
  std::int32_t decimals = 0;              // most in the table
  bool doubles = false;                   // numbers have all digits of doubles
  std::uint64_t values = 0;
  WrongCounts wrong;
  std::vector<JudgedSurface> surfaces;  // in the order of the table
  std::vector<std::string> unknown, untold;
  std::vector<TableWitness> worst;
  bool interrupted = false;
  bool oracle_fault = false;  // kernel and oracle differ: a bug of ours

  bool failed() const { return wrong.all() > 0; }
};

std::string table_verdict_text(const TableVerdict& verdict);
/// A line a surface.
std::string table_verdicts_csv(const std::vector<TableVerdict>& verdicts);
/// "gnomon-certificate" with a run a table. Requires: at least one, all of one scene.
void write_table_verdicts_json(report::TextSink& sink, const std::vector<TableVerdict>& verdicts);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ENGINE_TABLES_TABLE_VERDICT_H
