// SPDX-License-Identifier: GPL-3.0-or-later
#include "witness_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon::test {
namespace {

using Vec = std::array<mpq_class, 3>;

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec times(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
mpq_class dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Plane {
  Vec n;
  mpq_class d;
  mpq_class at(const Vec& p) const { return dot(n, p) - d; }
};

std::vector<Vec> loop_of(const PreparedScene& scene, std::uint32_t part) {
  std::vector<Vec> loop;
  for (const VertexId v : scene.loop(scene.parts[part])) {
    Vec p;
    for (int k = 0; k < 3; ++k) {
      p[k] =
          scene.geometry.origin[k] + scene.geometry.step * mpq_class(scene.geometry.grid.at(v, k));
    }
    loop.push_back(std::move(p));
  }
  return loop;
}

/// Area vector by the fan of the first vertex: non-zero for a loop of positive area.
Vec area_vector(const std::vector<Vec>& loop) {
  Vec sum;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Vec piece = times(minus(loop[i - 1], loop[0]), minus(loop[i], loop[0]));
    for (int k = 0; k < 3; ++k) sum[k] += piece[k];
  }
  return sum;
}

/// A light as (x, w), the point x / w or the direction x.
struct Homogeneous {
  Vec x;
  int w = 1;
};

mpq_class at_light(const Plane& plane, const Homogeneous& light) {
  return dot(plane.n, light.x) - plane.d * light.w;
}

/// The half-spaces whose intersection is the caster's shadow: behind its plane, and inside the
/// planes through its edges and the light. All values are positive inside.
std::vector<Plane> shadow_volume(const std::vector<Vec>& caster, const Homogeneous& light) {
  std::vector<Plane> volume;
  const Vec n = area_vector(caster);
  Plane support{n, dot(n, caster[0])};
  const int facing = sgn(at_light(support, light));
  for (int k = 0; k < 3; ++k) support.n[k] *= -facing;
  support.d *= -facing;
  volume.push_back(support);
  for (std::size_t i = 0; i < caster.size(); ++i) {
    const Vec& a = caster[i];
    const Vec& b = caster[(i + 1) % caster.size()];
    const Vec to_light = light.w == 1 ? minus(light.x, a) : light.x;
    Plane edge;
    edge.n = times(minus(b, a), to_light);
    edge.d = dot(edge.n, a);
    const Vec& other = caster[(i + 2) % caster.size()];
    if (sgn(edge.at(other)) < 0) {
      for (int k = 0; k < 3; ++k) edge.n[k] = -edge.n[k];
      edge.d = -edge.d;
    }
    volume.push_back(edge);
  }
  return volume;
}

std::string check_fragment(const std::vector<Vec>& fragment, const Plane& support,
                           const Vec& normal) {
  if (fragment.size() < 3) return "has fewer than three vertices";
  for (const Vec& p : fragment) {
    if (support.at(p) != 0) return "has a vertex off its support plane";
  }
  // Convex, in one turn, without repeated or collinear vertices: all turns of one sign, and the
  // fan's triangles too.
  const int whole = sgn(dot(area_vector(fragment), normal));
  if (whole == 0) return "has no area";
  for (std::size_t i = 0; i < fragment.size(); ++i) {
    const Vec& a = fragment[i];
    const Vec& b = fragment[(i + 1) % fragment.size()];
    const Vec& c = fragment[(i + 2) % fragment.size()];
    const int turn = sgn(dot(times(minus(b, a), minus(c, b)), normal));
    if (turn * whole < 0) return "is not convex";
    if (a == b) return "has a repeated vertex";
  }
  for (std::size_t i = 2; i < fragment.size(); ++i) {
    const Vec fan = times(minus(fragment[i - 1], fragment[0]), minus(fragment[i], fragment[0]));
    if (sgn(dot(fan, normal)) * whole < 0) return "turns more than once";
  }
  return {};
}

/// What of a convex loop is in front of a plane.
std::vector<Vec> clipped(const std::vector<Vec>& loop, const Plane& plane) {
  std::vector<Vec> front;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const mpq_class at_a = plane.at(a), at_b = plane.at(b);
    if (at_a >= 0) front.push_back(a);
    if (sgn(at_a) * sgn(at_b) >= 0) continue;
    Vec crossing;
    for (std::size_t k = 0; k < 3; ++k) crossing[k] = a[k] + (b[k] - a[k]) * (at_a / (at_a - at_b));
    front.push_back(std::move(crossing));
  }
  return front;
}

