// SPDX-License-Identifier: GPL-3.0-or-later
// Integers of binary files, low bytes first whatever the machine does.
#ifndef GNOMON_REPORT_TEXT_LITTLE_ENDIAN_H
#define GNOMON_REPORT_TEXT_LITTLE_ENDIAN_H

#include <cstddef>
#include <string>

namespace gnomon::report {

template <class Integer>
void append_little_endian(std::string& text, Integer value) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    text += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_LITTLE_ENDIAN_H
