// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/received_light/received_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "gnomon/algorithms/loop_illumination.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/scene/rational_text.h"
#include "gnomon/scene/visible_light_scene.h"
#include "scene/base/random.h"
#include "scene/base/vectors.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon::comparison {

namespace {

/// Of truths: far below what is asked of any kernel.
constexpr double kRelativeError = 1e-13;

using RationalVector = std::array<mpq_class, 3>;

RationalVector exact(const Position& position) {
  return {position[0].exact(), position[1].exact(), position[2].exact()};
}

std::array<double, 3> nearest(const Position& position) {
  return {position[0].nearest(), position[1].nearest(), position[2].nearest()};
}

/// The vector of length 1, from one of any size: scaled first, so that no square overflows.
std::array<double, 3> unit(const RationalVector& vector) {
  mpq_class largest = 0;
  for (const mpq_class& c : vector) largest = std::max(largest, mpq_class(abs(c)));
  std::array<double, 3> scaled{};
  for (std::size_t k = 0; k < 3; ++k) scaled[k] = mpq_class(vector[k] / largest).get_d();
  const double length = std::hypot(scaled[0], scaled[1], scaled[2]);
  for (double& c : scaled) c /= length;
  return scaled;
}

Sight sight_of(bool some, bool all) {
  if (!some) return Sight::kNothing;
  return all ? Sight::kAll : Sight::kPart;
}

/// What is seen by the fragments of the light, which is the scene's first polygon.
void add_fragments(const LightResult& light, const PreparedScene& scene,
                   const std::array<double, 3>& point, const std::array<double, 3>& normal,
                   FoundLight& found) {
  bool some = false, hidden = false;
  for (const PartResult& part : light.parts) {
    if (part.part >= scene.first_part[1]) continue;
    if (part.reason != ShadowReason::kNone) {
      hidden = hidden || part.reason != ShadowReason::kOutsideRegion;
      continue;
    }
    found.visible += part.lit.middle();
    for (std::uint32_t f = 0; f < part.fragment_count; ++f) {
      const Fragment& fragment = light.fragments[part.first_fragment + f];
      if (fragment.state != LightState::kLit) {
        hidden = hidden || fragment.reason != ShadowReason::kOutsideRegion;
        continue;
      }
      some = true;
      found.received += loop_illumination(
          std::span(light.points).subspan(fragment.first, fragment.count), point, normal);
    }
  }
  found.sight = sight_of(some, !hidden);
}

}  // namespace

const char* name_of(Sight sight) {
  constexpr std::array kNames{"nothing", "part", "all"};
  return kNames[static_cast<std::size_t>(sight)];
}

ReceivedLight::ReceivedLight(const Scene& scene, const PreparedScene& prepared,
                             const LitSide& receiver)
    : scene_(&scene),
      prepared_(&prepared),
      receiver_(receiver),
      part_(prepared.first_part[receiver.polygon]),
      visibility_(prepared, receiver.light),
      illuminator_(prepared, receiver.light, scene.lights[receiver.light].intensity.nearest(),
                   kRelativeError) {}

Expected<ReceivedLight> ReceivedLight::make(const Scene& scene, const PreparedScene& prepared,
                                            const LitSide& receiver) {
  // The plane is found, and the receiver refused, by the same code that makes the scenes of points.
  const Polygon& polygon = scene.polygons[receiver.polygon];
  const auto seen =
      visible_light_scene(scene, {scene.lights[receiver.light].id,
                                  scene.vertices[polygon.loop.front()], polygon.id, receiver.side});
  if (!seen) return tl::unexpected(seen.error());
  ReceivedLight result(scene, prepared, receiver);
  const RegionPlane& plane = seen->lights.front().region.front();
  result.origin_ = exact(plane[0]);
  result.normal_ =
      cross(minus(exact(plane[1]), result.origin_), minus(exact(plane[2]), result.origin_));
  result.unit_normal_ = unit(result.normal_);
  return result;
}

mpq_class ReceivedLight::height_of(const RationalVector& point) const {
  return dot(normal_, minus(point, origin_));
}

