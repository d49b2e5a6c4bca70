// SPDX-License-Identifier: LGPL-3.0-or-later
// Makes the planes through a light: shadow planes of edges, depth planes of supports, cuts, traces
// and imported ones, each with its provenance and its doubles.
#include "kernel/implicit/light_planes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/implicit/scaled_doubles.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

LightPlanes::LightPlanes(const ScenePlanes& scene, const LightPoint& light)
    : shared_(std::make_shared<Shared>(scene, light)) {
  shared_->stretch = integers().is_parallel() ? static_cast<int>(integers().grid_bits()) : 0;
  shared_->edges.resize(geometry().edges.size());
  make_depth_planes();
}

// --- Doubles. ---

// The doubles of a directional light's q are scaled by 2^b in z: q = (x d_z - z d_x, y d_z - z d_y,
// d_z) has two components of b + e bits and one of e bits, and an error bound in the largest
// component would say nothing about the smallest. Scaling q by diag(1, 1, 2^b) scales normals by
// diag(2^b, 2^b, 1), up to a positive factor: no sign changes.
template <class Int>
LightPlanes::FilteredPlane LightPlanes::filtered_from(const Vector3<Int>& normal) const {
  FilteredPlane plane;
  plane.slack = to_normalized(normal, {stretch(), stretch(), 0}, plane.n) ? 1 : kUnknownError;
  return plane;
}

void LightPlanes::make_edge_planes(EdgeId begin, EdgeId end) {
  const LightIntegers& exact = integers();
  // One bit more for the difference of two products; a far lamp's plane has its offset.
  const unsigned bits =
      exact.far ? std::max(exact.edge_bits, 2 * exact.grid_bits() + exact.light_bits + 2)
                : exact.edge_bits;
  with_width(width_of(exact.narrow, bits + 2), [&]<class Int>() {
    for (EdgeId edge = begin; edge < end; ++edge) {
      const EdgeEnds& ends = geometry().edges[edge];
      shared_->edges[edge] =
          filtered_from(exact.far ? exact.far_edge_plane<Int>(ends) : exact.edge_normal<Int>(ends));
    }
  });
}

template <class Normal, class Int>
LightPlanes::DepthPlane LightPlanes::depth_plane(PlaneId id) const {
  using Position = PositionFor<Int>;
  const LightIntegers& exact_light = integers();
  const ExactGeometry<Position> exact(geometry());
  const Vector3<Normal> normal = exact.template normal<Normal>(id);
  const Vector3<Position> l = exact_light.position<Position>();
  const Vector3<Position> corner = exact.position(geometry().planes[id].a);
  const bool directional = exact_light.light.directional;
  const Int height = directional ? dot<Int>(normal, l) : dot<Int>(normal, difference(l, corner));
  DepthPlane depth;
  depth.at_light = sign_of(height);
  depth.magnitude = kUnknownError;
  if (depth.at_light == Sign::kZero) return depth;
  // Scaled such that nothing of usual size over- or underflows.
  const unsigned b = exact_light.grid_bits();
  double h;
  if (exact_light.is_parallel()) {
    const auto [x, y, z] = exact_light.axes;
    if (exact_light.far) {
      for (std::int8_t k = 1; k < 3; ++k) {
        const double size = std::fabs(to_double_scaled(normal[k], 2 * b));
        if (size > std::fabs(to_double_scaled(normal[depth.steepest], 2 * b))) depth.steepest = k;
      }
    }
    h = to_double_scaled(height, 2 * b + exact_light.light_bits);
    const double sign = sgn(exact_light.light.grid[z]) < 0 ? -1 : 1;
    const Int offset = dot<Int>(normal, corner);
    if (sign_of(normal[x]) == Sign::kZero && sign_of(normal[y]) == Sign::kZero &&
        sign_of(offset) == Sign::kZero) {
      depth.magnitude = 0;  // the ground at height 0, say: exactly 0 everywhere
      return depth;
    }
    depth.n = {-sign * to_double_scaled(normal[x], 2 * b) / h,
               -sign * to_double_scaled(normal[y], 2 * b) / h,
               sign * to_double_scaled(offset, 3 * b) / h};
  } else {
    h = to_double_scaled(height, 2 * b + exact_light.q_bits);
    for (int k = 0; k < 3; ++k) depth.n[k] = to_double_scaled(normal[k], 2 * b) / h;
  }
  const double magnitude = largest(depth.n);
  // Neither the quotient nor its operands have lost bits to underflow.
  if (magnitude > 0x1p-900 && magnitude < 0x1p900 && std::fabs(h) > 0x1p-900 &&
      magnitude * std::fabs(h) > 0x1p-900) {
    depth.magnitude = magnitude;
  }
  return depth;
}

void LightPlanes::make_depth_planes() {
  std::vector<DepthPlane>& depths = shared_->depths;
  depths.resize(geometry().planes.size());
  const unsigned b = integers().grid_bits();
  // n . (L - A), n . d and the plane's offset n . A; one bit more for the difference in a normal.
  const unsigned bits =
      2 * b + (integers().is_parallel() ? integers().light_bits : integers().q_bits);
  const unsigned most = std::max(bits, 3 * b) + 4;
  with_widths(width_of(integers().narrow, most), support_normal_bits(b) + 1,
              [&]<class Normal, class Int>() {
                tbb::parallel_for(std::size_t{0}, depths.size(), [&](std::size_t id) {
                  depths[id] = depth_plane<Normal, Int>(static_cast<PlaneId>(id));
                });
              });
}

