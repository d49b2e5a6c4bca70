// SPDX-License-Identifier: GPL-3.0-or-later
// POLYGON or POLYGON:back on the command line: the side of a polygon that a point lies on.
#ifndef GNOMON_CLI_COMMON_RECEIVER_ARGUMENT_H
#define GNOMON_CLI_COMMON_RECEIVER_ARGUMENT_H

#include <algorithm>
#include <string>
#include <string_view>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/scene.h"

namespace gnomon::cli {

struct ReceiverArgument {
  std::string polygon;  // an id, which the scene need not have
  Side side = Side::kFront;
};

/// An id that ends in ":back" itself is that id.
inline ReceiverArgument parse_receiver(const std::string& text, const Scene& scene) {
  constexpr std::string_view kBack = ":back";
  if (!text.ends_with(kBack) ||
      std::ranges::find(scene.polygons, text, &Polygon::id) != scene.polygons.end()) {
    return {text, Side::kFront};
  }
  return {text.substr(0, text.size() - kBack.size()), Side::kBack};
}

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_RECEIVER_ARGUMENT_H
