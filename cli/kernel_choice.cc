// SPDX-License-Identifier: GPL-3.0-or-later
#include "kernel_choice.h"

namespace gnomon::cli {

namespace {

constexpr std::string_view kIdentitySuffix = "+identity";

}  // namespace

std::string KernelChoice::name() const {
  std::string text(kernel_info(kernel).name);
  if (identity) text += kIdentitySuffix;
  return text;
}

Expected<KernelChoice> parse_kernel_choice(std::string_view text) {
  KernelChoice choice;
  std::string_view name = text;
  if (name.ends_with(kIdentitySuffix)) {
    choice.identity = true;
    name.remove_suffix(kIdentitySuffix.size());
  }
  const auto kernel = name == "exact" ? kDefaultExactKernel : kernel_by_name(name);
  if (!kernel) {
    std::string names;
    for (const KernelInfo& info : kernel_list()) names += std::string(info.name) + ' ';
    return fail(ErrorCode::kUsage, "--kernel " + std::string(text) + ": no such kernel",
                "one of: " + names + "exact, rounded ones also with +identity");
  }
  choice.kernel = *kernel;
  // An exact kernel answers the same with and without.
  if (choice.exact()) choice.identity = false;
  return choice;
}

}  // namespace gnomon::cli
