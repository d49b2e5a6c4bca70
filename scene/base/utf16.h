// SPDX-License-Identifier: LGPL-3.0-or-later
// Texts in UTF-16, which programs of Windows write: gbXML of Revit, tables of a spreadsheet.
#ifndef GNOMON_SCENE_BASE_UTF16_H
#define GNOMON_SCENE_BASE_UTF16_H

#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"

namespace gnomon {

/// Do the bytes begin with a byte order mark of UTF-16, and not of UTF-32?
bool is_utf16(std::string_view bytes);

/// The same text in UTF-8, without a mark. Requires: is_utf16(). Errors: kSyntax at what is half of
/// a character.
Expected<std::string> utf8_of_utf16(std::string_view bytes, const std::string& file);

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_UTF16_H
