// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene made of a model of honeybee (HBJSON): rooms with faces, of which those that face the
// outdoors count, with their apertures and doors; faces and shades of no room.
#ifndef GNOMON_SCENE_BUILDING_HONEYBEE_READER_H
#define GNOMON_SCENE_BUILDING_HONEYBEE_READER_H

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/building/opening_plane.h"
#include "scene/files/scene_builder.h"
#include "scene/json/json_tape.h"

namespace gnomon {

class HoneybeeReader {
 public:
  HoneybeeReader(const JsonTape& tape, const std::string& file, const ReadOptions& options);
  /// Errors: kFormat, kNumber, kId, kIndex, kLimit.
  Expected<ReadResult> read();

 private:
  /// A polygon of the model: the exact boundary and holes, in metres.
  struct Face3D {
    std::vector<Position> boundary;
    std::vector<std::vector<Position>> holes;
  };
  /// What an object that has a name and a geometry becomes.
  struct Surface {
    JsonNode node;
    std::string room;  // empty: of none, and with two sides
    const char* kind = "";
  };

  Expected<void> read_units(const JsonNode& root);
  Expected<void> read_room(const JsonNode& room);
  Expected<void> read_face(const JsonNode& face, const std::string& room);
  Expected<void> read_opening(const Surface& opening, const OpeningPlane* wall);
  Expected<void> read_outdoor_shades(const JsonNode& owner);
  Expected<void> read_shade(const JsonNode& shade);
  Expected<void> read_shade_mesh(const JsonNode& mesh);
  void count_indoor_shades(const JsonNode& owner);

  /// Adds the surface and its holes; its boundary, if `boundary` is given. One that cannot be used
  /// is left out where that was asked for.
  Expected<void> add(const Surface& surface, std::vector<Position>* boundary = nullptr);
  Expected<void> add_face3d(const Surface& surface, const Face3D& geometry);
  Expected<std::string> name_of(const JsonNode& object) const;
  Expected<Face3D> face3d(const JsonNode& object) const;
  Expected<std::vector<Position>> loop(const JsonNode& list) const;
  Expected<Position> position(const JsonNode& list) const;
  /// Is it a face, aperture or door that faces the outdoors?
  Expected<bool> sees_the_sun(const JsonNode& object) const;
  /// `each(element)` of a list that may be missing or null. Errors: those of `each`; kFormat.
  template <class Each>
  Expected<void> for_each(const JsonNode& object, std::string_view key, const Each& each) const;
  /// An error of the builder at a value.
  tl::unexpected<Error> at(const JsonNode& node, const Error& error) const;
  void warn();

  const JsonTape& tape_;
  SceneBuilder builder_;
  Number factor_;  // metres in a unit of the file
  std::string units_ = "Meters", tolerance_;
  std::size_t interior_ = 0, indoor_shades_ = 0, transmitting_ = 0, air_boundaries_ = 0;
  std::size_t openings_ = 0, off_plane_ = 0;
  double farthest_ = 0;  // of an opening from its face's plane, metres
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_BUILDING_HONEYBEE_READER_H
