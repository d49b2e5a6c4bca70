// SPDX-License-Identifier: LGPL-3.0-or-later
// Units of length of building models: each is an exact decimal number of metres.
#ifndef GNOMON_SCENE_BUILDING_LENGTH_UNITS_H
#define GNOMON_SCENE_BUILDING_LENGTH_UNITS_H

#include <cstdint>
#include <string>
#include <string_view>

#include "gnomon/scene/number.h"

namespace gnomon {

struct LengthUnit {
  std::string_view name;
  std::int64_t mantissa;  // mantissa * 10^exponent metres
  std::int32_t exponent;

  Number metres() const { return Number::from_short_decimal(mantissa, exponent); }
};

/// Null for any other name. Upper and lower case differ.
const LengthUnit* length_unit(std::string_view name);
/// "Meters, Millimeters, ...": for messages.
std::string shown_length_units();
/// A length with three digits: for messages.
std::string shown_length(double length);

}  // namespace gnomon

#endif  // GNOMON_SCENE_BUILDING_LENGTH_UNITS_H
