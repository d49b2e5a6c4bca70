// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "gnomon/algorithms/components.h"
#include "gnomon/algorithms/facing_sides.h"
#include "report/loops/ridge_loops_report.h"
#include "report/pictures/svg.h"
#include "scene/base/vectors.h"

namespace gnomon::report {

namespace {

using Vector = std::array<double, 3>;
using Point = std::array<double, 2>;

constexpr double kWidth = 800, kMargin = 30;

Vector scaled(const Vector& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}
Vector unit(const Vector& a) { return scaled(a, 1 / std::hypot(a[0], a[1], a[2])); }

/// From space to the plane that the light sees, y up.
class LightView {
 public:
  LightView(const PreparedScene& scene, const LightPoint& light)
      : directional_(light.directional), light_(light.nearest) {
    Vector towards = light_;
    if (!directional_) {
      // The middle of all that casts, from the lamp's place.
      towards = {0, 0, 0};
      for (const auto& position : scene.geometry.polygon_positions()) {
        const Vector one = minus(light_, position);
        const double length = std::hypot(one[0], one[1], one[2]);
        if (length > 0) {
          for (std::size_t k = 0; k < 3; ++k) towards[k] += one[k] / length;
        }
      }
    }
    back_ = unit(towards);
    const Vector up = std::fabs(back_[2]) < 0.9 ? Vector{0, 0, 1} : Vector{0, 1, 0};
    right_ = unit(cross(up, back_));
    up_ = cross(back_, right_);
  }

  /// Empty behind the lamp, and too far beside it.
  std::optional<Point> of(const Vector& position) const {
    if (directional_) return Point{dot(right_, position), dot(up_, position)};
    return of_direction(minus(light_, position));
  }
  std::optional<Point> of_direction(const Vector& to_light) const {
    constexpr double kLeast = 0.05;
    const double depth = dot(back_, to_light);
    if (depth <= kLeast * std::hypot(to_light[0], to_light[1], to_light[2])) return std::nullopt;
    return Point{-dot(right_, to_light) / depth, -dot(up_, to_light) / depth};
  }

 private:
  bool directional_;
  Vector light_, back_, right_, up_;
};

/// Where the ray of a loop is: from the directions of its component's vertices, in doubles.
class RayPlaces {
 public:
  RayPlaces(const RidgeLoopsOf& loops, const RidgeLoops& own, const LightView& view)
      : places_(own.rays.size()) {
    const Geometry& geometry = loops.prepared.geometry;
    const LightPoint& light = loops.prepared.lights[loops.light].point;
    for (std::size_t i = 0; i < own.rays.size(); ++i) {
      const mpz_class& third = own.rays[i][2];
      if (!light.directional) {
        // Scaled by its largest coordinate, so that it is in the range of doubles.
        mpz_class largest = 1;
        for (const mpz_class& c : own.rays[i]) largest = std::max(largest, mpz_class(abs(c)));
        Vector direction;
        for (std::size_t k = 0; k < 3; ++k) {
          direction[k] = mpq_class(own.rays[i][k], largest).get_d();
        }
        places_[i] = view.of_direction(direction);
        continue;
      }
      places_[i] = view.of(on_chart(geometry, light, own.rays[i], third));
    }
  }
  const std::optional<Point>& of(std::uint32_t ray) const { return places_[ray]; }

 private:
  /// The point of space that has these chart coordinates and 0 along the chart's axis of the grid.
  static Vector on_chart(const Geometry& geometry, const LightPoint& light,
                         const std::array<mpz_class, 3>& ray, const mpz_class& third) {
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      if (abs(light.grid[k]) > abs(light.grid[axis])) axis = k;
    }
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const mpz_class& along = light.grid[axis];
    std::array<mpq_class, 3> grid{0, 0, 0};
    grid[static_cast<std::size_t>(u)] = mpq_class(along < 0 ? mpz_class(-ray[0]) : ray[0], 1);
    grid[static_cast<std::size_t>(v)] = mpq_class(ray[1], 1);
    Vector place;
    for (std::size_t k = 0; k < 3; ++k) {
      grid[k] /= mpq_class(along * third);
      place[k] = mpq_class(geometry.origin[k] + geometry.step * grid[k]).get_d();
    }
    return place;
  }

  std::vector<std::optional<Point>> places_;
};

struct Drawn {
  std::vector<std::vector<Point>> facing;
  struct Loop {
    LoopKind kind;
    std::vector<Point> points;
    std::vector<Point> jumps;  // imaginary edges
  };
  std::vector<Loop> loops;
};

bool add_loop(const RidgeLoop& loop, const RayPlaces& places, Drawn& drawn) {
  Drawn::Loop own{loop.kind, {}, {}};
  for (const LoopStep& step : loop.steps) {
    const auto& place = places.of(step.ray);
    if (!place) return false;
    own.points.push_back(*place);
    if (step.imaginary) own.jumps.push_back(*place);
  }
  drawn.loops.push_back(std::move(own));
  return true;
}

void add_facing(const RidgeLoopsOf& loops, const LightView& view, Drawn& drawn) {
  const LightPoint& light = loops.prepared.lights[loops.light].point;
  const auto sides = facing_sides(loops.prepared, light);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (sides[i] == Side::kOn) continue;
    std::vector<Point> points;
    for (const VertexId vertex : loops.prepared.loop(loops.prepared.parts[i])) {
      const auto place = view.of(loops.prepared.geometry.positions[vertex]);
      if (!place) break;
      points.push_back(*place);
    }
    if (points.size() == loops.prepared.parts[i].count) drawn.facing.push_back(std::move(points));
  }
}

