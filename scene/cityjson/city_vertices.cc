// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/cityjson/city_vertices.h"

#include <utility>

#include "scene/model/decimal_arithmetic.h"

namespace gnomon {

namespace {

Expected<Number> exact_number(const JsonNode& node) {
  auto number = Number::parse(node.number(), NumberMeaning::kDecimal);
  if (number) return number;
  return node.tape().error(node, number.error().code, number.error().what, number.error().expected);
}

/// Is it an array of so many numbers?
bool is_vector(const JsonNode& node, std::size_t length) {
  if (!node.is_array()) return false;
  std::size_t count = 0;
  for (JsonNode at = node.begin(); at != node.end(); at = at.next()) {
    if (!at.is_number() || ++count > length) return false;
  }
  return count == length;
}

Expected<Position> read_vector(const JsonNode& object, std::string_view key) {
  const auto node = object.find(key);
  if (!node) return object.tape().missing(object, key, "an array of three numbers");
  if (!is_vector(*node, 3)) {
    return node->tape().error(*node, ErrorCode::kFormat, "this is no vector",
                              "an array of three numbers");
  }
  return exact_position(*node);
}

}  // namespace

Expected<CityTransform> read_city_transform(const JsonNode& node) {
  if (!node.is_object()) return node.tape().wrong_kind(node, "an object with scale and translate");
  auto scale = read_vector(node, "scale");
  if (!scale) return tl::unexpected(std::move(scale.error()));
  auto translate = read_vector(node, "translate");
  if (!translate) return tl::unexpected(std::move(translate.error()));
  return CityTransform{*std::move(scale), *std::move(translate)};
}

Expected<CityVertices> CityVertices::read(const JsonNode& list) {
  if (!list.is_array()) return list.tape().wrong_kind(list, "an array of vertices");
  CityVertices result;
  for (JsonNode at = list.begin(); at != list.end(); at = at.next()) {
    if (!is_vector(at, 3)) {
      return at.tape().error(at, ErrorCode::kFormat, "this is no vertex",
                             "an array of three numbers");
    }
    result.nodes_.push_back(at.index());
  }
  return result;
}

Expected<Position> exact_position(const JsonNode& node) {
  Position position;
  JsonNode at = node.begin();
  for (Number& coordinate : position) {
    auto number = exact_number(at);
    if (!number) return tl::unexpected(std::move(number.error()));
    coordinate = *std::move(number);
    at = at.next();
  }
  return position;
}

Position transformed(Position position, const std::optional<CityTransform>& transform) {
  if (!transform) return position;
  for (std::size_t axis = 0; axis < position.size(); ++axis) {
    position[axis] = decimal_sum(decimal_product(position[axis], transform->scale[axis]),
                                 transform->translate[axis]);
  }
  return position;
}

Expected<CityMatrix> CityMatrix::read(const JsonNode& node) {
  constexpr std::size_t kEntries = 16;
  const char* const expected = "16 numbers, row by row";
  if (!is_vector(node, kEntries)) {
    return node.tape().error(node, ErrorCode::kFormat, "this is no 4x4 matrix", expected);
  }
  CityMatrix matrix;
  std::size_t count = 0;
  for (JsonNode at = node.begin(); at != node.end(); at = at.next(), ++count) {
    auto number = exact_number(at);
    if (!number) return tl::unexpected(std::move(number.error()));
    if (count < matrix.entries_.size()) {
      matrix.entries_[count] = *std::move(number);
    } else if (!(*number == Number(count == kEntries - 1 ? 1.0 : 0.0))) {
      return at.tape().error(at, ErrorCode::kFormat, "a projective matrix",
                             "0 0 0 1 as its last row");
    }
  }
  return matrix;
}

Position CityMatrix::apply(const Position& point, const Position& anchor) const {
  Position result;
  for (std::size_t row = 0; row < result.size(); ++row) {
    Number sum = decimal_sum(entries_[4 * row + 3], anchor[row]);
    for (std::size_t column = 0; column < point.size(); ++column) {
      sum = decimal_sum(sum, decimal_product(entries_[4 * row + column], point[column]));
    }
    result[row] = std::move(sum);
  }
  return result;
}

bool CityMatrix::mirrors() const {
  const auto minor = [this](std::size_t i, std::size_t j) {
    return decimal_difference(decimal_product(entries_[4 + i], entries_[8 + j]),
                              decimal_product(entries_[4 + j], entries_[8 + i]));
  };
  const Number determinant =
      decimal_sum(decimal_difference(decimal_product(entries_[0], minor(1, 2)),
                                     decimal_product(entries_[1], minor(0, 2))),
                  decimal_product(entries_[2], minor(0, 1)));
  return determinant.sign() < 0;
}

}  // namespace gnomon
