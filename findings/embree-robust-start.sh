#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Embree 3.13.5 (Debian's libembree3-3 and libembree-dev 3.13.5+dfsg-2): rays that start exactly on a
# triangle, with and without RTC_SCENE_FLAG_ROBUST.
#
# Guess: the robust flag "avoids optimizations that reduce arithmetic accuracy" (its manual) and is for
# rays that slip through between neighbours; where all numbers are exact it changes nothing. A ray with
# tnear = 0 that starts in the plane of a triangle and leaves it meets it in both modes, or in neither.
# Seen: without the flag such a ray does not meet the triangle, and with the flag it does, at 0: the near
# end of a ray is open in one mode and closed in the other. Of 64 points on a floor alone under a lamp
# all are lit without the flag and none with it. Starting 0.001 above the floor makes all 64 lit in both
# modes; but points at the foot of a wall lie in the wall's plane, which no offset along the floor's
# normal leaves, and stay dark with the flag. With tnear = 1e-6 all are lit in both modes.
# Where it matters: shadow rays. examples/embree_samples.cc, docs/samples.md.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -q libembree3-3=3.13.5+dfsg-2 libembree-dev=3.13.5+dfsg-2 > /dev/null 2>&1
for package in *.deb; do dpkg -x "$package" package; done
cat > rays.cc <<'C'
#include <embree3/rtcore.h>

#include <cstdio>
#include <initializer_list>

// A floor [0,8]^2 at height 0, and a wall 8 high that stands on its edge y = 8; or the floor alone.
const float corners[8][3] = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0},
                             {0, 8, 0}, {8, 8, 0}, {8, 8, 8}, {0, 8, 8}};
const unsigned faces[4][3] = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};

int lit(bool robust, int triangles, float y, float dy, float offset, float near) {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  if (robust) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 8));
  for (int i = 0; i < 24; ++i) vertices[i] = corners[i / 3][i % 3];
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles));
  for (int i = 0; i < 3 * triangles; ++i) indices[i] = faces[i / 3][i % 3];
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene, mesh);
  rtcCommitScene(scene);
  int count = 0;
  for (int i = 0; i < 64; ++i) {
    const float x = 0.5f + i % 8, z = 4;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    // To a lamp at (3, 3, 4). All numbers are exact.
    const float py = y + dy * (i / 8);
    RTCRay ray{x, py, offset, near, 3 - x, 3 - py, z - offset, 0, 1, ~0u, 0, 0};
    rtcOccluded1(scene, &context, &ray);
    if (ray.tfar >= 0) ++count;
  }
  rtcReleaseGeometry(mesh);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return count;
}

int main() {
  for (const bool robust : {false, true}) {
    const char* mode = robust ? "robust" : "plain ";
    std::printf("%s floor alone: %d of 64 lit, from 0.001 above %d, with tnear 1e-6 %d\n", mode,
                lit(robust, 2, 0.5f, 1, 0, 0), lit(robust, 2, 0.5f, 1, 0.001f, 0),
                lit(robust, 2, 0.5f, 1, 0, 1e-6f));
    std::printf("%s foot of the wall: %d of 64 lit, from 0.001 above %d, with tnear 1e-6 %d\n", mode,
                lit(robust, 4, 8, 0, 0, 0), lit(robust, 4, 8, 0, 0.001f, 0),
                lit(robust, 4, 8, 0, 0, 1e-6f));
  }
}
C
libraries=$(echo package/usr/lib/*-linux-gnu)
g++ -O2 -I package/usr/include rays.cc -L "$libraries" -Wl,-rpath,"$folder/$libraries" \
  -l:libembree3.so.3 -Wl,--allow-shlib-undefined -o rays
./rays | tee seen.txt
diff seen.txt - <<'SEEN'
plain  floor alone: 64 of 64 lit, from 0.001 above 64, with tnear 1e-6 64
plain  foot of the wall: 64 of 64 lit, from 0.001 above 64, with tnear 1e-6 64
robust floor alone: 0 of 64 lit, from 0.001 above 64, with tnear 1e-6 64
robust foot of the wall: 0 of 64 lit, from 0.001 above 0, with tnear 1e-6 64
SEEN
echo "as found: Embree 3.13.5+dfsg-2"
