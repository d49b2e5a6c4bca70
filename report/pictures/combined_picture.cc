// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pictures/combined_picture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "report/pictures/flat_geometry.h"
#include "report/pictures/scene_lines.h"
#include "report/pictures/view.h"

namespace gnomon::report {

namespace {

constexpr Colour kByAllBright{255, 241, 198}, kByAllDim{176, 138, 88};
constexpr Colour kByNone{44, 46, 52}, kByMost{208, 210, 214};
constexpr double kBorderOfLoop = 0.6;  // its share of ink

/// Of a side of a polygon: where so many lights do or do not reach it.
struct ReachedLoop {
  std::vector<Vector> loop;
  std::vector<std::string> dark_for;  // of an overlay
  double reach = 0;                   // of a partition: so many lights
  std::uint64_t level = 0;
};

class CombinedPainter {
 public:
  CombinedPainter(const Scene& scene, const PreparedScene& prepared, const Claims& claims,
                  const std::vector<std::uint32_t>& lights, const PictureOptions& options,
                  const View& view, SvgPicture& svg)
      : scene_(scene),
        prepared_(prepared),
        lights_(lights),
        is_overlay_(claims.overlay.has_value()),
        options_(options),
        view_(view),
        svg_(svg) {
    const auto [low, high] = bounding_box(prepared);
    size_ = length(high - low);
    for (const SharedPolygon& polygon : is_overlay_ ? *claims.overlay : *claims.combined) {
      std::vector<ReachedLoop>& loops = loops_[{polygon.id, polygon.side}];
      for (const SharedFragment& fragment : polygon.fragments) {
        ReachedLoop loop{{}, fragment.dark_for, 0, fragment.level};
        loop.reach = static_cast<double>(fragment.lit_by.size()) +
                     0.5 * static_cast<double>(fragment.penumbra_of.size());
        for (const RationalPoint& point : fragment.loop) {
          loop.loop.push_back({point[0].get_d(), point[1].get_d(), point[2].get_d()});
        }
        if (loop.loop.size() >= 3) loops.push_back(std::move(loop));
      }
      std::ranges::stable_sort(loops, {}, &ReachedLoop::level);
    }
  }

  void paint(const OrderedPiece& piece) {
    const Part& part = prepared_.parts[piece.part];
    const std::vector<Vector> whole = whole_loop(prepared_, part);
    const Vector normal = unit(area_vector(whole));
    const bool front = dot(normal, view_.eye() - whole.front()) > 0;
    if (!front && !part.two_sided && !options_.backs) return;
    const auto facing = facing_lights(front ? normal : -1.0 * normal, whole.front());
    // Greys of one part alike, whatever the tree cut it into.
    const double bright =
        0.5 * std::abs(dot(normal, unit(view_.eye() - whole.front()))) + 0.5 * std::abs(normal[2]);
    const double base = is_overlay_ ? static_cast<double>(facing.size()) : 0;
    fill(piece.loop, colour(base, bright), false);
    const auto found = loops_.find(
        {scene_.polygons[part.polygon].id, front || !part.two_sided ? Side::kFront : Side::kBack});
    if (found != loops_.end()) {
      for (const ReachedLoop& loop : found->second) {
        const auto cut = intersection(projected(loop.loop, normal, piece.loop.front()), piece.loop);
        if (cut.empty()) continue;
        double reach = loop.reach;
        if (is_overlay_) {
          reach = static_cast<double>(std::ranges::count_if(facing, [&](const std::string& light) {
            return std::ranges::find(loop.dark_for, light) == loop.dark_for.end();
          }));
        }
        fill(cut, colour(reach, bright), options_.fragments);
      }
    }
    paint_outline(prepared_, piece, size_, view_, svg_);
  }

  Colour colour(double reach, double bright) const {
    const double most = static_cast<double>(lights_.size());
    if (reach >= most) return mix(kByAllDim, kByAllBright, bright);
    const Colour grey = mix(kByNone, kByMost, most > 1 ? reach / (most - 1) : 0);
    return mix(kByNone, grey, 0.7 + 0.3 * bright);
  }

 private:
  /// Ids of the point and directional lights that a plane's side faces; good to a pixel.
  std::vector<std::string> facing_lights(const Vector& normal, const Vector& on_plane) const {
    std::vector<std::string> ids;
    for (const std::uint32_t light : lights_) {
      const LightPoint& point = prepared_.lights[light].point;
      const Vector at{point.nearest[0], point.nearest[1], point.nearest[2]};
      if (dot(normal, point.directional ? at : at - on_plane) > 0) {
        ids.push_back(scene_.lights[prepared_.lights[light].light].id);
      }
    }
    return ids;
  }

  void fill(const std::vector<Vector>& loop, Colour colour, bool bordered) {
    const std::vector<PixelPoint> pixels = view_.pixels(loop);
    if (pixels.size() < 3) return;
    const Colour border = bordered ? mix(colour, kPictureInk, kBorderOfLoop) : colour;
    svg_.polygon(pixels, {colour_text(colour), colour_text(border), kSeamWidth});
  }

  const Scene& scene_;
  const PreparedScene& prepared_;
  const std::vector<std::uint32_t>& lights_;
  bool is_overlay_;
  const PictureOptions& options_;
  const View& view_;
  SvgPicture& svg_;
  double size_ = 1;
  std::map<std::pair<std::string, Side>, std::vector<ReachedLoop>> loops_;
};

void paint_counts_legend(SvgPicture& svg, const CombinedPainter& painter, std::size_t lights,
                         double top) {
  double x = 2;
  for (std::size_t reach = lights + 1; reach-- > 0;) {
    const std::string text = reach == lights ? "lit by all " + std::to_string(lights)
                             : reach == 0    ? "by none"
                                             : "by " + std::to_string(reach);
    svg.rectangle({x, top + 14}, 22, 16,
                  {colour_text(painter.colour(static_cast<double>(reach), 1)),
                   colour_text(kPictureInk), 0.6});
    svg.text({x + 30, top + 27}, text, 14, kPictureInk);
    x += 54 + 7.2 * static_cast<double>(text.size());
  }
}

}  // namespace

SvgPicture paint_combined_scene(const Scene& scene, const PreparedScene& prepared,
                                const std::vector<OrderedPiece>& pieces, const Claims& claims,
                                const std::vector<std::uint32_t>& lights,
                                const PictureOptions& options) {
  const double height = options.height + (options.legend ? kLegendHeight : 0);
  SvgPicture svg(options.width, height, options.title.empty() ? scene.name : options.title);
  svg.rectangle({0, 0}, options.width, height, {"#ffffff"});
  const View view = view_of(prepared, options);
  begin_frame(svg, options);
  CombinedPainter painter(scene, prepared, claims, lights, options, view, svg);
  for (const OrderedPiece& piece : pieces) painter.paint(piece);
  for (const std::uint32_t light : lights) {
    if (!prepared.lights[light].has_area()) {
      paint_point_lamp(prepared.lights[light].point, view, svg);
    }
  }
  end_frame(svg, options);
  if (options.legend) paint_counts_legend(svg, painter, lights.size(), options.height);
  return svg;
}

}  // namespace gnomon::report
