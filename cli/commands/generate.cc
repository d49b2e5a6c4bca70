// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon generate: scenes made by rule, and single scenes of campaigns.
#include "gnomon/scene/generate.h"

#include <memory>

#include "cli/common/commands.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "fuzz/generate/generator.h"
#include "gnomon/scene/write.h"
#include "report/text/table.h"

namespace gnomon::cli {

namespace {

struct GenerateOptions {
  std::string name;
  std::vector<std::string> parameters;
  std::uint64_t seed = 1;
  bool list = false;
  std::string output;
};

std::string default_of(const GeneratorParameter& parameter) {
  if (parameter.words.empty()) return std::to_string(parameter.default_value);
  return parameter.words[static_cast<std::size_t>(parameter.default_value - parameter.minimum)];
}

std::string listing() {
  std::string text;
  for (const GeneratorInfo& info : generators()) {
    using report::wrapped;
    constexpr std::size_t kWidth = report::TextTable::kWidth;
    text += info.name + '\n';
    text += wrapped(info.summary, kWidth, 4, 4);
    if (!info.source.empty()) text += wrapped("(" + info.source + ")", kWidth, 4, 5);
    for (const GeneratorParameter& parameter : info.parameters) {
      text += wrapped(parameter.name + "=" + default_of(parameter) + "  " + parameter.meaning +
                          " (" + values_of(parameter) + ")",
                      kWidth, 6, 8);
    }
  }
  std::string names;
  for (const std::string& name : fuzz::generator_names()) names += " " + name;
  text += "Small degenerate scenes of campaigns (docs/generators.md), by --seed:\n";
  text += report::wrapped(names.substr(1), report::TextTable::kWidth, 4, 4);
  return text;
}

Expected<std::map<std::string, std::int64_t>> parse_parameters(
    const GeneratorInfo& info, const std::vector<std::string>& texts) {
  std::map<std::string, std::int64_t> parameters;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const auto value = equals == std::string::npos
                           ? std::nullopt
                           : parameter_value(info, name, text.substr(equals + 1));
    if (name.empty() || !value) {
      return fail(ErrorCode::kUsage, "--param '" + text + "'",
                  "NAME=WHOLE NUMBER, or a word that --list gives");
    }
    if (!parameters.emplace(name, *value).second) {
      return fail(ErrorCode::kUsage, "--param " + text + ": given twice", "each parameter once");
    }
  }
  return parameters;
}

/// One of the scenes that --list describes, or one that a campaign's generator makes of the seed.
Expected<Scene> scene_by_name(const GenerateOptions& options) {
  if (const GeneratorInfo* const info = generator_by_name(options.name)) {
    const auto parameters = parse_parameters(*info, options.parameters);
    if (!parameters) return tl::unexpected(parameters.error());
    return generate(options.name, *parameters, options.seed);
  }
  const auto generator = fuzz::Generator::parse(options.name);
  if (!generator) {
    // What has no part of a generator's text was meant as a scene's name.
    if (options.name.find_first_of("+:") != std::string::npos) {
      return tl::unexpected(generator.error());
    }
    return fail(ErrorCode::kUsage, "generate: there is no scene '" + options.name + "'",
                "one of those that 'gnomon generate --list' names");
  }
  if (!options.parameters.empty()) {
    return fail(
        ErrorCode::kUsage,
        "--param " + options.parameters.front() + ": '" + options.name + "' has no parameters",
        "--seed alone");
  }
  return generator->make(options.seed).scene;
}

int run_generate(const GenerateOptions& options) {
  if (options.list) {
    const auto done = write_output(options.output, listing());
    return done ? kDone : report_error(done.error());
  }
  if (options.name.empty()) {
    return report_usage("generate: no NAME",
                        "the name of a scene; 'gnomon generate --list' names them");
  }
  SceneFormat format = SceneFormat::kJson;
  if (!options.output.empty() && options.output != "-") {
    const auto by_extension = format_by_extension(options.output);
    if (!by_extension) {
      return report_usage("the name does not say which format to write",
                          "an extension " + shown_written_extensions(), options.output);
    }
    format = *by_extension;
  }
  const auto scene = scene_by_name(options);
  if (!scene) return report_error(scene.error());
  const auto written = scene_to_text(*scene, format);
  if (!written) return report_error(written.error());
  for (const std::string& warning : written->warnings) warn(options.output + ": " + warning);
  const auto done = write_output(options.output, written->text);
  return done ? kDone : report_error(done.error());
}

}  // namespace

void add_generate_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<GenerateOptions>();
  CLI::App& command = *app.add_subcommand(
      "generate", "Make a scene: those of the papers, and families of hard ones");
  command.footer(
      "The same name, parameters and seed give the same scene on every machine.\n\n"
      "Examples:\n"
      "  gnomon generate --list\n"
      "  gnomon generate city --param n=1000 --seed 7 -o city.json\n"
      "  gnomon generate soup-lattice+duplicate --seed 7 -o case.json");
  command.add_option("NAME", options->name,
                     "Which scene, or which generator of campaigns; --list names them");
  repeatable(command.add_option("--param", options->parameters, "A parameter (repeatable)"))
      ->type_name("NAME=N");
  command.add_option("--seed", options->seed, "Seed of what is random")
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--list", options->list, "Print all scenes and their parameters");
  command.add_option("-o,--output", options->output, "Scene file; standard output if absent")
      ->type_name("FILE");
  command.callback([options, &action] { action = [options] { return run_generate(*options); }; });
}

}  // namespace gnomon::cli
