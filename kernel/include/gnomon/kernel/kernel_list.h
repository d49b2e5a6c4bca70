// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernels by name, and what each guarantees; the list itself is kernels.def.
#ifndef GNOMON_KERNEL_KERNEL_LIST_H
#define GNOMON_KERNEL_KERNEL_LIST_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gnomon {

enum class KernelId : std::uint8_t {
#define GNOMON_KERNEL(id, ...) id,
#include "gnomon/kernel/kernels.def"
};

struct KernelInfo {
  KernelId id;
  std::string_view name;       // as on the command line
  bool exact;                  // every answer equals the definition
  bool has_thickness;          // a vertex near a plane is on it (`--thickness`)
  std::string_view points;     // the vertices that algorithms make
  std::string_view decisions;  // how a side of a plane is found
};

/// In the order of docs; `exact` on the command line is an alias of kDefaultExactKernel.
std::span<const KernelInfo> kernel_list();
const KernelInfo& kernel_info(KernelId id);
std::optional<KernelId> kernel_by_name(std::string_view name);
/// The names of all kernels with `between` between them.
std::string kernel_names(std::string_view between);
inline constexpr KernelId kDefaultExactKernel = KernelId::kPlane;

/// Relative plane thickness of the rounded kernels unless told otherwise (docs/exactness.md says
/// why).
inline constexpr double kDefaultThickness = 1e-12;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_KERNEL_LIST_H
