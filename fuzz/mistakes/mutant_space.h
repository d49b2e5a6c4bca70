// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels with a mistake (mistake.h): a kernel of coordinates as it is, but for what the mistake
// says. They are wrapped around the sound kernel, as kernel/watched/ wraps two, and add what the
// algorithms let a space have besides (scene_bsp.h, svbsp_run.h, split.h).
#ifndef GNOMON_FUZZ_MISTAKES_MUTANT_SPACE_H
#define GNOMON_FUZZ_MISTAKES_MUTANT_SPACE_H

#include <cstdint>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/coordinate/coordinate_space.h"
#include "kernel/coordinate/coordinate_volume_space.h"

namespace gnomon::fuzz {

/// "As polygon fragments get progressively smaller [...], the plane equation that would be
/// calculated for each will also get progressively more inaccurate" (1989, sec. 7): it is
/// calculated all the same, and fragments of one plane are no longer known to be coplanar. Planes
/// [0, planes + edges) are named as by the sound kernel, those of fragments follow.
template <class T>
class FragmentPlanesSceneSpace : public CoordinateSceneSpace<T> {
  using Base = CoordinateSceneSpace<T>;

 public:
  using Vertex = typename Base::Vertex;

  FragmentPlanesSceneSpace(const Geometry& geometry, const KernelOptions& options)
      : Base(geometry, options),
        first_own_(static_cast<std::uint32_t>(geometry.planes.size() + geometry.edges.size())) {}

  /// Through the first three vertices, as they are.
  CoordinatePlane<T> plane_of(const LoopView<Vertex>& loop) const {
    return this->arithmetic().plane_through(loop.vertices[0], loop.vertices[1], loop.vertices[2]);
  }
  PlaneId add_plane_of(const LoopView<Vertex>& loop) {
    own_.push_back(plane_of(loop));
    return first_own_ + static_cast<std::uint32_t>(own_.size() - 1);
  }
  bool is_own(PlaneId id) const { return id >= first_own_; }
  const CoordinatePlane<T>& plane(PlaneId id) const {
    return is_own(id) ? own_[id - first_own_] : Base::support(id);
  }
  Side side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) const {
    if (!is_own(ref.index())) return Base::side_of_plane(ref, corner);
    if (this->arithmetic().identity() &&
        (ref.same_plane(corner.before) || ref.same_plane(corner.after))) {
      return Side::kOn;
    }
    const Side side = this->arithmetic().side(plane(ref.index()), corner.vertex);
    return ref.flipped() ? opposite(side) : side;
  }
  Vertex crossing(PlaneRef ref, PlaneRef, bool, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const {
    return this->arithmetic().crossing(plane(ref.index()), from.vertex, to.vertex);
  }

 private:
  std::uint32_t first_own_;
  std::vector<CoordinatePlane<T>> own_;
};

template <class T>
class FragmentPlanesLightSpace : public CoordinateLightSpace<T> {
  using Base = CoordinateLightSpace<T>;

 public:
  using SceneSpace = FragmentPlanesSceneSpace<T>;
  using Vertex = typename Base::Vertex;

  FragmentPlanesLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options)
      : Base(scene, light, options), fragments_(&scene) {}

  FragmentPlanesLightSpace fork() const { return *this; }
  PlaneRef import_edge(PlaneRef edge, PlaneId support, bool reversed, const Vertex& from,
                       const Vertex& to) {
    // Any support plane's name says that the edge is no input edge.
    return Base::import_edge(fragments_->is_own(edge.index()) ? PlaneRef(0) : edge, support,
                             reversed, from, to);
  }
  Sign light_side(PlaneId plane) const { return Base::light_side_of(fragments_->plane(plane)); }
  /// On which side of a fragment, as its own vertices have it, is the light?
  Sign light_side_of_fragment(const LoopView<typename SceneSpace::Vertex>& loop) const {
    return Base::light_side_of(fragments_->plane_of(loop));
  }

 private:
  SceneSpace* fragments_;
};

/// "The vertex at which a split occurs is also shared among the polygon's fragments" (1992,
/// "Discussion and Implementation"): here each side computes its own, beginning with the end of the
/// edge that it keeps.
template <class T>
class SplitVerticesSceneSpace : public CoordinateSceneSpace<T> {
 public:
  using CoordinateSceneSpace<T>::CoordinateSceneSpace;

  using Vertex = typename CoordinateSceneSpace<T>::Vertex;
  Vertex crossing_of_child(PlaneRef plane, PlaneRef edge, const Corner<Vertex>& kept,
                           const Corner<Vertex>& lost) const {
    return this->crossing(plane, edge, true, kept, lost);
  }
};

template <class T>
class SplitVerticesLightSpace : public CoordinateLightSpace<T> {
  using Base = CoordinateLightSpace<T>;

 public:
  using SceneSpace = SplitVerticesSceneSpace<T>;
  using Vertex = typename Base::Vertex;

  SplitVerticesLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options)
      : Base(scene, light, options) {}
  SplitVerticesLightSpace fork() const { return *this; }
  Vertex crossing_of_child(PlaneRef plane, PlaneRef edge, const Corner<Vertex>& kept,
                           const Corner<Vertex>& lost) const {
    return Base::crossing(plane, edge, true, kept, lost);
  }
};

template <class T>
class SplitVerticesVolumeSpace : public CoordinateVolumeSpace<T> {
  using Base = CoordinateVolumeSpace<T>;

 public:
  using SceneSpace = SplitVerticesSceneSpace<T>;
  using Vertex = typename Base::Vertex;

  SplitVerticesVolumeSpace(const SceneSpace& scene, const KernelOptions& options)
      : Base(scene, options) {}
  SplitVerticesVolumeSpace fork() const { return *this; }
  Vertex crossing_of_child(PlaneRef plane, PlaneRef edge, const Corner<Vertex>& kept,
                           const Corner<Vertex>& lost) const {
    return Base::crossing(plane, edge, true, kept, lost);
  }
};

/// The kernels with their spaces, as the algorithms take them.
struct FragmentPlanesKernel {
  using LightSpace = FragmentPlanesLightSpace<double>;
  using VolumeSpace = CoordinateVolumeSpace<double>;
};
struct SplitVerticesKernel {
  using LightSpace = SplitVerticesLightSpace<double>;
  using VolumeSpace = SplitVerticesVolumeSpace<double>;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_MISTAKES_MUTANT_SPACE_H
