// SPDX-License-Identifier: LGPL-3.0-or-later
// Formats that are not read here, by their content: who gives such a file is told what it is, and
// not at which of its words a reader of another format stumbled.
#ifndef GNOMON_SCENE_FILES_FOREIGN_FORMATS_H
#define GNOMON_SCENE_FILES_FOREIGN_FORMATS_H

#include <optional>
#include <string_view>

namespace gnomon {

/// The name of the format, such as "CityJSON" or "a ZIP archive"; nothing if it is not known. Looks
/// at the first 64 KiB, and is meant for files that no reader took.
std::optional<std::string_view> foreign_format(std::string_view text);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_FOREIGN_FORMATS_H
