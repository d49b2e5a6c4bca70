// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/beside.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "scene/base/text_file.h"

namespace gnomon {

Expected<std::string> path_beside(const std::string& file, std::string_view name) {
  const std::filesystem::path named(name);
  const bool leads_out =
      name.empty() || name.find('\0') != std::string_view::npos || named.is_absolute() ||
      std::any_of(named.begin(), named.end(), [](const auto& part) { return part == ".."; });
  if (leads_out) {
    return fail(ErrorCode::kFile, quoted_text(name) + " is outside of the file's folder",
                "a name of a file in it, without '..'");
  }
  if (file == "<stdin>") {
    return fail(ErrorCode::kFile, "standard input has no folder for " + quoted_text(name),
                "a file");
  }
  const std::filesystem::path path = std::filesystem::path(file).parent_path() / named;
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) {
    return fail(ErrorCode::kFile, "there is no file " + quoted_text(name) + " beside this one",
                "a plain file");
  }
  return path.string();
}

}  // namespace gnomon
