// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/findings/finding_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fuzz/scene/scene_coordinates.h"
#include "report/text/text_sink.h"
#include "scene/base/vectors.h"

namespace gnomon::fuzz {

namespace {

using report::Camera;
using report::Point;

double length(const Point& a) { return std::sqrt(dot(a, a)); }

/// Powers of two that bring all axes to about the same extent, where one is far shorter or longer
/// than the others, or beyond what pictures are made for.
std::array<int, kAxes> exponents_for(const Scene& scene) {
  constexpr int kMostApart = 5, kFarthest = 24;
  std::array<int, kAxes> size{}, result{};
  std::array<bool, kAxes> flat{};
  int most = -100'000;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    std::vector<mpq_class> values;
    for (const Position& vertex : scene.vertices) values.push_back(vertex[axis].exact());
    for (const Light& light : scene.lights) {
      for (const Position& corner : light.loop) values.push_back(corner[axis].exact());
    }
    if (values.empty()) return result;
    const auto [low, high] = std::ranges::minmax_element(values);
    const mpq_class extent = *high - *low;
    flat[axis] = sgn(extent) == 0;
    if (flat[axis]) continue;
    size[axis] =
        static_cast<int>(bits_of(extent.get_num())) - static_cast<int>(bits_of(extent.get_den()));
    most = std::max(most, size[axis]);
  }
  if (most == -100'000) return result;
  const int all = std::abs(most) > kFarthest ? -most : 0;
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    result[axis] = all;
    if (!flat[axis] && most - size[axis] > kMostApart) result[axis] += most - size[axis];
  }
  return result;
}

mpq_class times_power_of_two(mpq_class value, int exponent) {
  const mpz_class power = power_of(2, static_cast<unsigned long>(std::abs(exponent)));
  return exponent < 0 ? mpq_class(value / power) : mpq_class(value * power);
}

/// The scene in doubles and stretched, good enough for pictures.
Scene stretched_scene(Scene scene, const std::array<int, kAxes>& exponents) {
  if (exponents == std::array<int, kAxes>{}) return scene;
  scene.numbers = NumberMeaning::kDouble;
  for (Position* point : points_of(scene)) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const double value = times_power_of_two((*point)[axis].exact(), exponents[axis]).get_d();
      (*point)[axis] = Number(std::isfinite(value) ? value : 0.0);
    }
  }
  return scene;
}

/// What a camera sees of a scene, as far as it matters here.
class Views {
 public:
  Views(const Scene& scene, const PreparedScene& prepared, std::optional<Point> place,
        std::string polygon, bool back)
      : scene_(scene),
        prepared_(prepared),
        place_(std::move(place)),
        polygon_(std::move(polygon)),
        back_(back) {}

  /// The default camera, turned so that the place is seen, from the side that matters, and of the
  /// other polygons as much as that allows.
  Camera best() const {
    Camera best = report::default_camera(prepared_);
    const double distance = length(minus(best.eye, best.look_at));
    if (!(distance > 0) || !std::isfinite(distance)) return best;
    // Directions of length 1, the default first; no function of the library is asked.
    constexpr std::array<std::array<double, 2>, 8> kRound{{{0.5846, -0.8113},
                                                           {-0.5846, -0.8113},
                                                           {0.9848, -0.1736},
                                                           {-0.9848, -0.1736},
                                                           {0.8113, 0.5846},
                                                           {-0.8113, 0.5846},
                                                           {0.1736, 0.9848},
                                                           {-0.1736, 0.9848}}};
    constexpr std::array<std::array<double, 2>, 5> kUp{
        {{0.8660, 0.5}, {0.5, 0.8660}, {0.9659, 0.2588}, {0.8660, -0.5}, {0.5, -0.8660}}};
    double best_score = -1;
    for (const auto& [flat, up] : kUp) {
      for (const auto& [x, y] : kRound) {
        const Point direction{flat * x, flat * y, up};
        Point eye = best.look_at;
        for (std::size_t k = 0; k < kAxes; ++k) eye[k] += distance * direction[k];
        const double score = score_of(direction, eye);
        if (score <= best_score) continue;
        best_score = score;
        best.eye = eye;
      }
    }
    return best;
  }

 private:
  std::vector<Point> loop_of(const Part& part) const {
    std::vector<Point> loop;
    for (const VertexId vertex : prepared_.loop(part)) {
      loop.push_back(prepared_.geometry.positions[vertex]);
    }
    return loop;
  }

