// SPDX-License-Identifier: GPL-3.0-or-later
// From a scene to its code.
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "fuzz/generate/scene_code.h"
#include "fuzz/generate/scene_code_words.h"

namespace gnomon::fuzz {

namespace {

using namespace scene_code;

/// The code of a scene: a lattice where its vertices lie on one, Number's parts elsewhere.
class Encoder {
 public:
  Encoder(const Scene& scene, const SceneCodeLimits& limits) : scene_(scene), limits_(limits) {}

  std::optional<std::vector<std::uint8_t>> run() {
    if (scene_.vertices.size() > limits_.vertices || scene_.polygons.size() > limits_.polygons ||
        scene_.lights.size() > limits_.lights) {
      return std::nullopt;
    }
    put((scene_.two_sided ? kTwoSidedScene : 0u) | (decimal() ? kDecimals : 0u));
    put(0);
    for (const Position& vertex : scene_.vertices) {
      if (is_lattice(vertex)) {
        lattice(Step::kLattice, vertex);
      } else {
        put(Step::kExact);
        if (!point(vertex)) return std::nullopt;
      }
    }
    for (const Polygon& polygon : scene_.polygons) {
      put(Step::kPolygon);
      unsigned flags = polygon.casts ? 0 : kCastsNot;
      if (polygon.two_sided) flags |= *polygon.two_sided ? kTwoSided : kOneSided;
      put(flags);
      if (!loop(polygon.loop) || polygon.holes.size() > 4) return std::nullopt;
      for (const auto& hole : polygon.holes) {
        put(Step::kHole);
        if (!loop(hole)) return std::nullopt;
      }
    }
    for (const Light& one : scene_.lights) {
      if (!light(one)) return std::nullopt;
    }
    return std::move(code_);
  }

 private:
  bool decimal() const { return scene_.numbers == NumberMeaning::kDecimal; }
  void put(unsigned byte) { code_.push_back(static_cast<std::uint8_t>(byte)); }
  void put(Step step) { put(static_cast<unsigned>(step)); }

  /// The integer that a signed byte holds, if the number is one.
  static std::optional<int> byte_of(const Number& value) {
    const mpq_class exact = value.exact();
    if (exact.get_den() != 1 || abs(exact) > 127) return std::nullopt;
    return static_cast<int>(exact.get_num().get_si());
  }
  static bool is_lattice(const Position& p) {
    return std::all_of(p.begin(), p.end(), [](const Number& x) { return byte_of(x).has_value(); });
  }
  void lattice(Step step, const Position& p) {
    put(step);
    for (const Number& x : p) put(static_cast<unsigned>(*byte_of(x)) & 0xff);
  }

  bool number(const Number& value) {
    if (const auto small = byte_of(value); small && *small >= -64 && *small <= 63) {
      put(static_cast<unsigned>(*small + 64));
      return true;
    }
    if (value.is_decimal() != decimal() || !value.has_small_mantissa()) return false;
    if (decimal() && std::abs(value.exponent()) > 127) return false;
    const std::uint64_t mantissa = value.small_mantissa() < 0
                                       ? 0 - static_cast<std::uint64_t>(value.small_mantissa())
                                       : static_cast<std::uint64_t>(value.small_mantissa());
    const unsigned count = std::max(1u, (static_cast<unsigned>(std::bit_width(mantissa)) + 7) / 8);
    put(kMantissa | (value.small_mantissa() < 0 ? 8u : 0u) | (count - 1));
    for (unsigned i = count; i-- > 0;) put(static_cast<unsigned>(mantissa >> (8 * i)) & 0xff);
    const auto exponent = static_cast<std::uint16_t>(value.exponent());
    put(exponent & 0xffu);
    put(exponent >> 8);
    return true;
  }
  bool point(const Position& p) {
    return std::all_of(p.begin(), p.end(), [&](const Number& x) { return number(x); });
  }
  bool count(std::size_t size) {
    if (size < 3 || size > limits_.loop) return false;
    put(static_cast<unsigned>(size - 3));
    return true;
  }
  bool loop(const std::vector<VertexId>& loop) {
    if (!count(loop.size())) return false;
    for (const VertexId vertex : loop) put(vertex);
    return true;
  }

  bool light(const Light& light) {
    if (light.has_area()) {
      put(Step::kExactPanel);
      return count(light.loop.size()) && std::all_of(light.loop.begin(), light.loop.end(),
                                                     [&](const Position& p) { return point(p); });
    }
    const bool sun = light.is_directional();
    if (is_lattice(light.position)) {
      lattice(sun ? Step::kSun : Step::kPointLight, light.position);
      return true;
    }
    put(Step::kExactLight);
    put(sun ? kDirectional : 0u);
    return point(light.position);
  }

  const Scene& scene_;
  SceneCodeLimits limits_;
  std::vector<std::uint8_t> code_;
};

}  // namespace

std::optional<std::vector<std::uint8_t>> code_of_scene(const Scene& scene,
                                                       const SceneCodeLimits& limits) {
  return Encoder(scene, limits).run();
}

}  // namespace gnomon::fuzz
