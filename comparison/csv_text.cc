// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/csv_text.h"

#include "report/text/csv_field.h"

namespace gnomon::comparison {

void add_csv_line(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) text += ',';
    report::append_csv_field(text, cells[i]);
  }
  text += '\n';
}

}  // namespace gnomon::comparison
