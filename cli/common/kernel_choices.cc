// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/kernel_choices.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "cli/common/commands.h"
#include "gnomon/algorithms/shadows.h"
#include "report/certificate/judging_limits.h"

namespace gnomon::cli {

namespace {

/// Every kernel under the policies of the default set, however slow; all of them count.
constexpr std::string_view kAllKernels = "all";

}  // namespace

CLI::Option* add_kernels_option(CLI::App& command, std::vector<std::string>& names) {
  return repeatable(
             command.add_option(
                 "--kernel", names,
                 "A kernel to run, such as double, double+identity or double+thin (thickness 0);\n"
                 "all: every one, and each counts (repeatable)"))
      ->type_name("K");
}

Expected<std::vector<KernelChoice>> chosen_kernels(const std::vector<std::string>& names,
                                                   std::size_t parts) {
  std::vector<KernelChoice> kernels;
  const bool all = std::ranges::find(names, kAllKernels) != names.end();
  for (const std::string& name : names) {
    if (name == kAllKernels) continue;
    const auto kernel = parse_kernel_choice(name);
    if (!kernel) return tl::unexpected(kernel.error());
    if (std::ranges::find(kernels, *kernel) == kernels.end()) kernels.push_back(*kernel);
  }
  if (!all && !kernels.empty()) return kernels;
  // With no thickness, as a program that compares with zero; then with the thickness that helps
  // most.
  const std::vector<KernelChoice> named =
      std::exchange(kernels, {{.kernel = KernelId::kFloat},
                              {.kernel = KernelId::kDouble, .thin = true},
                              {.kernel = KernelId::kDouble},
                              {.kernel = KernelId::kDouble, .identity = true},
                              {.kernel = KernelId::kLongDouble},
                              {.kernel = KernelId::kEpick}});
  if (all || parts <= report::kSmallScene) {
    kernels.push_back({.kernel = KernelId::kEpeck});
    kernels.push_back({.kernel = KernelId::kRational});
  }
  kernels.push_back({.kernel = KernelId::kPlane});
  for (const KernelChoice& kernel : named) {
    if (std::ranges::find(kernels, kernel) == kernels.end()) kernels.push_back(kernel);
  }
  std::erase_if(kernels, [](const KernelChoice& choice) { return !has_kernel(choice.kernel); });
  return kernels;
}

}  // namespace gnomon::cli