  static Point area_vector(const std::vector<Point>& loop) {
    Point sum{};
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      const Point own = cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0]));
      for (std::size_t k = 0; k < kAxes; ++k) sum[k] += own[k];
    }
    return sum;
  }

  double score_of(const Point& direction, const Point& eye) const {
    constexpr double kEnough = 0.5;  // seen more steeply than this is no better
    constexpr double kLeast = 0.2;   // a plane seen less steeply is not seen
    bool seen_steeply = false;
    double score = direction[2] > 0 ? 0.1 : 0;
    for (const Part& part : prepared_.parts) {
      const Point vector = area_vector(loop_of(part));
      const double area = length(vector);
      if (!(area > 0) || !std::isfinite(area)) continue;
      const double facing = dot(vector, direction) / area;
      if (scene_.polygons[part.polygon].id == polygon_) {
        const double own = back_ ? -facing : facing;
        score += 4 * std::min(own, kEnough);
        seen_steeply = seen_steeply || own >= kLeast;
      } else {
        // A back is better than an edge.
        const double seen = part.two_sided ? std::abs(facing) : std::max(facing, -facing / 2);
        score += std::min(seen, kEnough) / static_cast<double>(prepared_.parts.size());
      }
    }
    if (place_ && seen_steeply && !hidden_from(eye)) score += 3;
    return score;
  }

  bool hidden_from(const Point& eye) const {
    const Point along = minus(eye, *place_);
    for (const Part& part : prepared_.parts) {
      if (scene_.polygons[part.polygon].id == polygon_) continue;
      const std::vector<Point> loop = loop_of(part);
      const Point normal = area_vector(loop);
      const double slope = dot(normal, along);
      const double at = dot(normal, minus(loop[0], *place_)) / slope;
      constexpr double kTouching = 1e-6;
      if (!(at > kTouching && at < 1)) continue;
      Point meets = *place_;
      for (std::size_t k = 0; k < kAxes; ++k) meets[k] += at * along[k];
      bool inside = true;
      for (std::size_t i = 0; i < loop.size() && inside; ++i) {
        const Point& a = loop[i];
        const Point& b = loop[(i + 1) % loop.size()];
        inside = dot(normal, cross(minus(b, a), minus(meets, a))) > 0;
      }
      if (inside) return true;
    }
    return false;
  }

  const Scene& scene_;
  const PreparedScene& prepared_;
  const std::optional<Point> place_;
  const std::string polygon_;
  bool back_;
};

}  // namespace

FindingPicture::FindingPicture(const Scene& scene, std::uint32_t light,
                               const std::optional<oracle::Witness>& place)
    : exponents_(exponents_for(scene)), scene_(stretched_scene(scene, exponents_)), light_(light) {
  auto prepared = prepare(scene_);
  if (!prepared || light >= prepared->lights.size()) return;
  prepared_ = std::move(*prepared);
  std::optional<Point> at;
  if (place) {
    at.emplace();
    for (std::size_t k = 0; k < kAxes; ++k) {
      (*at)[k] = times_power_of_two(place->point[k], exponents_[k]).get_d();
    }
    mark_ = report::Mark{*at, place->polygon};
  }
  options_.camera = Views(scene_, *prepared_, at, place ? place->polygon : std::string(),
                          place && place->side == Side::kBack)
                        .best();
  options_.height = 600;
  options_.backs = true;
  options_.title = scene_.name;
  pieces_ = back_to_front(*prepared_, options_.camera.eye);
}

namespace {

/// What of a side is lit by its fragments; in doubles, for a picture.
double lit_share(const ClaimedPolygon& polygon) {
  double lit = 0, all = 0;
  for (const ClaimedFragment& fragment : polygon.fragments) {
    Point sum{};
    const auto at = [&](std::size_t i) {
      Point point;
      for (std::size_t k = 0; k < kAxes; ++k) point[k] = fragment.loop[i][k].get_d();
      return point;
    };
    for (std::size_t i = 1; i + 1 < fragment.loop.size(); ++i) {
      const Point own = cross(minus(at(i), at(0)), minus(at(i + 1), at(0)));
      for (std::size_t k = 0; k < kAxes; ++k) sum[k] += own[k];
    }
    all += length(sum);
    if (fragment.state == LightState::kLit) lit += length(sum);
  }
  return all > 0 ? lit / all : 0;
}

/// Of an answer that does not tell where light arrives: the true fragments of the sides of which it
/// tells the true share. Of the others there is nothing to show.
ClaimedLight with_true_fragments(const ClaimedLight& shown, const ClaimedLight& truth) {
  constexpr double kSame = 1e-6;
  ClaimedLight result = truth;
  for (ClaimedPolygon& polygon : result.polygons) {
    const auto own = std::ranges::find_if(shown.polygons, [&](const ClaimedPolygon& other) {
      return other.id == polygon.id && other.side == polygon.side;
    });
    const double share = lit_share(polygon);
    if (own == shown.polygons.end() || !(own->share.lower - kSame <= share) ||
        !(share <= own->share.upper + kSame)) {
      polygon.fragments.clear();
    }
  }
  return result;
}

}  // namespace

ClaimedLight FindingPicture::stretched(const ClaimedLight& light) const {
  ClaimedLight result = light;
  for (ClaimedPolygon& polygon : result.polygons) {
    for (ClaimedFragment& fragment : polygon.fragments) {
      for (RationalPoint& point : fragment.loop) {
        for (std::size_t k = 0; k < kAxes; ++k) {
          point[k] = times_power_of_two(point[k], exponents_[k]);
        }
      }
    }
  }
  return result;
}

std::string FindingPicture::paint(const std::string& caption, const ClaimedLight& shown,
                                  const ClaimedLight* truth) const {
  if (!prepared_) return {};
  const bool told_where = !shown.shares_alone || truth == nullptr;
  const ClaimedLight own = stretched(told_where ? shown : with_true_fragments(shown, *truth));
  std::optional<ClaimedLight> right;
  if (truth != nullptr) right = stretched(*truth);
  report::Panel panel;
  panel.light = light_;
  panel.caption = caption;
  for (std::size_t k = 0; k < kAxes; ++k) {
    if (exponents_[k] == 0) continue;
    panel.caption += fmt::format("{}{} times 2^{}", panel.caption == caption ? "; " : ", ",
                                 "xyz"[k], exponents_[k]);
  }
  panel.shown = &own;
  panel.truth = right ? &*right : nullptr;
  if (mark_) panel.marks = {*mark_};
  report::StringSink sink;
  report::paint_scene(scene_, *prepared_, pieces_, {panel}, options_).write(sink);
  return sink.text();
}

}  // namespace gnomon::fuzz
