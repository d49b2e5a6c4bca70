// SPDX-License-Identifier: GPL-3.0-or-later
// A failure's members in JSON: what workers say, databases keep and findings hold.
#ifndef GNOMON_FUZZ_SRC_FAILURE_JSON_H
#define GNOMON_FUZZ_SRC_FAILURE_JSON_H

#include "gnomon/fuzz/property.h"
#include "gnomon/report/json_writer.h"

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
}

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SRC_FAILURE_JSON_H
