// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pictures/picture.h"

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "report/pictures/scene_lines.h"
#include "report/pictures/view.h"

namespace gnomon::report {

namespace {

// Warm light, cool shadow, and a signal that is neither.
constexpr Colour kLitBright{255, 241, 198};
constexpr Colour kLitDim{176, 138, 88};
constexpr Colour kShadowBright{104, 118, 150};
constexpr Colour kShadowDim{58, 66, 92};
// As on the plates of 1992: light grey penumbra, dark grey umbra.
constexpr Colour kPenumbraBright{201, 203, 208};
constexpr Colour kPenumbraDim{150, 153, 162};
constexpr Colour kUmbraBright{98, 101, 110};
constexpr Colour kUmbraDim{56, 59, 68};
constexpr Colour kMissing{208, 188, 240};
constexpr Colour kSignal{226, 26, 124};
constexpr Colour kWall{0, 96, 180};
constexpr Colour kLampFrame{176, 120, 0};
constexpr double kFragmentInk = 0.6;  // of a fragment's border, the rest is the fragment's colour
constexpr double kCaptionHeight = 34;
constexpr double kGap = 12;

struct ShadedLoop {
  LightState state;
  std::vector<Vector> loop;
  Vector low, high;
};

void set_box(ShadedLoop& shaded) {
  shaded.low = shaded.high = shaded.loop.front();
  for (const Vector& point : shaded.loop) {
    for (int k = 0; k < 3; ++k) {
      shaded.low[k] = std::min(shaded.low[k], point[k]);
      shaded.high[k] = std::max(shaded.high[k], point[k]);
    }
  }
}

bool boxes_meet(const ShadedLoop& a, const ShadedLoop& b) {
  for (int k = 0; k < 3; ++k) {
    // Flat boxes of one plane may miss each other by a rounding of their coordinates.
    const double slack = 1e-12 * (std::fabs(a.low[k]) + std::fabs(b.low[k]));
    if (a.low[k] > b.high[k] + slack || b.low[k] > a.high[k] + slack) return false;
  }
  return true;
}

/// The fragments of one result under one light, by polygon and side.
class ShadedPolygons {
 public:
  explicit ShadedPolygons(const ClaimedLight& light)
      : background_(light.background),
        cover_(light.cover),
        per_caster_umbra_(light.per_caster_umbra) {
    for (const ClaimedPolygon& polygon : light.polygons) {
      std::vector<ShadedLoop> loops;
      for (const ClaimedFragment& fragment : polygon.fragments) {
        ShadedLoop shaded{fragment.state, {}, {}, {}};
        for (const RationalPoint& point : fragment.loop) {
          shaded.loop.push_back({point[0].get_d(), point[1].get_d(), point[2].get_d()});
        }
        if (shaded.loop.size() < 3) continue;
        set_box(shaded);
        loops.push_back(std::move(shaded));
      }
      // A foreign file that names no side means the only one that counts.
      if (!polygon.side_given) loops_[{polygon.id, Side::kBack}] = loops;
      loops_[{polygon.id, polygon.side}] = std::move(loops);
    }
  }

  /// Null if the result does not list this side.
  const std::vector<ShadedLoop>* find(const std::string& id, Side side) const {
    const auto found = loops_.find({id, side});
    return found == loops_.end() ? nullptr : &found->second;
  }
  std::optional<LightState> background() const { return background_; }
  Cover cover() const { return cover_; }
  /// Else umbra may be called penumbra: a cost, no difference.
  bool per_caster_umbra() const { return per_caster_umbra_; }

 private:
  std::optional<LightState> background_;
  Cover cover_;
  bool per_caster_umbra_;
  std::map<std::pair<std::string, Side>, std::vector<ShadedLoop>> loops_;
};

class Painter {
 public:
  Painter(const Scene& scene, const PreparedScene& prepared, std::uint32_t light,
          const PictureOptions& options, SvgPicture& svg)
      : scene_(scene),
        prepared_(prepared),
        light_(prepared.lights[light].point),
        area_light_(prepared.lights[light].has_area()),
        options_(options),
        svg_(svg) {
    const auto [low, high] = bounding_box(prepared);
    size_ = length(high - low);
    if (!area_light_) return;
    for (const auto& corner : prepared.lights[light].area_loop) {
      Vector point;
      for (int k = 0; k < 3; ++k) {
        const mpq_class exact = prepared.geometry.origin[k] +
                                prepared.geometry.step * corner[static_cast<std::size_t>(k)];
        point[k] = exact.get_d();
      }
      panel_.push_back(point);
    }
    for (const Vector& corner : panel_) {
      panel_centre_ = panel_centre_ + (1.0 / static_cast<double>(panel_.size())) * corner;
    }
  }

