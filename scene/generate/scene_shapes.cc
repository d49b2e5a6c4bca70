// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/generate/scene_shapes.h"

#include <algorithm>

namespace gnomon::scene_detail {

void floor_at(SceneMaker& maker, Int3 low, Int3 high) {
  maker.face("floor",
             {low, {high.x, low.y, low.z}, {high.x, high.y, low.z}, {low.x, high.y, low.z}});
}

void tetrahedron(SceneMaker& maker, const std::string& id, const std::array<Int3, 4>& v) {
  const bool positive = dot(cross(v[1] - v[0], v[2] - v[0]), v[3] - v[0]) > 0;
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (int f = 0; f < 4; ++f) {
    const auto corner = [&](int k) { return v[static_cast<std::size_t>(faces[f][k])]; };
    std::vector<Int3> loop{corner(0), corner(1), corner(2)};
    if (!positive) std::reverse(loop.begin(), loop.end());
    maker.face(id + "." + std::to_string(f), loop);
  }
}

void hexagonal_prism(SceneMaker& maker, const std::string& id, Int3 middle, std::int64_t reach,
                     std::int64_t height) {
  const std::int64_t half = reach / 2, across = reach - 1;
  const std::array<Int3, 6> hexagon{{{reach, 0, 0},
                                     {half, across, 0},
                                     {-half, across, 0},
                                     {-reach, 0, 0},
                                     {-half, -across, 0},
                                     {half, -across, 0}}};
  std::vector<Int3> foot;
  foot.reserve(hexagon.size());
  for (const Int3& p : hexagon) foot.push_back(middle + p);
  upright_prism(maker, id, foot, height);
}

void upright_prism(SceneMaker& maker, const std::string& id, const std::vector<Int3>& foot,
                   std::int64_t height) {
  const Int3 up{0, 0, height};
  std::vector<Int3> top, bottom;
  for (const Int3& p : foot) {
    top.push_back(p + up);
    bottom.insert(bottom.begin(), p);
  }
  maker.face(id + ".top", top);
  maker.face(id + ".bottom", bottom);
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const Int3 p = foot[i], q = foot[(i + 1) % foot.size()];
    maker.face(id + "." + std::to_string(i), {p, q, q + up, p + up});
  }
}

void octahedron(SceneMaker& maker, const std::string& id, Int3 middle, std::int64_t reach) {
  const Int3 up{0, 0, reach};
  const std::array<Int3, 4> waist{{{reach, 0, 0}, {0, reach, 0}, {-reach, 0, 0}, {0, -reach, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Int3 p = middle + waist[i], q = middle + waist[(i + 1) % 4];
    maker.face(id + ".up" + std::to_string(i), {p, q, middle + up});
    maker.face(id + ".down" + std::to_string(i), {q, p, middle - up});
  }
}

void table(SceneMaker& maker, const std::string& id, Int3 o, std::int64_t width, std::int64_t depth,
           std::int64_t height) {
  maker.box(id + ".top", o + Int3{0, 0, height - 2}, o + Int3{width, depth, height});
  for (int k = 0; k < 4; ++k) {
    const Int3 foot = o + Int3{(k & 1) != 0 ? width - 3 : 1, (k & 2) != 0 ? depth - 3 : 1, 0};
    maker.box(id + ".leg" + std::to_string(k), foot, foot + Int3{2, 2, height - 2},
              SceneMaker::kSides);
  }
}

void chair(SceneMaker& maker, const std::string& id, Int3 o) {
  table(maker, id, o, 14, 14, 15);
  maker.box(id + ".back", o + Int3{0, 12, 15}, o + Int3{14, 14, 32});
}

void room_shell(SceneMaker& maker, Int3 high) {
  maker.box("room", {0, 0, 0}, high, SceneMaker::kAll, true);
}

}  // namespace gnomon::scene_detail