/// Pixels with y down, all of the loops in view.
class Frame {
 public:
  explicit Frame(const Drawn& drawn) {
    const auto take = [&](const std::vector<Point>& points) {
      for (const Point& p : points) {
        for (std::size_t k = 0; k < 2; ++k) {
          low_[k] = std::min(low_[k], p[k]);
          high_[k] = std::max(high_[k], p[k]);
        }
      }
    };
    for (const auto& loop : drawn.loops) take(loop.points);
    if (drawn.loops.empty()) {
      for (const auto& loop : drawn.facing) take(loop);
    }
    const double across = std::max(high_[0] - low_[0], 1e-300);
    const double down = std::max(high_[1] - low_[1], 0.0);
    scale_ = (kWidth - 2 * kMargin) / std::max(across, down);
    height_ = down * scale_ + 2 * kMargin;
  }
  double height() const { return height_; }
  std::vector<PixelPoint> of(const std::vector<Point>& points) const {
    std::vector<PixelPoint> pixels;
    for (const Point& p : points) {
      pixels.push_back(
          {kMargin + (p[0] - low_[0]) * scale_, height_ - kMargin - (p[1] - low_[1]) * scale_});
    }
    return pixels;
  }

 private:
  static constexpr double kMost = std::numeric_limits<double>::infinity();
  Point low_{kMost, kMost}, high_{-kMost, -kMost};
  double scale_ = 1, height_ = kWidth;
};

Paint paint_of(LoopKind kind) {
  Paint paint;
  paint.stroke_width = 2.5;
  paint.stroke = kind == LoopKind::kExternal ? "#1b1b1b" : "#c0392b";
  if (kind == LoopKind::kInternal) {
    paint.stroke = "#2563a8";
    paint.stroke_width = 1.5;
  }
  return paint;
}

void write(TextSink& sink, const Drawn& drawn) {
  const Frame frame(drawn);
  SvgPicture picture(kWidth, frame.height() + kMargin, "ridge-edge loops");
  Paint polygon;
  polygon.fill = "#e9e4d4";
  polygon.stroke = "#ffffff";
  polygon.stroke_width = 0.8;
  for (const auto& loop : drawn.facing) picture.polygon(frame.of(loop), polygon);
  for (const LoopKind kind : {LoopKind::kInternal, LoopKind::kHole, LoopKind::kExternal}) {
    for (const Drawn::Loop& loop : drawn.loops) {
      if (loop.kind != kind) continue;
      picture.polygon(frame.of(loop.points), paint_of(kind));
    }
  }
  Paint jump;
  jump.fill = "#e08a00";
  for (const Drawn::Loop& loop : drawn.loops) {
    for (const PixelPoint& at : frame.of(loop.jumps)) picture.circle(at, 3.5, jump);
  }
  double x = kMargin;
  const double y = frame.height() + kMargin / 3;
  for (const auto& [kind, words] : {std::pair(LoopKind::kExternal, "external"),
                                    {LoopKind::kHole, "hole"},
                                    {LoopKind::kInternal, "internal"}}) {
    picture.line({x, y - 4}, {x + 26, y - 4}, paint_of(kind));
    picture.text({x + 32, y}, words, 13, {60, 60, 60});
    x += 120;
  }
  picture.circle({x + 6, y - 4}, 3.5, jump);
  picture.text({x + 16, y}, "imaginary edge, from one depth to another", 13, {60, 60, 60});
  picture.write(sink);
}

}  // namespace

Expected<void> write_ridge_loops_svg(TextSink& sink, const RidgeLoopsOf& loops) {
  const LightView view(loops.prepared, loops.prepared.lights[loops.light].point);
  Drawn drawn;
  for (const RidgeLoops& own : loops.components) {
    const RayPlaces places(loops, own, view);
    for (const RidgeLoop& loop : own.loops) {
      if (add_loop(loop, places, drawn)) continue;
      return fail(ErrorCode::kUsage,
                  "loops go too far around light '" +
                      loops.scene.lights[loops.prepared.lights[loops.light].light].id +
                      "' to be in one picture",
                  "a light that sees all of the scene before it, or JSON");
    }
  }
  add_facing(loops, view, drawn);
  write(sink, drawn);
  return {};
}

}  // namespace gnomon::report
