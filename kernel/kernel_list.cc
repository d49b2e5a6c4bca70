// SPDX-License-Identifier: LGPL-3.0-or-later
// The table of kernels; the README's and docs/exactness.md's tables say the same.
#include "gnomon/kernel/kernel_list.h"

#include <cstddef>

namespace gnomon {

const std::array<KernelInfo, 7>& kernel_list() {
  static constexpr std::string_view kRounded = "rounded coordinates";
  static constexpr std::string_view kThickness = "rounded, with a stated plane thickness";
  static constexpr std::array<KernelInfo, 7> kList{{
      {KernelId::kFloat, "float", false, kRounded, kThickness},
      {KernelId::kDouble, "double", false, kRounded, kThickness},
      {KernelId::kLongDouble, "longdouble", false, kRounded, kThickness},
      {KernelId::kEpick, "epick", false, kRounded, "CGAL's exact predicates, on rounded points"},
      {KernelId::kEpeck, "epeck", true, "CGAL lazy exact", "exact"},
      {KernelId::kRational, "rational", true, "GMP rationals", "exact"},
      {KernelId::kPlane, "plane", true, "never constructed: a vertex is the planes that meet in it",
       "filtered, then exact"},
  }};
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

}  // namespace gnomon
