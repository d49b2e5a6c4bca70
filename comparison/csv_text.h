// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of CSV (RFC 4180, with line feeds alone).
#ifndef GNOMON_COMPARISON_CSV_TEXT_H
#define GNOMON_COMPARISON_CSV_TEXT_H

#include <string>
#include <vector>

namespace gnomon::comparison {

/// Adds a line; cells are quoted where they have to be.
void add_csv_line(std::string& text, const std::vector<std::string>& cells);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_CSV_TEXT_H
