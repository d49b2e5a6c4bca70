// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/plain_json_scene.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "gnomon/scene/validate.h"
#include "scene/base/index_table.h"
#include "scene/base/large_pages.h"
#include "scene/files/readers.h"
#include "scene/json/json_scanner.h"

namespace gnomon {

namespace {

/// Are the ids of polygons different? Each is looked up some polygons after it was read, when the
/// table's memory has come.
class DifferentIds {
 public:
  static constexpr std::size_t kLate = 16;

  explicit DifferentIds(const std::vector<Polygon>& polygons) : polygons_(polygons) {}

  /// Requires: at most kLate were added.
  void reserve(std::size_t expected) { table_.reserve(expected); }
  /// Takes the id of the last polygon. False if an earlier one was found to have an earlier one's.
  bool add() {
    const std::size_t hash = std::hash<std::string_view>{}(polygons_.back().id);
    table_.look_ahead(hash);
    std::size_t& place = hashes_[added_ % kLate];
    const bool is_new = added_ < kLate || enter(place);
    place = hash;
    ++added_;
    return is_new;
  }
  /// Are all that were added different?
  bool finish() {
    while (entered_ < added_) {
      if (!enter(hashes_[entered_ % kLate])) return false;
    }
    return true;
  }

 private:
  bool enter(std::size_t hash) {
    const auto place = static_cast<std::uint32_t>(entered_++);
    return table_.find_or_enter(hash, place, [&](std::uint32_t other) {
      return polygons_[other].id == polygons_[place].id;
    }) == scene_detail::IndexTable::kNone;
  }

  const std::vector<Polygon>& polygons_;
  scene_detail::IndexTable table_;
  std::size_t hashes_[kLate] = {};
  std::size_t added_ = 0, entered_ = 0;
};

class PlainScene {
 public:
  PlainScene(TextWindow& window, const ReadOptions& options)
      : scanner_(window), meaning_is_fixed_(options.numbers.has_value()) {
    scene_.numbers = options.numbers.value_or(NumberMeaning::kDouble);
  }

  bool read() {
    scanner_.skip_byte_order_mark();
    if (!scanner_.take([&] { return scanner_.mark('{'); })) return false;
    char last = 0;
    do {
      if (!member(last)) return false;
    } while (last == ',');
    constexpr unsigned kNeeded = kFormat | kVersion | kVertices | kPolygons;
    return (seen_ & kNeeded) == kNeeded && scanner_.at_end() && is_valid();
  }

  Scene& scene() { return scene_; }
  bool has_name() const { return (seen_ & kName) != 0; }

 private:
  enum Key : unsigned {
    kFormat = 1u << 0,
    kVersion = 1u << 1,
    kName = 1u << 2,
    kNumbers = 1u << 3,
    kTwoSided = 1u << 4,
    kVertices = 1u << 5,
    kPolygons = 1u << 6,
    kLights = 1u << 7,
    kExtra = 1u << 8,
    kId = 1u << 9,
    kLoop = 1u << 10,
    kHoles = 1u << 11,
    kCasts = 1u << 12,
    kType = 1u << 13,
    kPosition = 1u << 14,
    kToLight = 1u << 15,
    kIntensity = 1u << 16,
  };

  /// Takes a key that must not be there twice, and its colon.
  template <std::size_t size>
  bool is_key(const char (&quoted)[size], Key key, unsigned& seen) {
    if (!scanner_.text(quoted)) return false;
    is_good_key_ = (seen & key) == 0 && scanner_.mark(':');
    seen |= key;
    return true;
  }

  // ------------------------------------------------------------------------ members of the scene

  bool member(char& last) {
    // Lists are taken element by element, everything else with what follows it.
    unsigned list = 0;
    const auto key = [&] {
      unsigned seen = seen_;
      list = 0;
      if (!scene_key(seen, list) || !is_good_key_) return false;
      if (list == 0 && !scanner_.mark(',', '}', last)) return false;
      seen_ = seen;
      return true;
    };
    if (!scanner_.take(key)) return false;
    if (list == 0) return true;
    return this->list(list) && scanner_.take([&] { return scanner_.mark(',', '}', last); });
  }

  bool list(unsigned key) {
    switch (key) {
      case kVertices:
        return elements(scene_.vertices, [&](Position& vertex) { return position(vertex); });
      case kPolygons:
        return elements(scene_.polygons,
                        [&](Polygon& polygon) { return this->polygon(polygon); }) &&
               ids_.finish();
      default:
        return elements(scene_.lights, [&](Light& light) { return this->light(light); });
    }
  }

