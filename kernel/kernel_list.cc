// SPDX-License-Identifier: LGPL-3.0-or-later
// The table of kernels; the README's and docs/exactness.md's tables say the same.
#include "gnomon/kernel/kernel_list.h"

#include <array>
#include <cstddef>

namespace gnomon {

std::span<const KernelInfo> kernel_list() {
  static constexpr std::array kList{
#define GNOMON_KERNEL(id, name, kernel, header, exact, has_thickness, points, decisions) \
  KernelInfo{KernelId::id, name, exact, has_thickness, points, decisions},
#include "gnomon/kernel/kernels.def"
  };
  return kList;
}

const KernelInfo& kernel_info(KernelId id) { return kernel_list()[static_cast<std::size_t>(id)]; }

std::optional<KernelId> kernel_by_name(std::string_view name) {
  if (name == "exact") return kDefaultExactKernel;
  for (const KernelInfo& info : kernel_list()) {
    if (info.name == name) return info.id;
  }
  return std::nullopt;
}

std::string kernel_names(std::string_view between) {
  std::string names;
  for (const KernelInfo& info : kernel_list()) {
    if (!names.empty()) names += between;
    names += info.name;
  }
  return names;
}

}  // namespace gnomon
