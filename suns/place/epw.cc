// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/place/epw.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "scene/base/text_file.h"

namespace gnomon::suns {

namespace {

/// A field and where it begins in its line.
struct Field {
  std::string_view text;
  std::size_t offset;
};

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    std::size_t end = std::min(line.find(',', begin), line.size());
    const std::size_t next = end + 1;
    while (begin < end && line[begin] == ' ') ++begin;
    while (end > begin && line[end - 1] == ' ') --end;
    fields.push_back({line.substr(begin, end - begin), begin});
    begin = next;
  }
  return fields;
}

}  // namespace

Expected<Place> read_epw_place(const std::filesystem::path& path) {
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(std::move(bytes.error()));
  const std::string file = shown_name(path);
  if (auto checked = check_is_text(*bytes, file); !checked) {
    return tl::unexpected(std::move(checked.error()));
  }
  const std::string_view text = *bytes;
  const auto wrong = [&](std::size_t offset, std::string what, std::string expected) {
    return tl::unexpected(Error{ErrorCode::kSyntax, place_in_text(file, text, offset),
                                std::move(what), std::move(expected)});
  };
  const std::size_t start = byte_order_mark(text);
  const std::string_view line = text.substr(start, text.find_first_of("\r\n", start) - start);
  const std::vector<Field> fields = fields_of(line);
  constexpr std::size_t kFields = 10;
  constexpr const char* kExpected =
      "LOCATION,city,state,country,source,WMO number,latitude,longitude,time zone,elevation";
  if (fields.front().text != "LOCATION") {
    return wrong(start, quoted_text(fields.front().text) + " begins no weather file", kExpected);
  }
  if (fields.size() < kFields) {
    return wrong(start + line.size(),
                 "the line LOCATION has " + std::to_string(fields.size()) + " fields", kExpected);
  }
  std::array<double, 4> numbers{};
  constexpr std::array<const char*, 4> kNames{"latitude", "longitude", "time zone", "elevation"};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Field& field = fields[6 + i];
    std::string_view digits = field.text;
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    const char* end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, numbers[i]);
    if (read.ec != std::errc() || read.ptr != end || !std::isfinite(numbers[i])) {
      return wrong(start + field.offset, quoted_text(field.text) + " is no " + kNames[i],
                   "a number");
    }
  }
  Place place;
  place.name = fields[1].text;
  place.latitude = numbers[0];
  place.longitude = numbers[1];
  place.elevation = numbers[3];
  const double minutes = std::round(60 * numbers[2]);
  constexpr double kFarthest = 14 * 60;
  if (!(std::fabs(minutes) <= kFarthest) || std::fabs(minutes - 60 * numbers[2]) > 0.01) {
    return wrong(start + fields[8].offset, quoted_text(fields[8].text) + " is no time zone",
                 "hours from UTC, in whole minutes");
  }
  place.zone = std::chrono::minutes(static_cast<long>(minutes));
  if (auto checked = check_place(place, "LOCATION"); !checked) {
    checked.error().code = ErrorCode::kSyntax;
    checked.error().where = place_in_text(file, text, start);
    return tl::unexpected(std::move(checked.error()));
  }
  return place;
}

}  // namespace gnomon::suns
