// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/building/length_units.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon {

namespace {

constexpr LengthUnit kUnits[] = {
    {"Meters", 1, 0},   {"Kilometers", 1, 3}, {"Centimeters", 1, -2}, {"Millimeters", 1, -3},
    {"Feet", 3048, -4}, {"Inches", 254, -4},  {"Yards", 9144, -4},    {"Miles", 1609344, -3},
};

}  // namespace

const LengthUnit* length_unit(std::string_view name) {
  const auto* const found = std::ranges::find(kUnits, name, &LengthUnit::name);
  return found == std::end(kUnits) ? nullptr : found;
}

std::string shown_length_units() {
  std::string text;
  for (const LengthUnit& unit : kUnits) {
    text += (text.empty()                    ? ""
             : &unit == std::end(kUnits) - 1 ? " or "
                                             : ", ") +
            std::string(unit.name);
  }
  return text;
}

std::string shown_length(double length) { return fmt::format("{:.3g}", length); }

}  // namespace gnomon
