// SPDX-License-Identifier: GPL-3.0-or-later
#include "method_variants.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

namespace gnomon::test {
namespace {

/// Values of an option to try, from what it says that it takes: "on|off", "1..1024".
std::vector<std::string> values_of(const MethodOption& option) {
  const std::string_view text = option.values;
  if (const std::size_t dots = text.find(".."); dots != std::string_view::npos) {
    const int lowest = std::stoi(std::string(text.substr(0, dots)));
    return {std::to_string(lowest), std::to_string(lowest + 3)};
  }
  std::vector<std::string> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t bar = std::min(text.find('|', begin), text.size());
    values.emplace_back(text.substr(begin, bar - begin));
    begin = bar + 1;
  }
  return values;
}

}  // namespace

std::vector<MethodId> object_methods() {
  std::vector<MethodId> ids;
  for (const Method& method : methods()) {
    const bool picky =
        method.needs.closed_meshes || method.needs.camera || method.needs.one_hemisphere;
    if (method.lights.point && method.chosen_by_name && method.domain == Domain::kObjectSpace &&
        method.on_exact_kernels && method.on_rounded_kernels && !picky) {
      ids.push_back(method.id);
    }
  }
  return ids;
}

std::vector<MethodSelection> method_variants() {
  std::vector<MethodSelection> variants;
  for (const MethodId id : object_methods()) {
    variants.push_back({id, {}});
    for (const std::string_view name : method_info(id).options) {
      const MethodOption& option = *method_option(name);
      for (const std::string& value : values_of(option)) {
        MethodSelection selection{id, {}};
        if (!option.read(selection.values, value)) {
          throw std::runtime_error(std::string(name) + " does not take " + value);
        }
        if (selection.values != MethodOptionValues{}) variants.push_back(selection);
      }
    }
  }
  return variants;
}

std::string text_of(const MethodSelection& selection) {
  return method_text(selection.id, selection.values);
}

std::string test_name_of(const MethodSelection& selection) {
  std::string name = text_of(selection);
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

ShadowOptions with_method(ShadowOptions options, const MethodSelection& selection) {
  options.method.point = selection.id;
  options.method.options = selection.values;
  return options;
}

}  // namespace gnomon::test