  bool scene_key(unsigned& seen, unsigned& list) {
    std::string_view word;
    if (is_key("\"format\"", kFormat, seen)) return scanner_.text("\"gnomon-scene\"");
    if (is_key("\"version\"", kVersion, seen)) return scanner_.text("1");
    if (is_key("\"name\"", kName, seen)) {
      if (!scanner_.string(word)) return false;
      scene_.name = word;
      return true;
    }
    if (is_key("\"numbers\"", kNumbers, seen)) {
      if ((seen & (kVertices | kLights)) != 0 || !scanner_.string(word)) return false;
      if (word != "double" && word != "decimal") return false;
      if (meaning_is_fixed_) return true;
      scene_.numbers = word == "decimal" ? NumberMeaning::kDecimal : NumberMeaning::kDouble;
      return true;
    }
    if (is_key("\"two_sided\"", kTwoSided, seen)) return scanner_.truth(scene_.two_sided);
    if (is_key("\"extra\"", kExtra, seen)) {
      scanner_.next();
      const char* const begin = scanner_.place();
      if (!scanner_.value()) return false;
      scene_.extra.assign(begin, scanner_.place());
      return true;
    }
    if (!is_key("\"vertices\"", kVertices, seen) && !is_key("\"polygons\"", kPolygons, seen) &&
        !is_key("\"lights\"", kLights, seen)) {
      return false;
    }
    list = seen & ~seen_;
    return scanner_.mark('[');
  }

  /// The elements of a list, each with what follows it, and the end of the list.
  template <class Element, class Take>
  bool elements(std::vector<Element>& list, const Take& take) {
    char last = 0;
    const auto is_empty = [&] {
      last = scanner_.next() == ']' ? ']' : ',';
      return last == ']' ? scanner_.mark(']') : scanner_.next() != '\0';
    };
    if (!scanner_.take(is_empty)) return false;
    const std::size_t bytes = scanner_.bytes_left();
    const auto element = [&] {
      if (take(list.emplace_back()) && scanner_.mark(',', ']', last)) return true;
      list.pop_back();
      return false;
    };
    while (last == ',') {
      if (!scanner_.take(element)) return false;
      if constexpr (std::is_same_v<Element, Polygon>) {
        if (!ids_.add()) return false;
      }
      if (list.size() == DifferentIds::kLate) make_room(list, bytes);
    }
    return true;
  }

  /// Room for as many elements as the rest of the text can hold if they are as long as the first
  /// ones; `bytes` were left before these.
  template <class Element>
  void make_room(std::vector<Element>& list, std::size_t bytes) {
    const std::size_t left = scanner_.bytes_left();
    const std::size_t expected = list.size() + left / ((bytes - left) / list.size() + 1);
    scene_detail::reserve_in_large_pages(list, expected);
    if constexpr (std::is_same_v<Element, Polygon>) ids_.reserve(expected);
  }

  // ------------------------------------------------------------------------------------- vertices

  bool number(Number& result) {
    const bool decimal = scene_.numbers == NumberMeaning::kDecimal;
    std::int32_t integer = 0;
    if (scanner_.short_integer(integer)) {
      result =
          decimal ? Number::from_short_decimal(integer, 0) : Number(static_cast<double>(integer));
      return true;
    }
    JsonNumber number;
    if (!scanner_.number(number)) return false;
    constexpr std::int32_t kSmallExponent = 1000;
    const bool is_short = number.is_short && std::abs(number.exponent) <= kSmallExponent;
    if (is_short && decimal) {
      result = Number::from_short_decimal(number.mantissa, number.exponent);
      return true;
    }
    if (!decimal && double_nearest_to(number, result)) return true;
    bool underflow = false;
    auto parsed = Number::parse(number.text, scene_.numbers, &underflow);
    if (!parsed || underflow) return false;
    result = *std::move(parsed);
    return true;
  }

  /// False if it is not found here.
  static bool double_nearest_to(const JsonNumber& number, Number& result) {
    constexpr std::int64_t kExactIntegers = std::int64_t{1} << 53;
    constexpr std::int32_t kExactPowerOfTen = 22;
    if (number.is_short && std::abs(number.mantissa) <= kExactIntegers &&
        std::abs(number.exponent) <= kExactPowerOfTen) {
      result = Number(Number::from_short_decimal(number.mantissa, number.exponent).nearest());
      return true;
    }
    double value = 0;
    const char* const end = number.text.data() + number.text.size();
    const auto [stop, error] = std::from_chars(number.text.data(), end, value);
    if (error != std::errc{} || stop != end) return false;
    if (!(std::abs(value) >= std::numeric_limits<double>::min())) return false;
    result = Number(value);
    return true;
  }

  bool position(Position& p) {
    return scanner_.mark('[') && number(p[0]) && scanner_.mark(',') && number(p[1]) &&
           scanner_.mark(',') && number(p[2]) && scanner_.mark(']');
  }

  // ------------------------------------------------------------------------------------- polygons

  bool loop(std::vector<VertexId>& indices) {
    if (!scanner_.mark('[')) return false;
    workspace_.clear();
    char last = 0;
    do {
      VertexId index = 0;
      if (!scanner_.index(index) || !scanner_.mark(',', ']', last)) return false;
      workspace_.push_back(index);
      greatest_index_ = std::max(greatest_index_, index);
    } while (last == ',');
    constexpr std::size_t kFewest = 3;
    if (workspace_.size() < kFewest) return false;
    indices.assign(workspace_.begin(), workspace_.end());
    return true;
  }

