// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/triangles/gltf_matrix.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/base/text_file.h"

namespace gnomon {

namespace {

// Sums and products of dyadic numbers, exactly.

Number product(const Number& a, const Number& b) {
  if (a.is_zero() || b.is_zero()) return {};
  return Number::from_dyadic(a.mantissa() * b.mantissa(), a.exponent() + b.exponent());
}

Number sum(const Number& a, const Number& b) {
  if (a.is_zero()) return b;
  if (b.is_zero()) return a;
  const std::int32_t exponent = std::min(a.exponent(), b.exponent());
  mpz_class left = a.mantissa(), right = b.mantissa();
  left <<= static_cast<unsigned long>(a.exponent() - exponent);
  right <<= static_cast<unsigned long>(b.exponent() - exponent);
  return Number::from_dyadic(left + right, exponent);
}

Number negated(const Number& a) { return Number::from_dyadic(-a.mantissa(), a.exponent()); }

/// What is too small for a float is 0; what is too large has no value.
std::optional<float> nearest_float(std::string_view text) {
  const char* const end = text.data() + text.size();
  float value = 0;
  if (std::from_chars(text.data(), end, value).ec == std::errc{}) return value;
  double wide = 0;
  const bool is_double = std::from_chars(text.data(), end, wide).ec == std::errc{};
  const bool is_small =
      is_double ? std::abs(wide) < 1 : text.find("e-") != text.npos || text.find("E-") != text.npos;
  return is_small ? std::optional(0.0F) : std::nullopt;
}

/// The numbers of a list, as the float32 nearest to each.
Expected<std::vector<float>> floats(const JsonNode& list, std::size_t wanted) {
  const JsonTape& tape = list.tape();
  const std::string expected = "an array of " + std::to_string(wanted) + " numbers";
  if (!list.is_array()) return tape.wrong_kind(list, expected);
  std::vector<float> values;
  for (JsonNode node = list.begin(); node != list.end(); node = node.next()) {
    if (!node.is_number()) return tape.wrong_kind(node, "a number");
    const std::string_view text = node.number();
    const auto value = nearest_float(text);
    if (!value) {
      return tape.error(node, ErrorCode::kNumber, quoted_text(text) + " is beyond single precision",
                        "a magnitude below 3.4e38");
    }
    values.push_back(*value);
  }
  if (values.size() != wanted) {
    return tape.error(list, ErrorCode::kFormat, std::to_string(values.size()) + " numbers",
                      expected);
  }
  return values;
}

Number exact(float value) { return Number(static_cast<double>(value)); }

using Rows = std::array<std::array<Number, 3>, 3>;

/// 1 - 2 (y y + z z), 2 (x y - z w), ... for the quaternion (x, y, z, w). Exactness: exact.
Rows rows_of(const std::vector<float>& quaternion) {
  std::array<std::array<Number, 4>, 4> twice;  // 2 q_i q_j
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      twice[i][j] = product(Number(2.0), product(exact(quaternion[i]), exact(quaternion[j])));
    }
  }
  Rows rows;
  for (std::size_t x = 0; x < 3; ++x) {
    const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
    rows[x][x] = sum(Number(1.0), negated(sum(twice[y][y], twice[z][z])));
    rows[x][y] = sum(twice[x][y], negated(twice[z][3]));
    rows[x][z] = sum(twice[x][z], twice[y][3]);
  }
  return rows;
}

/// Of the 24 rotations that map axes to axes, of which the numbers are 0, 1/2, the root of 1/2 and
/// 1 (or their negatives), each as the nearest float.
bool is_of_axes(const std::vector<float>& quaternion) {
  int halves = 0, roots = 0, ones = 0, zeros = 0;
  for (const float value : quaternion) {
    const float size = std::abs(value);
    constexpr float kNear = 2e-7F;  // three float32 steps below 1
    if (size < kNear) {
      ++zeros;
    } else if (std::abs(size - 0.5F) < kNear) {
      ++halves;
    } else if (std::abs(size - 0.70710678F) < kNear) {
      ++roots;
    } else if (std::abs(size - 1) < kNear) {
      ++ones;
    }
  }
  return halves == 4 || (roots == 2 && zeros == 2) || (ones == 1 && zeros == 3);
}

