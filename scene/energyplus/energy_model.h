// SPDX-License-Identifier: LGPL-3.0-or-later
// An energy model as its file says: objects of the classes that have to do with geometry, their
// fields as texts with places. IDF and epJSON are two syntaxes of it; which fields there are, by
// name and in the order of IDF, is in energy_classes.cc.
#ifndef GNOMON_SCENE_ENERGYPLUS_ENERGY_MODEL_H
#define GNOMON_SCENE_ENERGYPLUS_ENERGY_MODEL_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/number.h"
#include "scene/base/ascii_case.h"
#include "scene/base/text_file.h"

namespace gnomon {

/// A class is handled by what it is, whatever its name.
enum class EnergyKind : std::uint8_t {
  kVersion,
  kBuilding,
  kRules,
  kZone,
  kLocation,
  kSurface,            // walls, roofs, floors by their vertices
  kRectangle,          // walls and roofs by corner, length and height
  kInterior,           // simple surfaces that never see the sun
  kWindow,             // windows and doors by their vertices
  kRectangularWindow,  // and by their place on a wall
  kSiteShading,        // detached: of the site, and of the building, by vertices
  kBuildingShading,
  kZoneShading,
  kSiteRectangle,  // the same by corner, length and height
  kBuildingRectangle,
  kOverhang,
  kFin,
  kRefused,  // changes the geometry in a way that is not carried out here
  kNoted,    // changes what the sun reaches, and is told of
};

struct EnergyClass {
  std::string_view name;
  EnergyKind kind;
  std::span<const std::string_view> fields;  // as epJSON calls them; the first is the name
  bool has_vertices = false;                 // behind the fields, the last of which is their number
};

/// Null for any class that has nothing to do with geometry. Upper and lower case are the same.
const EnergyClass* energy_class(std::string_view name);

struct EnergyField {
  std::string text;  // empty if it is blank or missing
  std::size_t offset = 0;
};

struct EnergyObject {
  const EnergyClass* type = nullptr;
  std::vector<EnergyField> fields;    // of the class, in its order; missing ones are empty
  std::vector<EnergyField> vertices;  // three for each vertex
  std::size_t offset = 0;

  const std::string& name() const { return fields[0].text; }
  /// Requires: a field that the class has.
  const EnergyField& field(std::string_view name) const;
  bool has_field(std::string_view name) const;
};

struct EnergyModel {
  std::string_view text;
  std::string file;
  std::vector<EnergyObject> objects;  // in the order of the file

  tl::unexpected<Error> error(ErrorCode code, std::string what, std::string expected,
                              std::size_t offset) const {
    return fail(code, std::move(what), std::move(expected), place_in_text(file, text, offset));
  }
  /// A number that must be there, or has a default (null: none). Errors: kFormat, kNumber, kLimit.
  Expected<Number> number(const EnergyObject& object, std::string_view field,
                          const char* otherwise = nullptr) const;
};

/// The objects of an IDF text. Errors: kSyntax, kFormat.
Expected<EnergyModel> parse_idf(const std::string& text, const std::string& file);
/// The objects of an epJSON text. Errors: also kNumber, kLimit.
Expected<EnergyModel> parse_epjson(const std::string& text, const std::string& file);

}  // namespace gnomon

#endif  // GNOMON_SCENE_ENERGYPLUS_ENERGY_MODEL_H
