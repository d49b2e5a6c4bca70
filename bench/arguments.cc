// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <cstddef>

namespace gnomon::bench {

ArgumentsRead read_arguments(std::span<const std::string_view> words,
                             std::span<const std::string_view> parts) {
  ArgumentsRead read;
  Arguments& arguments = read.arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (word == "--short") {
      arguments.extent = Extent::kShort;
    } else if (word == "--long") {
      arguments.extent = Extent::kLong;
    } else if (word == "--json") {
      arguments.json = true;
    } else if (word == "--help" || word == "-h") {
      arguments.help = true;
    } else if (word == "--against") {
      if (++i == words.size() || words[i].empty()) {
        read.complaint = "--against needs a gnomon command";
        return read;
      }
      arguments.against = words[i];
    } else if (word == "--plots") {
      if (++i == words.size() || words[i].empty()) {
        read.complaint = "--plots needs a folder";
        return read;
      }
      arguments.plots = words[i];
    } else if (std::ranges::count(parts, word) == 0) {
      read.complaint = "unknown '" + std::string(word) + "'";
      return read;
    } else if (!arguments.names(word)) {
      arguments.parts.emplace_back(word);
    }
  }
  if (!arguments.plots.empty() && !arguments.parts.empty() && !arguments.names("papers")) {
    read.complaint = "--plots is of the part papers";
  }
  // Other parts print tables only, and would make the output no JSON.
  if (arguments.json && arguments.parts != std::vector<std::string>{"targets"}) {
    read.complaint = "--json is of the part targets alone";
  }
  return read;
}

}  // namespace gnomon::bench
