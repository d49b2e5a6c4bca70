// SPDX-License-Identifier: LGPL-3.0-or-later
// Samples of a picture: at each, which part the eye sees, and which lights reach the point that it
// sees. Methods of image space find them on any kernel; the fragments of a method of object space
// can be sampled, too, so that every method has its picture.
//
// Exactness: on exact kernels every sample is exact; one that lies on a border is decided by moving
// it a little along the picture's frame (gnomon/kernel/image_frame.h). What a sample is:
// docs/image-space.md.
#ifndef GNOMON_ALGORITHMS_PIXELS_H
#define GNOMON_ALGORITHMS_PIXELS_H

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/algorithms/work_counts.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/image_frame.h"
#include "gnomon/kernel/stage_counts.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

struct PixelOptions {
  KernelPolicy kernel;
  MethodId method = MethodId::kZbuffer;  // of either domain
  MethodOptionValues options;            // each method reads its own
  std::vector<std::uint32_t> lights;     // indices into PreparedScene::lights; empty: all
  bool stage_counts = false;             // Pixels::stages (kernel plane)
  bool caster_counts = false;            // Pixels::casters, of methods that count them
  const Scene* scene = nullptr;          // its polygons' names for errors; null: their numbers
  unsigned jobs = 0;                     // threads; 0: as many as processors
  RunControl control;                    // light_done is not called
};

/// Row by row from the top, each from the left.
struct Pixels {
  static constexpr std::uint32_t kNoPart = 0xffffffffu;

  std::string kernel, algorithm;
  bool exact = false;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> lights;  // indices into PreparedScene::lights
  std::vector<std::uint32_t> part;    // the part seen; kNoPart: nothing is
  /// Bit b: the light lights[b] reaches the point that is seen, on the side that is seen.
  std::vector<std::uint64_t> lit_by;
  /// On request, of a method with Method::counts_casters: of each light, all samples of the first
  /// before those of the second, how many parts are between the point and the light. 0 where the
  /// side that is seen does not face the light, and where nothing is seen.
  std::vector<std::int32_t> casters;
  WorkCounts work;
  StageCounts stages;
  double seconds = 0;  // CPU time
  // Of these, of methods with an angular table: what it took to make it, and to look things up.
  double table_seconds = 0, lookup_seconds = 0;

  std::size_t index(ImageSample sample) const { return std::size_t{sample.j} * width + sample.i; }
};

/// Requires: `frame` was prepared with the scene (gnomon/scene/camera.h). Errors: kUsage (an area
/// light, no such light, a kernel that was not built, a method that makes no fragments), kLimit
/// (more than 64 lights), kGeometry (a scene that the method does not take), kInterrupted, and
/// those of compute_shadows() for methods of object space.
Expected<Pixels> compute_pixels(const PreparedScene& scene, const ImageFrame& frame,
                                const PixelOptions& options);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_H
