// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/cause.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::fuzz {

namespace {

constexpr double kNear = 1e-6;
constexpr double kFar = 1e6;

/// In order: the first that holds is the cause.
constexpr std::array<std::string_view, 9> kCauses = {
    "light-in-plane", "near-coplanar", "grazing",  "sliver",   "far",
    "shared-edge",    "shared-vertex", "touching", "crossing",
};
enum Cause : std::size_t {
  kLightInPlane,
  kNearCoplanar,
  kGrazing,
  kSliver,
  kFarAway,
  kSharedEdge,
  kSharedVertex,
  kTouching,
  kCrossing,
  kGeneral
};

using Integers = std::array<mpz_class, 3>;

Integers minus(const Integers& a, const Integers& b) {
  return {mpz_class(a[0] - b[0]), mpz_class(a[1] - b[1]), mpz_class(a[2] - b[2])};
}
Integers cross(const Integers& a, const Integers& b) {
  return {mpz_class(a[1] * b[2] - a[2] * b[1]), mpz_class(a[2] * b[0] - a[0] * b[2]),
          mpz_class(a[0] * b[1] - a[1] * b[0])};
}
mpz_class dot(const Integers& a, const Integers& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Integers& a) { return std::sqrt(mpz_class(dot(a, a)).get_d()); }

/// A part on the grid.
struct Face {
  const Part* part = nullptr;
  std::span<const VertexId> vertices;
  std::vector<Integers> loop;
  Integers normal;
  double diameter = 0;  // grid steps
  double area = 0;      // of it, doubled

  mpz_class height(const Integers& point) const { return dot(normal, minus(point, loop[0])); }
  double distance(const Integers& point) const {
    return std::fabs(height(point).get_d()) / length(normal);
  }
  /// Of a point of the plane: not outside of any edge.
  bool holds(const Integers& point) const {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Integers& a = loop[i];
      const Integers along = minus(loop[(i + 1) % loop.size()], a);
      if (dot(cross(normal, along), minus(point, a)) < 0) return false;
    }
    return true;
  }
};

Integers at(const Geometry& geometry, VertexId vertex) {
  return {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1), geometry.grid.at(vertex, 2)};
}

Face face_of(const PreparedScene& scene, const Part& part) {
  Face face;
  face.part = &part;
  face.vertices = scene.loop(part);
  for (const VertexId vertex : face.vertices) face.loop.push_back(at(scene.geometry, vertex));
  face.normal = {};
  for (std::size_t i = 1; i + 1 < face.loop.size(); ++i) {
    const Integers twice =
        cross(minus(face.loop[i], face.loop[0]), minus(face.loop[i + 1], face.loop[0]));
    for (std::size_t k = 0; k < 3; ++k) face.normal[k] += twice[k];
  }
  face.area = length(face.normal);
  for (const Integers& a : face.loop) {
    for (const Integers& b : face.loop)
      face.diameter = std::max(face.diameter, length(minus(a, b)));
  }
  return face;
}

class CauseSearch {
 public:
  CauseSearch(const PreparedScene& scene, const PreparedLight* light)
      : scene_(scene), light_(light) {}

  Cause of_pair(const Face& a, const Face& b) const {
    Cause cause = of_light(a);
    cause = std::min(cause, of_light(b));
    const auto note = [&](Cause other, bool holds) {
      if (holds) cause = std::min(cause, other);
    };
    const double extent = std::max(a.diameter, b.diameter);
    note(kNearCoplanar, a.part->plane != b.part->plane && boxes_meet(a, b, kNear * extent) &&
                            is_close(a, b, kNear * extent) && is_close(b, a, kNear * extent));
    note(kSliver, is_sliver(a) || is_sliver(b));
    note(kFarAway, from_origin(a) > kFar * extent);
    const auto shared = std::ranges::count_if(a.vertices, [&](VertexId vertex) {
      return std::ranges::find(b.vertices, vertex) != b.vertices.end();
    });
    note(kSharedEdge, shared > 1);
    note(kSharedVertex, shared == 1);
    note(kTouching, touches(a, b) || touches(b, a));
    note(kCrossing, straddles(a, b) && straddles(b, a));
    return cause;
  }

