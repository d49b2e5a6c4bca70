// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/lines/lines_picture.h"

#include <array>
#include <optional>
#include <utility>

#include "report/pictures/flat_geometry.h"

namespace gnomon::report {
namespace {

Vector from_integers(const std::array<std::int32_t, 3>& v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// The picture of an exact camera, in doubles.
class LineView {
 public:
  explicit LineView(const ExactCamera& camera)
      : eye_{camera.eye[0].nearest(), camera.eye[1].nearest(), camera.eye[2].nearest()},
        width_(camera.width),
        height_(camera.height) {
    // p = (ahead . p) F + (across . p) R + (above . p) U, since the frame need not be orthogonal.
    const Vector right = from_integers(camera.right), up = from_integers(camera.up);
    const Vector forward = from_integers(camera.forward);
    const double volume = dot(forward, cross(right, up));
    ahead_ = (1 / volume) * cross(right, up);
    across_ = (1 / volume) * cross(up, forward);
    above_ = (1 / volume) * cross(forward, right);
  }

  double width() const { return width_; }
  double height() const { return height_; }

  /// What is in view of a segment, in pixels.
  std::optional<std::pair<PixelPoint, PixelPoint>> segment(const Vector& a, const Vector& b) const {
    const Vector first = seen(a), second = seen(b);
    double from = 0, to = 1;
    // A little beyond the frame; and not nearer than a millionth of the farther end.
    constexpr double kBeyond = 1.02;
    const double nearest = 1e-6 * std::max(first[0], second[0]);
    const auto keep = [&](double at_first, double at_second) {
      if (at_first < 0 && at_second < 0) to = -1;
      if (at_first < 0 && at_second >= 0) {
        from = std::max(from, at_first / (at_first - at_second));
      }
      if (at_first >= 0 && at_second < 0) to = std::min(to, at_first / (at_first - at_second));
    };
    if (!(nearest > 0)) return std::nullopt;
    keep(first[0] - nearest, second[0] - nearest);
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
      keep(kBeyond * first[0] - first[k], kBeyond * second[0] - second[k]);
      keep(kBeyond * first[0] + first[k], kBeyond * second[0] + second[k]);
    }
    if (!(from < to)) return std::nullopt;
    return std::pair(pixel(first + from * (second - first)), pixel(first + to * (second - first)));
  }

 private:
  Vector seen(const Vector& point) const {
    const Vector p = point - eye_;
    return {dot(ahead_, p), dot(across_, p), dot(above_, p)};
  }
  PixelPoint pixel(const Vector& seen) const {
    return {width_ / 2 * (1 + seen[1] / seen[0]), height_ / 2 * (1 - seen[2] / seen[0])};
  }

  Vector eye_, ahead_, across_, above_;
  double width_, height_;
};

}  // namespace

SvgPicture lines_picture(const PreparedScene& prepared, const DrawnLines& drawn, bool hidden,
                         const std::string& title) {
  const LineView view(drawn.camera);
  SvgPicture picture(view.width(), view.height(), title);
  Paint paper;
  paper.fill = "#ffffff";
  picture.rectangle({0, 0}, view.width(), view.height(), paper);
  struct Pen {
    LineStyle style;
    const char* attributes;
  };
  constexpr std::array kPens = {
      Pen{LineStyle::kHidden, "stroke=\"#8a94a6\" stroke-width=\"0.5\" stroke-linecap=\"round\""},
      Pen{LineStyle::kShadowed, "stroke=\"#1d2330\" stroke-width=\"1.2\" stroke-dasharray=\"4 3\""},
      Pen{LineStyle::kSeen, "stroke=\"#1d2330\" stroke-width=\"1.4\" stroke-linecap=\"round\""}};
  for (const Pen& pen : kPens) {
    if (pen.style == LineStyle::kHidden && !hidden) continue;
    picture.begin_group(pen.attributes);
    for (std::size_t i = 0; i < drawn.edges.size(); ++i) {
      const EdgeEnds ends = prepared.geometry.edges[drawn.edges[i].edge];
      const Vector a = prepared.geometry.positions[ends.a], b = prepared.geometry.positions[ends.b];
      for (const StyledPart& part : styled_parts(drawn, i)) {
        if (part.style != pen.style) continue;
        const auto pixels = view.segment(a + part.from * (b - a), a + part.to * (b - a));
        if (pixels) picture.line(pixels->first, pixels->second, {});
      }
    }
    picture.end_group();
  }
  return picture;
}

}  // namespace gnomon::report
