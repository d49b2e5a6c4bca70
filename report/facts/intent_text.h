// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene says and perhaps does not mean (gnomon/scene/intent.h): the lines of `gnomon info`,
// the one line of the other commands, and both for programs.
#ifndef GNOMON_REPORT_FACTS_INTENT_TEXT_H
#define GNOMON_REPORT_FACTS_INTENT_TEXT_H

#include <string>

#include "gnomon/scene/intent.h"
#include "report/json/json_writer.h"

namespace gnomon::report {

/// One line without the name of the file; empty if nothing is doubtful.
std::string intent_warning(const Scene& scene, const Intent& intent);

/// For people: a line or two a kind with the first few examples, all of them if `all`.
std::string intent_text(const Scene& scene, const PreparedScene& prepared, const Intent& intent,
                        bool all);

/// The member "intent" of an object.
void write_intent_json(JsonWriter& json, const Scene& scene, const PreparedScene& prepared,
                       const Intent& intent);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_FACTS_INTENT_TEXT_H