std::vector<Position> ReceivedLight::spread_points(std::size_t count, std::uint64_t seed) const {
  const Polygon& polygon = scene_->polygons[receiver_.polygon];
  std::vector<VertexId> inputs = polygon.loop;
  for (const auto& hole : polygon.holes) inputs.insert(inputs.end(), hole.begin(), hole.end());
  const auto corner = [&](const Part& part, std::size_t i) {
    const VertexId own = prepared_->loop(part)[i];
    const auto input = std::ranges::find_if(
        inputs, [&](VertexId vertex) { return prepared_->vertex_of_input[vertex] == own; });
    return exact(scene_->vertices[*input]);
  };
  // Decimal weights keep decimals decimal, and powers of two keep doubles short.
  constexpr std::uint64_t kSteps = 1024;
  Random random(seed);
  std::vector<Position> points;
  const std::uint32_t parts = prepared_->first_part[receiver_.polygon + 1] - part_;
  for (std::size_t k = 0; k < count; ++k) {
    const Part& part = prepared_->parts[part_ + k % parts];
    const auto turn = static_cast<std::size_t>(random.below(part.count - 2));
    const RationalVector first = corner(part, 0);
    const RationalVector along = minus(corner(part, turn + 1), first),
                         across = minus(corner(part, turn + 2), first);
    std::uint64_t u = random.below(kSteps - 1) + 1, v = random.below(kSteps - 1) + 1;
    if (u + v >= kSteps) {  // the other half of the parallelogram, turned into this one
      u = kSteps - u;
      v = kSteps - v;
    }
    Position point;
    for (std::size_t c = 0; c < 3; ++c) {
      point[c] = decimal_of(
          first[c] + (along[c] * mpq_class(mpz_class(u)) + across[c] * mpq_class(mpz_class(v))) /
                         mpq_class(mpz_class(kSteps)));
    }
    points.push_back(std::move(point));
  }
  return points;
}

Expected<PointSight> ReceivedLight::at(const Position& position) const {
  const RationalVector point = exact(position);
  if (const mpq_class height = height_of(point); height != 0) {
    const double off =
        std::abs(height.get_d()) / std::sqrt(mpq_class(dot(normal_, normal_)).get_d());
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", off);
    return fail(ErrorCode::kGeometry,
                "the point is " + std::string(text) + " off the plane of polygon '" +
                    scene_->polygons[receiver_.polygon].id + "'",
                "a point exactly in it");
  }
  PointSight result;
  result.position = position;
  VisibleLight seen = visibility_.at(part_, receiver_.side, point);
  result.sight = sight_of(seen.visible > 0, seen.visible == seen.in_front);
  result.in_front = std::move(seen.in_front);
  result.visible = std::move(seen.visible);
  result.received = illuminator_.at(part_, receiver_.side, point, false);
  result.unobstructed = illuminator_.at(part_, receiver_.side, point, true);
  return result;
}

Expected<PreparedScene> ReceivedLight::scene_of(const PointSight& point) const {
  const auto seen =
      visible_light_scene(*scene_, {scene_->lights[receiver_.light].id, point.position,
                                    scene_->polygons[receiver_.polygon].id, receiver_.side});
  if (!seen) return tl::unexpected(seen.error());
  return prepare(*seen);
}

Expected<FoundLight> ReceivedLight::found(const PointSight& point, const PreparedScene& scene,
                                          ShadowOptions options) const {
  const bool is_exact = kernel_info(options.kernel.id).exact;
  options.output.points = true;
  options.output.exact_fractions = is_exact;
  const auto result = compute_shadows(scene, options);
  if (!result) return tl::unexpected(result.error());
  const LightResult& light = result->lights.front();
  FoundLight found;
  add_fragments(light, scene, nearest(point.position), unit_normal_, found);
  found.received *= scene_->lights[receiver_.light].intensity.nearest();
  if (is_exact && scene.first_part[1] == 1) {
    mpq_class share = 0;
    for (std::size_t i = 0; i < light.parts.size(); ++i) {
      if (light.parts[i].part == 0) share += light.exact_fractions[i].lit;
    }
    found.exact_share = std::move(share);
  }
  found.cpu_seconds = result->scene_bsp_seconds + result->shadow_seconds;
  return found;
}

void add_to(KernelReceipt& receipt, std::size_t index, const PointSight& point,
            const FoundLight& found) {
  ++receipt.points;
  receipt.cpu_seconds += found.cpu_seconds;
  if (found.sight != point.sight) ++receipt.wrong;
  if (found.exact_share && *found.exact_share != point.visible) receipt.differs = true;
  const double share_off = std::abs(found.visible - point.visible.get_d());
  receipt.share_off = std::max(receipt.share_off, share_off);
  double off = std::abs(found.received - point.received.value);
  if (std::isnan(off)) off = std::numeric_limits<double>::infinity();
  if (point.received.value > 0) {
    receipt.relative_off = std::max(receipt.relative_off, off / point.received.value);
  }
  // A point that sees nothing of the light's plane receives nothing, and nothing can be off.
  const double received_off =
      off == 0 ? 0 : off / std::max(point.unobstructed.value, point.received.value);
  if (receipt.points == 1 || received_off > receipt.received_off) {
    receipt.received_off = received_off;
    receipt.worst = index;
  }
}

}  // namespace gnomon::comparison
