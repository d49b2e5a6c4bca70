// SPDX-License-Identifier: LGPL-3.0-or-later
// A kernel as it is named on the command line: `double`, `double+identity`, `double+thin`, `exact`.
#ifndef GNOMON_KERNEL_KERNEL_CHOICE_H
#define GNOMON_KERNEL_KERNEL_CHOICE_H

#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"
#include "gnomon/kernel/kernel_list.h"

namespace gnomon {

struct KernelChoice {
  KernelId kernel = kDefaultExactKernel;
  bool identity = false;  // rounded kernels only
  bool thin = false;      // kernels with a thickness only: planes of thickness 0

  bool exact() const { return kernel_info(kernel).exact; }
  /// Such as "double+identity".
  std::string name() const;
  friend bool operator==(const KernelChoice&, const KernelChoice&) = default;
};

/// Errors: kUsage, with the names that there are.
Expected<KernelChoice> parse_kernel_choice(std::string_view text);

}  // namespace gnomon

#endif  // GNOMON_KERNEL_KERNEL_CHOICE_H
