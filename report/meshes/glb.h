// SPDX-License-Identifier: GPL-3.0-or-later
// The container of binary glTF 2.0.
#ifndef GNOMON_REPORT_MESHES_GLB_H
#define GNOMON_REPORT_MESHES_GLB_H

#include <string>

namespace gnomon::report {

/// Header, JSON chunk padded with spaces, binary chunk unless it is empty. Requires: the size of
/// `bytes` is a multiple of 4, and all of it is below 4 GB.
std::string glb_file(std::string json, const std::string& bytes);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_MESHES_GLB_H
