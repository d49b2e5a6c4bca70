// SPDX-License-Identifier: LGPL-3.0-or-later
// What the generators build with: a scene whose equal vertices are shared, boxes, lights.
#ifndef GNOMON_SCENE_GENERATE_SCENE_MAKER_H
#define GNOMON_SCENE_GENERATE_SCENE_MAKER_H

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "gnomon/scene/generate.h"
#include "scene/base/index_table.h"
#include "scene/base/random.h"

namespace gnomon::scene_detail {

struct Int3 {
  std::int64_t x = 0, y = 0, z = 0;
  friend bool operator==(const Int3&, const Int3&) = default;
};
inline Int3 operator+(Int3 a, Int3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Int3 operator-(Int3 a, Int3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Int3 operator*(std::int64_t k, Int3 a) { return {k * a.x, k * a.y, k * a.z}; }
inline Int3 cross(Int3 a, Int3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline std::int64_t dot(Int3 a, Int3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline bool is_zero(Int3 a) { return a == Int3{}; }

using Values = std::map<std::string, std::int64_t, std::less<>>;

inline std::int64_t at(const Values& values, std::string_view name) {
  return values.find(name)->second;
}

/// The parameters that SceneMaker::lights(values, ...) reads.
inline const GeneratorParameter kLightParameter{"light", 0, 0, 2, "0: a lamp, 1: the sun, 2: both"};
inline const GeneratorParameter kAreaParameter{
    "area", 0, 0, 2, "1: an area light instead of the other lights, 2: besides them"};
inline const GeneratorParameter kAreaSizeParameter{
    "area_size", 10, 1, 1000, "its length and width, in hundredths of the scene's"};

/// Coordinates are given as integers; the scene's are these times 2^-fraction_bits.
class SceneMaker {
 public:
  explicit SceneMaker(std::string name, int fraction_bits = 0) : fraction_bits_(fraction_bits) {
    scene_.name = std::move(name);
  }
  void set_fraction_bits(int bits) { fraction_bits_ = bits; }
  /// Room for large scenes. Requires: there are no vertices yet.
  void reserve(std::int64_t polygons, std::int64_t vertices);

  /// The polygon as it is written to the scene, to be changed further.
  Polygon& face(std::string id, const std::vector<Int3>& loop);

  enum BoxFaces : unsigned {
    kBottom = 1,
    kTop = 2,
    kFront = 4,
    kBack = 8,
    kLeft = 16,
    kRight = 32,
    kSides = kFront | kBack | kLeft | kRight,
    kNoBottom = kSides | kTop,
    kAll = kNoBottom | kBottom
  };
  /// Faces of the box [low, high], seen from outside, or from inside: left and right are -x and +x,
  /// front and back -y and +y. Ids are id.top and so on.
  void box(const std::string& id, Int3 low, Int3 high, unsigned faces = kAll, bool inside = false);

  void lamp(Int3 position);
  void sun(Int3 to_light);
  /// An area light; it emits to where its loop is counter-clockwise.
  void panel(const std::vector<Int3>& loop);
  /// One that looks down, `area_size` hundredths of `width` long and wide.
  void panel_above(const Values& values, Int3 middle, std::int64_t width);
  /// 0: the lamp, 1: the sun, 2: both.
  void lamp_and_sun(std::int64_t which, Int3 lamp_position, Int3 to_sun);
  /// What the parameters above ask for; a panel round the lamp's place.
  void lights(const Values& values, Int3 lamp_position, Int3 to_sun, std::int64_t width);

  void set_two_sided(bool two_sided) { scene_.two_sided = two_sided; }
  void shuffle_polygons(Random& random) { random.shuffle(std::span(scene_.polygons)); }
  Scene take() { return std::move(scene_); }

 private:
  static std::uint64_t hash(Int3 p);
  VertexId vertex(Int3 p, std::uint64_t hash);
  Number number(std::int64_t value) const;
  Light& light(LightType type, const char* name);

  Scene scene_;
  int fraction_bits_;
  IndexTable table_;
  std::vector<Int3> points_;
  std::vector<std::uint64_t> hashes_;  // of the loop at hand
  std::map<std::string, int> light_counts_;
};

/// One generator: what it is, and the function that fills the scene.
struct Generator {
  GeneratorInfo info;
  void (*make)(SceneMaker& maker, const Values& values, Random& random);
};

std::vector<Generator> paper_generators();
std::vector<Generator> room_generators();
std::vector<Generator> figure_generators();
std::vector<Generator> solid_generators();
std::vector<Generator> large_generators();
std::vector<Generator> object_generators();
std::vector<Generator> hard_generators();
std::vector<Generator> repair_generators();
std::vector<Generator> area_paper_generators();
std::vector<Generator> area_generators();

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_GENERATE_SCENE_MAKER_H
