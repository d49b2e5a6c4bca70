// SPDX-License-Identifier: GPL-3.0-or-later
// The painter's order: along rays from an eye, the piece that is painted last belongs to the
// polygon that the ray meets first, which is found in rationals from the whole polygons. Samples on
// a border, or so near one that rounded coordinates of the pieces decide, are left out and counted.
#include "gnomon/algorithms/painters_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exact_space.h"
#include "fuzz/generate/families.h"
#include "fuzz/generate/soups.h"
#include "gnomon/scene/generate.h"
#include "scene/base/random.h"

namespace gnomon::test {
namespace {

using Vector = std::array<double, 3>;

Rational3 to_grid(const PreparedScene& scene, const Vector& point) {
  Rational3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = (mpq_class(point[k]) - scene.geometry.origin[k]) / scene.geometry.step;
  }
  return result;
}

/// How far a ray from `eye` is inside of a rounded piece, as a fraction of the lengths involved:
/// positive inside, negative outside.
double depth_inside(const OrderedPiece& piece, const Vector& eye, const Vector& direction) {
  std::vector<Rational3> to;
  for (const Vector& point : piece.loop) {
    Rational3& own = to.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) own[k] = mpq_class(point[k]) - mpq_class(eye[k]);
  }
  Rational3 along;
  for (std::size_t k = 0; k < 3; ++k) along[k] = direction[k];
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Rational3 normal = cross_product(to[i], to[(i + 1) % to.size()]);
    const double value = mpq_class(dot_product(normal, along)).get_d() /
                         std::sqrt(mpq_class(dot_product(normal, normal)).get_d() *
                                   mpq_class(dot_product(along, along)).get_d());
    least = std::min(least, value);
    most = std::max(most, value);
  }
  // The loop may be seen from either side; the opposite ray is inside of the same planes.
  const double inside = std::max(least, -most);
  const Rational3 normal = area_vector(to);
  const bool is_ahead = sgn(dot_product(normal, to[0])) * sgn(dot_product(normal, along)) > 0;
  return is_ahead ? inside : std::min(inside, -1.0);
}

struct Samples {
  std::uint64_t judged = 0, on_border = 0, wrong = 0, wrong_if_reversed = 0;
};

/// What is on top along the ray: of pieces in the order of painting, the last. Nothing if a border
/// is too near to tell. `edge_on`, by part: its plane holds the eye, so that it has no picture.
std::optional<std::optional<std::uint32_t>> on_top(const std::vector<OrderedPiece>& pieces,
                                                   const std::vector<bool>& edge_on,
                                                   const Vector& eye, const Vector& direction) {
  constexpr double kNearBorder = 1e-9;
  std::optional<std::uint32_t> top;
  for (const OrderedPiece& piece : pieces) {
    if (edge_on[piece.part]) continue;
    const double inside = depth_inside(piece, eye, direction);
    if (std::isnan(inside) || std::fabs(inside) < kNearBorder) return std::nullopt;
    if (inside > 0) top = piece.part;
  }
  return top;
}

void sample(const Scene& scene, std::uint64_t seed, Samples& samples) {
  const auto prepared = prepare(scene);
  if (!prepared) return;
  Random random(seed + 77);
  Vector low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const VertexId vertex : prepared->loop_vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], prepared->geometry.positions[vertex][k]);
      high[k] = std::max(high[k], prepared->geometry.positions[vertex][k]);
    }
  }
  const auto point_in = [&](std::int64_t from, std::int64_t to) {
    Vector point;
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = static_cast<double>(random.between(1000 * from, 1000 * to)) / 1000;
      point[k] = low[k] + share * (high[k] - low[k]);
    }
    return point;
  };
  const auto point_of_a_part = [&] {
    const auto loop = prepared->loop(prepared->parts[random.below(prepared->parts.size())]);
    Vector point{};
    double total = 0;
    for (const VertexId vertex : loop) {
      const double weight = static_cast<double>(random.between(1, 1000));
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] += weight * prepared->geometry.positions[vertex][k];
      }
      total += weight;
    }
    for (double& coordinate : point) coordinate /= total;
    return point;
  };
  // Outside, inside, and on a vertex, where some planes hold the eye.
  for (const Vector& eye :
       {point_in(2, 3), point_in(-2, -1), point_in(0, 1),
        prepared->geometry
            .positions[prepared->loop_vertices[seed % prepared->loop_vertices.size()]]}) {
    const std::vector<OrderedPiece> pieces = back_to_front(*prepared, eye);
    std::vector<OrderedPiece> reversed = pieces;
    std::reverse(reversed.begin(), reversed.end());
    const Rational3 grid_eye = to_grid(*prepared, eye);
    std::vector<bool> edge_on;
    for (std::uint32_t part = 0; part < prepared->parts.size(); ++part) {
      edge_on.push_back(plane_of(grid_loop(*prepared, part)).value(grid_eye) == 0);
    }
    for (int i = 0; i < 60; ++i) {
      const Vector target = i % 2 == 0 ? point_in(0, 1) : point_of_a_part();
      Vector direction;
      Rational3 exact;
      for (std::size_t k = 0; k < 3; ++k) {
        direction[k] = target[k] - eye[k];
        exact[k] = direction[k];  // the grid is scaled alike in all axes
      }
      if (exact == Rational3{}) continue;
      const FirstMet truth = first_met(*prepared, grid_eye, exact);
      const auto found = on_top(pieces, edge_on, eye, direction);
      if (truth.on_border || !found) {
        ++samples.on_border;
        continue;
      }
      ++samples.judged;
      if (*found != truth.part) ++samples.wrong;
      if (*on_top(reversed, edge_on, eye, direction) != truth.part) ++samples.wrong_if_reversed;
    }
  }
}

void expect_right(const Samples& samples) {
  EXPECT_EQ(samples.wrong, 0u);
  // The samples could have told: the order turned round shows other polygons.
  EXPECT_GT(samples.wrong_if_reversed, samples.judged / 50);
  EXPECT_LT(samples.on_border, samples.judged / 4);
  testing::Test::RecordProperty("judged", std::to_string(samples.judged));
  testing::Test::RecordProperty("on_border", std::to_string(samples.on_border));
  testing::Test::RecordProperty("wrong_if_reversed", std::to_string(samples.wrong_if_reversed));
}

void sample_family(const std::string& name, std::uint64_t scenes, Samples& samples) {
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    sample(fuzz::family_by_name(name).make(seed), seed, samples);
  }
}

TEST(PaintersOrder, Pinwheels) {
  Samples samples;
  for (const std::int64_t rings : {1, 2, 3}) {
    sample(generate("pinwheel", {{"n", rings}}).value(), static_cast<std::uint64_t>(rings),
           samples);
  }
  expect_right(samples);
}

TEST(PaintersOrder, CrossingSticks) {
  Samples samples;
  sample_family("CrossingSticks", 8, samples);
  sample_family("Crossing", 8, samples);
  expect_right(samples);
}

TEST(PaintersOrder, Soups) {
  Samples samples;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    sample(
        fuzz::make_soup(seed % 2 == 0 ? fuzz::Soup::kUniform : fuzz::Soup::kLattice, false, random),
        seed, samples);
  }
  expect_right(samples);
}

TEST(PaintersOrder, CoplanarPolygonsAreInOrderOfParts) {
  Samples samples;
  sample_family("CoplanarTiles", 20, samples);
  sample_family("TouchingBoxes", 6, samples);
  expect_right(samples);
}

}  // namespace
}  // namespace gnomon::test
