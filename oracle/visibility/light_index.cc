// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/visibility/light_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::oracle {

namespace {

constexpr std::size_t kManyCells = 64;  // a box over more is looked at by every question
constexpr double kLargest = 0x1p400;    // beyond it, or below its inverse, boxes are not made
constexpr double kNear = 1024;          // rounding errors that a depth must exceed to be divided by

}  // namespace

LightIndex::LightIndex(const PreparedScene& scene, const PreparedLight& light,
                       const std::vector<std::uint32_t>& casters)
    : scene_(scene), directional_(light.point.directional), light_(light.point.nearest) {
  double greatest = 0;
  for (const VertexId vertex : scene.loop_vertices) {
    for (const double coordinate : scene.geometry.positions[vertex]) {
      greatest = std::max(greatest, std::fabs(coordinate));
    }
  }
  if (directional_) {
    for (int k = 0; k < 3; ++k) {
      if (std::fabs(light_[k]) > std::fabs(light_[axis_])) axis_ = k;
    }
    const double most = std::fabs(light_[axis_]);
    if (!(most > 0 && most < kLargest)) greatest = std::numeric_limits<double>::infinity();
    for (double& component : light_) component /= most;
  } else {
    for (const double coordinate : light_) greatest = std::max(greatest, std::fabs(coordinate));
  }
  // Half a unit in the last place for each of the rounded numbers, products and differences; 16 are
  // more than there are.
  error_ = 16 * 0x1p-53 * greatest;
  if (!(greatest > 1 / kLargest && greatest < kLargest)) {
    everywhere_ = casters;
    return;
  }
  faces_.resize(directional_ ? 1 : 6);
  for (const std::uint32_t part : casters) {
    for (const FaceBox& own : boxes_of(part)) faces_[own.face].boxes.emplace_back(own.box, part);
  }
  for (Face& face : faces_) arrange(face);
}

std::vector<LightIndex::FaceBox> LightIndex::boxes_of(std::uint32_t part) const {
  std::vector<std::array<double, 3>> corners;
  for (const VertexId vertex : scene_.loop(scene_.parts[part])) {
    corners.push_back(scene_.geometry.positions[vertex]);
  }
  return boxes_of(corners, error_);
}

/// `error`: of a difference of coordinates.
std::vector<LightIndex::FaceBox> LightIndex::boxes_of(
    std::span<const std::array<double, 3>> corners, double error) const {
  std::vector<FaceBox> result;
  const auto add = [&](int face, const auto& corner_at, double off, double limit) {
    Box box{{limit, limit}, {-limit, -limit}};
    for (const std::array<double, 3>& corner : corners) {
      const std::array<double, 2> place = corner_at(corner);
      for (int i = 0; i < 2; ++i) {
        box.low[i] = std::min(box.low[i], std::max(place[i] - off, -limit));
        box.high[i] = std::max(box.high[i], std::min(place[i] + off, limit));
      }
    }
    result.push_back({face, box});
  };
  if (directional_) {
    const int i = (axis_ + 1) % 3, j = (axis_ + 2) % 3;
    const double sign = light_[axis_];
    add(
        0,
        [&](const std::array<double, 3>& p) {
          return std::array<double, 2>{p[i] - p[axis_] * sign * light_[i],
                                       p[j] - p[axis_] * sign * light_[j]};
        },
        error, std::numeric_limits<double>::infinity());
    return result;
  }
  for (int face = 0; face < 6; ++face) {
    const int k = face / 2, i = (k + 1) % 3, j = (k + 2) % 3;
    const double sign = face % 2 == 0 ? 1 : -1;
    const auto depth = [&](const std::array<double, 3>& p) { return sign * (p[k] - light_[k]); };
    // Beyond one of the planes that bound what the face is seen through.
    const auto all_beyond = [&](const auto& value) {
      return std::ranges::all_of(
          corners, [&](const std::array<double, 3>& p) { return value(p) < -3 * error; });
    };
    bool apart = all_beyond(depth);
    for (const int other : {i, j}) {
      for (const double turn : {1.0, -1.0}) {
        apart = apart || all_beyond([&](const std::array<double, 3>& p) {
                  return depth(p) - turn * (p[other] - light_[other]);
                });
      }
    }
    if (apart) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::array<double, 3>& p : corners) nearest = std::min(nearest, depth(p));
    if (!(nearest > kNear * error)) {
      result.push_back({face, {{-1, -1}, {1, 1}}});
      continue;
    }
    // (a + e) / (w - e) for |a| <= w: off by less than 3 e / w.
    add(
        face,
        [&](const std::array<double, 3>& p) {
          return std::array<double, 2>{(p[i] - light_[i]) / depth(p),
                                       (p[j] - light_[j]) / depth(p)};
        },
        4 * error / nearest + 0x1p-50, 1);
  }
  return result;
}

