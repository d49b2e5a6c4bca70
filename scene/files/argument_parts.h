// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of an option's value that tells of a light: points between colons, numbers between
// commas, blanks around them.
#ifndef GNOMON_SCENE_FILES_ARGUMENT_PARTS_H
#define GNOMON_SCENE_FILES_ARGUMENT_PARTS_H

#include <string_view>

namespace gnomon {

std::string_view trimmed(std::string_view text);
/// Takes what stands before the separator off the text; all of it if there is none.
std::string_view take_until(std::string_view& text, char separator);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_ARGUMENT_PARTS_H
