// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/kernel/kernel_choice.h"

namespace gnomon {

namespace {

constexpr std::string_view kIdentitySuffix = "+identity";
constexpr std::string_view kThinSuffix = "+thin";

bool take_suffix(std::string_view& name, std::string_view suffix) {
  if (!name.ends_with(suffix)) return false;
  name.remove_suffix(suffix.size());
  return true;
}

}  // namespace

std::string KernelChoice::name() const {
  std::string text(kernel_info(kernel).name);
  if (identity) text += kIdentitySuffix;
  if (thin) text += kThinSuffix;
  return text;
}

Expected<KernelChoice> parse_kernel_choice(std::string_view text) {
  KernelChoice choice;
  std::string_view name = text;
  for (bool more = true; more;) {
    const bool identity = take_suffix(name, kIdentitySuffix);
    const bool thin = take_suffix(name, kThinSuffix);
    choice.identity |= identity;
    choice.thin |= thin;
    more = identity || thin;
  }
  const auto kernel = kernel_by_name(name);
  if (!kernel) {
    return fail(ErrorCode::kUsage, "--kernel " + std::string(text) + ": no such kernel",
                "one of: " + kernel_names(" ") + " exact, rounded ones also with +identity, +thin");
  }
  choice.kernel = *kernel;
  // An exact kernel answers the same with and without.
  if (choice.exact()) choice.identity = false;
  if (!kernel_info(choice.kernel).has_thickness) choice.thin = false;
  return choice;
}

}  // namespace gnomon
