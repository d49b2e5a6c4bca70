// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/generate/scene_maker.h"

#include <algorithm>
#include <cmath>

#include "scene/base/exact_int.h"

namespace gnomon::scene_detail {

Number SceneMaker::number(std::int64_t value) const {
  return Number(std::ldexp(static_cast<double>(value), -fraction_bits_));
}

void SceneMaker::reserve(std::int64_t polygons, std::int64_t vertices) {
  scene_.polygons.reserve(static_cast<std::size_t>(polygons));
  scene_.vertices.reserve(static_cast<std::size_t>(vertices));
  points_.reserve(static_cast<std::size_t>(vertices));
  table_.reserve(static_cast<std::size_t>(vertices));
}

std::uint64_t SceneMaker::hash(Int3 p) {
  return mix(hash_into(hash_into(hash_into(0, p.x), p.y), p.z), 1) * 0x9e3779b97f4a7c15u;
}

VertexId SceneMaker::vertex(Int3 p, std::uint64_t hash) {
  const auto next = static_cast<std::uint32_t>(points_.size());
  const std::uint32_t found =
      table_.find_or_enter(hash, next, [&](std::uint32_t i) { return points_[i] == p; });
  if (found != IndexTable::kNone) return found;
  points_.push_back(p);
  scene_.vertices.push_back({number(p.x), number(p.y), number(p.z)});
  return next;
}

Polygon& SceneMaker::face(std::string id, const std::vector<Int3>& loop) {
  hashes_.clear();
  for (const Int3& p : loop) {
    hashes_.push_back(hash(p));
    table_.look_ahead(hashes_.back());
  }
  Polygon& polygon = scene_.polygons.emplace_back();
  polygon.id = std::move(id);
  polygon.loop.reserve(loop.size());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    polygon.loop.push_back(vertex(loop[i], hashes_[i]));
  }
  return polygon;
}

void SceneMaker::box(const std::string& id, Int3 low, Int3 high, unsigned faces, bool inside) {
  const auto corner = [&](unsigned k) {
    return Int3{(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                (k & 4) != 0 ? high.z : low.z};
  };
  struct FaceOfBox {
    BoxFaces bit;
    const char* name;
    std::array<unsigned, 4> corners;  // counter-clockwise seen from outside
  };
  static constexpr std::array<FaceOfBox, 6> kFaces{{{kBottom, "bottom", {0, 2, 3, 1}},
                                                    {kTop, "top", {4, 5, 7, 6}},
                                                    {kFront, "front", {0, 1, 5, 4}},
                                                    {kBack, "back", {2, 6, 7, 3}},
                                                    {kLeft, "left", {0, 4, 6, 2}},
                                                    {kRight, "right", {1, 3, 7, 5}}}};
  for (const FaceOfBox& f : kFaces) {
    if ((faces & f.bit) == 0) continue;
    std::vector<Int3> loop;
    for (const unsigned k : f.corners) loop.push_back(corner(k));
    if (inside) std::reverse(loop.begin(), loop.end());
    face(id + "." + f.name, loop);
  }
}

Light& SceneMaker::light(LightType type, const char* name) {
  Light light;
  light.type = type;
  const int count = light_counts_[name]++;
  light.id = count == 0 ? name : name + std::to_string(count + 1);
  scene_.lights.push_back(std::move(light));
  return scene_.lights.back();
}

void SceneMaker::lamp(Int3 p) {
  light(LightType::kPoint, "lamp").position = {number(p.x), number(p.y), number(p.z)};
}

void SceneMaker::sun(Int3 p) {
  light(LightType::kDirectional, "sun").position = {Number(static_cast<double>(p.x)),
                                                    Number(static_cast<double>(p.y)),
                                                    Number(static_cast<double>(p.z))};
}

void SceneMaker::panel(const std::vector<Int3>& loop) {
  Light& panel = light(LightType::kArea, "panel");
  for (const Int3& p : loop) panel.loop.push_back({number(p.x), number(p.y), number(p.z)});
}

void SceneMaker::panel_above(const Values& values, Int3 middle, std::int64_t width) {
  const std::int64_t half = std::max<std::int64_t>(1, width * at(values, "area_size") / 200);
  panel({middle + Int3{-half, -half, 0}, middle + Int3{-half, half, 0},
         middle + Int3{half, half, 0}, middle + Int3{half, -half, 0}});
}

void SceneMaker::lamp_and_sun(std::int64_t which, Int3 lamp_position, Int3 to_sun) {
  if (which != 1) lamp(lamp_position);
  if (which != 0) sun(to_sun);
}

void SceneMaker::lights(const Values& values, Int3 lamp_position, Int3 to_sun, std::int64_t width) {
  const std::int64_t area = at(values, "area");
  if (area != 1) lamp_and_sun(at(values, "light"), lamp_position, to_sun);
  if (area != 0) panel_above(values, lamp_position, width);
}

}  // namespace gnomon::scene_detail