  /// `clip`: a name of the panel's own.
  void panel(const Panel& panel, const std::string& clip, const std::vector<OrderedPiece>& pieces,
             double left, double top) {
    const View view(options_.camera, left, top, options_.width, options_.height, size_,
                    to_be_in_view());
    svg_.define("<clipPath id=\"" + clip + "\"><rect x=\"" +
                std::to_string(static_cast<int>(left)) + "\" y=\"" +
                std::to_string(static_cast<int>(top)) + "\" width=\"" +
                std::to_string(static_cast<int>(options_.width)) + "\" height=\"" +
                std::to_string(static_cast<int>(options_.height)) + "\"/></clipPath>");
    svg_.begin_group("clip-path=\"url(#" + clip + ")\" stroke-linejoin=\"round\"");
    svg_.rectangle({left, top}, options_.width, options_.height, {colour_text(kPictureBackground)});
    const ShadedPolygons shown(*panel.shown);
    std::optional<ShadedPolygons> truth;
    if (panel.truth != nullptr) truth.emplace(*panel.truth);
    for (const OrderedPiece& piece : pieces) {
      paint(piece, view, shown, truth ? &*truth : nullptr);
    }
    for (const std::vector<Point>& wall : panel.walls) paint_wall(wall, view);
    paint_lamp(view);
    for (const Mark& mark : panel.marks) paint_mark(mark, view);
    svg_.end_group();
    svg_.rectangle({left, top}, options_.width, options_.height,
                   {"none", colour_text(mix(kPictureInk, kPictureBackground, 0.6)), 1});
    if (!panel.caption.empty()) {
      svg_.text({left + 2, top - 11}, panel.caption, 16, kPictureInk, "start", true);
    }
  }

 private:
  /// The scene, and an area light unless it is so far off that the scene would be small.
  std::vector<Vector> to_be_in_view() const {
    const auto own = prepared_.geometry.polygon_positions();
    std::vector<Vector> points(own.begin(), own.end());
    const auto [low, high] = bounding_box(prepared_);
    if (area_light_ && length(panel_centre_ - 0.5 * (low + high)) < 0.75 * size_) {
      points.insert(points.end(), panel_.begin(), panel_.end());
    }
    return points;
  }

  Vector to_light(const Vector& from) const {
    if (area_light_) return unit(panel_centre_ - from);
    const Vector light{light_.nearest[0], light_.nearest[1], light_.nearest[2]};
    return unit(light_.directional ? light : light - from);
  }

  /// Lit by orientation to the light, shadow by orientation to the eye, so that faces stay apart.
  Colour colour(LightState shade, const Vector& normal, const Vector& centre,
                const View& view) const {
    if (shade == LightState::kLit) {
      return mix(kLitDim, kLitBright, std::abs(dot(normal, to_light(centre))));
    }
    const double facing = std::abs(dot(normal, unit(view.eye() - centre)));
    const double tilt = 0.5 * std::abs(normal[2]);
    const double brightness = 0.5 * facing + tilt;
    switch (shade) {
      case LightState::kPenumbra:
        return mix(kPenumbraDim, kPenumbraBright, brightness);
      case LightState::kUmbra:
        return mix(kUmbraDim, kUmbraBright, brightness);
      default:
        return mix(kShadowDim, kShadowBright, brightness);
    }
  }

  /// Bordered as a fragment, or in its own colour.
  void fill(const std::vector<Vector>& loop, Colour colour, const View& view,
            bool bordered = false) {
    const std::vector<PixelPoint> pixels = view.pixels(loop);
    if (pixels.size() < 3) return;
    const Colour border = bordered ? mix(colour, kPictureInk, kFragmentInk) : colour;
    svg_.polygon(pixels, {colour_text(colour), colour_text(border), kSeamWidth});
  }

