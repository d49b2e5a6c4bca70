// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pictures/shaded_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "report/pictures/flat_geometry.h"
#include "report/pictures/scene_lines.h"
#include "report/pictures/view.h"
#include "report/text/number_text.h"

namespace gnomon::report {

namespace {

constexpr double kBorderInk = 0.5;    // of a face's border, the rest is the face's colour
constexpr double kShortest = 1.5;     // pixels; a gradient that is shorter is not seen
constexpr double kLevel = 1.0 / 255;  // one step of what the screen can show

std::string hundredths(double pixels) { return shortest(std::round(100 * pixels) / 100); }

/// A linear function, fitted to values at points of a plane by least squares about their mean.
struct LinearFit {
  PixelPoint middle{};
  double mean = 0;
  PixelPoint gradient{};

  double at(const PixelPoint& p) const {
    return mean + gradient[0] * (p[0] - middle[0]) + gradient[1] * (p[1] - middle[1]);
  }
};

LinearFit fit(const std::vector<PixelPoint>& points, const std::vector<double>& values) {
  LinearFit result;
  const auto n = static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) result.middle[k] += points[i][k] / n;
    result.mean += values[i] / n;
  }
  double xx = 0, xy = 0, yy = 0, xv = 0, yv = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i][0] - result.middle[0], y = points[i][1] - result.middle[1];
    const double v = values[i] - result.mean;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xv += x * v;
    yv += y * v;
  }
  const double determinant = xx * yy - xy * xy;
  // Points on a line, as good as: what is seen edge-on is flat.
  if (!(determinant > 1e-9 * (xx + yy) * (xx + yy))) return result;
  result.gradient = {(yy * xv - xy * yv) / determinant, (xx * yv - xy * xv) / determinant};
  return result;
}

/// A convex loop in scene space with a shade, 0 to 1 as the screen shows it, at each vertex.
struct Patch {
  std::vector<Vector> loop;
  std::vector<double> shades;
};