void round_to_axes(Rows& rows) {
  for (auto& row : rows) {
    for (Number& number : row) number = Number(std::round(number.nearest()));
  }
}

double stretch_of(const Rows& rows) {
  double worst = 0;
  for (std::size_t column = 0; column < 3; ++column) {
    Number square;
    for (std::size_t row = 0; row < 3; ++row) {
      square = sum(square, product(rows[row][column], rows[row][column]));
    }
    worst = std::max(worst, std::abs(sum(square, Number(-1.0)).nearest()) / 2);
  }
  return worst;
}

}  // namespace

GltfMatrix GltfMatrix::identity() {
  GltfMatrix result;
  for (std::size_t i = 0; i < 3; ++i) result.rows[i][i] = Number(1.0);
  return result;
}

bool GltfMatrix::is_identity() const { return rows == identity().rows; }

Position GltfMatrix::apply(const Position& position) const {
  Position result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = rows[i][3];
    for (std::size_t k = 0; k < 3; ++k) {
      result[i] = sum(result[i], product(rows[i][k], position[k]));
    }
  }
  return result;
}

GltfMatrix GltfMatrix::after(const GltfMatrix& inner) const {
  GltfMatrix result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      Number& number = result.rows[i][j];
      if (j == 3) number = rows[i][3];
      for (std::size_t k = 0; k < 3; ++k) {
        number = sum(number, product(rows[i][k], inner.rows[k][j]));
      }
    }
  }
  return result;
}

bool GltfMatrix::mirrors() const {
  Number determinant;
  for (std::size_t x = 0; x < 3; ++x) {
    const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
    const Number minor =
        sum(product(rows[1][y], rows[2][z]), negated(product(rows[1][z], rows[2][y])));
    determinant = sum(determinant, product(rows[0][x], minor));
  }
  return determinant.sign() < 0;
}

Expected<GltfPlacement> gltf_placement(const JsonNode& node) {
  GltfPlacement result{GltfMatrix::identity()};
  auto& rows = result.matrix.rows;
  if (const auto matrix = node.find("matrix")) {
    const auto values = floats(*matrix, 16);
    if (!values) return tl::unexpected(values.error());
    const bool is_affine =
        (*values)[3] == 0 && (*values)[7] == 0 && (*values)[11] == 0 && (*values)[15] == 1;
    if (!is_affine) {
      return node.tape().error(*matrix, ErrorCode::kFormat, "a matrix that is not affine",
                               "a last row of 0, 0, 0, 1 (the matrix is written by columns)");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) rows[i][j] = exact((*values)[4 * j + i]);
    }
    return result;
  }
  if (const auto rotation = node.find("rotation")) {
    const auto quaternion = floats(*rotation, 4);
    if (!quaternion) return tl::unexpected(quaternion.error());
    double square = 0;
    for (const float value : *quaternion) square += static_cast<double>(value) * value;
    constexpr double kMost = 0.02;
    if (!(std::abs(square - 1) < kMost)) {
      return node.tape().error(*rotation, ErrorCode::kFormat,
                               "a quaternion that is far from the length 1",
                               "a unit quaternion x, y, z, w");
    }
    Rows turned = rows_of(*quaternion);
    if (is_of_axes(*quaternion)) {
      round_to_axes(turned);
    } else {
      result.is_rounded = true;
      result.stretch = stretch_of(turned);
    }
    for (std::size_t i = 0; i < 3; ++i)
      std::copy(turned[i].begin(), turned[i].end(), rows[i].begin());
  }
  if (const auto scale = node.find("scale")) {
    const auto factors = floats(*scale, 3);
    if (!factors) return tl::unexpected(factors.error());
    for (auto& row : rows) {
      for (std::size_t j = 0; j < 3; ++j) row[j] = product(row[j], exact((*factors)[j]));
    }
  }
  if (const auto translation = node.find("translation")) {
    const auto move = floats(*translation, 3);
    if (!move) return tl::unexpected(move.error());
    for (std::size_t i = 0; i < 3; ++i) rows[i][3] = exact((*move)[i]);
  }
  return result;
}

}  // namespace gnomon
