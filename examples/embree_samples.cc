// SPDX-License-Identifier: GPL-3.0-or-later
// A ray caster to be judged (docs/samples.md): shadow rays of Embree, in single precision, from a
// grid of points on every polygon (convex, without holes) to the lights of a scene.
//   g++ -std=c++20 -O2 embree_samples.cc -lembree3 -o embree_samples  # libembree-dev,
//   rapidjson-dev
//   ./embree_samples SCENE.json [GRID [OFFSET [robust]]] > rays.csv
//   gnomon certify SCENE.json --samples rays.csv
#include <embree3/rtcore.h>
#include <rapidjson/document.h>
#include <rapidjson/istreamwrapper.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <valarray>
#include <vector>

using Vector = std::valarray<float>;
using Json = rapidjson::Value;
struct Triangle {
  std::string id;
  Vector a, u, v;  // a corner, and the ways to the others
  bool two_sided;
};
Vector read(const Json& v) { return {v[0].GetFloat(), v[1].GetFloat(), v[2].GetFloat()}; }
float dot(const Vector& a, const Vector& b) { return (a * b).sum(); }
Vector cross(const Vector& a, const Vector& b) {
  return a.cshift(1) * b.cshift(2) - a.cshift(2) * b.cshift(1);
}

/// One side hides only what comes from in front of it.
void drop_backs(const RTCFilterFunctionNArguments* hit) {
  const auto* ray = reinterpret_cast<const RTCRay*>(hit->ray);
  const auto* at = reinterpret_cast<const RTCHit*>(hit->hit);
  if (ray->dir_x * at->Ng_x + ray->dir_y * at->Ng_y + ray->dir_z * at->Ng_z <= 0) *hit->valid = 0;
}

std::vector<Triangle> build(const Json& scene, RTCDevice device, RTCScene casters) {
  std::vector<Triangle> triangles;
  for (const Json& polygon : scene["polygons"].GetArray()) {
    const bool two_sided =
        (polygon.HasMember("two_sided") ? polygon : scene).HasMember("two_sided") &&
        (polygon.HasMember("two_sided") ? polygon : scene)["two_sided"].GetBool();
    const Json& loop = polygon["loop"];
    const auto corner = [&](unsigned i) { return read(scene["vertices"][loop[i].GetUint()]); };
    for (unsigned i = 1; i + 1 < loop.Size(); ++i) {
      triangles.push_back({polygon["id"].GetString(), corner(0), corner(i) - corner(0),
                           corner(i + 1) - corner(0), two_sided});
      RTCGeometry shape = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* to = static_cast<float*>(
          rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3));
      for (const Vector& c : {corner(0), corner(i), corner(i + 1)})
        to = std::copy(begin(c), end(c), to);
      auto* index = static_cast<unsigned*>(
          rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 1));
      for (unsigned k = 0; k < 3; ++k) index[k] = k;
      if (!two_sided) rtcSetGeometryOccludedFilterFunction(shape, drop_backs);
      rtcCommitGeometry(shape);
      rtcAttachGeometry(casters, shape);
    }
  }
  rtcCommitScene(casters);
  return triangles;
}

int main(int count, char** arguments) {
  std::ifstream file(arguments[count > 1 ? 1 : 0]);
  rapidjson::IStreamWrapper stream(file);
  rapidjson::Document scene;
  if (scene.ParseStream(stream).HasParseError() || !scene.IsObject()) return 2;
  const int grid = count > 2 ? std::stoi(arguments[2]) : 16;
  const float offset = count > 3 ? std::stof(arguments[3]) : 0;
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene casters = rtcNewScene(device);
  if (count > 4) rtcSetSceneFlags(casters, RTC_SCENE_FLAG_ROBUST);
  const std::vector<Triangle> triangles = build(scene, device, casters);

  std::puts("light,x,y,z,visible,polygon");
  for (const Json& light : scene["lights"].GetArray()) {
    const bool sun = light.HasMember("to_light");
    std::vector<Vector> places;  // of an area light, a parallelogram: 8 x 8
    Vector shines(3);            // away from its front
    if (light.HasMember("loop")) {
      const Json& loop = light["loop"];
      const Vector a = read(loop[0]), u = read(loop[1]) - a, v = read(loop[loop.Size() - 1]) - a;
      for (int i = 0; i < 64; ++i) {
        places.push_back(a + (i % 8 + 0.5f) / 8 * u + (i / 8 + 0.5f) / 8 * v);
      }
      shines = cross(v, u);
    } else {
      places.push_back(read(light[sun ? "to_light" : "position"]));
    }
    for (const Triangle& triangle : triangles) {
      const Vector normal = cross(triangle.u, triangle.v),
                   up = normal / std::sqrt(dot(normal, normal));
      for (int i = 0; i < grid * grid; ++i) {
        const float s = (i % grid + 0.5f) / grid, t = (i / grid + 0.5f) / grid;
        if (s + t > 1) continue;
        const Vector point = triangle.a + s * triangle.u + t * triangle.v;
        int seen = 0;
        for (const Vector& place : places) {
          Vector way = sun ? place : Vector(place - point);
          const bool lights = !light.HasMember("loop") || dot(way, shines) > 0;
          const float side = !lights ? 0 : dot(way, normal) > 0 ? 1 : triangle.two_sided ? -1 : 0;
          const Vector from = point + side * offset * up;
          if (!sun) way = place - from;
          RTCIntersectContext context;
          rtcInitIntersectContext(&context);
          // Not quite up to a light, which may lie in a ceiling.
          const float end = sun ? std::numeric_limits<float>::infinity() : 1 - 1e-5f;
          RTCRay ray{from[0], from[1], from[2], 0, way[0], way[1], way[2], 0, end, ~0u, 0, 0};
          if (side != 0) rtcOccluded1(casters, &context, &ray);
          if (side != 0 && ray.tfar >= 0) ++seen;  // an occluded ray ends at minus infinity
        }
        std::printf("%s,%.9g,%.9g,%.9g,%.9g,%s\n", light["id"].GetString(), point[0], point[1],
                    point[2], static_cast<double>(seen) / static_cast<double>(places.size()),
                    triangle.id.c_str());
      }
    }
  }
}
