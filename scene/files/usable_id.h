// SPDX-License-Identifier: LGPL-3.0-or-later
// Names of other formats as ids of polygons.
#ifndef GNOMON_SCENE_FILES_USABLE_ID_H
#define GNOMON_SCENE_FILES_USABLE_ID_H

#include <string>
#include <string_view>

namespace gnomon {

/// The name with '#', control characters and bytes that are no UTF-8 written as %23, %0A, ...,
/// since no id holds them (validate.h).
std::string usable_id(std::string_view name);
/// The name with bytes that are no UTF-8 written so: what JSON can hold.
std::string usable_text(std::string_view name);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_USABLE_ID_H