class ShadedPainter {
 public:
  ShadedPainter(const PreparedScene& prepared, const ShadingMesh& mesh,
                const ShadedPictureOptions& options, const View& view, SvgPicture& svg)
      : prepared_(prepared), mesh_(mesh), options_(options), view_(view), svg_(svg) {
    if (!(options_.shade.exposure > 0)) options_.shade.exposure = automatic_exposure(mesh);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      faces_[{mesh.faces[f].part, mesh.faces[f].side}].push_back(f);
    }
  }

  double exposure() const { return options_.shade.exposure; }

  void paint(const OrderedPiece& piece) {
    const Part& part = prepared_.parts[piece.part];
    const auto first = prepared_.geometry.positions[prepared_.loop(part).front()];
    std::vector<Vector> whole;
    for (const VertexId vertex : prepared_.loop(part)) {
      whole.push_back(prepared_.geometry.positions[vertex]);
    }
    const bool front = dot(area_vector(whole), view_.eye() - first) > 0;
    if (!front && !part.two_sided && !options_.picture.backs) return;
    const auto faces =
        faces_.find({piece.part, front || !part.two_sided ? Side::kFront : Side::kBack});
    if (faces == faces_.end()) return;
    paint_ground(faces->second, piece);
    for (const std::uint32_t f : faces->second) paint(mesh_.faces[f], piece);
  }

 private:
  /// The mean of all shades under what is painted: what still shines through seams is not far off.
  void paint_ground(const std::vector<std::uint32_t>& faces, const OrderedPiece& piece) {
    const std::vector<PixelPoint> pixels = view_.pixels(piece.loop);
    if (pixels.size() < 3) return;
    double sum = 0, weight = 0;
    for (const std::uint32_t f : faces) {
      std::vector<Vector> loop;
      double mean = 0;
      for (const MeshCorner& corner : mesh_.loop(mesh_.faces[f])) {
        loop.push_back(mesh_.points[corner.vertex]);
        mean += shown(corner.sample) / mesh_.faces[f].count;
      }
      const double area = length(area_vector(loop));
      sum += mean * area;
      weight += area;
    }
    const Colour ground = colour(weight > 0 ? sum / weight : 0, mesh_.faces[faces.front()]);
    svg_.polygon(pixels, {colour_text(ground), colour_text(ground), kSeamWidth});
  }

  double shown(std::uint32_t sample) const {
    const double grey = std::clamp(mesh_.shade(sample) * exposure(), 0.0, 1.0);
    return grey <= 0.0031308 ? 12.92 * grey : 1.055 * std::pow(grey, 1 / 2.4) - 0.055;
  }

  Colour colour(double shown, const MeshFace& face) const {
    const double s = std::clamp(shown, 0.0, 1.0);
    const double grey = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    const std::array<double, 3> linear = shade_colour(grey / exposure(), face, options_.shade);
    return {srgb_byte(linear[0]), srgb_byte(linear[1]), srgb_byte(linear[2])};
  }

  void paint(const MeshFace& face, const OrderedPiece& piece) {
    const auto loop = mesh_.loop(face);
    Patch whole;
    for (const MeshCorner& corner : loop) {
      whole.loop.push_back(mesh_.points[corner.vertex]);
      whole.shades.push_back(shown(corner.sample));
    }
    // As one patch if a linear function comes within a level of all vertices, else as triangles.
    if (is_linear(whole)) {
      paint(whole, face, piece);
      return;
    }
    for (const auto& triangle : triangulate(mesh_, face)) {
      Patch patch;
      for (const std::uint32_t corner : triangle) {
        patch.loop.push_back(whole.loop[corner]);
        patch.shades.push_back(whole.shades[corner]);
      }
      paint(patch, face, piece);
    }
  }

  /// Coordinates in the plane of a patch.
  static std::vector<PixelPoint> in_plane(const std::vector<Vector>& points, const Patch& patch) {
    const Vector normal = unit(area_vector(patch.loop));
    Vector u = cross(normal, Vector{1, 0, 0});
    if (length(u) < 0.5) u = cross(normal, Vector{0, 1, 0});
    u = unit(u);
    const Vector v = cross(normal, u);
    std::vector<PixelPoint> result;
    for (const Vector& point : points) {
      const Vector d = point - patch.loop.front();
      result.push_back({dot(d, u), dot(d, v)});
    }
    return result;
  }

  static bool is_linear(const Patch& patch) {
    if (patch.loop.size() == 3) return true;
    const std::vector<PixelPoint> points = in_plane(patch.loop, patch);
    const LinearFit linear = fit(points, patch.shades);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::fabs(linear.at(points[i]) - patch.shades[i]) > kLevel) return false;
    }
    return true;
  }

  void paint(const Patch& patch, const MeshFace& face, const OrderedPiece& piece) {
    const std::vector<Vector> cut = intersection(patch.loop, piece.loop);
    if (cut.size() < 3) return;
    const LinearFit on_plane = fit(in_plane(patch.loop, patch), patch.shades);
    std::vector<PixelPoint> pixels;
    std::vector<double> shades;
    // What the frame cuts is in the camera's axes; its shade follows from the plane.
    const std::vector<Vector> seen = view_.visible(cut);
    for (const Vector& corner : seen) {
      pixels.push_back(view_.pixel(corner));
      shades.push_back(on_plane.at(in_plane({view_.scene_point(corner)}, patch).front()));
    }
    if (pixels.size() < 3) return;
    const LinearFit on_screen = fit(pixels, shades);
    double low = on_screen.at(pixels[0]), high = low;
    for (const PixelPoint& pixel : pixels) {
      low = std::min(low, on_screen.at(pixel));
      high = std::max(high, on_screen.at(pixel));
    }
    const Colour mean = colour(on_screen.mean, face);
    std::string fill = colour_text(mean);
    const double steepness = std::hypot(on_screen.gradient[0], on_screen.gradient[1]);
    if (high - low > 1.5 * kLevel && high - low > kShortest * steepness) {
      fill = gradient(on_screen, low, high, face);
    }
    const std::string border =
        options_.picture.fragments ? colour_text(mix(mean, kPictureInk, kBorderInk)) : fill;
    svg_.polygon(pixels, {fill, border, kSeamWidth});
  }

  /// A gradient between the points where the function has these values.
  std::string gradient(const LinearFit& linear, double low, double high, const MeshFace& face) {
    const double gx = linear.gradient[0], gy = linear.gradient[1];
    const double square = gx * gx + gy * gy;
    const auto point_at = [&](double value) {
      const double t = (value - linear.mean) / square;
      return PixelPoint{linear.middle[0] + t * gx, linear.middle[1] + t * gy};
    };
    const PixelPoint from = point_at(low), to = point_at(high);
    const std::string id = "g" + std::to_string(gradients_++);
    svg_.define("<linearGradient id=\"" + id + "\" gradientUnits=\"userSpaceOnUse\" x1=\"" +
                hundredths(from[0]) + "\" y1=\"" + hundredths(from[1]) + "\" x2=\"" +
                hundredths(to[0]) + "\" y2=\"" + hundredths(to[1]) + "\"><stop stop-color=\"" +
                colour_text(colour(low, face)) + "\"/><stop offset=\"1\" stop-color=\"" +
                colour_text(colour(high, face)) + "\"/></linearGradient>");
    return "url(#" + id + ")";
  }

  const PreparedScene& prepared_;
  const ShadingMesh& mesh_;
  ShadedPictureOptions options_;
  const View& view_;
  SvgPicture& svg_;
  std::map<std::pair<std::uint32_t, Side>, std::vector<std::uint32_t>> faces_;
  std::uint64_t gradients_ = 0;
};

}  // namespace

SvgPicture paint_shaded_scene(const Scene& scene, const PreparedScene& prepared,
                              const std::vector<OrderedPiece>& pieces, const ShadingMesh& mesh,
                              const ShadedPictureOptions& options) {
  const PictureOptions& picture = options.picture;
  const double height = picture.height + (picture.legend ? kLegendHeight : 0);
  SvgPicture svg(picture.width, height, picture.title.empty() ? scene.name : picture.title);
  svg.rectangle({0, 0}, picture.width, height, {"#ffffff"});
  const View view = view_of(prepared, picture);
  begin_frame(svg, picture);
  ShadedPainter painter(prepared, mesh, options, view, svg);
  for (const OrderedPiece& piece : pieces) painter.paint(piece);
  end_frame(svg, picture);
  if (picture.legend) {
    std::string lights;
    for (const std::uint32_t light : mesh.lights) {
      lights += (lights.empty() ? "" : ", ") + scene.lights[prepared.lights[light].light].id;
    }
    svg.text({8, picture.height + 27},
             (mesh.lights.size() == 1 ? "light: " : "lights: ") + lights + "; " +
                 grouped(mesh.faces.size()) + " faces; white is " +
                 rounded(1 / painter.exposure(), 3),
             14, kPictureInk);
  }
  return svg;
}

}  // namespace gnomon::report
