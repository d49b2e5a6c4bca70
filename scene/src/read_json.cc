// SPDX-License-Identifier: LGPL-3.0-or-later
// The JSON reader: one pass of RapidJSON's SAX parser into the scene. The parser's events drive a
// machine whose states are the places of the format; structure is checked afterwards by validate.h,
// and only then is a JSON pointer turned into a line, by a second pass over the text.
#include <rapidjson/reader.h>

#include <charconv>
#include <optional>
#include <span>
#include <utility>

#include "gnomon/scene/text_file.h"
#include "gnomon/scene/validate.h"
#include "json_text.h"
#include "readers.h"

namespace gnomon {

namespace {

enum class State : std::uint8_t {
  kStart,
  kScene,
  kVertices,
  kVertex,
  kPolygons,
  kPolygon,
  kLoop,
  kHoles,
  kHole,
  kLights,
  kLight,
  kVector,  // position or to_light
  kAreaLoop,
  kAreaPoint,
  kExtra,
  kDone,
};

/// Keys as bits, so that a set of them says which were seen in an object.
enum Key : std::uint32_t {
  kNone = 0,
  kFormat = 1u << 0,
  kVersion = 1u << 1,
  kName = 1u << 2,
  kNumbers = 1u << 3,
  kTwoSided = 1u << 4,
  kVertexList = 1u << 5,
  kPolygonList = 1u << 6,
  kLightList = 1u << 7,
  kExtraKey = 1u << 8,
  kId = 1u << 9,
  kLoopKey = 1u << 10,
  kHoleList = 1u << 11,
  kCasts = 1u << 12,
  kType = 1u << 13,
  kPosition = 1u << 14,
  kToLight = 1u << 15,
  kIntensity = 1u << 16,
};

struct KeyWord {
  std::string_view word;
  Key key;
  const char* expected;  // what its value is
};

constexpr KeyWord kSceneKeys[] = {
    {"format", kFormat, "\"gnomon-scene\""},
    {"version", kVersion, "1"},
    {"name", kName, "a string"},
    {"numbers", kNumbers, "\"double\" or \"decimal\""},
    {"two_sided", kTwoSided, "true or false"},
    {"vertices", kVertexList, "an array of vertices"},
    {"polygons", kPolygonList, "an array of polygons"},
    {"lights", kLightList, "an array of lights"},
    {"extra", kExtraKey, "anything"},
};
constexpr KeyWord kPolygonKeys[] = {
    {"id", kId, "a string"},
    {"loop", kLoopKey, "an array of vertex indices"},
    {"holes", kHoleList, "an array of loops"},
    {"two_sided", kTwoSided, "true or false"},
    {"casts", kCasts, "true or false"},
    {"extra", kExtraKey, "anything"},
};
constexpr KeyWord kLightKeys[] = {
    {"id", kId, "a string"},
    {"type", kType, "\"point\", \"directional\" or \"area\""},
    {"position", kPosition, "an array of three numbers"},
    {"to_light", kToLight, "an array of three numbers"},
    {"loop", kLoopKey, "an array of points"},
    {"intensity", kIntensity, "a number"},
    {"extra", kExtraKey, "anything"},
};

constexpr std::size_t kCoordinates = 3;
/// Below "extra" alone; the format itself has five levels.
constexpr std::size_t kMostNesting = 1000;
constexpr std::uint64_t kMostVertices = 0xfffffffe;

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

class SceneHandler : public rapidjson::BaseReaderHandler<rapidjson::UTF8<>, SceneHandler> {
 public:
  SceneHandler(const std::string& text, const std::string& file, std::size_t start,
               const rapidjson::StringStream& stream, const LongNumbers& long_numbers,
               NumberMeaning meaning, bool meaning_is_fixed, bool lights_only)
      : text_(text),
        file_(file),
        start_(start),
        stream_(stream),
        long_numbers_(long_numbers),
        meaning_is_fixed_(meaning_is_fixed),
        lights_only_(lights_only) {
    scene_.numbers = meaning;
    scene_.file = file;
  }

