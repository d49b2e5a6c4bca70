// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of an option's value that tells of a light: points between colons, numbers between
// commas, blanks around them.
#ifndef GNOMON_SCENE_FILES_ARGUMENT_PARTS_H
#define GNOMON_SCENE_FILES_ARGUMENT_PARTS_H

#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

std::string_view trimmed(std::string_view text);
/// Takes what stands before the separator off the text; all of it if there is none.
std::string_view take_until(std::string_view& text, char separator);
/// Three coordinates. `option`: its name. Errors: kUsage, kNumber, kLimit.
Expected<Position> parse_position(std::string_view text, NumberMeaning meaning,
                                  const std::string& option);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_ARGUMENT_PARTS_H
