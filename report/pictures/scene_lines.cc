// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pictures/scene_lines.h"

#include <algorithm>
#include <cstdint>

#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

constexpr double kOutlineWidth = 0.9;

/// An edge that a coplanar part of the same polygon shares was made by cutting the polygon up.
bool is_inner_edge(const PreparedScene& prepared, const Part& part, std::size_t edge) {
  const std::uint32_t first = prepared.first_part[part.polygon];
  const std::uint32_t last = prepared.first_part[part.polygon + 1];
  if (last - first == 1) return false;
  const std::uint32_t index = prepared.edges(part)[edge].index();
  int uses = 0;
  for (std::uint32_t other = first; other < last; ++other) {
    const Part& sibling = prepared.parts[other];
    if (sibling.plane != part.plane) continue;
    for (PlaneRef ref : prepared.edges(sibling)) uses += ref.index() == index ? 1 : 0;
  }
  return uses > 1;
}

}  // namespace

void begin_frame(SvgPicture& svg, const PictureOptions& options) {
  svg.define("<clipPath id=\"frame\"><rect width=\"" + rounded(options.width) + "\" height=\"" +
             rounded(options.height) + "\"/></clipPath>");
  svg.begin_group("clip-path=\"url(#frame)\" stroke-linejoin=\"round\"");
  svg.rectangle({0, 0}, options.width, options.height, {colour_text(kPictureBackground)});
}

void end_frame(SvgPicture& svg, const PictureOptions& options) {
  svg.end_group();
  svg.rectangle({0, 0}, options.width, options.height,
                {"none", colour_text(mix(kPictureInk, kPictureBackground, 0.6)), 1});
}

View view_of(const PreparedScene& prepared, const PictureOptions& options) {
  const auto [low, high] = bounding_box(prepared);
  const auto positions = prepared.geometry.polygon_positions();
  return {options.camera,
          0,
          0,
          options.width,
          options.height,
          length(high - low),
          std::vector<Vector>(positions.begin(), positions.end())};
}

std::vector<Vector> whole_loop(const PreparedScene& prepared, const Part& part) {
  std::vector<Vector> loop;
  for (const VertexId vertex : prepared.loop(part)) {
    loop.push_back(prepared.geometry.positions[vertex]);
  }
  return loop;
}

void paint_outline(const PreparedScene& prepared, const OrderedPiece& piece, double size,
                   const View& view, SvgPicture& svg) {
  const Part& part = prepared.parts[piece.part];
  const std::vector<Vector> whole = whole_loop(prepared, part);
  const auto on_outline = [&](const Vector& a, const Vector& b) {
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const Vector& from = whole[i];
      const Vector along = unit(whole[(i + 1) % whole.size()] - from);
      const double off = std::max(length(cross(along, a - from)), length(cross(along, b - from)));
      if (off < 1e-7 * size) return !is_inner_edge(prepared, part, i);
    }
    return false;
  };
  for (std::size_t i = 0; i < piece.loop.size(); ++i) {
    const Vector& a = piece.loop[i];
    const Vector& b = piece.loop[(i + 1) % piece.loop.size()];
    if (!on_outline(a, b)) continue;
    // A thin triangle is clipped like any loop; its long sides are the line.
    const std::vector<Vector> seen = view.visible({a, b, 0.5 * (a + b)});
    std::vector<PixelPoint> pixels;
    pixels.reserve(seen.size());
    for (const Vector& point : seen) pixels.push_back(view.pixel(point));
    if (pixels.size() < 2) continue;
    const auto [low, high] = std::ranges::minmax_element(pixels);
    PixelPoint first = *low, last = *high;
    svg.line(first, last, {"none", colour_text(kPictureInk), kOutlineWidth, 0.55});
  }
}

void paint_point_lamp(const LightPoint& light, const View& view, SvgPicture& svg) {
  if (light.directional) return;
  const auto at = view.pixel_of({light.nearest[0], light.nearest[1], light.nearest[2]});
  if (!at) return;
  svg.circle(*at, 10, {colour_text(kPictureLamp), "none", 0, 0.3});
  svg.circle(*at, 4.5, {colour_text(kPictureLamp), colour_text(kPictureInk), 0.9});
}

}  // namespace gnomon::report
