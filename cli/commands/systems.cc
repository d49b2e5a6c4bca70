// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon systems: the table of methods, for people and for programs.
#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/common/commands.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "gnomon/algorithms/method.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/work_counts.h"
#include "report/json/json_writer.h"
#include "report/text/table.h"
#include "report/text/text_sink.h"

namespace gnomon::cli {

namespace {

struct SystemsOptions {
  std::string name;
  std::string json;
};

template <class Texts>
std::string joined(const Texts& texts, const std::string& none) {
  std::string text;
  for (const auto& each : texts) text += (text.empty() ? "" : ", ") + std::string(each);
  return text.empty() ? none : text;
}

/// On which kernels it runs; nothing to say where it runs on all of them.
std::string kernels_of(const Method& method) {
  if (method.on_rounded_kernels && method.on_exact_kernels) return "all";
  return method.on_exact_kernels ? "exact ones alone" : "rounded ones alone";
}

std::string default_of(const MethodOption& option) { return option.text(MethodOptionValues{}); }

class Listing {
 public:
  /// The title and the facts that fit a line each.
  void add(const Method& method) {
    text_ += std::string(method.name) + "\n";
    line(std::string(method.summary), 4);
    line("(" + std::string(method.source) + ")", 4);
    std::string facts = "lights: " + name_of(method.lights) + "; " +
                        std::string(name_of(method.domain)) +
                        "; needs: " + joined(names_of(method.needs), "nothing") +
                        "; can: " + joined(abilities(method), "nothing more");
    if (method.domain == Domain::kImageSpace) {
      facts += "; run by gnomon pixels";
    } else if (!method.makes_fragments) {
      facts += "; tells classes and shares alone";
    }
    if (kernels_of(method) != "all") facts += "; kernels: " + kernels_of(method);
    if (!method.chosen_by_name) facts += "; chosen by an option, as --pieces";
    line(facts, 6);
  }

  /// Options by name and counters by name.
  void add_names(const Method& method) {
    std::vector<std::string> options, counters;
    for (const std::string_view name : method.options) {
      options.push_back(std::string(name) + '=' + default_of(*method_option(name)));
    }
    for (const Counter counter : method.counters) {
      counters.emplace_back(counter_info(counter).name);
    }
    if (!options.empty()) line("options: " + joined(options, ""), 6);
    if (!counters.empty()) line("counts: " + joined(counters, ""), 6);
  }

  /// A line for each option and each counter.
  void add_details(const Method& method) {
    line(method.options.empty() ? "options: none" : "options:", 6);
    for (const std::string_view name : method.options) {
      const MethodOption& option = *method_option(name);
      line(std::string(name) + '=' + default_of(option) + ": " + std::string(option.summary) +
               " (" + std::string(option.values) + ")",
           8);
    }
    line(method.counters.empty() ? "counts: nothing" : "counts:", 6);
    for (const Counter counter : method.counters) {
      const CounterInfo& info = counter_info(counter);
      line(std::string(info.name) + ": " + std::string(info.summary) +
               (info.kind == CountKind::kMost ? "; the largest of several" : ""),
           8);
    }
  }

  const std::string& text() const { return text_; }

 private:
  void line(const std::string& text, std::size_t indent) {
    text_ += report::wrapped(text, report::TextTable::kWidth, indent, indent + 2);
  }

  std::string text_;
};

void write_texts(report::JsonWriter& json, std::string_view key,
                 std::span<const std::string_view> texts) {
  json.key(key);
  json.begin_array(report::JsonLayout::kInline);
  for (const std::string_view text : texts) json.value(text);
  json.end_array();
}

void write_method(report::JsonWriter& json, const Method& method) {
  using report::JsonLayout;
  json.begin_object();
  json.member("name", method.name);
  json.member("summary", method.summary);
  json.member("source", method.source);
  std::vector<std::string_view> lights;
  if (method.lights.point) lights = {"point", "directional"};
  if (method.lights.area) lights.emplace_back("area");
  write_texts(json, "lights", lights);
  json.member("domain", name_of(method.domain));
  write_texts(json, "needs", names_of(method.needs));
  write_texts(json, "can", abilities(method));
  json.member("fragments", method.makes_fragments);
  json.member("kernels", kernels_of(method));
  json.member("chosen_by_name", method.chosen_by_name);
  json.key("options");
  json.begin_array();
  for (const std::string_view name : method.options) {
    const MethodOption& option = *method_option(name);
    json.begin_object(JsonLayout::kInline);
    json.member("name", option.name);
    json.member("values", option.values);
    json.member("default", default_of(option));
    json.member("summary", option.summary);
    json.end_object();
  }
  json.end_array();
  json.key("counters");
  json.begin_array();
  for (const Counter counter : method.counters) {
    const CounterInfo& info = counter_info(counter);
    json.begin_object(JsonLayout::kInline);
    json.member("name", info.name);
    json.member("summary", info.summary);
    json.member("several", info.kind == CountKind::kSum ? "sum" : "largest");
    json.member("share", info.denominator != 1);
    json.end_object();
  }
  json.end_array();
  json.end_object();
}

std::string json_text(std::span<const Method> listed) {
  report::StringSink sink;
  {
    report::JsonWriter json(sink);
    json.begin_object();
    json.member("format", "gnomon-systems");
    json.member("version", 1);
    json.key("systems");
    json.begin_array();
    for (const Method& method : listed) write_method(json, method);
    json.end_array();
    json.end_object();
    json.finish();
  }
  return sink.text();
}

int run_systems(const SystemsOptions& options) {
  std::vector<Method> listed;
  for (const Domain domain : {Domain::kObjectSpace, Domain::kImageSpace}) {
    std::ranges::copy(methods(domain), std::back_inserter(listed));
  }
  if (!options.name.empty()) {
    std::vector<std::string_view> names;
    for (const Method& method : listed) names.push_back(method.name);
    std::erase_if(listed, [&](const Method& method) { return method.name != options.name; });
    if (listed.empty()) {
      return report_usage("systems: there is no system '" + options.name + "'",
                          "one of: " + joined(names, ""));
    }
  }
  if (options.json != "-") {
    Listing listing;
    for (const Method& method : listed) {
      listing.add(method);
      options.name.empty() ? listing.add_names(method) : listing.add_details(method);
    }
    if (auto done = write_output({}, listing.text()); !done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    const auto done = write_output(options.json, json_text(listed));
    if (!done) return report_error(done.error());
  }
  return kDone;
}

}  // namespace

void add_systems_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<SystemsOptions>();
  CLI::App& command = *app.add_subcommand(
      "systems", "The systems of the papers: what each takes, can, counts, and its options");
  command.footer("Example:\n  gnomon systems tiling");
  command.add_option("NAME", options->name, "This one in full; all of them if absent");
  command
      .add_option("--json", options->json, "Write the same as JSON; - for standard output alone")
      ->type_name("FILE");
  command.callback([options, &action] { action = [options] { return run_systems(*options); }; });
}

}  // namespace gnomon::cli
