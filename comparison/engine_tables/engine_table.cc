// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/engine_tables/engine_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "comparison/engine_tables/csv_reader.h"
#include "scene/base/text_file.h"
#include "suns/calendar/read_time.h"

namespace gnomon::comparison {

namespace {

constexpr const char* kHeads =
    "'Surface Name,NAME,...', or 'time,sun_x,sun_y,sun_z,NAME,...' as gnomon year writes it";
constexpr std::array<std::string_view, 4> kSunHead{"time", "sun_x", "sun_y", "sun_z"};

constexpr std::string_view kSurfaceName = "surface name";

bool is_surface_name(std::string_view text) {
  return std::equal(text.begin(), text.end(), kSurfaceName.begin(), kSurfaceName.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

std::optional<TableForm> form_of(const std::vector<CsvField>& head) {
  if (is_surface_name(head.front().text)) return TableForm::kEnergyPlus;
  if (head.size() >= kSunHead.size() &&
      std::equal(kSunHead.begin(), kSunHead.end(), head.begin(),
                 [](std::string_view name, const CsvField& field) { return name == field.text; })) {
    return TableForm::kSuns;
  }
  return std::nullopt;
}

class TableReader {
 public:
  TableReader(CsvReader csv, const TableReading& reading)
      : csv_(std::move(csv)), reading_(&reading) {}

  Expected<EngineTable> read(std::string file);

 private:
  Expected<void> read_head();
  Expected<void> read_names();
  Expected<void> read_row();
  Expected<void> check_length() const;
  Expected<void> read_time(TableRow& row);
  Expected<void> read_direction(TableRow& row) const;
  Expected<void> check_order(suns::CivilTime time);
  Expected<void> read_values();

  CsvReader csv_;
  const TableReading* reading_;
  EngineTable table_;
  std::size_t before_ = 1;  // fields before the first share
  std::chrono::seconds least_{0};
};

Expected<EngineTable> TableReader::read(std::string file) {
  table_.file = std::move(file);
  if (auto done = read_head(); !done) return tl::unexpected(std::move(done.error()));
  for (;;) {
    auto more = csv_.next();
    if (!more) return tl::unexpected(std::move(more.error()));
    if (!*more) break;
    if (auto done = read_row(); !done) return tl::unexpected(std::move(done.error()));
    constexpr std::size_t kRowsBetween = 64;
    if (reading_->progress && table_.rows.size() % kRowsBetween == 0 &&
        !reading_->progress(csv_.done())) {
      return fail(ErrorCode::kInterrupted, "interrupted");
    }
  }
  if (table_.rows.empty()) {
    return csv_.wrong(ErrorCode::kFormat, csv_.fields().size(), "a table without rows",
                      "a row a step");
  }
  if (table_.rows.size() > 1) {
    table_.step = least_;
  } else {
    // One row tells no step: the longest up to an hour that ends then.
    const auto since_hour = table_.rows.front().time.time_since_epoch() % std::chrono::hours(1);
    table_.step = std::chrono::seconds(std::gcd(since_hour.count(), std::int64_t{3600}));
  }
  return std::move(table_);
}

Expected<void> TableReader::read_head() {
  auto more = csv_.next();
  if (!more) return tl::unexpected(std::move(more.error()));
  if (!*more) return csv_.wrong(ErrorCode::kFormat, 0, "an empty table", kHeads);
  const auto form = form_of(csv_.fields());
  if (!form) {
    return csv_.wrong(ErrorCode::kFormat, 0,
                      quoted_text(csv_.fields().front().text) + " begins no table that is known",
                      kHeads);
  }
  table_.form = *form;
  before_ = *form == TableForm::kSuns ? kSunHead.size() : 1;
  if (auto named = read_names(); !named) return named;
  auto kept = reading_->choose(table_);
  if (!kept) return tl::unexpected(std::move(kept.error()));
  table_.kept = *std::move(kept);
  return {};
}

Expected<void> TableReader::read_names() {
  std::size_t end = csv_.fields().size();
  while (end > before_ && csv_.fields()[end - 1].text.empty()) --end;
  if (end == before_) {
    return csv_.wrong(ErrorCode::kFormat, end, "a table without surfaces", kHeads);
  }
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = before_; i < end; ++i) {
    std::string name(csv_.fields()[i].text);
    if (name.empty()) return csv_.wrong(ErrorCode::kId, i, "a column without a name", "a name");
    if (!known.emplace(name, i).second) {
      return csv_.wrong(ErrorCode::kId, i, quoted_text(name) + " stands twice",
                        "one column a surface");
    }
    table_.names.push_back(std::move(name));
  }
  return {};
}

Expected<void> TableReader::read_row() {
  TableRow row;
  if (auto done = read_time(row); !done) return done;
  if (auto done = check_length(); !done) return done;
  if (table_.form == TableForm::kSuns) {
    if (auto done = read_direction(row); !done) return done;
  }
  if (auto done = check_order(row.time); !done) return done;
  table_.rows.push_back(row);
  return read_values();
}

Expected<void> TableReader::check_length() const {
  const std::size_t expected = before_ + table_.names.size();
  std::size_t end = csv_.fields().size();
  // A comma at the end of a line begins no field.
  while (end > expected && csv_.fields()[end - 1].text.empty()) --end;
  if (end == expected) return {};
  return csv_.wrong(ErrorCode::kFormat, std::min(end, expected),
                    std::to_string(end) + " fields in a row",
                    std::to_string(expected) + ", as in the first line");
}

Expected<void> TableReader::read_time(TableRow& row) {
  const std::string_view text = csv_.fields().front().text;
  const auto wrong = [&](const suns::WrongTime& what, std::string expected) -> Expected<void> {
    return csv_.wrong(ErrorCode::kFormat, 0, quoted_text(text) + " " + what, std::move(expected));
  };
  if (table_.form == TableForm::kEnergyPlus) {
    const auto time = suns::read_end_of_step(text, reading_->year);
    if (!time) {
      return wrong(time.error(), text.starts_with("02/29")
                                     ? "--year of a leap year"
                                     : "MM/DD HH:MM, the end of a step, up to 24:00");
    }
    row.time = *time;
    return {};
  }
  const auto time = suns::read_iso(text);
  if (!time) return wrong(time.error(), "a time such as 2026-03-20T06:30:00-07:00");
  if (table_.rows.empty()) table_.zone = time->zone;
  if (time->zone != table_.zone) {
    return wrong("is of another time zone than the rows before", "one zone in a table");
  }
  row.time = time->time;
  return {};
}

Expected<void> TableReader::read_direction(TableRow& row) const {
  for (std::size_t k = 0; k < row.direction.size(); ++k) {
    const std::string_view text = csv_.fields()[1 + k].text;
    const auto number = parse_written(text);
    constexpr double kMost = 2000;  // so that millionths fit
    if (!number || number->decimals > 6 || !(std::fabs(number->value) < kMost)) {
      return csv_.wrong(ErrorCode::kNumber, 1 + k,
                        quoted_text(text) + " is no component of a direction",
                        "a decimal of at most six digits after the point");
    }
    row.direction[k] = static_cast<std::int32_t>(std::lround(1e6 * number->value));
  }
  if (row.direction == suns::Direction{}) {
    return csv_.wrong(ErrorCode::kNumber, 1, "a sun without a direction", "not three zeros");
  }
  return {};
}

Expected<void> TableReader::check_order(suns::CivilTime time) {
  if (table_.rows.empty()) return {};
  const auto step = time - table_.rows.back().time;
  if (step <= std::chrono::seconds(0)) {
    return csv_.wrong(ErrorCode::kFormat, 0,
                      quoted_text(csv_.fields().front().text) + " is not after the row before",
                      "rows in the order of time, each once");
  }
  least_ = table_.rows.size() == 1 ? step : std::min(least_, step);
  return {};
}

Expected<void> TableReader::read_values() {
  for (const std::uint32_t column : table_.kept) {
    const std::string_view text = csv_.fields()[before_ + column].text;
    const auto number = parse_written(text);
    if (!number) {
      return csv_.wrong(ErrorCode::kNumber, before_ + column,
                        text.empty() ? "an empty field" : quoted_text(text) + " is no number",
                        "the lit share of " + quoted_text(table_.names[column]));
    }
    table_.values.add(*number);
  }
  return {};
}

}  // namespace

bool is_engine_table(const std::filesystem::path& file) {
  if (file == "-") return false;
  const bool ends_so = file.extension() == ".csv";
  std::error_code failed;
  if (!std::filesystem::is_regular_file(file, failed)) return ends_so;
  const auto window = TextWindow::of_file(file);
  if (ends_so || !window) return ends_so;
  std::string_view start(window->begin(),
                         static_cast<std::size_t>(window->end() - window->begin()));
  start.remove_prefix(byte_order_mark(start));
  start.remove_prefix(std::min(start.find_first_not_of(" \t\""), start.size()));
  constexpr std::string_view kSuns = "time,sun_x,";
  return start.starts_with(kSuns) || is_surface_name(start.substr(0, kSurfaceName.size()));
}

Expected<EngineTable> read_engine_table(const std::filesystem::path& file,
                                        const TableReading& reading) {
  auto csv = CsvReader::open(file);
  if (!csv) return tl::unexpected(std::move(csv.error()));
  return TableReader(*std::move(csv), reading).read(shown_name(file));
}

}  // namespace gnomon::comparison
