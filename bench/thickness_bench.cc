// SPDX-License-Identifier: GPL-3.0-or-later
// Which plane thickness serves a rounded kernel best: wrong parts over families of small scenes,
// with the exact kernel as the judge. The default of the command line comes from here.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "answers.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"

namespace gnomon::bench {
namespace {

struct Family {
  std::string name;
  Parameters parameters;
  std::uint64_t seeds;
};

const std::vector<Family>& families() {
  static const std::vector<Family> kFamilies = {
      {"quads", {{"n", 60}}, 10},
      {"city", {{"n", 30}, {"light", 2}}, 10},
      {"tetra", {{"level", 4}}, 1},
      {"tetra-staircase", {}, 1},
      {"table-chair", {}, 1},
      {"room", {}, 1},
      {"slater-room", {}, 10},
      {"stairs", {{"light", 2}}, 1},
      {"comb", {{"light", 2}}, 1},
      {"nested-boxes", {{"light", 2}}, 1},
      {"coplanar-tiles", {{"light", 2}}, 20},
      {"radial-fan", {{"kind", 0}, {"light", 2}}, 1},
      {"radial-fan", {{"kind", 2}, {"light", 2}}, 1},
      {"touching-boxes", {{"light", 2}}, 20},
      {"lattice", {{"n", 12}, {"light", 2}}, 40},
      {"crossing-sticks", {{"light", 2}}, 20},
      {"grazing", {{"light", 2}}, 40},
      {"pinwheel", {{"n", 4}, {"light", 2}}, 1},
      {"near-coplanar", {{"light", 2}}, 20},
      {"needles", {{"light", 2}}, 20},
  };
  return kFamilies;
}

constexpr std::array<double, 12> kThicknesses{0,     1e-16, 1e-15, 1e-14, 1e-13, 1e-12,
                                              1e-11, 1e-10, 1e-9,  1e-7,  1e-6,  1e-5};

struct Tally {
  std::uint64_t wrong_parts = 0, wrong_scenes = 0;
  double area = 0;  // sum of |fraction - exact|, capped at 1 a part
};

}  // namespace

bool run_thickness(Extent extent) {
  struct Choice {
    std::string name;
    KernelId kernel;
    bool identity;
  };
  const std::array<Choice, 4> choices{{{"float", KernelId::kFloat, false},
                                       {"double", KernelId::kDouble, false},
                                       {"double+identity", KernelId::kDouble, true},
                                       {"longdouble", KernelId::kLongDouble, false}}};
  // tallies[choice][thickness]
  std::vector<std::vector<Tally>> tallies(choices.size(), std::vector<Tally>(kThicknesses.size()));
  std::uint64_t scenes = 0, parts = 0;
  for (const Family& family : families()) {
    const std::uint64_t seeds = extent == Extent::kShort ? 1 : family.seeds;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const PreparedScene scene = make_scene(family.name, family.parameters, seed);
      ShadowOptions options;
      options.method.point =
          MethodId::kSvbsp;  // the papers' method, for which a thickness was meant
      options.output.exact_fractions = true;
      const ExactAnswers exact = exact_answers(shadows_or_stop(scene, options));
      ++scenes;
      parts += exact.lit.size();
      options.output.exact_fractions = false;
      for (std::size_t c = 0; c < choices.size(); ++c) {
        options.kernel.id = choices[c].kernel;
        options.kernel.identity = choices[c].identity;
        for (std::size_t t = 0; t < kThicknesses.size(); ++t) {
          options.kernel.thickness = kThicknesses[t];
          const ShadowResult result = shadows_or_stop(scene, options);
          Tally& tally = tallies[c][t];
          bool wrong = false;
          std::size_t i = 0;
          for (const LightResult& light : result.lights) {
            for (const PartResult& part : light.parts) {
              const double error = std::fabs(part.lit.middle() - exact.lit[i++]);
              const bool off = !(error <= kWrongBeyond);
              tally.wrong_parts += off;
              tally.area += std::isnan(error) ? 1 : std::fmin(error, 1);
              wrong = wrong || off;
            }
          }
          tally.wrong_scenes += wrong;
        }
      }
    }
  }
  fmt::print(
      "\nPlane thickness over {} scenes of {} families ({} part results): scenes with a wrong "
      "part,\nwrong parts (off by more than {:g}), and the sum of their errors in parts.\n",
      grouped(scenes), families().size(), grouped(parts), kWrongBeyond);
  std::vector<std::string> header = {"thickness"};
  for (const Choice& choice : choices) header.push_back(choice.name);
  Table table(header);
  for (std::size_t t = 0; t < kThicknesses.size(); ++t) {
    std::vector<std::string> row = {fmt::format("{:g}", kThicknesses[t])};
    for (std::size_t c = 0; c < choices.size(); ++c) {
      const Tally& tally = tallies[c][t];
      row.push_back(
          fmt::format("{} {:>5} {:>8.3f}", tally.wrong_scenes, tally.wrong_parts, tally.area));
    }
    table.add(std::move(row));
  }
  table.print();
  return true;
}

}  // namespace gnomon::bench
