// SPDX-License-Identifier: GPL-3.0-or-later
// NumPy's format 1.0 of arrays of doubles: a magic text, the version, the length of a dictionary,
// and that, padded with spaces. Reference: numpy.lib.format.
#ifndef GNOMON_REPORT_TEXT_NPY_H
#define GNOMON_REPORT_TEXT_NPY_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace gnomon::report {

/// What stands before little-endian doubles in C order: of one length for all shapes of up to three
/// dimensions, so that it can be written again when the shape is known. The numbers begin at a
/// multiple of 64.
inline std::string npy_head(std::span<const std::size_t> shape) {
  constexpr std::size_t kSize = 192, kBefore = 10;
  std::string text = "{'descr': '<f8', 'fortran_order': False, 'shape': (";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  }
  text += "), }";
  text.resize(kSize - kBefore - 1, ' ');
  text += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(text.size()) + '\0' + text;
}

/// A little-endian double; the end of it.
inline char* put_double(char* at, double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned shift = 0; shift < 64; shift += 8) *at++ = static_cast<char>(bits >> shift & 0xff);
  return at;
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_NPY_H
