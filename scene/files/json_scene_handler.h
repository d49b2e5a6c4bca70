// SPDX-License-Identifier: LGPL-3.0-or-later
// The machine that RapidJSON's events drive through the places of the scene format, and that fills
// the scene. It keeps no document; its state, the key and the counts so far are the JSON pointer.
#ifndef GNOMON_SCENE_FILES_JSON_SCENE_HANDLER_H
#define GNOMON_SCENE_FILES_JSON_SCENE_HANDLER_H

#include <rapidjson/reader.h>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gnomon/scene/scene.h"
#include "gnomon/scene/unusable.h"
#include "scene/base/text_file.h"
#include "scene/files/readers.h"
#include "scene/json/json_text.h"

namespace gnomon {

enum class JsonState : std::uint8_t {
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
  kRegion,
  kRegionPlane,
  kRegionPoint,
  kExtra,
  kDone,
};

/// Keys as bits, so that a set of them says which were seen in an object.
enum JsonKey : std::uint32_t {
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
  kRegionKey = 1u << 17,
};

struct JsonKeyWord {
  std::string_view word;
  JsonKey key;
  const char* expected;  // what its value is
};

constexpr JsonKeyWord kSceneKeys[] = {
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
constexpr JsonKeyWord kPolygonKeys[] = {
    {"id", kId, "a string"},
    {"loop", kLoopKey, "an array of vertex indices"},
    {"holes", kHoleList, "an array of loops"},
    {"two_sided", kTwoSided, "true or false"},
    {"casts", kCasts, "true or false"},
    {"extra", kExtraKey, "anything"},
};
constexpr JsonKeyWord kLightKeys[] = {
    {"id", kId, "a string"},
    {"type", kType, "\"point\", \"directional\" or \"area\""},
    {"position", kPosition, "an array of three numbers"},
    {"to_light", kToLight, "an array of three numbers"},
    {"loop", kLoopKey, "an array of points"},
    {"intensity", kIntensity, "a number"},
    {"region", kRegionKey, "an array of planes, each by three points"},
    {"extra", kExtraKey, "anything"},
};

constexpr std::size_t kCoordinates = 3;
/// Below "extra" alone; the format itself has five levels.
constexpr std::size_t kMostNesting = 1000;
constexpr std::uint64_t kMostVertices = 0xfffffffe;

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

  /// From here on polygons and vertices that cannot be used are no error, but listed.
  void skip_bad() { skip_bad_ = true; }
  std::vector<PolygonProblem>& problems() { return problems_; }
  /// Why the coordinates of a vertex are no numbers.
  const std::map<VertexId, std::string>& bad_vertices() const { return bad_vertices_; }
  /// The byte at which each polygon begins.
  std::vector<std::uint64_t>& polygon_offsets() { return polygon_offsets_; }

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
    return state_ == JsonState::kScene || state_ == JsonState::kPolygon ||
           state_ == JsonState::kLight;
  }
  std::span<const JsonKeyWord> keys() const {
    if (state_ == JsonState::kScene) return kSceneKeys;
    if (state_ == JsonState::kPolygon) return kPolygonKeys;
    return kLightKeys;
  }
  std::uint32_t& seen() { return state_ == JsonState::kScene ? scene_seen_ : element_seen_; }
  const JsonKeyWord* key_word() const;
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
  bool bad_index(std::string_view text, std::string expected);
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

  JsonState state_ = JsonState::kStart;
  JsonKey key_ = kNone;
  std::string unknown_key_;
  std::uint32_t scene_seen_ = 0, element_seen_ = 0;
  Position current_;
  std::size_t region_points_ = 0;  // of the last plane of a region
  std::size_t coordinate_count_ = 0;
  std::vector<VertexId> indices_;
  bool skip_bad_ = false;
  std::vector<PolygonProblem> problems_;
  std::map<VertexId, std::string> bad_vertices_;
  std::vector<std::uint64_t> polygon_offsets_;
  JsonState outside_extra_ = JsonState::kScene;
  std::size_t extra_depth_ = 0, extra_begin_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_JSON_SCENE_HANDLER_H
