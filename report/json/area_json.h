// SPDX-License-Identifier: GPL-3.0-or-later
// Areas in JSON. A scene may be so small or so large that its areas, products of two lengths, are
// beyond the range of doubles: then text stands beside the number, which is what it always was,
// with the digits that the number cannot have.
#ifndef GNOMON_REPORT_JSON_AREA_JSON_H
#define GNOMON_REPORT_JSON_AREA_JSON_H

#include <gmpxx.h>

#include <cmath>

#include "report/json/json_writer.h"
#include "report/text/decimal_text.h"

namespace gnomon::report {

/// Whether a double tells all of a value that is not 0.
inline bool tells(double nearest) { return std::isnormal(nearest); }

/// `area`, and `area_decimal` where no normal double is near. `precise()`: the area as a rational;
/// only asked where it may be needed. What is not known is null.
template <class Precise>
void write_area(JsonWriter& json, double nearest, const Precise& precise) {
  json.member("area", nearest);
  if (std::isnan(nearest) || tells(nearest)) return;
  const mpq_class area = precise();
  if (area != 0) json.member("area_decimal", decimal_text(area));
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_JSON_AREA_JSON_H
