// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pictures/svg.h"

#include <algorithm>
#include <cmath>

#include "report/text/number_text.h"
#include "report/text/xml_text.h"

namespace gnomon::report {

namespace {

/// Far outside any picture, and still a number that every viewer reads.
constexpr double kFar = 1e6;

std::string pixel(double value) {
  if (std::isnan(value)) value = 0;
  return shortest(std::round(std::clamp(value, -kFar, kFar) * 100) / 100 + 0.0);
}

}  // namespace

Colour mix(Colour a, Colour b, double share) {
  share = std::clamp(share, 0.0, 1.0);
  const auto between = [&](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
  };
  return {between(a.red, b.red), between(a.green, b.green), between(a.blue, b.blue)};
}

std::string colour_text(Colour colour) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string text = "#";
  for (std::uint8_t channel : {colour.red, colour.green, colour.blue}) {
    text += kHex[channel >> 4];
    text += kHex[channel & 15];
  }
  return text;
}

SvgPicture::SvgPicture(double width, double height, std::string_view title)
    : width_(width), height_(height), title_(title) {}

void SvgPicture::attributes(const Paint& paint) {
  body_ += " fill=\"" + paint.fill + '"';
  if (paint.stroke != "none" && paint.stroke_width > 0) {
    body_ += " stroke=\"" + paint.stroke + "\" stroke-width=\"" + pixel(paint.stroke_width) + '"';
  }
  if (paint.opacity < 1) body_ += " opacity=\"" + pixel(paint.opacity) + '"';
}

void SvgPicture::polygon(std::span<const PixelPoint> loop, const Paint& paint) {
  body_ += "<path d=\"M";
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (i > 0) body_ += 'L';
    body_ += pixel(loop[i][0]) + ' ' + pixel(loop[i][1]);
  }
  body_ += "Z\"";
  attributes(paint);
  body_ += "/>\n";
}

void SvgPicture::line(PixelPoint a, PixelPoint b, const Paint& paint) {
  body_ +=
      "<path d=\"M" + pixel(a[0]) + ' ' + pixel(a[1]) + 'L' + pixel(b[0]) + ' ' + pixel(b[1]) + '"';
  attributes(paint);
  body_ += "/>\n";
}

void SvgPicture::circle(PixelPoint centre, double radius, const Paint& paint) {
  body_ += "<circle cx=\"" + pixel(centre[0]) + "\" cy=\"" + pixel(centre[1]) + "\" r=\"" +
           pixel(radius) + '"';
  attributes(paint);
  body_ += "/>\n";
}

void SvgPicture::rectangle(PixelPoint corner, double width, double height, const Paint& paint) {
  body_ += "<rect x=\"" + pixel(corner[0]) + "\" y=\"" + pixel(corner[1]) + "\" width=\"" +
           pixel(width) + "\" height=\"" + pixel(height) + '"';
  attributes(paint);
  body_ += "/>\n";
}

void SvgPicture::text(PixelPoint at, std::string_view words, double size, Colour colour,
                      std::string_view anchor, bool bold) {
  body_ += "<text x=\"" + pixel(at[0]) + "\" y=\"" + pixel(at[1]) + "\" font-size=\"" +
           pixel(size) + "\" fill=\"" + colour_text(colour) + '"';
  if (anchor != "start") body_ += " text-anchor=\"" + std::string(anchor) + '"';
  if (bold) body_ += " font-weight=\"600\"";
  body_ += '>' + xml_text(words) + "</text>\n";
}

void SvgPicture::begin_group(std::string_view attributes) {
  body_ += "<g " + std::string(attributes) + ">\n";
}

void SvgPicture::end_group() { body_ += "</g>\n"; }

void SvgPicture::define(std::string_view definition) {
  definitions_ += std::string(definition) + '\n';
}

void SvgPicture::write(TextSink& sink) const {
  const std::string size = "width=\"" + pixel(width_) + "\" height=\"" + pixel(height_) +
                           "\" viewBox=\"0 0 " + pixel(width_) + ' ' + pixel(height_) + '"';
  sink.write("<svg xmlns=\"http://www.w3.org/2000/svg\" " + size +
             " font-family=\"Helvetica, Arial, sans-serif\">\n<title>" + xml_text(title_) +
             "</title>\n");
  if (!definitions_.empty()) sink.write("<defs>\n" + definitions_ + "</defs>\n");
  sink.write(body_);
  sink.write("</svg>\n");
}

}  // namespace gnomon::report
