// SPDX-License-Identifier: GPL-3.0-or-later
// Which decisions of a rounded kernel differ, and which matter, for people and for programs.
#ifndef GNOMON_REPORT_CERTIFICATE_DECISIONS_H
#define GNOMON_REPORT_CERTIFICATE_DECISIONS_H

#include <string>
#include <vector>

#include "gnomon/algorithms/explain.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/json/json_writer.h"

namespace gnomon::report {

/// What names are taken from.
struct NamedScene {
  const Scene* scene = nullptr;
  const PreparedScene* prepared = nullptr;
};

/// How many differ, where and by how much; what each flipped one changed. Nothing if none differs.
std::vector<std::string> decisions_text(const Explanation& explanation, const std::string& kernel,
                                        const NamedScene& named);

/// The same in full, as an object.
void write_decisions(JsonWriter& json, const Explanation& explanation, const std::string& kernel,
                     const NamedScene& named);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_CERTIFICATE_DECISIONS_H
