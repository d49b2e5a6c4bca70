// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/zoo/zoo.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "fuzz/generate/generator.h"
#include "fuzz/zoo/zoo_case.h"
#include "report/text/table.h"
#include "scene/base/random.h"

namespace gnomon::fuzz {

namespace {

constexpr std::string_view kPointScenes = "mix", kAreaScenes = "area-mix";
constexpr std::string_view kTVertex = "t-vertex";
constexpr std::string_view kWrongLight = "wrong light", kWrongPolygon = "wrong polygon seen";

/// ridge-edges with nothing that is wrong without a mistake, and on scenes that are no solids.
constexpr std::string_view kAnyPolygons =
    "plane/ridge-edges:rows=exact,depth=facing,hemisphere=cube";

constexpr std::array kZoo = {
    ZooEntry{"planes-from-fragments", Mistake::kPlanesFromFragments, "double+identity+thin/svbsp",
             "soup-lattice", "misclassified"},
    ZooEntry{"vertices-per-side", Mistake::kVerticesPerSide, "double+thin/svbsp", "soup-lattice",
             "misclassified"},
    ZooEntry{"coplanar-in-sequence", Mistake::kCoplanarInSequence, "plane/svbsp", kPointScenes,
             "misclassified"},
    ZooEntry{"light-in-plane-faces", Mistake::kLightInPlaneFaces, "rational/svbsp", kPointScenes,
             "misclassified"},
    ZooEntry{"union-without-continued-planes", Mistake::kUnionWithoutContinuedPlanes,
             "plane/sectors/merged", kAreaScenes, "misclassified"},
    ZooEntry{"thickness-too-large", Mistake::kThicknessTooLarge, "double", kPointScenes,
             "misclassified"},
    ZooEntry{"thickness-too-small", Mistake::kThicknessTooSmall, "double/svbsp", kPointScenes,
             "misclassified"},
    ZooEntry{"t-vertices-left-in", Mistake::kTVerticesLeftIn, "plane/svbsp", kPointScenes,
             kTVertex},
    ZooEntry{"straddling-light-faces", Mistake::kStraddlingLightFaces, "plane", kAreaScenes,
             "misclassified"},
    ZooEntry{"slivers-dropped", Mistake::kSliversDropped, "plane/svbsp", kPointScenes, "uncovered"},
    ZooEntry{"on-swapped", Mistake::kOnSwapped, "plane", kPointScenes, "misclassified"},
    ZooEntry{"coplanar-dies-early", Mistake::kCoplanarDiesEarly, "plane/basic", kPointScenes,
             "misclassified"},
    ZooEntry{"tile-closed-early", Mistake::kTileClosedEarly, "plane/tiling:tiles=4", kPointScenes,
             "misclassified"},
    ZooEntry{"closed-tile-keeps-dead", Mistake::kClosedTileKeepsDead, "plane/tiling:tiles=32",
             "family-small-lattice", "misclassified"},
    ZooEntry{"bsp-edges-left-out", Mistake::kBspEdgesLeftOut, "plane/svbsp", kPointScenes,
             "misclassified"},
    ZooEntry{"support-before-edges", Mistake::kSupportBeforeEdges, "plane/svbsp-full", kPointScenes,
             "misclassified"},
    ZooEntry{"collinear-left-out", Mistake::kCollinearLeftOut, "plane/contour", kPointScenes,
             "misclassified"},
    ZooEntry{"caster-sets-differ", Mistake::kCasterSetsDiffer, "plane/contour", kPointScenes,
             "misclassified"},
    ZooEntry{"far-corner-decides", Mistake::kFarCornerDecides, "plane/contour", kPointScenes,
             "misclassified"},
    ZooEntry{"tie-turns-plane", Mistake::kTieTurnsPlane, "plane/zbuffer", "family-small-lattice",
             kWrongLight},
    ZooEntry{"backs-hide", Mistake::kBacksHide, "plane/zbuffer", kPointScenes, kWrongPolygon},
    ZooEntry{"eye-always-lit", Mistake::kEyeAlwaysLit, "plane/shadow-polygons", kPointScenes,
             kWrongLight},
    ZooEntry{"eye-by-first-surface", Mistake::kEyeByFirstSurface, "plane/shadow-polygons",
             kPointScenes, kWrongLight},
    ZooEntry{"eye-counted-once", Mistake::kEyeCountedOnce, "plane/shadow-polygons", kPointScenes,
             kWrongLight},
    ZooEntry{"walls-keep-order", Mistake::kWallsKeepOrder, "plane/shadow-polygons", kPointScenes,
             kWrongLight},
    ZooEntry{"one-perspective", Mistake::kOnePerspective, "plane/shadow-polygons", kPointScenes,
             kWrongLight},
    ZooEntry{"combined-bit-lost", Mistake::kCombinedBitLost, "plane/svbsp:merge=convex",
             kPointScenes, "misclassified"},
    ZooEntry{"blot-absorbed-early", Mistake::kBlotAbsorbedEarly, "plane/blots",
             "family-small-lattice", "misclassified"},
    ZooEntry{"pairs-in-order", Mistake::kPairsInOrder, kAnyPolygons, "family-frames", kWrongLight},
    ZooEntry{"holes-without-direction", Mistake::kHolesWithoutDirection, kAnyPolygons,
             "family-frames", kWrongLight},
    ZooEntry{"hidden-depth-strict", Mistake::kHiddenDepthStrict,
             "plane/ridge-edges:rows=exact,hemisphere=cube", "family-closed-boxes", kWrongLight},
    ZooEntry{"area-on-swapped", Mistake::kOnSwapped, "plane", kAreaScenes, "misclassified"},
};

/// Are all fragments the same, corner by corner, and all shares?
bool same(const ShadowResult& a, const ShadowResult& b) {
  const bool same_together =
      a.combined_exact_points == b.combined_exact_points &&
      std::ranges::equal(a.combined, b.combined,
                         [](const CombinedFragment& f, const CombinedFragment& g) {
                           return f.part == g.part && f.side == g.side && f.count == g.count &&
                                  f.lit_by == g.lit_by && f.penumbra_of == g.penumbra_of;
                         });
  return same_together &&
         std::ranges::equal(a.lights, b.lights, [](const LightResult& one, const LightResult& two) {
           return one.exact_points == two.exact_points &&
                  std::ranges::equal(one.exact_fractions, two.exact_fractions, {},
                                     &ExactFractions::lit, &ExactFractions::lit) &&
                  std::ranges::equal(one.parts, two.parts,
                                     [](const PartResult& p, const PartResult& q) {
                                       return p.part == q.part && p.side == q.side &&
                                              p.reason == q.reason &&
                                              p.fragment_count == q.fragment_count;
                                     }) &&
                  std::ranges::equal(one.fragments, two.fragments,
                                     [](const Fragment& f, const Fragment& g) {
                                       return f.state == g.state && f.caster == g.caster &&
                                              f.reason == g.reason && f.count == g.count;
                                     });
         });
}

Expected<ZooVerdict> judge_shadows(const ZooEntry& entry, const ZooCase& zoo_case) {
  ZooVerdict verdict;
  const auto wrong = zoo_case.shadows(entry.mistake);
  if (!wrong) return tl::unexpected(wrong.error());
  const auto right = zoo_case.shadows(Mistake::kNone);
  if (!right) return tl::unexpected(right.error());
  // The oracle takes far longer than the subjects, and on most scenes no mistake is made at all.
  if (same(*wrong, *right)) return verdict;
  const Claims candidate = zoo_case.candidate_of(*wrong, entry.mutant());
  const oracle::Report report = zoo_case.certified(candidate);
  verdict.mutant.regions = report.verdict == oracle::Verdict::kFailed;
  if (!verdict.mutant.regions) return verdict;
  if (report.worst) {
    verdict.disagreement = oracle::name_of(report.worst->kind);
    verdict.text = report.worst->text;
  }
  const Claims sound = zoo_case.candidate_of(*right, std::string(entry.sound));
  verdict.sound_fails =
      zoo_case.certified(sound).verdict == oracle::Verdict::kFailed || !zoo_case.claims_hold(sound);
  if (verdict.sound_fails) return verdict;
  verdict.mutant.points =
      zoo_case.certified_by_points(candidate).verdict == oracle::Verdict::kFailed;
  verdict.mutant.claims = !zoo_case.claims_hold(candidate);
  return verdict;
}

Expected<ZooVerdict> judge_meshes(const ZooEntry& entry, const ZooCase& zoo_case) {
  ZooVerdict verdict;
  for (std::uint32_t light = 0; light < zoo_case.prepared().lights.size(); ++light) {
    const auto wrong = zoo_case.mesh(light, entry.mistake);
    if (!wrong) return tl::unexpected(wrong.error());
    const auto right = zoo_case.mesh(light, Mistake::kNone);
    if (!right) return tl::unexpected(right.error());
    verdict.sound_fails = verdict.sound_fails || zoo_case.check(*right).t_vertices > 0;
    const oracle::MeshReport report = zoo_case.check(*wrong);
    if (report.t_vertices == 0) continue;
    verdict.mutant.mesh = true;
    verdict.disagreement = kTVertex;
    verdict.jump = std::max(verdict.jump, report.largest_jump);
    verdict.text = fmt::format("T-vertices: {}; the shade jumps by {:.3g}", report.t_vertices,
                               report.largest_jump);
  }
  return verdict;
}

Expected<ZooVerdict> judge_pictures(const ZooEntry& entry, const ZooCase& zoo_case) {
  ZooVerdict verdict;
  const auto wrong = zoo_case.picture(entry.mistake);
  if (!wrong) return tl::unexpected(wrong.error());
  if (!*wrong) return verdict;
  verdict.mutant.samples = true;
  verdict.disagreement = (*wrong)->disagreement();
  verdict.text = (*wrong)->text(zoo_case.scene());
  const auto right = zoo_case.picture(Mistake::kNone);
  if (!right) return tl::unexpected(right.error());
  verdict.sound_fails = right->has_value();
  return verdict;
}

}  // namespace

std::string ZooEntry::mutant() const {
  return std::string(sound) + '~' + std::string(name_of(mistake));
}

std::span<const ZooEntry> zoo() { return kZoo; }

const ZooEntry* zoo_entry(std::string_view name) {
  const auto at = std::ranges::find(kZoo, name, &ZooEntry::name);
  return at == kZoo.end() ? nullptr : &*at;
}

Expected<ZooVerdict> judge_mutant(const ZooEntry& entry, const Scene& scene) {
  Expected<PreparedScene> prepared = prepare(scene);
  if (!prepared) return tl::unexpected(prepared.error());
  const ZooCase zoo_case(entry, scene, std::move(*prepared));
  if (zoo_case.makes_pictures()) return judge_pictures(entry, zoo_case);
  return entry.mistake == Mistake::kTVerticesLeftIn ? judge_meshes(entry, zoo_case)
                                                    : judge_shadows(entry, zoo_case);
}

Expected<ZooRow> hunt(const ZooEntry& entry, std::uint64_t seed, std::uint64_t most_scenes) {
  const Expected<Generator> generator = Generator::parse(entry.generator);
  if (!generator) return tl::unexpected(generator.error());
  ZooRow row;
  row.name = entry.name;
  for (const MistakeInfo& info : mistakes()) {
    if (info.mistake == entry.mistake) row.mistake = info.sentence;
  }
  row.mutant = entry.mutant();
  row.seed = seed;
  Random random(seed);
  while (!row.found && row.scenes < most_scenes) {
    MadeScene made = generator->make(random.next());
    ++row.scenes;
    // Where a scene has no light for the mistake, or makes too much, the hunt goes on.
    const Expected<ZooVerdict> verdict = judge_mutant(entry, made.scene);
    if (!verdict || !verdict->shows()) continue;
    row.found = true;
    row.scene = std::move(made.scene);
    row.verdict = *verdict;
  }
  return row;
}

Expected<ZooTally> hunt_often(const ZooEntry& entry, std::uint64_t hunts,
                              std::uint64_t most_scenes) {
  ZooTally tally;
  tally.entry = &entry;
  tally.hunts = hunts;
  std::vector<std::uint64_t> scenes;
  for (std::uint64_t seed = 1; seed <= hunts; ++seed) {
    const Expected<ZooRow> row = hunt(entry, seed, most_scenes);
    if (!row) return tl::unexpected(row.error());
    scenes.push_back(row->scenes);
    if (!row->found) continue;
    ++tally.found;
    tally.regions += row->verdict.mutant.regions ? 1 : 0;
    tally.points += row->verdict.mutant.points ? 1 : 0;
    tally.claims += row->verdict.mutant.claims ? 1 : 0;
    tally.mesh += row->verdict.mutant.mesh ? 1 : 0;
    tally.samples += row->verdict.mutant.samples ? 1 : 0;
  }
  if (scenes.empty()) return tally;
  std::ranges::sort(scenes);
  tally.median = scenes[(scenes.size() - 1) / 2];
  tally.most = scenes.back();
  return tally;
}

std::string zoo_table(std::span<const ZooTally> tallies) {
  using report::Align;
  report::TextTable table({{"mutant"},
                           {"scenes", Align::kRight},
                           {"found", Align::kRight},
                           {"median", Align::kRight},
                           {"most", Align::kRight},
                           {"noticed by"}});
  for (const ZooTally& tally : tallies) {
    std::string ways;
    for (const auto& [name, count] :
         {std::pair<std::string_view, std::uint64_t>{"regions", tally.regions},
          {"points", tally.points},
          {"claims", tally.claims},
          {"mesh", tally.mesh},
          {"samples", tally.samples}}) {
      if (count == 0) continue;
      ways += (ways.empty() ? "" : ", ") + std::string(name);
      if (count < tally.found) ways += ' ' + std::to_string(count);
    }
    table.add_row({tally.entry->mutant(), std::string(tally.entry->generator),
                   std::to_string(tally.found) + '/' + std::to_string(tally.hunts),
                   std::to_string(tally.median), std::to_string(tally.most), ways});
  }
  return table.to_string();
}

}  // namespace gnomon::fuzz