 private:
  /// How the light stands to the plane of a face.
  Cause of_light(const Face& face) const {
    if (light_ == nullptr || light_->has_area()) return kGeneral;
    const Integers to_light = light_->is_directional() ? Integers{light_->point.grid}
                                                       : minus(light_->point.grid, face.loop[0]);
    const mpz_class height = dot(face.normal, to_light);
    if (height == 0) return kLightInPlane;
    const double sine =
        std::fabs(height.get_d()) / length(face.normal) / std::max(length(to_light), 1e-300);
    return sine < kNear ? kGrazing : kGeneral;
  }

  static bool is_close(const Face& face, const Face& other, double distance) {
    return std::ranges::all_of(
        other.loop, [&](const Integers& point) { return face.distance(point) <= distance; });
  }
  static bool is_sliver(const Face& face) {
    return face.area / 2 < kNear * face.diameter * face.diameter;
  }
  static bool boxes_meet(const Face& a, const Face& b, double slack) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto less = [k](const Integers& x, const Integers& y) { return x[k] < y[k]; };
      const auto [a_low, a_high] = std::ranges::minmax_element(a.loop, less);
      const auto [b_low, b_high] = std::ranges::minmax_element(b.loop, less);
      if (mpz_class((*a_low)[k] - (*b_high)[k]).get_d() > slack) return false;
      if (mpz_class((*b_low)[k] - (*a_high)[k]).get_d() > slack) return false;
    }
    return true;
  }
  static bool touches(const Face& face, const Face& other) {
    return std::ranges::any_of(other.loop, [&](const Integers& point) {
      return face.height(point) == 0 && face.holds(point);
    });
  }
  static bool straddles(const Face& face, const Face& other) {
    bool front = false, back = false;
    for (const Integers& point : other.loop) {
      const mpz_class height = face.height(point);
      front |= height > 0;
      back |= height < 0;
    }
    return front && back;
  }
  /// Grid steps.
  double from_origin(const Face& face) const {
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const mpq_class steps = scene_.geometry.origin[k] / scene_.geometry.step + face.loop[0][k];
      squared += steps.get_d() * steps.get_d();
    }
    return std::sqrt(squared);
  }

  const PreparedScene& scene_;
  const PreparedLight* light_;
};

std::optional<std::uint32_t> polygon_by_id(const Scene& scene, std::string_view id) {
  const auto found = std::ranges::find(scene.polygons, id, &Polygon::id);
  if (id.empty() || found == scene.polygons.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - scene.polygons.begin());
}

std::vector<Face> faces_of(const PreparedScene& scene, std::uint32_t polygon) {
  std::vector<Face> faces;
  for (std::uint32_t i = scene.first_part[polygon]; i < scene.first_part[polygon + 1]; ++i) {
    faces.push_back(face_of(scene, scene.parts[i]));
  }
  return faces;
}

}  // namespace

std::string cause_of(const Scene& scene, const PreparedScene& prepared, std::string_view light,
                     std::string_view polygon, std::string_view caster) {
  const auto own = polygon_by_id(scene, polygon);
  if (!own) return {};
  const PreparedLight* prepared_light = nullptr;
  for (const PreparedLight& one : prepared.lights) {
    if (scene.lights[one.light].id == light) prepared_light = &one;
  }
  const CauseSearch search(prepared, prepared_light);
  const std::vector<Face> receivers = faces_of(prepared, *own);
  if (receivers.empty()) return {};
  std::vector<std::uint32_t> others;
  const auto decides = polygon_by_id(scene, caster);
  if (decides) {
    others.push_back(*decides);
  } else {
    for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) others.push_back(i);
  }
  Cause cause = kGeneral;
  for (const std::uint32_t other : others) {
    for (const Face& face : faces_of(prepared, other)) {
      for (const Face& receiver : receivers) {
        if (face.part == receiver.part) continue;
        cause = std::min(cause, search.of_pair(receiver, face));
      }
    }
  }
  if (!decides && cause > kFarAway) cause = kGeneral;
  return cause == kGeneral ? "general" : std::string(kCauses[cause]);
}

}  // namespace gnomon::fuzz
