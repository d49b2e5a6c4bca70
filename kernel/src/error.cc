// SPDX-License-Identifier: LGPL-3.0-or-later
// Errors in words, in the one form that the command line prints.
#include "gnomon/kernel/error.h"

namespace gnomon {

std::string to_string(const Error& error) {
  std::string text = error.where.file;
  if (error.where.line > 0) {
    if (!text.empty()) text += ':';
    text += std::to_string(error.where.line);
    if (error.where.column > 0) text += ':' + std::to_string(error.where.column);
  }
  if (!text.empty()) text += ": ";
  text += error.what;
  if (!error.expected.empty()) text += "; expected " + error.expected;
  if (!error.where.pointer.empty()) text += " (at " + error.where.pointer + ")";
  return text;
}

}  // namespace gnomon
