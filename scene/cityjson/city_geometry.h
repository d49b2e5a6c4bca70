// SPDX-License-Identifier: LGPL-3.0-or-later
// One geometry of a CityJSON file: its surfaces, with the kinds that its semantics give them.
// Indices are checked here, and still count the vertices of the file (or of the templates).
#ifndef GNOMON_SCENE_CITYJSON_CITY_GEOMETRY_H
#define GNOMON_SCENE_CITYJSON_CITY_GEOMETRY_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/number.h"
#include "scene/json/json_tape.h"

namespace gnomon {

/// How deep the arrays of a type lie: 3 is a list of surfaces, which are lists of rings.
struct CityGeometryType {
  std::string_view name;
  int depth;
  bool is_solid;
  bool has_surfaces() const { return depth >= 3; }
};
/// Null for a type that CityJSON does not have.
const CityGeometryType* city_geometry_type(std::string_view name);
inline constexpr std::string_view kSolidType = "Solid";
/// A geometry that stands for a template; it has no surfaces of its own.
inline constexpr std::string_view kInstanceType = "GeometryInstance";

struct CitySurface {
  std::vector<std::vector<std::uint32_t>> rings;  // the first is the outer one
  std::optional<std::uint32_t> kind;              // index into CityGeometry::kinds
  std::uint32_t solid = 0;                        // of a geometry of solids: of which, from 1 on
  bool is_outer = false;                          // is it of that solid's outer shell?
  std::uint64_t offset = 0;                       // of the byte at which it begins
  std::optional<Error> bad;                       // why it cannot be used, where that was asked for
};

struct CityGeometry {
  bool is_solid = false;
  std::vector<std::string> kinds;  // "RoofSurface", ...
  std::vector<CitySurface> surfaces;
};

/// Reads a geometry of that type, which has surfaces. `vertices`: how many there are. With
/// `keep_bad`, surfaces with too few or wrong indices are kept with the reason. Errors: kFormat,
/// kIndex.
Expected<CityGeometry> read_city_geometry(const JsonNode& geometry, const CityGeometryType& type,
                                          std::size_t vertices, bool keep_bad);

/// The level of detail of a geometry: "2.2", or the number 2.2 as CityJSON 1.0 has it. Nothing if
/// it has none. Errors: kFormat.
Expected<std::optional<Number>> level_of_detail(const JsonNode& geometry);

/// An index below `count`. `what` it is one of, for messages: "vertex". Errors: kFormat, kIndex.
Expected<std::uint32_t> city_index(const JsonNode& node, std::size_t count, const char* what);

}  // namespace gnomon

#endif  // GNOMON_SCENE_CITYJSON_CITY_GEOMETRY_H