LightPlanes::Vertex LightPlanes::import_vertex(const ScenePlanes::Vertex& vertex) const {
  Vertex result;
  result.source = vertex.source;
  if (vertex.source == kMadeVertex) return result;
  bool some = false;
  const LightIntegers& light = integers();
  const unsigned bits = light.far ? light.grid_bits() + light.light_bits + 1 : light.q_bits;
  with_width(width_of(light.narrow, bits + 1), [&]<class Int>() {
    some =
        to_normalized(light.far ? light.far_ray<Int>(vertex.source) : light.q<Int>(vertex.source),
                      {0, 0, stretch()}, result.ray);
  });
  result.bound = some ? LightBounds::input() : static_cast<float>(kUnknownError);
  return result;
}

// --- Planes of the stack. ---

PlaneRef LightPlanes::add(const FilteredPlane& plane, LightPlaneSource source) {
  own_.push_back(plane);
  sources_.push_back(source);
  return PlaneRef(edge_count() + static_cast<std::uint32_t>(own_.size()) - 1);
}

void LightPlanes::release_planes(std::uint32_t mark) {
  for (std::size_t i = mark; i < sources_.size(); ++i) {
    if (sources_[i].is_explicit()) explicit_.pop_back();
  }
  own_.resize(mark);
  sources_.resize(mark);
  const std::uint32_t gone = edge_count() + mark;
  const auto is_gone = [&](const auto& found) { return found.second.index() >= gone; };
  std::erase_if(cuts_, is_gone);
  std::erase_if(traces_, is_gone);
  std::erase_if(in_scene_, [&](const auto& found) { return found.first >= gone; });
}

PlaneRef LightPlanes::add_explicit(Vector3<mpz_class> normal) {
  const FilteredPlane plane =
      integers().far ? filtered_from(integers().in_far_rays(normal)) : filtered_from(normal);
  const unsigned bits = bits_of(normal);
  explicit_.push_back({std::move(normal), bits});
  return add(plane,
             {static_cast<std::uint32_t>(explicit_.size() - 1), LightPlaneSource::kExplicit});
}

PlaneRef LightPlanes::trace(PlaneId support, const ExactPlane<mpz_class>& cut) {
  auto found = supports_.find(support);
  if (found == supports_.end()) {
    found = supports_.emplace(support, ExactGeometry<mpz_class>(geometry()).plane(support)).first;
  }
  return add_explicit(integers().cut_normal(found->second, cut));
}

const ExactPlane<mpz_class>& LightPlanes::plane_in_scene(PlaneRef plane) const {
  auto found = in_scene_.find(plane.index());
  if (found == in_scene_.end()) {
    const Vector3<mpz_class> normal = exact_normal<mpz_class>(PlaneRef(plane.index()));
    found = in_scene_.emplace(plane.index(), integers().in_scene(normal)).first;
  }
  return found->second;
}

// Both planes usable: the normal is the difference of the depth planes, up to a positive factor.
PlaneRef LightPlanes::cut_of_supports(PlaneId first, PlaneId second) {
  const DepthPlane& i = depth(first);
  const DepthPlane& j = depth(second);
  const double sum = i.magnitude + j.magnitude;
  FilteredPlane plane;
  plane.slack = kUnknownError;
  for (int k = 0; k < 3; ++k) plane.n[k] = i.n[k] - j.n[k];
  const double magnitude = largest(plane.n);
  if (sum < kUnknownError && magnitude > sum * LightBounds::kLeastDifference) {
    const double scale = normalizer(magnitude) * static_cast<int>(j.at_light);
    for (double& x : plane.n) x *= scale;
    plane.slack = LightBounds::cut_slack(sum, std::fabs(scale));
    if (!(plane.slack <= LightBounds::kMostSlack)) plane.slack = kUnknownError;
  }
  return add(plane, {first, second});
}

PlaneRef LightPlanes::import_cut(const LightPlanes& other, PlaneRef ref, PlaneId support) {
  const CutKey key{&other, ref.index(), support};
  auto found = cuts_.find(key);
  if (found == cuts_.end()) {
    found = cuts_.emplace(key, trace(support, other.plane_in_scene(ref))).first;
  }
  return ref.flipped() ? -found->second : found->second;
}

PlaneRef LightPlanes::import_edge(PlaneRef scene_edge, PlaneId support, bool reversed,
                                  const Vertex&, const Vertex&) {
  const SceneEdges names = scene().edges();
  if (names.is_input_edge(scene_edge)) {
    const EdgeId edge = names.edge(scene_edge);
    if (shared_->edges[edge].slack == kNotMade) make_edge_planes(edge, edge + 1);
    return PlaneRef(edge, scene_edge.flipped() != reversed);
  }
  const std::uint64_t key = (std::uint64_t{support} << 32) | scene_edge.index();
  auto found = traces_.find(key);
  if (found == traces_.end()) {
    const ExactPlane<mpz_class> cut =
        ExactGeometry<mpz_class>(geometry()).plane(scene_edge.index());
    found = traces_.emplace(key, trace(support, cut)).first;
  }
  return scene_edge.flipped() ? -found->second : found->second;
}

// --- Provenance. ---

unsigned LightPlanes::plane_bits(PlaneRef plane) const {
  if (is_edge(plane)) return integers().edge_bits;
  const LightPlaneSource& from = source(plane);
  return from.is_explicit() ? explicit_[from.a].bits : integers().cut_bits;
}

bool LightPlanes::is_narrow(PlaneRef plane) const {
  if (is_edge(plane)) return true;
  const LightPlaneSource& from = source(plane);
  return !from.is_explicit() || explicit_[from.a].bits <= 63;
}

std::string LightPlanes::describe(PlaneRef ref) const {
  if (!is_edge(ref)) return "a plane through the light along a cut";
  const EdgeEnds ends = ends_of(ref);
  return "the shadow plane of edge " + std::to_string(ends.a) + "-" + std::to_string(ends.b);
}

}  // namespace gnomon
