// SPDX-License-Identifier: LGPL-3.0-or-later
// The table of methods: every way to shadows that this library has, with its source, what it takes
// and what it can put out. The command line, its help, the fuzzer's subjects and the benchmarks
// read it; nothing else lists methods.
#ifndef GNOMON_ALGORITHMS_METHOD_H
#define GNOMON_ALGORITHMS_METHOD_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/work_counts.h"

namespace gnomon {

enum class MethodId : std::uint8_t {
  // Of area lights receiver; of others svbsp where lights are combined, contour where an exact
  // kernel
  // is asked for classes and nearest shares alone, else sectors.
  kAutomatic,
  kSectors,
  kSvbsp,
  kReceiver,
  kMerged,
  kPieces,
  kBasic,
  kTiling,
  kSvbspFull,
  kTwoPass,
  kBlots,
  kContour,
  // Of image space:
  kZbuffer,
  kShadowPolygons,
  kScanOut,
  kRidgeEdges,
};

/// Where a method finds its regions: on the polygons themselves, or in a picture of them.
enum class Domain : std::uint8_t { kObjectSpace, kImageSpace };

/// The lights that a question is about; `point` stands for directional lights, too.
struct LightKinds {
  bool point = false, area = false;
};

/// What a scene must be for a method to take it.
struct MethodNeeds {
  bool closed_meshes = false, camera = false, one_hemisphere = false;
};

struct Method {
  MethodId id = MethodId::kAutomatic;
  std::string_view name;     // on the command line and in results
  std::string_view summary;  // a clause for help texts, in parentheses after the name
  std::string_view source;   // paper and section
  LightKinds lights;         // the lights that it takes
  bool on_rounded_kernels = true, on_exact_kernels = true;
  Domain domain = Domain::kObjectSpace;
  bool chosen_by_name = true;  // false: an option of another method stands for it
  MethodNeeds needs = {};
  // What it can put out or be asked besides classified fragments with witnesses:
  bool combines_lights = false;   // the set of lights that reach each fragment
  bool explains = false;          // the first decision on which a rounded kernel goes wrong
  bool leaves_out_steps = false;  // runs without the balanced prefix, and without merging fragments
  bool moves_lights = false;      // lights together, step by step (ShadowOptions::steps)
  bool overlays = false;          // shadows painted over polygons (Cover::kOverlay)
  bool threads = false;           // runs on several
  bool names_casters = true;      // of every fragment in shadow, the polygon that hides it
  bool makes_fragments = true;    // else it tells classes and shares alone
  bool counts_casters = false;    // of each sample, those between it and the light
  std::span<const std::string_view> options = {};  // names of method_option()
  std::span<const Counter> counters = {};          // those that it fills
};

/// The rows of one domain, in the order of the documents; kAutomatic is no row. Methods of image
/// space are run by compute_pixels(), not by compute_shadows().
std::span<const Method> methods(Domain domain = Domain::kObjectSpace);
/// Where a method finds its regions, in words: "object space".
std::string_view name_of(Domain domain);
/// What a scene must be, in words: "closed meshes", ...; none if any scene will do.
std::vector<std::string_view> names_of(const MethodNeeds& needs);
/// "point, directional", "area", or all three.
std::string name_of(LightKinds lights);
/// What the method can besides classifying, in words: "combined", "explain", "moving", "overlay",
/// "threads", "witness".
std::vector<std::string_view> abilities(const Method& method);

/// Requires: not kAutomatic.
const Method& method_info(MethodId id);
/// The method of this domain that is chosen by this name; none for "auto".
std::optional<MethodId> method_by_name(std::string_view name, Domain domain = Domain::kObjectSpace);
/// Names of the methods of this domain that take lights of one of these kinds and are chosen by
/// name, joined by ", ".
std::string method_names(LightKinds lights, Domain domain = Domain::kObjectSpace);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_METHOD_H
