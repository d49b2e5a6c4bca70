// SPDX-License-Identifier: GPL-3.0-or-later
// What is under test: one of our kernels under a policy, by one of our algorithms, perhaps a
// variant that is wrong on purpose; or a foreign program. Each has a name that makes it again.
#ifndef GNOMON_FUZZ_CHECK_SUBJECT_H
#define GNOMON_FUZZ_CHECK_SUBJECT_H

#include <optional>
#include <string>
#include <string_view>

#include "fuzz/mistakes/mistake.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/kernel_choice.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct Subject {
  KernelChoice kernel;
  MethodId algorithm = MethodId::kSectors;        // of point and directional lights
  MethodId area_algorithm = MethodId::kReceiver;  // of area lights
  MethodOptionValues options = {};                // of both algorithms
  Mistake mistake = Mistake::kNone;
  // A foreign program: a command line, run by the shell with the scene's file as its last argument;
  // the result is its standard output. Not empty: nothing above counts.
  std::string command;

  bool foreign() const { return !command.empty(); }
  /// Anything but the exact answer is a bug of ours.
  bool exact() const {
    return !foreign() && kernel.exact() && mistake == Mistake::kNone &&
           options.interpolation == Interpolation::kPlane;
  }
  friend bool operator==(const Subject&, const Subject&) = default;
};

/// KERNEL[+identity][+thin][/ALGORITHM[/AREA-ALGORITHM]][~MISTAKE], such as "double+identity",
/// "plane/svbsp/merged", "plane/tiling:tiles=8" or "plane/svbsp~coplanar-in-sequence"; algorithms
/// that are the default are left out. A foreign program's name is "command:" and its command line.
std::string name_of(const Subject& subject);
/// Errors: kUsage, with the names that there are; for a mistake that changes nothing of what that
/// kernel and those algorithms do.
Expected<Subject> parse_subject(std::string_view text);

/// Whether it can classify these lights together, and its mistake, if it has one, may be made then.
bool combines(const Subject& subject, const Scene& scene);

/// Options that run it, but for its mistake: exact points kept, exact fractions if it has them, one
/// thread. compute_shadows(scene, options, subject.mistake) adds the mistake (mistakes/compute.h).
ShadowOptions shadow_options(const Subject& subject);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_SUBJECT_H