  void paint(const OrderedPiece& piece, const View& view, const ShadedPolygons& shown,
             const ShadedPolygons* truth) {
    const Part& part = prepared_.parts[piece.part];
    const std::vector<Vector> whole = whole_loop(prepared_, part);
    const Vector normal = unit(area_vector(whole));
    const bool front = dot(normal, view.eye() - whole.front()) > 0;
    if (!front && !part.two_sided && !options_.backs) return;
    const auto side = front ? Side::kFront : Side::kBack;
    // One shade a part, whatever the tree cut it into.
    Vector centre{};
    for (const Vector& point : whole) {
      centre = centre + (1.0 / static_cast<double>(whole.size())) * point;
    }
    const std::string& id = scene_.polygons[part.polygon].id;
    const std::vector<ShadedLoop>* loops = shown.find(id, side);
    // A side that no result lists does not face the light, nor sees it.
    const LightState base =
        shown.background().value_or(area_light_ ? LightState::kUmbra : LightState::kShadow);
    if (loops == nullptr) {
      fill(piece.loop, colour(base, normal, centre, view), view);
    } else {
      paint_fragments(
          piece, normal, *loops, shown.cover(),
          [&](std::optional<LightState> shade) {
            if (!shade && shown.background()) shade = base;
            return shade ? colour(*shade, normal, centre, view) : kMissing;
          },
          view);
      if (truth != nullptr) {
        paint_difference(piece, normal, *loops, truth->find(id, side), view,
                         shown.per_caster_umbra());
      }
    }
    paint_outline(prepared_, piece, size_, view, svg_);
  }

  /// `colour_of` nothing is what no fragment covers; it is only painted where that can be seen,
  /// since it would shine through along the edges of what covers it.
  template <class ColourOf>
  void paint_fragments(const OrderedPiece& piece, const Vector& normal,
                       const std::vector<ShadedLoop>& loops, Cover cover, const ColourOf& colour_of,
                       const View& view) {
    constexpr double kAll = 0.99999;
    const Vector& on_plane = piece.loop.front();
    ShadedLoop own{LightState::kLit, piece.loop, {}, {}};
    set_box(own);
    std::vector<std::pair<LightState, std::vector<Vector>>> seen;
    double covered = 0;
    for (const ShadedLoop& shaded : loops) {
      if (!boxes_meet(own, shaded)) continue;
      // A foreign loop may be anything; the piece that cuts it is convex.
      std::vector<Vector> cut = intersection(projected(shaded.loop, normal, on_plane), piece.loop);
      if (cut.empty()) continue;
      covered += length(area_vector(cut));
      seen.emplace_back(shaded.state, std::move(cut));
    }
    // Loops that overlap may add up to the whole and yet leave some of it out.
    if (cover == Cover::kOverlay || covered < kAll * length(area_vector(piece.loop))) {
      fill(piece.loop, colour_of(std::nullopt), view);
    }
    for (const auto& [shade, loop] : seen) fill(loop, colour_of(shade), view, options_.fragments);
  }

  /// Where the classes of two results differ. Only overlaps of fragments are looked at: what one of
  /// them leaves uncovered shows as grey.
  void paint_difference(const OrderedPiece& piece, const Vector& normal,
                        const std::vector<ShadedLoop>& shown, const std::vector<ShadedLoop>* truth,
                        const View& view, bool per_caster_umbra) {
    if (truth == nullptr) return;
    for (const ShadedLoop& a : shown) {
      for (const ShadedLoop& b : *truth) {
        if (a.state == b.state || !boxes_meet(a, b)) continue;
        if (!per_caster_umbra && a.state == LightState::kPenumbra && b.state == LightState::kUmbra)
          continue;
        const std::vector<Vector> wrong = intersection(
            intersection(projected(a.loop, normal, piece.loop.front()), b.loop), piece.loop);
        if (wrong.empty()) continue;
        // A sliver of rounding is thinner than any pixel, and is not worth one.
        if (length(area_vector(wrong)) < 1e-9 * size_ * size_) continue;
        const std::vector<PixelPoint> pixels = view.pixels(wrong);
        if (pixels.size() < 3) continue;
        svg_.polygon(pixels, {colour_text(kSignal), colour_text(kSignal), 1.6});
      }
    }
  }

  void paint_wall(std::vector<Vector> wall, const View& view) {
    const auto [low, high] = bounding_box(prepared_);
    for (std::size_t k = 0; k < 3 && !wall.empty(); ++k) {
      Vector inward{};
      inward[k] = 1;
      wall = clipped(clipped(wall, inward, low[k]), -1.0 * inward, -high[k]);
    }
    const std::vector<PixelPoint> pixels = view.pixels(wall);
    if (pixels.size() < 3) return;
    svg_.polygon(pixels, {colour_text(kWall), "none", 0, 0.16});
    svg_.polygon(pixels, {"none", colour_text(kWall), 0.8, 0.7});
  }

  void paint_lamp(const View& view) {
    if (area_light_) {
      // Solid where it emits to the eye, a mere frame from behind.
      const std::vector<PixelPoint> pixels = view.pixels(panel_);
      if (pixels.size() < 3) return;
      const bool emits = dot(area_vector(panel_), view.eye() - panel_centre_) > 0;
      svg_.polygon(pixels, {colour_text(kPictureLamp), "none", 0, emits ? 0.95 : 0.5});
      svg_.polygon(pixels, {"none", colour_text(kLampFrame), 1.8});
      return;
    }
    paint_point_lamp(light_, view, svg_);
  }

