// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene made of a Radiance file: polygons, which have two sides; lamps, which are polygons of a
// material that emits; distant sources. Everything else is counted and told of.
#ifndef GNOMON_SCENE_RADIANCE_RAD_READER_H
#define GNOMON_SCENE_RADIANCE_RAD_READER_H

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scene/files/scene_builder.h"
#include "scene/radiance/rad_transform.h"

namespace gnomon {

class RadReader {
 public:
  RadReader(const std::string& text, const std::string& file, const ReadOptions& options);
  /// Errors: kSyntax, kFormat, kNumber, kGeometry (a source without a direction), kFile (a file
  /// that an xform names), kLimit.
  Expected<ReadResult> read();

 private:
  /// What a modifier makes of a surface.
  enum class Matter : std::uint8_t { kOpaque, kSeenThrough, kLamp, kOtherLamp, kNothing };
  struct Word {
    std::string text;
    std::size_t offset = 0;
  };
  struct Primitive {
    std::string modifier, type, name;
    std::vector<Word> reals;
    std::size_t offset = 0;
  };
  /// A file, or one of its instances, that is being read.
  struct Open {
    std::shared_ptr<const std::string> text;
    std::string file;
    std::size_t at = 0;
    RadTransform transform;
    std::string prefix;           // of names
    std::string modifier;         // of all surfaces; empty: their own
    std::size_t main_offset = 0;  // of the command in the main file; none of that file itself
    std::size_t depth = 0;
  };

  Open& here() { return open_.back(); }
  tl::unexpected<Error> error(ErrorCode code, std::string what, std::string expected,
                              std::size_t offset);
  std::optional<Word> word();
  Expected<Word> word(const char* wanted);
  Expected<std::size_t> count(const char* wanted);
  Expected<Primitive> primitive(Word first);
  Expected<void> command();
  Expected<void> open_files(const XformCommand& xform, std::size_t offset);

  Expected<void> define(Primitive given);
  Expected<void> add_source(const Primitive& source);
  Expected<void> add_polygon(const Primitive& polygon);
  Expected<void> add_lamp(const Primitive& lamp, const std::vector<Position>& corners);
  Expected<std::vector<Position>> corners(const Primitive& polygon);
  Expected<Position> position(const Primitive& primitive, std::size_t first);
  Matter matter_of(const std::string& modifier);
  std::string light_id(const std::string& name);
  void warn();

  SceneBuilder builder_;
  std::vector<Open> open_;
  std::map<std::string, std::shared_ptr<const std::string>> texts_;  // of files beside, by path
  std::unordered_map<std::string, Matter> modifiers_;
  std::unordered_map<std::string, std::size_t> light_names_;
  std::size_t opened_ = 0;

  std::map<std::string, std::size_t> commands_, left_out_;  // by name, type
  std::size_t undefined_ = 0, seen_through_ = 0, nothing_ = 0, other_lamps_ = 0, skies_ = 0;
  std::size_t discs_ = 0, turned_ = 0;
  double error_ = 0, stretch_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_RADIANCE_RAD_READER_H
