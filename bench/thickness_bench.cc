// SPDX-License-Identifier: GPL-3.0-or-later
// Which plane thickness serves a rounded kernel best: wrong parts over families of small scenes,
// with the exact kernel as the judge, by each method and also sheared, since planes along the axes
// are friendly to rounding. The default of the command line comes from here.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "answers.h"
#include "comparison/extreme_scenes.h"
#include "gnomon/algorithms/method.h"
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

struct Choice {
  std::string name;
  KernelId kernel;
  bool identity;
};
const std::array<Choice, 4> kChoices{{{"float", KernelId::kFloat, false},
                                      {"double", KernelId::kDouble, false},
                                      {"double+identity", KernelId::kDouble, true},
                                      {"longdouble", KernelId::kLongDouble, false}}};

struct Tally {
  std::uint64_t wrong_parts = 0, wrong_scenes = 0;
  double area = 0;  // sum of |fraction - exact|, capped at 1 a part
};

/// What one method does on all scenes, as they are or sheared.
class Measured {
 public:
  Measured(MethodId method, bool sheared) : method_(method), sheared_(sheared) {}

  void add(Scene scene);
  void print() const;

 private:
  void compare(const ShadowResult& result, const ExactAnswers& exact, Tally& tally) const;

  MethodId method_;
  bool sheared_;
  std::uint64_t scenes_ = 0, parts_ = 0;
  std::array<std::array<Tally, kThicknesses.size()>, kChoices.size()> tallies_{};
};

void Measured::add(Scene scene) {
  if (sheared_) comparison::shear(scene);
  const PreparedScene prepared = prepared_or_stop(scene);
  ShadowOptions options;
  options.method.point = method_;
  options.output.exact_fractions = true;
  const ExactAnswers exact = exact_answers(shadows_or_stop(prepared, options));
  ++scenes_;
  parts_ += exact.lit.size();
  options.output.exact_fractions = false;
  for (std::size_t c = 0; c < kChoices.size(); ++c) {
    options.kernel.id = kChoices[c].kernel;
    options.kernel.identity = kChoices[c].identity;
    for (std::size_t t = 0; t < kThicknesses.size(); ++t) {
      options.kernel.thickness = kThicknesses[t];
      compare(shadows_or_stop(prepared, options), exact, tallies_[c][t]);
    }
  }
}

void Measured::compare(const ShadowResult& result, const ExactAnswers& exact, Tally& tally) const {
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

void Measured::print() const {
  fmt::print(
      "\nPlane thickness by {}{} over {} scenes of {} families ({} part results): scenes with a "
      "wrong\npart, wrong parts (off by more than {:g}), and the sum of their errors in parts.\n",
      method_info(method_).name, sheared_ ? ", sheared," : "", grouped(scenes_), families().size(),
      grouped(parts_), kWrongBeyond);
  std::vector<std::string> header = {"thickness"};
  for (const Choice& choice : kChoices) header.push_back(choice.name);
  Table table(header);
  for (std::size_t t = 0; t < kThicknesses.size(); ++t) {
    std::vector<std::string> row = {fmt::format("{:g}", kThicknesses[t])};
    for (const auto& of_choice : tallies_) {
      const Tally& tally = of_choice[t];
      row.push_back(
          fmt::format("{} {:>5} {:>8.3f}", tally.wrong_scenes, tally.wrong_parts, tally.area));
    }
    table.add(std::move(row));
  }
  table.print();
}

}  // namespace

bool run_thickness(Extent extent) {
  // svbsp is the papers' method, for which a thickness was meant.
  std::vector<Measured> all;
  for (const MethodId method : {MethodId::kSvbsp, MethodId::kSectors}) {
    for (const bool sheared : {false, true}) all.emplace_back(method, sheared);
  }
  for (const Family& family : families()) {
    const std::uint64_t seeds = extent == Extent::kShort ? 1 : family.seeds;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      for (Measured& measured : all) {
        measured.add(generated({family.name, family.parameters}, seed));
      }
    }
  }
  for (const Measured& measured : all) measured.print();
  return true;
}

}  // namespace gnomon::bench