  void paint_mark(const Mark& mark, const View& view) {
    const auto at = view.pixel_of(mark.at);
    if (!at) return;
    svg_.circle(*at, 9, {"none", "#ffffff", 4.5});
    svg_.circle(*at, 9, {"none", colour_text(kSignal), 2.2});
    if (!mark.label.empty()) {
      svg_.text({(*at)[0] + 14, (*at)[1] + 5}, mark.label, 14, kSignal, "start", true);
    }
  }

  const Scene& scene_;
  const PreparedScene& prepared_;
  const LightPoint& light_;
  bool area_light_;
  std::vector<Vector> panel_;  // of an area light
  Vector panel_centre_{};
  const PictureOptions& options_;
  SvgPicture& svg_;
  double size_ = 1;
};

/// What the panels show.
struct LegendLights {
  bool point = false, area = false;  // kinds of lights
  std::vector<std::string> ids;
};

void paint_legend(SvgPicture& svg, double left, double top, const LegendLights& lights,
                  bool differences, bool marks, bool walls) {
  double x = left + 2;
  const auto entry = [&](Colour colour, const std::string& text) {
    svg.rectangle({x, top + 14}, 22, 16, {colour_text(colour), colour_text(kPictureInk), 0.6});
    svg.text({x + 30, top + 27}, text, 14, kPictureInk);
    x += 54 + 7.2 * static_cast<double>(text.size());
  };
  entry(kLitBright, "lit");
  if (lights.point) entry(kShadowBright, "in shadow");
  if (lights.area) {
    entry(kPenumbraBright, "penumbra");
    entry(kUmbraBright, "umbra");
  }
  if (differences) {
    entry(kSignal, "differs from the exact answer");
    entry(kMissing, "not covered");
  }
  if (walls) entry(mix(kPictureBackground, kWall, 0.4), "shadow polygons");
  if (marks) {
    svg.circle({x + 9, top + 22}, 8, {"none", colour_text(kSignal), 2.2});
    svg.text({x + 26, top + 27}, "worst places", 14, kPictureInk);
    x += 130;
  }
  std::string words = lights.ids.size() == 1 ? "light: " : "lights: ";
  for (const std::string& id : lights.ids) words += (&id == lights.ids.data() ? "" : ", ") + id;
  svg.text({x + 6, top + 27}, words, 14, mix(kPictureInk, kPictureBackground, 0.3));
}

}  // namespace

Camera default_camera(const PreparedScene& prepared) {
  const auto [low, high] = bounding_box(prepared);
  Camera camera;
  camera.look_at = 0.5 * (low + high);
  camera.centre_scene = true;
  const double size = std::max(length(high - low), 1e-300);
  camera.eye = camera.look_at + size * Vector{0.62, -0.86, 0.62};
  return camera;
}

SvgPicture paint_scene(const Scene& scene, const PreparedScene& prepared,
                       const std::vector<OrderedPiece>& pieces, const std::vector<Panel>& panels,
                       const PictureOptions& options) {
  const auto count = static_cast<double>(panels.size());
  bool captions = false, differences = false, marks = false, walls = false;
  LegendLights lights;
  for (const Panel& panel : panels) {
    const PreparedLight& light = prepared.lights[panel.light];
    (light.has_area() ? lights.area : lights.point) = true;
    const std::string& id = scene.lights[light.light].id;
    if (std::ranges::find(lights.ids, id) == lights.ids.end()) lights.ids.push_back(id);
    captions = captions || !panel.caption.empty();
    differences = differences || panel.truth != nullptr;
    marks = marks || !panel.marks.empty();
    walls = walls || !panel.walls.empty();
  }
  const double top = captions ? kCaptionHeight : 0;
  const double width = count * options.width + (count - 1) * kGap;
  const double height = top + options.height + (options.legend ? kLegendHeight : 0);
  SvgPicture svg(width, height, options.title.empty() ? scene.name : options.title);
  svg.rectangle({0, 0}, width, height, {"#ffffff"});
  double left = 0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Painter(scene, prepared, panels[i].light, options, svg)
        .panel(panels[i], "frame" + std::to_string(i), pieces, left, top);
    left += options.width + kGap;
  }
  if (options.legend) {
    paint_legend(svg, 0, top + options.height, lights, differences, marks, walls);
  }
  return svg;
}

}  // namespace gnomon::report