  Scene& scene() { return scene_; }
  std::optional<Error>& error() { return error_; }
  const UnderflowCount& underflow() const { return underflow_; }
  /// Set if "numbers" came after numbers that were read with another meaning.
  std::optional<NumberMeaning> meaning_found_late() const { return late_meaning_; }
  bool has_name() const { return (scene_seen_ & kName) != 0; }

  std::string pointer() const;

  // Events of the parser. False stops it.
  bool Null() { return scalar("null", position() - 4, position()); }
  bool Bool(bool value);
  bool RawNumber(const char* text, rapidjson::SizeType length, bool copy);
  bool String(const char* text, rapidjson::SizeType length, bool copy);
  bool StartObject();
  bool Key(const char* text, rapidjson::SizeType length, bool copy);
  bool EndObject(rapidjson::SizeType count);
  bool StartArray();
  bool EndArray(rapidjson::SizeType count);

 private:
  // The parser works on a copy of the stream inside a string or number, so that this is where the
  // token begins; for true, false and null it is where they end, for a bracket its own place.
  std::size_t position() const { return start_ + stream_.Tell(); }

  bool stop(ErrorCode code, std::string what, std::string expected, std::size_t offset,
            std::string pointer) {
    error_ = Error{code, place_in_text(file_, text_, offset, std::move(pointer)), std::move(what),
                   std::move(expected)};
    return false;
  }
  bool stop_here(ErrorCode code, std::string what, std::string expected) {
    return stop(code, std::move(what), std::move(expected), position(), pointer());
  }
  bool wrong_type(const char* found, std::size_t offset) {
    return stop(ErrorCode::kFormat, std::string("found ") + found, expectation(), offset,
                pointer());
  }

  bool in_object() const {
    return state_ == State::kScene || state_ == State::kPolygon || state_ == State::kLight;
  }
  std::span<const KeyWord> keys() const {
    if (state_ == State::kScene) return kSceneKeys;
    if (state_ == State::kPolygon) return kPolygonKeys;
    return kLightKeys;
  }
  std::uint32_t& seen() { return state_ == State::kScene ? scene_seen_ : element_seen_; }
  const KeyWord* key_word() const;
  std::string expectation() const;

  /// A value that no place takes, or that "extra" does.
  bool scalar(const char* found, std::size_t begin, std::size_t end);
  bool begin_extra(std::size_t begin);
  bool open_in_extra();
  bool close_in_extra();
  void keep_extra(std::size_t end);
  std::size_t string_end(std::size_t begin) const;

  bool coordinate(std::string_view text);
  bool index(std::string_view text);
  bool number(std::string_view text, Number& result);
  bool end_coordinates();
  bool end_polygon();
  bool end_light();
  bool end_scene();
  bool require(std::uint32_t seen, std::uint32_t needed, const std::string& pointer);

  const std::string& text_;
  const std::string& file_;
  const std::size_t start_;  // of the stream in the text
  const rapidjson::StringStream& stream_;
  const LongNumbers& long_numbers_;
  const bool meaning_is_fixed_;
  const bool lights_only_;

  Scene scene_;
  std::optional<Error> error_;
  std::optional<NumberMeaning> late_meaning_;
  UnderflowCount underflow_;
  bool any_number_ = false;

