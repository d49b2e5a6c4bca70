// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/argument_parts.h"

#include <algorithm>
#include <utility>

#include "gnomon/scene/light_arguments.h"
#include "scene/base/text_file.h"

namespace gnomon {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string_view take_until(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

Expected<Position> parse_position(std::string_view text, NumberMeaning meaning,
                                  const std::string& option) {
  const std::string_view whole = text;
  if (std::count(text.begin(), text.end(), ',') != 2) {
    return fail(ErrorCode::kUsage, option + ": " + quoted_text(whole) + " is not a point", "x,y,z");
  }
  Position position;
  for (Number& coordinate : position) {
    auto number = Number::parse(trimmed(take_until(text, ',')), meaning);
    if (!number) {
      number.error().what = option + ": " + number.error().what;
      return tl::unexpected(std::move(number.error()));
    }
    coordinate = *std::move(number);
  }
  return position;
}

}  // namespace gnomon
