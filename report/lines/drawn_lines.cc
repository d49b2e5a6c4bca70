// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/lines/drawn_lines.h"

#include <algorithm>

namespace gnomon::report {

std::vector<StyledPart> styled_parts(const DrawnLines& drawn, std::size_t i) {
  const std::vector<LinePart>& seen = drawn.seen.lines[i].parts;
  std::vector<std::size_t> at(drawn.shadowed.size(), 0);  // of each light, the part that is next
  std::vector<StyledPart> parts;
  double from = 0;
  for (std::size_t own = 0; own < seen.size();) {
    // The nearest end of the parts that the eye and the lights have here.
    const mpq_class* end = &seen[own].end;
    bool is_shadowed = false;
    for (std::size_t l = 0; l < at.size(); ++l) {
      const LinePart& part = drawn.shadowed[l].lines.lines[i].parts[at[l]];
      is_shadowed = is_shadowed || part.hidden_by > 0;
      if (part.end < *end) end = &part.end;
    }
    const LineStyle style = seen[own].hidden_by > 0 ? LineStyle::kHidden
                            : is_shadowed           ? LineStyle::kShadowed
                                                    : LineStyle::kSeen;
    const double to = end->get_d();
    if (!parts.empty() && parts.back().style == style) {
      parts.back().to = to;
    } else {
      parts.push_back({from, to, style});
    }
    from = to;
    for (std::size_t l = 0; l < at.size(); ++l) {
      if (drawn.shadowed[l].lines.lines[i].parts[at[l]].end == *end) ++at[l];
    }
    if (seen[own].end == *end) ++own;
  }
  return parts;
}

}  // namespace gnomon::report
