// SPDX-License-Identifier: GPL-3.0-or-later
#include "targets/target_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "targets/result_shares.h"

namespace gnomon::bench {
namespace {

[[noreturn]] void stop(const std::string& path, const std::string& why) {
  fmt::print(stderr, "gnomon_bench: {}: {}\n", path, why);
  std::exit(2);
}

std::string file_name(const SceneRecipe& recipe) {
  std::string name = recipe.generator;
  for (const auto& [parameter, value] : recipe.parameters) {
    name += fmt::format("-{}{}", parameter, value);
  }
  return name;
}

void write_lights(const std::string& path, const std::vector<std::string>& lights) {
  std::ofstream file(path);
  file << fmt::format("{{\"format\": \"gnomon-scene\", \"version\": 1, \"lights\": [\n {}\n]}}\n",
                      fmt::join(lights, ",\n "));
  if (!file.flush()) stop(path, "cannot be written");
}

std::string milliseconds(double seconds) {
  return std::isnan(seconds) ? "-" : short_number(1e3 * seconds) + " ms";
}

/// The result of `shadows`, written to a file and read from it.
ResultShares shares_by(const Command& command, const TargetRun& run, const Words& words) {
  const std::string path = run.files.path("result.json");
  command.shadows(words + Words{"--output", path}, false);
  ResultShares shares = read_shares(path);
  std::filesystem::remove(path);
  return shares;
}

}  // namespace

WorkFiles::WorkFiles() {
  std::string name = (std::filesystem::temp_directory_path() / "gnomon-targets-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) stop(name, "cannot be made");
  directory_ = name;
}

WorkFiles::~WorkFiles() {
  std::error_code ignored;
  std::filesystem::remove_all(directory_, ignored);
}

std::string WorkFiles::scene(const Command& command, const SceneRecipe& recipe) const {
  std::string file = path(file_name(recipe) + ".json");
  if (std::filesystem::exists(file)) return file;
  Words words = {recipe.generator, "--output", file};
  for (const auto& [name, value] : recipe.parameters) {
    words.emplace_back("--param");
    words.push_back(fmt::format("{}={}", name, value));
  }
  command.generate(words);
  return file;
}

std::string WorkFiles::more_lamps(const SceneRecipe& recipe, std::size_t count) const {
  std::string file = path(fmt::format("{}-{}-lamps.json", file_name(recipe), count));
  if (std::filesystem::exists(file)) return file;
  const Position lamp = generated(recipe).lights.at(0).position;
  std::vector<std::string> lights;
  for (std::size_t i = 1; i <= count; ++i) {
    lights.push_back(fmt::format(R"({{"id": "lamp{}", "type": "point", "position": [{}, {}, {}]}})",
                                 i, lamp[0].nearest() + static_cast<double>(i), lamp[1].nearest(),
                                 lamp[2].nearest()));
  }
  write_lights(file, lights);
  return file;
}

std::string WorkFiles::suns(const std::vector<std::array<std::int64_t, 3>>& directions) const {
  std::string file = path(fmt::format("{}-suns.json", directions.size()));
  std::vector<std::string> lights;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    lights.push_back(fmt::format(R"({{"id": "sun{}", "type": "directional", "to_light": [{}]}})", i,
                                 fmt::join(directions[i], ", ")));
  }
  write_lights(file, lights);
  return file;
}

const Words& contour_words() {
  static const Words kWords = {"--algorithm", "contour"};
  return kWords;
}

SizedScene quads(std::int64_t n) {
  return {"quads, " + grouped(static_cast<std::uint64_t>(n + 1)), {"quads", {{"n", n}}, {}}};
}

SizedScene triangles(std::int64_t level) {
  const std::uint64_t count = (std::uint64_t{1} << (2 * level)) + 1;
  return {"triangles, " + grouped(count), {"tetra", {{"level", level}, {"ground", 1}}, {}}};
}

SizedScene city(std::int64_t houses) {
  return {"city, " + grouped(static_cast<std::uint64_t>(5 * houses + 1)),
          {"city", {{"n", houses}}, {}}};
}

std::string before_and_now(double before, double now) {
  return fmt::format("{} -> {}", milliseconds(before), milliseconds(now));
}

void compare_answers(TargetRun& run, const SizedScene& scene, const Words& lights,
                     Compared compared) {
  const Words words = Words{run.files.scene(run.now, scene.recipe)} + lights +
                      (compared == Compared::kRationals ? Words{"--exact-fractions"} : Words{});
  const ResultShares before =
      run.before ? shares_by(*run.before, run, words)
                 : shares_by(run.now, run, words + Words{"--algorithm", "sectors"});
  const ResultShares now = shares_by(run.now, run, words + contour_words());
  const bool rationals = compared == Compared::kRationals;
  const std::string left = rationals ? checksum(before) : "bounds",
                    right = rationals ? checksum(now) : "bounds";
  const bool same =
      before.size() == now.size() && (rationals ? left == right : bounds_overlap(before, now));
  run.answers.add({rationals ? "rationals equal" : "bounds overlap", scene.title,
                   grouped(now.size()), left, right, same ? "yes" : "NO"});
  run.good = run.good && same;
}

}  // namespace gnomon::bench