/// Nothing of a fragment that has an area is inside of all planes of the region.
bool is_outside(const Light& light, std::vector<Vec> fragment) {
  for (const RegionPlane& plane : light.region) {
    std::array<Vec, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) corners[i][k] = plane[i][k].exact();
    }
    const Vec inside = times(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    fragment = clipped(fragment, {inside, dot(inside, corners[0])});
  }
  return fragment.size() < 3 || area_vector(fragment) == Vec{};
}

}  // namespace

std::string find_false_witness(const Case& scene, const ShadowResult& result) {
  const PreparedScene& prepared = scene.prepared();
  const auto id_of = [&](std::uint32_t part) {
    return scene.scene().polygons[prepared.parts[part].polygon].id;
  };
  for (const LightResult& light : result.lights) {
    const Light& own = scene.scene().lights[prepared.lights[light.light].light];
    Homogeneous source;
    for (int k = 0; k < 3; ++k) source.x[k] = own.position[k].exact();
    source.w = own.is_point() ? 1 : 0;
    for (const PartResult& part : light.parts) {
      const std::vector<Vec> loop = loop_of(prepared, part.part);
      const Vec normal = area_vector(loop);
      const Plane support{normal, dot(normal, loop[0])};
      for (std::uint32_t i = 0; i < part.fragment_count; ++i) {
        const Fragment& fragment = light.fragments[part.first_fragment + i];
        const std::vector<Vec> points(light.exact_points.begin() + fragment.first,
                                      light.exact_points.begin() + fragment.first + fragment.count);
        const auto complain = [&](const std::string& what) {
          return fmt::format("{}, light '{}': fragment {} of polygon '{}' {}", result.kernel,
                             own.id, i, id_of(part.part), what);
        };
        if (const std::string wrong = check_fragment(points, support, normal); !wrong.empty()) {
          return complain(wrong);
        }
        if (fragment.state == LightState::kLit) {
          if (fragment.caster != Fragment::kNoCaster) return complain("is lit and names a caster");
          continue;
        }
        if (fragment.reason == ShadowReason::kOutsideRegion) {
          if (!is_outside(own, points)) return complain("is not outside of the region");
          continue;
        }
        if (fragment.casters != Fragment::kNoCaster) {
          // Whether they shadow it together, the oracle's own check says.
          if (light.caster_sets.at(fragment.casters).size() < 2)
            return complain("names a set of one");
          continue;
        }
        if (fragment.caster == Fragment::kNoCaster) return complain("names no caster");
        const Part& caster = prepared.parts[fragment.caster];
        const auto fails = [&](const std::string& why) {
          return complain(fmt::format("is not shadowed by '{}': {}", id_of(fragment.caster), why));
        };
        if (fragment.caster == part.part) return fails("it is the receiver");
        if (!caster.casts && !own.is_eye) return fails("it does not cast");
        const std::vector<Vec> caster_loop = loop_of(prepared, fragment.caster);
        const Vec caster_normal = area_vector(caster_loop);
        const Plane caster_plane{caster_normal, dot(caster_normal, caster_loop[0])};
        const int facing = sgn(at_light(caster_plane, source));
        if (facing == 0 || (facing < 0 && !caster.two_sided)) return fails("it faces away");
        Vec middle;
        for (const Vec& p : points) {
          for (int k = 0; k < 3; ++k) middle[k] += p[k] / mpq_class(points.size());
        }
        for (const Plane& side : shadow_volume(caster_loop, source)) {
          for (const Vec& p : points) {
            if (sgn(side.at(p)) < 0) return fails("a vertex is outside its shadow");
          }
          if (sgn(side.at(middle)) <= 0) return fails("it lies on the border of its shadow");
        }
      }
    }
  }
  return {};
}

}  // namespace gnomon::test
