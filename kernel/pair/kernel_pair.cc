// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/pair/kernel_pair.h"

namespace gnomon {

std::string describe_vertex(VertexId source) {
  return source == kMadeVertex ? std::string("a vertex made by splitting")
                               : "input vertex " + std::to_string(source);
}

}  // namespace gnomon
