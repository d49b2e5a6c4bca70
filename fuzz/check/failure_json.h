// SPDX-License-Identifier: GPL-3.0-or-later
// A failure's members in JSON: what workers say, databases keep and findings hold.
#ifndef GNOMON_FUZZ_CHECK_FAILURE_JSON_H
#define GNOMON_FUZZ_CHECK_FAILURE_JSON_H

#include <limits>
#include <optional>
#include <string>

#include "fuzz/check/property.h"
#include "report/json/json_writer.h"
#include "scene/json/json_members.h"

namespace gnomon::fuzz {

/// Into an object that has been begun.
inline void write_failure_members(report::JsonWriter& json, const Failure& failure) {
  json.member("property", id_of(failure.property));
  json.member("class", failure.disagreement);
  json.member("subject", failure.subject);
  json.member("light", failure.light);
  json.member("polygon", failure.polygon);
  json.member("text", failure.text);
  json.member("width", failure.width);
  json.member("share", failure.share);
  if (!failure.cause.empty()) json.member("cause", failure.cause);
}

/// What write_failure_members() wrote; errors are the reader's.
inline Failure read_failure(JsonMembers& members) {
  Failure failure;
  std::string property;
  members.read("property", property);
  members.read("class", failure.disagreement);
  members.read("subject", failure.subject);
  members.read("light", failure.light);
  members.read("polygon", failure.polygon);
  members.read("text", failure.text);
  // A region without bounds has no width that JSON could tell: it is null.
  std::optional<double> width;
  members.read("width", width);
  failure.width = width.value_or(std::numeric_limits<double>::infinity());
  members.read("share", failure.share);
  members.read_if_there("cause", failure.cause);
  if (const auto known = property_by_id(property)) {
    failure.property = *known;
  } else {
    members.reject("property");
  }
  return failure;
}

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_FAILURE_JSON_H