LightIndex::Cells LightIndex::cells_of(const Face& face, const Box& box) {
  Cells cells{};
  for (int i = 0; i < 2; ++i) {
    const std::size_t count = i == 0 ? face.columns : face.rows;
    const double size = face.bounds.high[i] - face.bounds.low[i];
    const auto cell = [&](double place) {
      const double at = (place - face.bounds.low[i]) / size * static_cast<double>(count);
      return at > 0 ? std::min(count - 1,
                               static_cast<std::size_t>(std::min(at, static_cast<double>(count))))
                    : std::size_t{0};
    };
    cells.first[i] = cell(box.low[i]);
    cells.last[i] = std::max(cells.first[i], cell(box.high[i]));
  }
  return cells;
}

void LightIndex::arrange(Face& face) const {
  if (face.boxes.empty()) return;
  face.bounds = face.boxes.front().first;
  for (const auto& [box, part] : face.boxes) {
    for (int i = 0; i < 2; ++i) {
      face.bounds.low[i] = std::min(face.bounds.low[i], box.low[i]);
      face.bounds.high[i] = std::max(face.bounds.high[i], box.high[i]);
    }
  }
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(face.boxes.size())));
  constexpr std::size_t kMostColumns = 512;
  face.columns = face.rows = std::clamp(side, std::size_t{1}, kMostColumns);
  face.cells.resize(face.columns * face.rows);
  for (std::uint32_t b = 0; b < face.boxes.size(); ++b) {
    const Cells cells = cells_of(face, face.boxes[b].first);
    if (cells.count() > kManyCells) {
      face.large.push_back(b);
      continue;
    }
    for (std::size_t y = cells.first[1]; y <= cells.last[1]; ++y) {
      for (std::size_t x = cells.first[0]; x <= cells.last[0]; ++x) {
        face.cells[y * face.columns + x].push_back(b);
      }
    }
  }
}

std::vector<std::uint32_t> LightIndex::overlapping(std::uint32_t part) const {
  return faces_.empty() ? everywhere_ : meeting(boxes_of(part));
}

std::vector<std::uint32_t> LightIndex::before(const std::array<double, 3>& point) const {
  double greatest = 0;
  for (const double coordinate : point) greatest = std::max(greatest, std::fabs(coordinate));
  if (faces_.empty() || !(greatest < kLargest)) return everywhere_;
  // As error_, of which the scene's own coordinates are a part.
  const double error = std::max(error_, 16 * 0x1p-53 * greatest);
  return meeting(boxes_of(std::span(&point, 1), error));
}

std::vector<std::uint32_t> LightIndex::meeting(const std::vector<FaceBox>& boxes) const {
  std::vector<std::uint32_t> found;
  for (const FaceBox& own : boxes) {
    const Face& face = faces_[own.face];
    if (face.boxes.empty()) continue;
    const auto look_at = [&](std::uint32_t b) {
      const Box& box = face.boxes[b].first;
      for (int i = 0; i < 2; ++i) {
        if (box.high[i] < own.box.low[i] || own.box.high[i] < box.low[i]) return;
      }
      found.push_back(face.boxes[b].second);
    };
    const Cells cells = cells_of(face, own.box);
    for (std::size_t y = cells.first[1]; y <= cells.last[1]; ++y) {
      for (std::size_t x = cells.first[0]; x <= cells.last[0]; ++x) {
        std::ranges::for_each(face.cells[y * face.columns + x], look_at);
      }
    }
    std::ranges::for_each(face.large, look_at);
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace gnomon::oracle
