// SPDX-License-Identifier: LGPL-3.0-or-later
// The bodies behind rounded_spaces.h for one kernel whose vertices are coordinates.
#ifndef GNOMON_KERNEL_WATCHED_ROUNDED_SPACES_OF_H
#define GNOMON_KERNEL_WATCHED_ROUNDED_SPACES_OF_H

#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "kernel/watched/rounded_spaces.h"

namespace gnomon::rounded_detail {

template <class Vertex>
using Number = std::remove_cvref_t<decltype(std::declval<Vertex>().x[0])>;

template <class Vertex>
Vertex narrow(const WideVertex& wide) {
  Vertex vertex;
  for (std::size_t k = 0; k < 3; ++k) vertex.x[k] = static_cast<Number<Vertex>>(wide.x[k]);
  vertex.source = wide.source;
  return vertex;
}

template <class Vertex>
WideVertex widen(const Vertex& vertex) {
  return {{vertex.x[0], vertex.x[1], vertex.x[2]}, vertex.source};
}

/// A corner of the kernel's own, with the vertex that it refers to.
template <class Vertex>
class OwnCorner {
 public:
  explicit OwnCorner(const WideCorner& wide)
      : vertex_(narrow<Vertex>(wide.vertex)),
        corner_{wide.before, vertex_, wide.after, wide.support} {}
  OwnCorner(const OwnCorner&) = delete;
  OwnCorner& operator=(const OwnCorner&) = delete;
  const Corner<Vertex>& operator*() const { return corner_; }

 private:
  Vertex vertex_;
  Corner<Vertex> corner_;
};

/// The two functions that all spaces share, over `Interface`.
template <class Interface, class Space>
class PlanesOf : public Interface {
 public:
  using Vertex = typename Space::Vertex;
  using Own = OwnCorner<Vertex>;

  explicit PlanesOf(Space space) : space_(std::move(space)) {}
  Side side_of_plane(PlaneRef plane, const WideCorner& corner) override {
    return space_.side_of_plane(plane, *Own(corner));
  }
  WideVertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const WideCorner& from,
                      const WideCorner& to) const override {
    return widen(space_.crossing(plane, edge, leaving, *Own(from), *Own(to)));
  }

 protected:
  Space space_;
};

template <class Space>
class LightOf final : public PlanesOf<RoundedLight, Space> {
  using Base = PlanesOf<RoundedLight, Space>;
  using typename Base::Own;
  using typename Base::Vertex;

 public:
  using Base::Base;
  std::unique_ptr<RoundedLight> fork() const override {
    return std::make_unique<LightOf>(this->space_.fork());
  }
  Sign light_side(PlaneId plane) const override { return this->space_.light_side(plane); }
  PlaneRef import_edge(PlaneRef edge, PlaneId support, bool reversed, const WideVertex& from,
                       const WideVertex& to) override {
    return this->space_.import_edge(edge, support, reversed, narrow<Vertex>(from),
                                    narrow<Vertex>(to));
  }
  PlaneRef shadow_plane(PlaneRef edge, const WideVertex& from, const WideVertex& to) override {
    return this->space_.shadow_plane(edge, narrow<Vertex>(from), narrow<Vertex>(to));
  }
  PlaneRef add_prefix_plane(const PrefixPlane& plane) override {
    return this->space_.add_prefix_plane(plane);
  }
  PlaneRef cut_of_supports(PlaneId first, PlaneId second) override {
    return this->space_.cut_of_supports(first, second);
  }
  Side side_of_support(PlaneId plane, const WideCorner& corner) override {
    return this->space_.side_of_support(plane, *Own(corner));
  }
  std::uint32_t plane_mark() const override { return this->space_.plane_mark(); }
  void release_planes(std::uint32_t mark) override { this->space_.release_planes(mark); }
};

template <class Space>
class VolumeOf final : public PlanesOf<RoundedVolume, Space> {
  using Base = PlanesOf<RoundedVolume, Space>;
  using typename Base::Own;

 public:
  using Base::Base;
  std::unique_ptr<RoundedVolume> fork() const override {
    return std::make_unique<VolumeOf>(this->space_.fork());
  }
  PlaneRef add_plane(const WideCorner& a, const WideCorner& b, const WideCorner& c) override {
    return this->space_.add_plane(*Own(a), *Own(b), *Own(c));
  }
  PlaneRef add_plane(const WideCorner& a, const WideCorner& b,
                     const LightPoint& direction) override {
    return this->space_.add_plane(*Own(a), *Own(b), direction);
  }
  PlaneRef add_axis_plane(int axis, double value) override {
    return this->space_.add_axis_plane(axis, value);
  }
  WideVertex axis_point(const std::array<double, 3>& fractions) const override {
    return widen(this->space_.axis_point(fractions));
  }
  std::uint32_t plane_mark() const override { return this->space_.plane_mark(); }
  void release_planes(std::uint32_t mark) override { this->space_.release_planes(mark); }
};

template <class Kernel>
class SceneOf final : public PlanesOf<RoundedScene, typename Kernel::LightSpace::SceneSpace> {
  using Space = typename Kernel::LightSpace::SceneSpace;
  using Base = PlanesOf<RoundedScene, Space>;

 public:
  SceneOf(const Geometry& geometry, const KernelOptions& options)
      : Base(Space(geometry, options)), options_(options) {}
  WideVertex input_vertex(VertexId vertex) const override {
    return widen(this->space_.input_vertex(vertex));
  }
  int digits() const override {
    return std::numeric_limits<Number<typename Space::Vertex>>::digits;
  }
  std::unique_ptr<RoundedLight> light(const LightPoint& light) override {
    using Light = typename Kernel::LightSpace;
    return std::make_unique<LightOf<Light>>(Light(this->space_, light, options_));
  }
  std::unique_ptr<RoundedVolume> volume() const override {
    using Volume = typename Kernel::VolumeSpace;
    return std::make_unique<VolumeOf<Volume>>(Volume(this->space_, options_));
  }

 private:
  KernelOptions options_;
};

}  // namespace gnomon::rounded_detail

namespace gnomon {

template <class Kernel>
std::unique_ptr<RoundedScene> RoundedSpacesOf<Kernel>::run(const Geometry& geometry,
                                                           const KernelOptions& options) {
  return std::make_unique<rounded_detail::SceneOf<Kernel>>(geometry, options);
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_WATCHED_ROUNDED_SPACES_OF_H
