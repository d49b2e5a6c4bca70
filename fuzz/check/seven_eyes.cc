// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/seven_eyes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon::fuzz {
namespace {

using Exact = std::array<mpq_class, 3>;

/// Exactly, if the denominator is a power of two; else the nearest double.
Number number_of(const mpq_class& value) {
  const mpz_class& denominator = value.get_den();
  const auto twos = mpz_scan1(denominator.get_mpz_t(), 0);
  if (denominator == mpz_class(1) << twos) {
    return Number::from_dyadic(value.get_num(), -static_cast<std::int32_t>(twos));
  }
  return Number(value.get_d());
}

class EyeMaker {
 public:
  EyeMaker(const PreparedScene& scene, std::uint32_t size) : scene_(scene), size_(size) {
    for (std::size_t k = 0; k < 3; ++k) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const VertexId v : scene.loop_vertices) {
        low = std::min(low, scene.geometry.positions[v][k]);
        high = std::max(high, scene.geometry.positions[v][k]);
      }
      middle_[k] = low + (high - low) / 2;
      extent_ = std::max(extent_, high - low);
    }
  }

  Exact at(VertexId v) const {
    Exact x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = scene_.geometry.origin[k] +
             scene_.geometry.step * scene_.geometry.grid.at(v, static_cast<int>(k));
    }
    return x;
  }
  Exact light() const {
    const LightPoint& point = scene_.lights[0].point;
    Exact x;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = point.directional
                 ? mpq_class(point.grid[k])
                 : mpq_class(scene_.geometry.origin[k] + scene_.geometry.step * point.grid[k]);
    }
    return x;
  }
  const std::array<double, 3>& middle() const { return middle_; }
  double extent() const { return extent_; }

  void add(const std::string& name, const Exact& eye) {
    CameraView view;
    Position position;
    for (std::size_t k = 0; k < 3; ++k) {
      position[k] = number_of(eye[k]);
      view.eye[k] = position[k].nearest();
      view.look_at[k] = middle_[k];
    }
    if (view.eye == view.look_at) view.look_at[0] += extent_ > 0 ? extent_ : 1;
    view.field_of_view = 100;
    view.width = view.height = size_;
    if (auto camera = make_camera(position, view)) eyes_.push_back({name, *std::move(camera)});
  }
  /// Adds the eye that was added last again, looking along the axis nearest to its view, by steps
  /// of a quarter of the distance.
  void add_along_axis() {
    if (eyes_.empty()) return;
    ExactCamera camera = eyes_.back().camera;
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (std::abs(camera.forward[k]) > std::abs(camera.forward[axis])) axis = k;
    }
    const std::int32_t sense = camera.forward[axis] < 0 ? -1 : 1;
    camera.right = camera.up = camera.forward = {0, 0, 0};
    camera.width = camera.height = size_ | 1;  // odd, so that a sample looks straight ahead
    camera.right[(axis + 1) % 3] = static_cast<std::int32_t>(camera.width);
    camera.up[(axis + 2) % 3] = static_cast<std::int32_t>(camera.height);
    camera.forward[axis] = 8 * sense;
    eyes_.push_back({eyes_.back().name + ", along an axis", camera});
  }
  std::vector<NamedEye> take() { return std::move(eyes_); }

 private:
  const PreparedScene& scene_;
  std::uint32_t size_;
  std::array<double, 3> middle_{};
  double extent_ = 0;
  std::vector<NamedEye> eyes_;
};

}  // namespace

std::vector<NamedEye> seven_eyes(const PreparedScene& scene, std::uint32_t size,
                                 std::uint32_t pick) {
  EyeMaker maker(scene, size);
  if (scene.parts.empty()) return {};
  const Part& part = scene.parts[pick % scene.parts.size()];
  const auto loop = scene.loop(part);
  const Exact a = maker.at(loop[0]), b = maker.at(loop[1]), c = maker.at(loop[2]);
  const bool has_point = !scene.lights.empty() && !scene.lights[0].has_area();
  Exact x;
  if (has_point) {
    const Exact light = maker.light();
    const bool directional = scene.lights[0].is_directional();
    for (std::size_t k = 0; k < 3; ++k) {  // a little behind the middle of three corners
      const mpq_class m = (2 * a[k] + b[k] + c[k]) / 4;
      x[k] = directional ? mpq_class(m - light[k] / 16) : mpq_class(m + (m - light[k]) / 16);
    }
    maker.add("in a shadow", x);
    maker.add_along_axis();
    for (std::size_t k = 0; k < 3; ++k) {
      const mpq_class m = (a[k] + b[k]) / 2;
      x[k] = directional ? mpq_class(m - light[k]) : mpq_class(2 * m - light[k]);
    }
    maker.add("on a wall", x);
    maker.add_along_axis();
    if (!directional) {
      maker.add("at the lamp", light);
      maker.add_along_axis();
    }
  }
  for (std::size_t k = 0; k < 3; ++k) x[k] = mpq_class(maker.middle()[k]);
  maker.add("in a box", x);
  maker.add_along_axis();
  for (std::size_t k = 0; k < 3; ++k) x[k] = 3 * b[k] + 2 * c[k] - 4 * a[k];
  maker.add("in the plane of a cap", x);
  maker.add_along_axis();
  for (std::size_t k = 0; k < 3; ++k) x[k] = 2 * b[k] - a[k];
  maker.add("on the line of an edge", x);
  maker.add_along_axis();
  constexpr std::array<double, 3> kAway{0.6640625, -0.9140625, 0.7265625};
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = mpq_class(maker.middle()[k]) + mpq_class(maker.extent()) * mpq_class(kAway[k]);
  }
  maker.add("generic", x);
  return maker.take();
}

}  // namespace gnomon::fuzz
