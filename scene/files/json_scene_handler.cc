// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/json_scene_handler.h"

#include <charconv>

namespace gnomon {

namespace {

constexpr std::size_t kPlanePoints = 3;

/// A surrogate that came from a lone \uD8XX, encoded as if it were a character.
bool has_surrogate(std::string_view text) {
  for (std::size_t at = 0; at + 1 < text.size(); ++at) {
    if (static_cast<unsigned char>(text[at]) == 0xED &&
        static_cast<unsigned char>(text[at + 1]) >= 0xA0) {
      return true;
    }
  }
  return false;
}

}  // namespace

const JsonKeyWord* SceneHandler::key_word() const {
  if (!in_object()) return nullptr;
  for (const JsonKeyWord& known : keys()) {
    if (known.key == key_) return &known;
  }
  return nullptr;
}

std::string SceneHandler::expectation() const {
  switch (state_) {
    case JsonState::kStart:
      return "a scene: an object in braces";
    case JsonState::kVertices:
      return "a vertex: an array of three numbers";
    case JsonState::kPolygons:
      return "a polygon: an object in braces";
    case JsonState::kLights:
      return "a light: an object in braces";
    case JsonState::kHoles:
      return "a loop: an array of vertex indices";
    case JsonState::kAreaLoop:
    case JsonState::kRegionPlane:
      return "a point: an array of three numbers";
    case JsonState::kRegion:
      return "a plane: an array of three points";
    case JsonState::kLoop:
    case JsonState::kHole:
      return "a vertex index";
    case JsonState::kVertex:
    case JsonState::kVector:
    case JsonState::kAreaPoint:
    case JsonState::kRegionPoint:
      return "a number";
    default: {
      const JsonKeyWord* known = key_word();
      return known != nullptr ? known->expected : "";
    }
  }
}

std::string SceneHandler::pointer() const {
  const auto polygon = [&] { return "/polygons/" + std::to_string(scene_.polygons.size() - 1); };
  const auto light = [&] { return "/lights/" + std::to_string(scene_.lights.size() - 1); };
  const auto key = [&]() -> std::string {
    if (!unknown_key_.empty()) return "/" + escaped_token(unknown_key_);
    const JsonKeyWord* known = key_word();
    return known != nullptr ? "/" + std::string(known->word) : "";
  };
  const auto number = [](std::size_t value) { return "/" + std::to_string(value); };
  switch (state_) {
    case JsonState::kStart:
    case JsonState::kDone:
      return "";
    case JsonState::kScene:
      return key();
    case JsonState::kVertices:
      return "/vertices" + number(scene_.vertices.size());
    case JsonState::kVertex:
      return "/vertices" + number(scene_.vertices.size()) + number(coordinate_count_);
    case JsonState::kPolygons:
      return "/polygons" + number(scene_.polygons.size());
    case JsonState::kPolygon:
      return polygon() + key();
    case JsonState::kLoop:
      return polygon() + "/loop" + number(indices_.size());
    case JsonState::kHoles:
      return polygon() + "/holes" + number(scene_.polygons.back().holes.size());
    case JsonState::kHole:
      return polygon() + "/holes" + number(scene_.polygons.back().holes.size()) +
             number(indices_.size());
    case JsonState::kLights:
      return "/lights" + number(scene_.lights.size());
    case JsonState::kLight:
      return light() + key();
    case JsonState::kVector:
      return light() + (key_ == kPosition ? "/position" : "/to_light") + number(coordinate_count_);
    case JsonState::kAreaLoop:
      return light() + "/loop" + number(scene_.lights.back().loop.size());
    case JsonState::kAreaPoint:
      return light() + "/loop" + number(scene_.lights.back().loop.size()) +
             number(coordinate_count_);
    case JsonState::kRegion:
      return light() + "/region" + number(scene_.lights.back().region.size());
    case JsonState::kRegionPlane:
      return light() + "/region" + number(scene_.lights.back().region.size() - 1) +
             number(region_points_);
    case JsonState::kRegionPoint:
      return light() + "/region" + number(scene_.lights.back().region.size() - 1) +
             number(region_points_) + number(coordinate_count_);
    case JsonState::kExtra:
      if (outside_extra_ == JsonState::kPolygon) return polygon() + "/extra";
      if (outside_extra_ == JsonState::kLight) return light() + "/extra";
      return "/extra";
  }
  return "";
}

// ---------------------------------------------------------------------------------------- "extra"

bool SceneHandler::begin_extra(std::size_t begin) {
  outside_extra_ = state_;
  extra_begin_ = begin;
  extra_depth_ = 1;
  state_ = JsonState::kExtra;
  return true;
}

bool SceneHandler::open_in_extra() {
  if (++extra_depth_ <= kMostNesting) return true;
  return stop_here(ErrorCode::kLimit, "nested too deeply", "at most 1000 levels in \"extra\"");
}

bool SceneHandler::close_in_extra() {
  if (--extra_depth_ == 0) {
    state_ = outside_extra_;
    keep_extra(position() + 1);
  }
  return true;
}

void SceneHandler::keep_extra(std::size_t end) {
  if (state_ == JsonState::kScene) scene_.extra = long_numbers_.original(text_, extra_begin_, end);
  key_ = kNone;
}

std::size_t SceneHandler::string_end(std::size_t begin) const {
  std::size_t at = begin + 1;
  while (text_[at] != '"') at += text_[at] == '\\' ? 2 : 1;
  return at + 1;
}

bool SceneHandler::scalar(const char* found, std::size_t begin, std::size_t end) {
  if (state_ == JsonState::kExtra) return true;
  if (in_object() && key_ == kExtraKey) {
    extra_begin_ = begin;
    keep_extra(end);
    return true;
  }
  return wrong_type(found, begin);
}

// --------------------------------------------------------------------------------- parser's events

bool SceneHandler::Bool(bool value) {
  if (in_object() && key_ == kTwoSided) {
    if (state_ == JsonState::kScene) {
      scene_.two_sided = value;
    } else {
      scene_.polygons.back().two_sided = value;
    }
    return true;
  }
  if (in_object() && key_ == kCasts) {
    scene_.polygons.back().casts = value;
    return true;
  }
  return scalar(value ? "true" : "false", position() - (value ? 4 : 5), position());
}

bool SceneHandler::RawNumber(const char* text, rapidjson::SizeType length, bool) {
  const std::string_view digits = long_numbers_.at(position(), {text, length});
  switch (state_) {
    case JsonState::kVertex:
    case JsonState::kVector:
    case JsonState::kAreaPoint:
    case JsonState::kRegionPoint:
      return coordinate(digits);
    case JsonState::kLoop:
    case JsonState::kHole:
      return index(digits);
    case JsonState::kScene:
      if (key_ != kVersion) break;
      if (digits == "1") return true;
      return stop_here(ErrorCode::kFormat, "version " + std::string(digits.substr(0, 40)),
                       "version 1");
    case JsonState::kLight:
      if (key_ == kIntensity) return number(digits, scene_.lights.back().intensity);
      break;
    default:
      break;
  }
  return scalar("a number", position(), position() + digits.size());
}

bool SceneHandler::String(const char* text, rapidjson::SizeType length, bool) {
  const std::string_view value(text, length);
  const bool is_kept = in_object() && (key_ == kName || key_ == kId);
  if (is_kept && has_surrogate(value)) {
    return stop_here(ErrorCode::kSyntax, "half of a surrogate pair in a string", "both halves");
  }
  if (in_object()) {
    switch (key_) {
      case kFormat:
        if (value == "gnomon-scene") return true;
        return stop_here(ErrorCode::kFormat, "format " + quoted_text(value), "'gnomon-scene'");
      case kName:
        scene_.name = value;
        return true;
      case kNumbers: {
        if (value != "double" && value != "decimal") {
          return stop_here(ErrorCode::kFormat, "numbers " + quoted_text(value), expectation());
        }
        if (meaning_is_fixed_) return true;
        const NumberMeaning meaning =
            value == "decimal" ? NumberMeaning::kDecimal : NumberMeaning::kDouble;
        if (meaning != scene_.numbers && any_number_) {
          late_meaning_ = meaning;
          return false;
        }
        scene_.numbers = meaning;
        return true;
      }
      case kId:
        (state_ == JsonState::kPolygon ? scene_.polygons.back().id : scene_.lights.back().id) =
            value;
        return true;
      case kType: {
        Light& light = scene_.lights.back();
        if (value == "point") {
          light.type = LightType::kPoint;
        } else if (value == "directional") {
          light.type = LightType::kDirectional;
        } else if (value == "area") {
          light.type = LightType::kArea;
        } else {
          return stop_here(ErrorCode::kFormat, "light type " + quoted_text(value), expectation());
        }
        return true;
      }
      case kExtraKey:
        return scalar("a string", position(), string_end(position()));
      default:
        break;
    }
  }
  return scalar("a string", position(), position());
}

bool SceneHandler::StartObject() {
  switch (state_) {
    case JsonState::kStart:
      state_ = JsonState::kScene;
      return true;
    case JsonState::kPolygons:
      scene_.polygons.emplace_back();
      polygon_offsets_.push_back(position());
      state_ = JsonState::kPolygon;
      break;
    case JsonState::kLights:
      scene_.lights.emplace_back();
      state_ = JsonState::kLight;
      break;
    case JsonState::kExtra:
      return open_in_extra();
    default:
      if (in_object() && key_ == kExtraKey) return begin_extra(position());
      return wrong_type("an object", position());
  }
  key_ = kNone;
  element_seen_ = 0;
  return true;
}

bool SceneHandler::Key(const char* text, rapidjson::SizeType length, bool) {
  if (state_ == JsonState::kExtra) return true;
  const std::string_view word(text, length);
  for (const JsonKeyWord& known : keys()) {
    if (known.word != word) continue;
    key_ = known.key;
    if ((seen() & key_) != 0) {
      return stop_here(ErrorCode::kFormat, "the key " + quoted_text(word) + " stands here twice",
                       "each key once");
    }
    seen() |= key_;
    return true;
  }
  std::string expected = "one of";
  for (const JsonKeyWord& known : keys()) {
    expected += &known == &keys().front() ? " " : ", ";
    expected += known.word;
  }
  unknown_key_ = word;
  return stop_here(ErrorCode::kFormat, "unknown key " + quoted_text(word), std::move(expected));
}

bool SceneHandler::EndObject(rapidjson::SizeType) {
  if (state_ == JsonState::kExtra) return close_in_extra();
  key_ = kNone;
  switch (state_) {
    case JsonState::kPolygon:
      return end_polygon();
    case JsonState::kLight:
      return end_light();
    default:
      return end_scene();
  }
}

bool SceneHandler::StartArray() {
  switch (state_) {
    case JsonState::kVertices:
      state_ = JsonState::kVertex;
      break;
    case JsonState::kAreaLoop:
      state_ = JsonState::kAreaPoint;
      break;
    case JsonState::kHoles:
      state_ = JsonState::kHole;
      break;
    case JsonState::kRegion:
      scene_.lights.back().region.emplace_back();
      region_points_ = 0;
      state_ = JsonState::kRegionPlane;
      break;
    case JsonState::kRegionPlane:
      if (region_points_ == kPlanePoints) {
        return stop_here(ErrorCode::kFormat, "more than three points of a plane", "']'");
      }
      state_ = JsonState::kRegionPoint;
      break;
    case JsonState::kExtra:
      return open_in_extra();
    default:
      if (!in_object()) return wrong_type("an array", position());
      switch (key_) {
        case kVertexList:
          state_ = JsonState::kVertices;
          break;
        case kPolygonList:
          state_ = JsonState::kPolygons;
          break;
        case kLightList:
          state_ = JsonState::kLights;
          break;
        case kHoleList:
          state_ = JsonState::kHoles;
          break;
        case kLoopKey:
          state_ = state_ == JsonState::kPolygon ? JsonState::kLoop : JsonState::kAreaLoop;
          break;
        case kPosition:
        case kToLight:
          state_ = JsonState::kVector;
          break;
        case kRegionKey:
          state_ = JsonState::kRegion;
          break;
        case kExtraKey:
          return begin_extra(position());
        default:
          return wrong_type("an array", position());
      }
  }
  coordinate_count_ = 0;
  indices_.clear();
  return true;
}

bool SceneHandler::EndArray(rapidjson::SizeType) {
  switch (state_) {
    case JsonState::kVertex:
      if (!end_coordinates()) return false;
      if (scene_.vertices.size() == kMostVertices) {
        return stop_here(ErrorCode::kLimit, "too many vertices", "at most 4294967294");
      }
      scene_.vertices.push_back(std::move(current_));
      state_ = JsonState::kVertices;
      return true;
    case JsonState::kAreaPoint:
      if (!end_coordinates()) return false;
      scene_.lights.back().loop.push_back(std::move(current_));
      state_ = JsonState::kAreaLoop;
      return true;
    case JsonState::kVector:
      if (!end_coordinates()) return false;
      scene_.lights.back().position = std::move(current_);
      state_ = JsonState::kLight;
      return true;
    case JsonState::kLoop:
      scene_.polygons.back().loop.assign(indices_.begin(), indices_.end());
      state_ = JsonState::kPolygon;
      return true;
    case JsonState::kHole:
      scene_.polygons.back().holes.emplace_back(indices_.begin(), indices_.end());
      state_ = JsonState::kHoles;
      return true;
    case JsonState::kHoles:
      state_ = JsonState::kPolygon;
      return true;
    case JsonState::kAreaLoop:
    case JsonState::kRegion:
      state_ = JsonState::kLight;
      return true;
    case JsonState::kRegionPoint:
      if (!end_coordinates()) return false;
      scene_.lights.back().region.back()[region_points_++] = std::move(current_);
      state_ = JsonState::kRegionPlane;
      return true;
    case JsonState::kRegionPlane:
      if (region_points_ < kPlanePoints) {
        return stop_here(ErrorCode::kFormat,
                         "only " + std::to_string(region_points_) + " of three points of a plane",
                         expectation());
      }
      state_ = JsonState::kRegion;
      return true;
    case JsonState::kExtra:
      return close_in_extra();
    default:
      state_ = JsonState::kScene;
      return true;
  }
}

// --------------------------------------------------------------------------------- values of a
// scene

bool SceneHandler::number(std::string_view text, Number& result) {
  any_number_ = true;
  bool underflow = false;
  auto parsed = Number::parse(text, scene_.numbers, &underflow);
  if (!parsed && skip_bad_ && state_ == JsonState::kVertex) {
    bad_vertices_.emplace(static_cast<VertexId>(scene_.vertices.size()), parsed.error().what);
    result = Number();
    return true;
  }
  if (!parsed) {
    return stop_here(parsed.error().code, parsed.error().what, parsed.error().expected);
  }
  if (underflow) underflow_.add(position());
  result = *std::move(parsed);
  return true;
}

bool SceneHandler::coordinate(std::string_view text) {
  if (coordinate_count_ == kCoordinates) {
    return stop_here(ErrorCode::kFormat, "more than three coordinates", "']'");
  }
  return number(text, current_[coordinate_count_]) && ++coordinate_count_ != 0;
}

bool SceneHandler::end_coordinates() {
  if (coordinate_count_ == kCoordinates) return true;
  return stop_here(ErrorCode::kFormat,
                   "only " + std::to_string(coordinate_count_) + " of three coordinates",
                   "a number");
}

bool SceneHandler::index(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || text[0] == '-') {
    if (text[0] == '-' || error == std::errc::result_out_of_range) {
      return bad_index(text, "an index from 0");
    }
    return stop_here(ErrorCode::kFormat, quoted_text(text) + " is not an integer",
                     "a vertex index");
  }
  if (error != std::errc{} || value > kMostVertices) {
    return bad_index(text, "an index of a vertex");
  }
  indices_.push_back(static_cast<VertexId>(value));
  return true;
}