  State state_ = State::kStart;
  enum Key key_ = kNone;
  std::string unknown_key_;
  std::uint32_t scene_seen_ = 0, element_seen_ = 0;
  Position current_;
  std::size_t coordinate_count_ = 0;
  std::vector<VertexId> indices_;
  State outside_extra_ = State::kScene;
  std::size_t extra_depth_ = 0, extra_begin_ = 0;
};

const KeyWord* SceneHandler::key_word() const {
  if (!in_object()) return nullptr;
  for (const KeyWord& known : keys()) {
    if (known.key == key_) return &known;
  }
  return nullptr;
}

std::string SceneHandler::expectation() const {
  switch (state_) {
    case State::kStart:
      return "a scene: an object in braces";
    case State::kVertices:
      return "a vertex: an array of three numbers";
    case State::kPolygons:
      return "a polygon: an object in braces";
    case State::kLights:
      return "a light: an object in braces";
    case State::kHoles:
      return "a loop: an array of vertex indices";
    case State::kAreaLoop:
      return "a point: an array of three numbers";
    case State::kLoop:
    case State::kHole:
      return "a vertex index";
    case State::kVertex:
    case State::kVector:
    case State::kAreaPoint:
      return "a number";
    default: {
      const KeyWord* known = key_word();
      return known != nullptr ? known->expected : "";
    }
  }
}

std::string SceneHandler::pointer() const {
  const auto polygon = [&] { return "/polygons/" + std::to_string(scene_.polygons.size() - 1); };
  const auto light = [&] { return "/lights/" + std::to_string(scene_.lights.size() - 1); };
  const auto key = [&]() -> std::string {
    if (!unknown_key_.empty()) return "/" + escaped_token(unknown_key_);
    const KeyWord* known = key_word();
    return known != nullptr ? "/" + std::string(known->word) : "";
  };
  const auto number = [](std::size_t value) { return "/" + std::to_string(value); };
  switch (state_) {
    case State::kStart:
    case State::kDone:
      return "";
    case State::kScene:
      return key();
    case State::kVertices:
      return "/vertices" + number(scene_.vertices.size());
    case State::kVertex:
      return "/vertices" + number(scene_.vertices.size()) + number(coordinate_count_);
    case State::kPolygons:
      return "/polygons" + number(scene_.polygons.size());
    case State::kPolygon:
      return polygon() + key();
    case State::kLoop:
      return polygon() + "/loop" + number(indices_.size());
    case State::kHoles:
      return polygon() + "/holes" + number(scene_.polygons.back().holes.size());
    case State::kHole:
      return polygon() + "/holes" + number(scene_.polygons.back().holes.size()) +
             number(indices_.size());
    case State::kLights:
      return "/lights" + number(scene_.lights.size());
    case State::kLight:
      return light() + key();
    case State::kVector:
      return light() + (key_ == kPosition ? "/position" : "/to_light") + number(coordinate_count_);
    case State::kAreaLoop:
      return light() + "/loop" + number(scene_.lights.back().loop.size());
    case State::kAreaPoint:
      return light() + "/loop" + number(scene_.lights.back().loop.size()) +
             number(coordinate_count_);
    case State::kExtra:
      if (outside_extra_ == State::kPolygon) return polygon() + "/extra";
      if (outside_extra_ == State::kLight) return light() + "/extra";
      return "/extra";
  }
  return "";
}

// ---------------------------------------------------------------------------------------- "extra"

bool SceneHandler::begin_extra(std::size_t begin) {
  outside_extra_ = state_;
  extra_begin_ = begin;
  extra_depth_ = 1;
  state_ = State::kExtra;
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
  if (state_ == State::kScene) scene_.extra = long_numbers_.original(text_, extra_begin_, end);
  key_ = kNone;
}

std::size_t SceneHandler::string_end(std::size_t begin) const {
  std::size_t at = begin + 1;
  while (text_[at] != '"') at += text_[at] == '\\' ? 2 : 1;
  return at + 1;
}

bool SceneHandler::scalar(const char* found, std::size_t begin, std::size_t end) {
  if (state_ == State::kExtra) return true;
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
    if (state_ == State::kScene) {
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
    case State::kVertex:
    case State::kVector:
    case State::kAreaPoint:
      return coordinate(digits);
    case State::kLoop:
    case State::kHole:
      return index(digits);
    case State::kScene:
      if (key_ != kVersion) break;
      if (digits == "1") return true;
      return stop_here(ErrorCode::kFormat, "version " + std::string(digits.substr(0, 40)),
                       "version 1");
    case State::kLight:
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
        (state_ == State::kPolygon ? scene_.polygons.back().id : scene_.lights.back().id) = value;
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
    case State::kStart:
      state_ = State::kScene;
      return true;
    case State::kPolygons:
      scene_.polygons.emplace_back();
      state_ = State::kPolygon;
      break;
    case State::kLights:
      scene_.lights.emplace_back();
      state_ = State::kLight;
      break;
    case State::kExtra:
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
  if (state_ == State::kExtra) return true;
  const std::string_view word(text, length);
  for (const KeyWord& known : keys()) {
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
  for (const KeyWord& known : keys()) {
    expected += &known == &keys().front() ? " " : ", ";
    expected += known.word;
  }
  unknown_key_ = word;
  return stop_here(ErrorCode::kFormat, "unknown key " + quoted_text(word), std::move(expected));
}

bool SceneHandler::EndObject(rapidjson::SizeType) {
  if (state_ == State::kExtra) return close_in_extra();
  key_ = kNone;
  switch (state_) {
    case State::kPolygon:
      return end_polygon();
    case State::kLight:
      return end_light();
    default:
      return end_scene();
  }
}

bool SceneHandler::StartArray() {
  switch (state_) {
    case State::kVertices:
      state_ = State::kVertex;
      break;
    case State::kAreaLoop:
      state_ = State::kAreaPoint;
      break;
    case State::kHoles:
      state_ = State::kHole;
      break;
    case State::kExtra:
      return open_in_extra();
    default:
      if (!in_object()) return wrong_type("an array", position());
      switch (key_) {
        case kVertexList:
          state_ = State::kVertices;
          break;
        case kPolygonList:
          state_ = State::kPolygons;
          break;
        case kLightList:
          state_ = State::kLights;
          break;
        case kHoleList:
          state_ = State::kHoles;
          break;
        case kLoopKey:
          state_ = state_ == State::kPolygon ? State::kLoop : State::kAreaLoop;
          break;
        case kPosition:
        case kToLight:
          state_ = State::kVector;
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
    case State::kVertex:
      if (!end_coordinates()) return false;
      if (scene_.vertices.size() == kMostVertices) {
        return stop_here(ErrorCode::kLimit, "too many vertices", "at most 4294967294");
      }
      scene_.vertices.push_back(std::move(current_));
      state_ = State::kVertices;
      return true;
    case State::kAreaPoint:
      if (!end_coordinates()) return false;
      scene_.lights.back().loop.push_back(std::move(current_));
      state_ = State::kAreaLoop;
      return true;
    case State::kVector:
      if (!end_coordinates()) return false;
      scene_.lights.back().position = std::move(current_);
      state_ = State::kLight;
      return true;
    case State::kLoop:
      scene_.polygons.back().loop.assign(indices_.begin(), indices_.end());
      state_ = State::kPolygon;
      return true;
    case State::kHole:
      scene_.polygons.back().holes.emplace_back(indices_.begin(), indices_.end());
      state_ = State::kHoles;
      return true;
    case State::kHoles:
      state_ = State::kPolygon;
      return true;
    case State::kAreaLoop:
      state_ = State::kLight;
      return true;
    case State::kExtra:
      return close_in_extra();
    default:
      state_ = State::kScene;
      return true;
  }
}

// --------------------------------------------------------------------------------- values of a
// scene

bool SceneHandler::number(std::string_view text, Number& result) {
  any_number_ = true;
  bool underflow = false;
  auto parsed = Number::parse(text, scene_.numbers, &underflow);
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
      return stop_here(ErrorCode::kIndex,
                       "index " + std::string(text.substr(0, 40)) + " is not that of a vertex",
                       "an index from 0");
    }
    return stop_here(ErrorCode::kFormat, quoted_text(text) + " is not an integer",
                     "a vertex index");
  }
  if (error != std::errc{} || value > kMostVertices) {
    return stop_here(ErrorCode::kIndex,
                     "index " + std::string(text.substr(0, 40)) + " is not that of a vertex",
                     "an index of a vertex");
  }
  indices_.push_back(static_cast<VertexId>(value));
  return true;
}

bool SceneHandler::require(std::uint32_t seen, std::uint32_t needed, const std::string& pointer) {
  for (const KeyWord& known : keys()) {
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
  state_ = State::kPolygons;
  return true;
}

bool SceneHandler::end_light() {
  Light& light = scene_.lights.back();
  const std::size_t place = scene_.lights.size() - 1;
  const std::string pointer = "/lights/" + std::to_string(place);
  const std::uint32_t own = light.type == LightType::kPoint         ? kPosition
                            : light.type == LightType::kDirectional ? kToLight
                                                                    : kLoopKey;
  const std::uint32_t geometric = kPosition | kToLight | kLoopKey;
  if (!require(element_seen_, kType, pointer) || !require(element_seen_, own, pointer))
    return false;
  for (const KeyWord& known : kLightKeys) {
    if ((known.key & element_seen_ & geometric & ~own) == 0) continue;
    const std::string stray = pointer + "/" + std::string(known.word);
    return stop(ErrorCode::kFormat,
                "the key '" + std::string(known.word) + "' does not belong to this type of light",
                "position for point, to_light for directional, loop for area",
                locate_pointer(text_, stray), stray);
  }
  if ((element_seen_ & kId) == 0) light.id = std::to_string(place);
  state_ = State::kLights;
  return true;
}

bool SceneHandler::end_scene() {
  const std::uint32_t needed = lights_only_ ? kFormat | kVersion | kLightList
                                            : kFormat | kVersion | kVertexList | kPolygonList;
  if (!require(scene_seen_, needed, "")) return false;
  state_ = State::kDone;
  return true;
}

std::optional<Error> check_structure(const std::string& text, const Scene& scene,
                                     bool lights_only) {
  if (lights_only && !scene.polygons.empty()) {
    return Error{ErrorCode::kFormat, ErrorPlace{scene.file, 0, 0, "/polygons"},
                 "polygons in a file of lights", "lights only"};
  }
  auto valid = lights_only ? validate_lights(scene) : validate_scene(scene);
  if (valid) return std::nullopt;
  Error error = std::move(valid.error());
  error.where = place_in_text(scene.file, text, locate_pointer(text, error.where.pointer),
                              error.where.pointer);
  return error;
}

}  // namespace

Expected<ReadResult> read_json(std::string text, const std::string& file,
                               const ReadOptions& options) {
  if (auto readable = check_is_utf8(text, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  const std::size_t start = byte_order_mark(text);
  NumberMeaning meaning = options.numbers.value_or(NumberMeaning::kDouble);
  bool meaning_is_fixed = options.numbers.has_value();
  LongNumbers long_numbers;
  // Twice at most for a meaning found late, and once more for long numbers.
  for (;;) {
    rapidjson::StringStream stream(text.c_str() + start);
    SceneHandler handler(text, file, start, stream, long_numbers, meaning, meaning_is_fixed,
                         options.lights_only);
    rapidjson::Reader reader;
    const rapidjson::ParseResult parsed = reader.Parse<kJsonFlags>(stream, handler);
    if (handler.meaning_found_late()) {
      meaning = *handler.meaning_found_late();
      meaning_is_fixed = true;
      continue;
    }
    if (parsed.Code() == rapidjson::kParseErrorNumberTooBig && long_numbers.empty()) {
      long_numbers.hide_in(text);
      if (!long_numbers.empty()) continue;
    }
    if (handler.error()) return tl::unexpected(*std::move(handler.error()));
    if (parsed.IsError()) {
      return tl::unexpected(
          json_syntax_error(parsed.Code(), text, start + parsed.Offset(), file, handler.pointer()));
    }
    ReadResult result{std::move(handler.scene()), {}};
    if (!handler.has_name()) result.scene.name = name_from_file(file);
    if (auto error = check_structure(text, result.scene, options.lights_only)) {
      return tl::unexpected(*std::move(error));
    }
    handler.underflow().report(text, result.warnings);
    if (!options.lights_only && result.scene.polygons.empty()) {
      result.warnings.emplace_back("the scene has no polygons");
    }
    return result;
  }
}

}  // namespace gnomon
