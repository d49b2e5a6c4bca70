// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures as SVG: shapes in the order in which they are painted, coordinates in pixels with y
// down, rounded to a hundredth. No scripts, no external references, no fonts embedded.
#ifndef GNOMON_REPORT_PICTURES_SVG_H
#define GNOMON_REPORT_PICTURES_SVG_H

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "report/text/text_sink.h"

namespace gnomon::report {

using PixelPoint = std::array<double, 2>;

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(Colour, Colour) = default;
};
/// Between two colours: share 0 is a, 1 is b.
Colour mix(Colour a, Colour b, double share);
/// "#rrggbb".
std::string colour_text(Colour colour);

struct Paint {
  std::string fill = "none";  // "#rrggbb", "none", "url(#id)"
  std::string stroke = "none";
  double stroke_width = 0;
  double opacity = 1;
};

class SvgPicture {
 public:
  SvgPicture(double width, double height, std::string_view title);

  void polygon(std::span<const PixelPoint> loop, const Paint& paint);
  void line(PixelPoint a, PixelPoint b, const Paint& paint);
  void circle(PixelPoint centre, double radius, const Paint& paint);
  void rectangle(PixelPoint corner, double width, double height, const Paint& paint);
  /// Anchor: "start", "middle" or "end".
  void text(PixelPoint at, std::string_view words, double size, Colour colour,
            std::string_view anchor = "start", bool bold = false);
  void begin_group(std::string_view attributes);
  void end_group();
  /// Raw definitions such as patterns.
  void define(std::string_view definition);

  void write(TextSink& sink) const;

 private:
  void attributes(const Paint& paint);

  double width_, height_;
  std::string title_;
  std::string definitions_;
  std::string body_;
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PICTURES_SVG_H
