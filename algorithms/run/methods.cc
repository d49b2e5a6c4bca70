// SPDX-License-Identifier: LGPL-3.0-or-later
// The table of methods. A new method is a room, a row and a case here, and a line of
// gnomon_compile_on_kernels() in algorithms/CMakeLists.txt.
#include "algorithms/run/methods.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "algorithms/run/by_receiver.h"
#include "algorithms/run/on_every_kernel.h"
#include "algorithms/sectors/by_sectors.h"
#include "algorithms/svbsp/by_svbsp.h"

namespace gnomon {

namespace {

/// The first of the rows that can do what is asked is what the command line's `auto` takes.
constexpr std::array kMethods = {
    Method{.id = MethodId::kSectors,
           .name = "sectors",
           .summary = "needs no order",
           .source = "Slater 1992, tiles, in light space",
           .lights = {.point = true}},
    Method{.id = MethodId::kSvbsp,
           .name = "svbsp",
           .summary = "front to back by a scene BSP",
           .source = "Chin & Feiner 1989",
           .lights = {.point = true},
           .combines_lights = true,
           .explains = true,
           .leaves_out_steps = true},
    Method{.id = MethodId::kReceiver,
           .name = "receiver",
           .summary = "each polygon against its casters",
           .source = "Nishita & Nakamae 1983; Chin & Feiner 1992",
           .lights = {.point = true, .area = true},
           .combines_lights = true},
    Method{.id = MethodId::kMerged,
           .name = "merged",
           .summary = "two trees of all casters",
           .source = "Chin & Feiner 1992",
           .lights = {.area = true},
           .combines_lights = true},
    Method{.id = MethodId::kPieces,
           .name = "pieces",
           .summary = "the light cut by polygon planes, classes for each piece",
           .source = "Chin & Feiner 1992",
           .lights = {.area = true},
           .chosen_by_name = false},
};

template <template <class> class Run>
MethodFunction on_kernel(KernelId kernel) {
  static constexpr std::array kFunctions = on_every_kernel<Run>();
  return kFunctions[static_cast<std::size_t>(kernel)];
}

}  // namespace

std::span<const Method> methods() { return kMethods; }

const Method& method_info(MethodId id) { return *std::ranges::find(kMethods, id, &Method::id); }

std::optional<MethodId> method_by_name(std::string_view name) {
  for (const Method& method : kMethods) {
    if (method.chosen_by_name && method.name == name) return method.id;
  }
  return std::nullopt;
}

std::string method_names(LightKinds lights) {
  std::string names;
  for (const Method& method : kMethods) {
    const bool takes = (lights.point && method.lights.point) || (lights.area && method.lights.area);
    if (!method.chosen_by_name || !takes) continue;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  return names;
}

MethodFunction method_function(MethodId method, KernelId kernel) {
  switch (method) {
    case MethodId::kSectors:
      return on_kernel<BySectors>(kernel);
    case MethodId::kSvbsp:
      return on_kernel<BySvbsp>(kernel);
    case MethodId::kReceiver:
    case MethodId::kMerged:
    case MethodId::kPieces:
      return on_kernel<ByReceiver>(kernel);
    case MethodId::kAutomatic:
      break;
  }
  return nullptr;
}

}  // namespace gnomon
