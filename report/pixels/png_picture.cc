// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pixels/png_picture.h"

#include <png.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gnomon::report {
namespace {

using Colour = std::array<double, 3>;

constexpr Colour kLit{255, 241, 198}, kDark{74, 80, 104}, kNothing{244, 244, 246};
/// Of a polygon's colour, seen along its plane.
constexpr double kGrazing = 0.72;

Colour mix(const Colour& a, const Colour& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}

/// How much each polygon faces one fixed direction, 0 to 1.
std::vector<double> facing_of(const PreparedScene& prepared) {
  constexpr std::array<double, 3> kDirection{0.36, 0.48, 0.80};
  std::vector<double> result(prepared.first_part.size(), 1);
  for (const Part& part : prepared.parts) {
    const SupportTriple& triple = prepared.geometry.planes[part.plane];
    const auto& x = prepared.geometry.positions;
    std::array<double, 3> u, v;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = x[triple.b][k] - x[triple.a][k];
      v[k] = x[triple.c][k] - x[triple.a][k];
    }
    const std::array<double, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                  u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    if (!(length > 0)) continue;
    result[part.polygon] =
        std::fabs(n[0] * kDirection[0] + n[1] * kDirection[1] + n[2] * kDirection[2]) / length;
  }
  return result;
}

std::vector<std::uint8_t> colours_of(const PreparedScene& prepared, const PixelClaims& claims) {
  const std::vector<double> facing = facing_of(prepared);
  const double lights = static_cast<double>(claims.lights.size());
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * claims.polygon.size());
  for (std::size_t s = 0; s < claims.polygon.size(); ++s) {
    Colour colour = kNothing;
    if (claims.polygon[s] != PixelClaims::kNothing) {
      const double lit = lights > 0 ? std::popcount(claims.lit_by[s]) / lights : 1;
      const double shade = kGrazing + (1 - kGrazing) * facing[claims.polygon[s]];
      colour = mix({0, 0, 0}, mix(kDark, kLit, lit), shade);
    }
    for (const double c : colour) bytes.push_back(static_cast<std::uint8_t>(std::lround(c)));
  }
  return bytes;
}

}  // namespace

Expected<std::string> png_picture(const PreparedScene& prepared, const PixelClaims& claims) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = claims.camera.width;
  image.height = claims.camera.height;
  image.format = PNG_FORMAT_RGB;
  const std::vector<std::uint8_t> colours = colours_of(prepared, claims);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, colours.data(), 0, nullptr) == 0) {
    return fail(ErrorCode::kLimit, std::string("the picture cannot be made: ") + image.message,
                "fewer samples");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace gnomon::report
