// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/pixel_method.h"

#include <utility>

namespace gnomon::cli {
namespace {

bool can_be_sampled(const Method& method) {
  return method.chosen_by_name && method.lights.point &&
         (method.domain == Domain::kImageSpace || method.makes_fragments);
}

/// "zbuffer (...), ...": names, with summaries if asked for.
std::string names(Domain domain, bool summaries) {
  std::string text;
  for (const Method& method : methods(domain)) {
    if (!can_be_sampled(method)) continue;
    text += (text.empty() ? "" : ", ") + std::string(method.name);
    if (summaries) text += " (" + std::string(method.summary) + ")";
  }
  return text;
}

}  // namespace

CLI::Option* add_pixel_algorithm_option(CLI::App& command, std::string& name) {
  return command
      .add_option("--algorithm", name,
                  "How samples are found, in the picture: " + names(Domain::kImageSpace, true) +
                      ";\nor whose fragments are sampled: " + names(Domain::kObjectSpace, false))
      ->type_name("A")
      ->capture_default_str();
}

std::vector<MethodSelection> all_pixel_methods() {
  std::vector<MethodSelection> all;
  for (const Domain domain : {Domain::kImageSpace, Domain::kObjectSpace}) {
    for (const Method& method : methods(domain)) {
      if (can_be_sampled(method)) all.push_back({method.id, {}});
    }
  }
  return all;
}

Expected<MethodSelection> parse_pixel_method(std::string_view text) {
  const std::string_view name = text.substr(0, text.find(':'));
  for (const Domain domain : {Domain::kImageSpace, Domain::kObjectSpace}) {
    const auto id = method_by_name(name, domain);
    if (id && can_be_sampled(method_info(*id))) return parse_method(text, domain);
  }
  return fail(
      ErrorCode::kUsage, "--algorithm " + std::string(name) + ": no samples can be had of it",
      "one of: " + names(Domain::kImageSpace, false) + ", " + names(Domain::kObjectSpace, false));
}

}  // namespace gnomon::cli