bool SceneHandler::bad_index(std::string_view text, std::string expected) {
  const std::string what = "index " + std::string(text.substr(0, 40)) + " is not that of a vertex";
  if (!skip_bad_) return stop_here(ErrorCode::kIndex, what, std::move(expected));
  problems_.push_back(
      {static_cast<std::uint32_t>(scene_.polygons.size() - 1),
       Error{ErrorCode::kIndex, ErrorPlace{file_, 0, 0, {}}, what, std::move(expected)}});
  indices_.push_back(0);
  return true;
}

bool SceneHandler::require(std::uint32_t seen, std::uint32_t needed, const std::string& pointer) {
  for (const JsonKeyWord& known : keys()) {
    if ((known.key & needed & ~seen) == 0) continue;
    return stop(ErrorCode::kFormat, "the key '" + std::string(known.word) + "' is missing",
                known.expected, locate_pointer(text_, pointer), pointer);
  }
  return true;
}

bool SceneHandler::end_polygon() {
  const std::size_t place = scene_.polygons.size() - 1;
  if ((element_seen_ & kLoopKey) == 0) {
    return require(element_seen_, kLoopKey, "/polygons/" + std::to_string(place));
  }
  if ((element_seen_ & kId) == 0) scene_.polygons.back().id = std::to_string(place);
  state_ = JsonState::kPolygons;
  return true;
}

