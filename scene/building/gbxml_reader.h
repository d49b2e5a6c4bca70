// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene made of a gbXML model: surfaces by their PolyLoops, of which those that face the outdoors
// count, with their openings as holes and as polygons of their own.
#ifndef GNOMON_SCENE_BUILDING_GBXML_READER_H
#define GNOMON_SCENE_BUILDING_GBXML_READER_H

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/building/opening_plane.h"
#include "scene/files/scene_builder.h"

namespace gnomon {

class GbXmlReader {
 public:
  /// `text` must outlive the reader.
  GbXmlReader(std::string_view text, const std::string& file, const ReadOptions& options);
  /// Errors: kSyntax, kFormat, kNumber, kId, kLimit.
  Expected<ReadResult> read();

 private:
  Expected<void> read_units(const pugi::xml_node& root);
  Expected<void> read_surface(const pugi::xml_node& surface);
  Expected<void> add_surface(const pugi::xml_node& surface, const std::string& kind);
  Expected<void> add_openings(const pugi::xml_node& surface, std::size_t wall,
                              const OpeningPlane& plane, const std::string& space);
  /// How far it is from the plane of the wall, in metres.
  Expected<double> add_opening(const pugi::xml_node& opening, std::size_t wall,
                               const OpeningPlane& plane, const std::string& space);
  /// Openings that are no holes of their wall lie on it. `distances`: of each from its plane.
  Expected<void> fill_unusable_holes(std::size_t wall, const std::vector<double>& distances);
  /// The corners of an element's PlanarGeometry, in metres.
  Expected<std::vector<Position>> poly_loop(const pugi::xml_node& element) const;
  Expected<Position> point(const pugi::xml_node& element) const;
  std::size_t offset(const pugi::xml_node& node) const;
  tl::unexpected<Error> error(const pugi::xml_node& node, ErrorCode code, std::string what,
                              std::string expected) const;
  tl::unexpected<Error> at(const pugi::xml_node& node, const Error& error) const;
  /// Leaves the polygons behind the first `before` out where that was asked for, and lists `node`.
  Expected<void> skip(const pugi::xml_node& node, std::size_t before, Error why);
  void warn();

  std::string_view text_;
  const std::string& file_;
  SceneBuilder builder_;
  pugi::xml_document document_;
  Number factor_;  // metres in a unit of the file
  std::string units_ = "Meters";
  std::size_t interior_ = 0, unexposed_ = 0, air_ = 0;
  std::size_t openings_ = 0, off_plane_ = 0, uncut_ = 0;
  double farthest_ = 0, farthest_uncut_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_BUILDING_GBXML_READER_H
