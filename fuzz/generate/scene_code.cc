// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/scene_code.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "fuzz/generate/scene_code_words.h"

namespace gnomon::fuzz {

namespace {

using namespace scene_code;

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  bool at_end() const { return at_ >= bytes_.size(); }
  unsigned byte() { return at_end() ? 0 : bytes_[at_++]; }
  int signed_byte() { return static_cast<std::int8_t>(byte()); }
  int signed_word() {
    const unsigned low = byte();
    return static_cast<std::int16_t>(low | byte() << 8);
  }
  std::size_t index(std::size_t count) { return byte() % count; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// The power of two of byte 1.
int scale_exponent(int byte) {
  if (byte > 100) return (byte - 100) * 32;
  if (byte < -100) return (byte + 100) * 32;
  return byte;
}

class Decoder {
 public:
  Decoder(std::span<const std::uint8_t> code, const SceneCodeLimits& limits)
      : reader_(code), limits_(limits) {}

  Scene run() {
    const unsigned flags = reader_.byte();
    scene_.two_sided = (flags & kTwoSidedScene) != 0;
    scene_.numbers = (flags & kDecimals) != 0 ? NumberMeaning::kDecimal : NumberMeaning::kDouble;
    scale_ = scale_exponent(reader_.signed_byte());
    if (decimal()) scale_ = std::clamp(scale_, -100, 100);
    while (!reader_.at_end())
      step(static_cast<Step>(reader_.index(static_cast<int>(Step::kCount))));
    return std::move(scene_);
  }

 private:
  using Point = Position;

  bool decimal() const { return scene_.numbers == NumberMeaning::kDecimal; }

  // ---- numbers

  /// The value as the scene may have it: rounded to a double, or to a decimal if it is none.
  Number number(const mpq_class& value, const Number& otherwise) const {
    if (decimal()) {
      // Sums, eighths and powers of two of decimals are decimals; the limits are Number's.
      mpz_class denominator = value.get_den();
      int exponent = 0;
      mpz_class numerator = value.get_num();
      while (denominator != 1 && exponent < 400) {
        numerator *= 10;
        const mpz_class shared = gcd(numerator, denominator);
        numerator /= shared;
        denominator /= shared;
        ++exponent;
      }
      if (denominator != 1 || mpz_sizeinbase(numerator.get_mpz_t(), 10) > 400) return otherwise;
      return Number::from_decimal(numerator, -exponent);
    }
    // get_d() would truncate; the decimal text of no quotient is needed, since all are dyadic.
    const mpz_class denominator = value.get_den();
    const auto power = static_cast<std::int32_t>(mpz_scan1(denominator.get_mpz_t(), 0));
    const double nearest = Number::from_dyadic(value.get_num(), -power).nearest();
    return std::isfinite(nearest) ? Number(nearest) : otherwise;
  }

  Number scaled(long value, int shift) const {
    mpq_class result(value);
    const int power = scale_ - shift;
    if (power >= 0) {
      result <<= static_cast<mp_bitcnt_t>(power);
    } else {
      result >>= static_cast<mp_bitcnt_t>(-power);
    }
    return number(result, Number());
  }

  Number nudged(const Number& value, int ulps) const {
    if (decimal()) return number(value.exact() + mpq_class(ulps, 1'000'000'000), value);
    double result = value.nearest();
    const double infinity = std::numeric_limits<double>::infinity();
    for (; ulps != 0; ulps += ulps > 0 ? -1 : 1) {
      result = std::nextafter(result, ulps > 0 ? infinity : -infinity);
    }
    return std::isfinite(result) ? Number(result) : value;
  }

  Number exact_number() {
    const unsigned head = reader_.byte();
    if (head < kMantissa) return rounded(Number::from_dyadic(static_cast<int>(head) - 64, 0));
    // The count of bytes of the mantissa, its sign, and two bytes of exponent.
    const unsigned count = head & 7;
    mpz_class mantissa = 0;
    for (unsigned i = 0; i <= count; ++i) mantissa = mantissa * 256 + reader_.byte();
    if ((head & 8) != 0) mantissa = -mantissa;
    const int exponent = reader_.signed_word();
    if (decimal()) return Number::from_decimal(mantissa, std::clamp(exponent, -127, 127));
    return rounded(
        Number::from_dyadic(mantissa, std::clamp(exponent, -kMostExponent, kMostExponent)));
  }

  Number rounded(const Number& value) const {
    if (decimal()) return number(value.exact(), Number());
    const double nearest = value.nearest();
    return std::isfinite(nearest) ? Number(nearest) : Number();
  }

  // ---- points

  Point lattice() {
    Point p;
    for (Number& x : p) x = scaled(reader_.signed_byte(), 0);
    return p;
  }

  Point exact_point() {
    Point p;
    for (Number& x : p) x = exact_number();
    return p;
  }

  /// a + (b - a) * k / 8 of two vertices; Requires: there are vertices.
  Point between() {
    const Point& a = scene_.vertices[reader_.index(scene_.vertices.size())];
    const Point& b = scene_.vertices[reader_.index(scene_.vertices.size())];
    const int k = reader_.signed_byte();
    Point p;
    for (int i = 0; i < 3; ++i) {
      p[i] = number(a[i].exact() + (b[i].exact() - a[i].exact()) * mpq_class(k, 8), a[i]);
    }
    return p;
  }

  bool room_for_vertices(std::size_t count) const {
    return scene_.vertices.size() + count <= limits_.vertices;
  }
  void add_vertex(Point p) {
    if (room_for_vertices(1)) scene_.vertices.push_back(std::move(p));
  }

  std::vector<VertexId> loop() {
    const std::size_t count = 3 + reader_.index(limits_.loop - 2);
    std::vector<VertexId> result;
    for (std::size_t i = 0; i < count; ++i) {
      result.push_back(static_cast<VertexId>(reader_.index(scene_.vertices.size())));
    }
    return result;
  }

  // ---- polygons and lights

  void add_polygon(unsigned flags, std::vector<VertexId> loop,
                   std::vector<std::vector<VertexId>> holes = {}) {
    if (scene_.polygons.size() >= limits_.polygons) return;
    Polygon polygon;
    polygon.id = std::to_string(scene_.polygons.size());
    if ((flags & kReversed) != 0) std::reverse(loop.begin(), loop.end());
    polygon.loop = std::move(loop);
    polygon.holes = std::move(holes);
    if ((flags & kOneSided) != 0) polygon.two_sided = false;
    if ((flags & kTwoSided) != 0) polygon.two_sided = true;
    polygon.casts = (flags & kCastsNot) == 0;
    scene_.polygons.push_back(std::move(polygon));
  }

  void add_parallelogram(unsigned flags) {
    std::array<VertexId, 3> v;
    for (VertexId& vertex : v) {
      vertex = static_cast<VertexId>(reader_.index(scene_.vertices.size()));
    }
    if (!room_for_vertices(1)) return;
    Point fourth;
    for (int i = 0; i < 3; ++i) {
      const Number& a = scene_.vertices[v[0]][i];
      fourth[i] = number(
          a.exact() + scene_.vertices[v[2]][i].exact() - scene_.vertices[v[1]][i].exact(), a);
    }
    const auto last = static_cast<VertexId>(scene_.vertices.size());
    scene_.vertices.push_back(std::move(fourth));
    add_polygon(flags, {v[0], v[1], v[2], last});
  }

  void add_rectangle(unsigned flags) {
    const std::size_t axis = reader_.index(3);
    const int level = reader_.signed_byte();
    std::array<int, 4> ends;  // u, v of a corner, u, v of the opposite one
    for (int& end : ends) end = reader_.signed_byte();
    if (!room_for_vertices(4)) return;
    const auto first = static_cast<VertexId>(scene_.vertices.size());
    for (const auto& [u, v] : {std::pair{0, 1}, {2, 1}, {2, 3}, {0, 3}}) {
      Point p;
      p[axis] = scaled(level, 0);
      p[(axis + 1) % 3] = scaled(ends[u], 0);
      p[(axis + 2) % 3] = scaled(ends[v], 0);
      scene_.vertices.push_back(std::move(p));
    }
    add_polygon(flags, {first, first + 1, first + 2, first + 3});
  }

  void add_copy(unsigned flags) {
    const Polygon& polygon = scene_.polygons[reader_.index(scene_.polygons.size())];
    std::vector<VertexId> loop = polygon.loop;
    std::rotate(loop.begin(), loop.begin() + static_cast<long>(reader_.index(loop.size())),
                loop.end());
    auto holes = polygon.holes;
    add_polygon(flags, std::move(loop), std::move(holes));
  }

  void add_light(LightType type, Point position, std::vector<Point> loop = {}) {
    if (scene_.lights.size() >= limits_.lights) return;
    Light light;
    light.id = std::to_string(scene_.lights.size());
    light.type = type;
    light.position = std::move(position);
    light.loop = std::move(loop);
    if (type == LightType::kDirectional &&
        std::all_of(light.position.begin(), light.position.end(),
                    [](const Number& x) { return x.is_zero(); })) {
      light.position[2] = Number(1.0);
    }
    scene_.lights.push_back(std::move(light));
  }

  void add_panel() {
    const Point corner = lattice();
    std::array<std::array<int, 3>, 2> sides;
    for (auto& side : sides) {
      for (int& x : side) x = reader_.signed_byte();
    }
    std::vector<Point> loop(4, corner);
    for (int i = 0; i < 3; ++i) {
      const mpq_class from = corner[i].exact();
      const mpq_class u = scaled(sides[0][i], 0).exact(), v = scaled(sides[1][i], 0).exact();
      loop[1][i] = number(from + u, corner[i]);
      loop[2][i] = number(from + u + v, corner[i]);
      loop[3][i] = number(from + v, corner[i]);
    }
    add_light(LightType::kArea, {}, std::move(loop));
  }

  void add_panel_of_polygon() {
    const unsigned flags = reader_.byte();
    std::vector<Point> points;
    for (const VertexId vertex : scene_.polygons[reader_.index(scene_.polygons.size())].loop) {
      points.push_back(scene_.vertices[vertex]);
    }
    if ((flags & kReversed) != 0) std::reverse(points.begin(), points.end());
    add_light(LightType::kArea, {}, std::move(points));
  }

  void add_sun_along() {
    const Point& a = scene_.vertices[reader_.index(scene_.vertices.size())];
    const Point& b = scene_.vertices[reader_.index(scene_.vertices.size())];
    Point direction;
    for (int i = 0; i < 3; ++i) direction[i] = number(b[i].exact() - a[i].exact(), Number());
    add_light(LightType::kDirectional, std::move(direction));
  }

  // ---- steps

  void step(Step step) {
    const bool vertices = !scene_.vertices.empty(), polygons = !scene_.polygons.empty();
    switch (step) {
      case Step::kLattice:
        return add_vertex(lattice());
      case Step::kFine: {
        Point p;
        for (Number& x : p) x = scaled(reader_.signed_word(), 8);
        return add_vertex(std::move(p));
      }
      case Step::kNudged: {
        if (!vertices) return;
        Point p = scene_.vertices[reader_.index(scene_.vertices.size())];
        Number& x = p[reader_.index(3)];
        x = nudged(x, reader_.signed_byte() % 8);
        return add_vertex(std::move(p));
      }
      case Step::kBetween:
        if (vertices) add_vertex(between());
        return;
      case Step::kScaled: {
        if (!vertices) return;
        Point p = scene_.vertices[reader_.index(scene_.vertices.size())];
        const int k = scale_exponent(reader_.signed_byte());
        for (Number& x : p) {
          const mpq_class factor = mpq_class(1) << static_cast<mp_bitcnt_t>(std::abs(k));
          x = number(k > 0 ? mpq_class(x.exact() * factor) : mpq_class(x.exact() / factor), x);
        }
        return add_vertex(std::move(p));
      }
      case Step::kExact:
        return add_vertex(exact_point());
      case Step::kPolygon: {
        if (!vertices) return;
        const unsigned flags = reader_.byte();
        return add_polygon(flags, loop());
      }
      case Step::kParallelogram:
        if (vertices) add_parallelogram(reader_.byte());
        return;
      case Step::kRectangle:
        return add_rectangle(reader_.byte());
      case Step::kHole:
        if (polygons && scene_.polygons.back().holes.size() < 4) {
          scene_.polygons.back().holes.push_back(loop());
        }
        return;
      case Step::kCopy:
        if (polygons) add_copy(reader_.byte());
        return;
      case Step::kPointLight:
        return add_light(LightType::kPoint, lattice());
      case Step::kLightBetween:
        if (vertices) add_light(LightType::kPoint, between());
        return;
      case Step::kSun: {
        Point direction;
        for (Number& x : direction) x = rounded(Number::from_dyadic(reader_.signed_byte(), 0));
        return add_light(LightType::kDirectional, std::move(direction));
      }
      case Step::kSunAlong:
        if (vertices) add_sun_along();
        return;
      case Step::kPanel:
        return add_panel();
      case Step::kPanelOf:
        if (polygons) add_panel_of_polygon();
        return;
      case Step::kPanelAt: {
        if (!vertices) return;
        std::vector<Point> points;
        for (const VertexId vertex : loop()) points.push_back(scene_.vertices[vertex]);
        return add_light(LightType::kArea, {}, std::move(points));
      }
      case Step::kExactLight: {
        const unsigned flags = reader_.byte();
        return add_light((flags & kDirectional) != 0 ? LightType::kDirectional : LightType::kPoint,
                         exact_point());
      }
      case Step::kExactPanel: {
        const std::size_t count = 3 + reader_.index(limits_.loop - 2);
        std::vector<Point> points;
        for (std::size_t i = 0; i < count; ++i) points.push_back(exact_point());
        return add_light(LightType::kArea, {}, std::move(points));
      }
      case Step::kCount:
        return;
    }
  }

  Reader reader_;
  SceneCodeLimits limits_;
  Scene scene_;
  int scale_ = 0;
};

}  // namespace

Scene scene_from_code(std::span<const std::uint8_t> code, const SceneCodeLimits& limits) {
  return Decoder(code, limits).run();
}

}  // namespace gnomon::fuzz