  bool holes(std::vector<std::vector<VertexId>>& holes) {
    if (!scanner_.mark('[')) return false;
    if (scanner_.mark(']')) return true;
    char last = 0;
    do {
      if (!loop(holes.emplace_back()) || !scanner_.mark(',', ']', last)) return false;
    } while (last == ',');
    return true;
  }

  bool polygon(Polygon& polygon) {
    if (!scanner_.mark('{')) return false;
    unsigned seen = 0;
    char last = 0;
    do {
      bool truth = false;
      bool taken = false;
      if (is_key("\"id\"", kId, seen)) {
        std::string_view id;
        taken = scanner_.string(id) && is_valid_id(id);
        polygon.id = id;
      } else if (is_key("\"loop\"", kLoop, seen)) {
        taken = loop(polygon.loop);
      } else if (is_key("\"holes\"", kHoles, seen)) {
        taken = holes(polygon.holes);
      } else if (is_key("\"two_sided\"", kTwoSided, seen)) {
        taken = scanner_.truth(truth);
        polygon.two_sided = truth;
      } else if (is_key("\"casts\"", kCasts, seen)) {
        taken = scanner_.truth(polygon.casts);
      } else if (is_key("\"extra\"", kExtra, seen)) {
        taken = scanner_.value();
      }
      if (!taken || !is_good_key_ || !scanner_.mark(',', '}', last)) return false;
    } while (last == ',');
    if ((seen & kId) == 0) polygon.id = std::to_string(scene_.polygons.size() - 1);
    return (seen & kLoop) != 0;
  }

  // --------------------------------------------------------------------------------------- lights

  bool light(Light& light) {
    if (!scanner_.mark('{')) return false;
    unsigned seen = 0;
    char last = 0;
    do {
      bool taken = false;
      std::string_view word;
      if (is_key("\"id\"", kId, seen)) {
        taken = scanner_.string(word);
        light.id = word;
      } else if (is_key("\"type\"", kType, seen)) {
        taken = scanner_.string(word) && light_type(word, light.type);
      } else if (is_key("\"position\"", kPosition, seen)) {
        taken = position(light.position);
      } else if (is_key("\"to_light\"", kToLight, seen)) {
        taken = position(light.position);
      } else if (is_key("\"loop\"", kLoop, seen)) {
        taken = area_loop(light.loop);
      } else if (is_key("\"intensity\"", kIntensity, seen)) {
        taken = number(light.intensity);
      } else if (is_key("\"extra\"", kExtra, seen)) {
        taken = scanner_.value();
      }
      if (!taken || !is_good_key_ || !scanner_.mark(',', '}', last)) return false;
    } while (last == ',');
    if ((seen & kId) == 0) light.id = std::to_string(scene_.lights.size() - 1);
    const unsigned own = light.is_point() ? kPosition : light.is_directional() ? kToLight : kLoop;
    return (seen & kType) != 0 && (seen & (kPosition | kToLight | kLoop)) == own;
  }

  static bool light_type(std::string_view word, LightType& type) {
    type = word == "point"         ? LightType::kPoint
           : word == "directional" ? LightType::kDirectional
                                   : LightType::kArea;
    return type != LightType::kArea || word == "area";
  }

  bool area_loop(std::vector<Position>& points) {
    if (!scanner_.mark('[')) return false;
    if (scanner_.mark(']')) return true;
    char last = 0;
    do {
      if (!position(points.emplace_back()) || !scanner_.mark(',', ']', last)) return false;
    } while (last == ',');
    return true;
  }

  /// Loops, holes and ids were checked as they came.
  bool is_valid() const {
    return (scene_.polygons.empty() || greatest_index_ < scene_.vertices.size()) &&
           scene_.vertices.size() < std::numeric_limits<VertexId>::max() &&
           validate_lights(scene_).has_value();
  }

  JsonScanner scanner_;
  const bool meaning_is_fixed_;
  Scene scene_;
  DifferentIds ids_{scene_.polygons};
  unsigned seen_ = 0;         // keys of the scene
  bool is_good_key_ = false;  // the last one was the first of its kind, and had its colon
  VertexId greatest_index_ = 0;
  std::vector<VertexId> workspace_;
};

}  // namespace

std::optional<ReadResult> read_plain_json(TextWindow& window, const std::string& file,
                                          const ReadOptions& options) {
  if (options.lights_only) return std::nullopt;
  PlainScene plain(window, options);
  if (!plain.read()) return std::nullopt;
  ReadResult result{std::move(plain.scene()), {}, {}, {}};
  result.scene.file = file;
  if (!plain.has_name()) result.scene.name = name_from_file(file);
  if (result.scene.polygons.empty()) result.warnings.emplace_back("the scene has no polygons");
  return result;
}

}  // namespace gnomon