bool SceneHandler::end_light() {
  Light& light = scene_.lights.back();
  const std::size_t place = scene_.lights.size() - 1;
  const std::string pointer = "/lights/" + std::to_string(place);
  const std::uint32_t own = light.is_point()         ? kPosition
                            : light.is_directional() ? kToLight
                                                     : kLoopKey;
  const std::uint32_t geometric = kPosition | kToLight | kLoopKey;
  if (!require(element_seen_, kType, pointer) || !require(element_seen_, own, pointer))
    return false;
  for (const JsonKeyWord& known : kLightKeys) {
    if ((known.key & element_seen_ & geometric & ~own) == 0) continue;
    const std::string stray = pointer + "/" + std::string(known.word);
    return stop(ErrorCode::kFormat,
                "the key '" + std::string(known.word) + "' does not belong to this type of light",
                "position for point, to_light for directional, loop for area",
                locate_pointer(text_, stray), stray);
  }
  if (light.has_area() && (element_seen_ & kRegionKey) != 0) {
    const std::string stray = pointer + "/region";
    return stop(ErrorCode::kFormat, "the key 'region' does not belong to this type of light",
                "a region of a point or directional light", locate_pointer(text_, stray), stray);
  }
  if ((element_seen_ & kId) == 0) light.id = std::to_string(place);
  state_ = JsonState::kLights;
  return true;
}

bool SceneHandler::end_scene() {
  const std::uint32_t needed = lights_only_ ? kFormat | kVersion | kLightList
                                            : kFormat | kVersion | kVertexList | kPolygonList;
  if (!require(scene_seen_, needed, "")) return false;
  state_ = JsonState::kDone;
  return true;
}

}  // namespace gnomon
