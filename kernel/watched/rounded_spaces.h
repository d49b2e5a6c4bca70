// SPDX-License-Identifier: LGPL-3.0-or-later
// A rounded kernel behind virtual functions, so that methods that are watched are compiled once and
// not once for each rounded kernel. The functions are those of the concepts (kernel_concept.h);
// vertices are in long double, which holds those of every rounded kernel exactly.
#ifndef GNOMON_KERNEL_WATCHED_ROUNDED_SPACES_H
#define GNOMON_KERNEL_WATCHED_ROUNDED_SPACES_H

#include <array>
#include <cstdint>
#include <memory>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "kernel/concept/light_space.h"
#include "kernel/signs/corner.h"

namespace gnomon {

struct WideVertex {
  std::array<long double, 3> x{};
  VertexId source = kMadeVertex;
};
using WideCorner = Corner<WideVertex>;

/// What both a light's space and one in three dimensions have.
class RoundedPlanes {
 public:
  virtual ~RoundedPlanes() = default;
  virtual Side side_of_plane(PlaneRef plane, const WideCorner& corner) = 0;
  virtual WideVertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const WideCorner& from,
                              const WideCorner& to) const = 0;
};

class RoundedLight : public RoundedPlanes {
 public:
  virtual std::unique_ptr<RoundedLight> fork() const = 0;
  virtual Sign light_side(PlaneId plane) const = 0;
  virtual PlaneRef import_edge(PlaneRef edge, PlaneId support, bool reversed,
                               const WideVertex& from, const WideVertex& to) = 0;
  virtual PlaneRef shadow_plane(PlaneRef edge, const WideVertex& from, const WideVertex& to) = 0;
  virtual PlaneRef add_prefix_plane(const PrefixPlane& plane) = 0;
  virtual PlaneRef cut_of_supports(PlaneId first, PlaneId second) = 0;
  virtual Side side_of_support(PlaneId plane, const WideCorner& corner) = 0;
  virtual std::uint32_t plane_mark() const = 0;
  virtual void release_planes(std::uint32_t mark) = 0;
};

class RoundedVolume : public RoundedPlanes {
 public:
  virtual std::unique_ptr<RoundedVolume> fork() const = 0;
  virtual PlaneRef add_plane(const WideCorner& a, const WideCorner& b, const WideCorner& c) = 0;
  virtual PlaneRef add_plane(const WideCorner& a, const WideCorner& b,
                             const LightPoint& direction) = 0;
  virtual PlaneRef add_axis_plane(int axis, double value) = 0;
  virtual WideVertex axis_point(const std::array<double, 3>& fractions) const = 0;
  virtual std::uint32_t plane_mark() const = 0;
  virtual void release_planes(std::uint32_t mark) = 0;
};

class RoundedScene : public RoundedPlanes {
 public:
  virtual WideVertex input_vertex(VertexId vertex) const = 0;
  /// Bits of the kernel's numbers.
  virtual int digits() const = 0;
  /// The scene must outlive both.
  virtual std::unique_ptr<RoundedLight> light(const LightPoint& light) = 0;
  virtual std::unique_ptr<RoundedVolume> volume() const = 0;
};

/// run() makes the scene space of one rounded kernel. Defined in rounded_spaces_of.h, which CMake
/// compiles for each of them.
template <class Kernel>
struct RoundedSpacesOf {
  static std::unique_ptr<RoundedScene> run(const Geometry& geometry, const KernelOptions& options);
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_WATCHED_ROUNDED_SPACES_H
