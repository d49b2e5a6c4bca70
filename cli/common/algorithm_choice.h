// SPDX-License-Identifier: GPL-3.0-or-later
// Methods as they are named on the command line: those of the table of methods, `auto`, and for
// commands that compare, `both` and `all`.
#ifndef GNOMON_CLI_COMMON_ALGORITHM_CHOICE_H
#define GNOMON_CLI_COMMON_ALGORITHM_CHOICE_H

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

inline constexpr std::string_view kAutomaticName = "auto";
/// For commands that take each of them.
inline constexpr std::string_view kBothName = "both";
inline constexpr std::string_view kAllName = "all";

/// --kernel of a command that runs one, into `name`, whose value is the default.
CLI::Option* add_kernel_option(CLI::App& command, std::string& name);

/// --algorithm, into `name`. `question` opens the help text, `besides` says what the command takes
/// beyond names of methods.
CLI::Option* add_algorithm_option(
    CLI::App& command, std::string& name, std::string_view question = "How shadows are found.",
    std::string_view besides = "auto: sectors and receiver wherever they can do what is asked");

/// An option of the command line that only some methods can serve, and whether it was given.
struct NeedyOption {
  std::string_view name;  // such as "--combined"
  bool given = false;
  bool Method::*ability;  // what the method needs for it
};

struct AlgorithmChoice {
  MethodId point = MethodId::kSectors;  // for point and directional lights
  MethodId area = MethodId::kReceiver;
  MethodOptionValues options = {};  // of both

  /// Whether shadows are painted over polygons that stay whole.
  bool paints() const { return options.cover == Cover::kOverlay; }
  void apply(MethodChoice& method) const {
    method.point = point;
    method.area = area;
    method.options = options;
  }
  /// Such as "sectors", "merged" or "sectors+receiver", by the lights that there are.
  std::string name(const LoadedScene& loaded) const;
  friend bool operator==(const AlgorithmChoice&, const AlgorithmChoice&) = default;
};

/// NAME[:option=value,...]. `auto` is sectors and receiver; where one of `needs` was given, the
/// first method of point lights that can serve it stands for sectors, unless sectors was asked for
/// by name. Errors: kUsage, for an unknown name (`also`: what the command takes besides), and for a
/// method that cannot do what was asked.
Expected<AlgorithmChoice> parse_algorithm_choice(std::string_view name,
                                                 std::initializer_list<NeedyOption> needs = {},
                                                 std::string_view also = {});

/// The methods that `both` (sectors and receiver, then svbsp and merged) or `all` (every method
/// that takes lights of the scene) stands for; none if `name` is neither. As with `auto`, a method
/// of point lights that cannot serve one of `needs` gives way to the first that can.
std::vector<AlgorithmChoice> several_algorithms(std::string_view name,
                                                std::initializer_list<NeedyOption> needs = {});
/// Names of the methods that can do this, joined by ", ".
std::string methods_that(bool Method::*ability);

/// Leaves out choices that are the same methods as one before for the lights that there are, and,
/// of several, contour where a light has a region, which it does not know.
void drop_repeats(std::vector<AlgorithmChoice>& choices, const LoadedScene& loaded);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_ALGORITHM_CHOICE_H
