// SPDX-License-Identifier: LGPL-3.0-or-later
// The classes of objects that have to do with geometry, and their fields in the order of IDF, by
// EnergyPlus' input-output reference. Fields behind the last one that is used here are left out.
#include <algorithm>

#include "scene/energyplus/energy_model.h"

namespace gnomon {

namespace {

using Names = std::string_view;

constexpr Names kVersionFields[] = {"version_identifier"};
constexpr Names kBuildingFields[] = {"name",
                                     "north_axis",
                                     "terrain",
                                     "loads_convergence_tolerance_value",
                                     "temperature_convergence_tolerance_value",
                                     "solar_distribution"};
constexpr Names kRulesFields[] = {
    "starting_vertex_position", "vertex_entry_direction", "coordinate_system",
    "daylighting_reference_point_coordinate_system", "rectangular_surface_coordinate_system"};
constexpr Names kZoneFields[] = {"name", "direction_of_relative_north", "x_origin", "y_origin",
                                 "z_origin"};
constexpr Names kLocationFields[] = {"name", "latitude", "longitude", "time_zone", "elevation"};
constexpr Names kSurfaceFields[] = {"name",
                                    "surface_type",
                                    "construction_name",
                                    "zone_name",
                                    "space_name",
                                    "outside_boundary_condition",
                                    "outside_boundary_condition_object",
                                    "sun_exposure",
                                    "wind_exposure",
                                    "view_factor_to_ground",
                                    "number_of_vertices"};
constexpr Names kWallFields[] = {"name",
                                 "construction_name",
                                 "zone_name",
                                 "space_name",
                                 "outside_boundary_condition",
                                 "outside_boundary_condition_object",
                                 "sun_exposure",
                                 "wind_exposure",
                                 "view_factor_to_ground",
                                 "number_of_vertices"};
constexpr Names kWallRectangleFields[] = {"name",
                                          "construction_name",
                                          "zone_name",
                                          "space_name",
                                          "azimuth_angle",
                                          "tilt_angle",
                                          "starting_x_coordinate",
                                          "starting_y_coordinate",
                                          "starting_z_coordinate",
                                          "length",
                                          "height"};
constexpr Names kRoofRectangleFields[] = {"name",
                                          "construction_name",
                                          "zone_name",
                                          "space_name",
                                          "azimuth_angle",
                                          "tilt_angle",
                                          "starting_x_coordinate",
                                          "starting_y_coordinate",
                                          "starting_z_coordinate",
                                          "length",
                                          "width"};
constexpr Names kNameAlone[] = {"name"};
constexpr Names kWindowFields[] = {"name",
                                   "surface_type",
                                   "construction_name",
                                   "building_surface_name",
                                   "outside_boundary_condition_object",
                                   "view_factor_to_ground",
                                   "shading_control_name",
                                   "frame_and_divider_name",
                                   "multiplier",
                                   "number_of_vertices"};
constexpr Names kRectangularWindowFields[] = {"name",
                                              "construction_name",
                                              "building_surface_name",
                                              "shading_control_name",
                                              "frame_and_divider_name",
                                              "multiplier",
                                              "starting_x_coordinate",
                                              "starting_z_coordinate",
                                              "length",
                                              "height"};
constexpr Names kDoorFields[] = {"name",
                                 "construction_name",
                                 "building_surface_name",
                                 "multiplier",
                                 "starting_x_coordinate",
                                 "starting_z_coordinate",
                                 "length",
                                 "height"};
constexpr Names kInteriorWindowFields[] = {"name",
                                           "construction_name",
                                           "building_surface_name",
                                           "outside_boundary_condition_object",
                                           "multiplier",
                                           "starting_x_coordinate",
                                           "starting_z_coordinate",
                                           "length",
                                           "height"};
constexpr Names kDetachedFields[] = {"name", "transmittance_schedule_name", "number_of_vertices"};
constexpr Names kAttachedFields[] = {"name", "base_surface_name", "transmittance_schedule_name",
                                     "number_of_vertices"};
constexpr Names kDetachedRectangleFields[] = {"name",
                                              "azimuth_angle",
                                              "tilt_angle",
                                              "starting_x_coordinate",
                                              "starting_y_coordinate",
                                              "starting_z_coordinate",
                                              "length",
                                              "height"};
constexpr Names kOverhangFields[] = {"name",
                                     "window_or_door_name",
                                     "height_above_window_or_door",
                                     "tilt_angle_from_window_door",
                                     "left_extension_from_window_door_width",
                                     "right_extension_from_window_door_width",
                                     "depth"};
constexpr Names kOverhangShareFields[] = {"name",
                                          "window_or_door_name",
                                          "height_above_window_or_door",
                                          "tilt_angle_from_window_door",
                                          "left_extension_from_window_door_width",
                                          "right_extension_from_window_door_width",
                                          "depth_as_fraction_of_window_door_height"};
constexpr Names kFinFields[] = {"name",
                                "window_or_door_name",
                                "left_extension_from_window_door",
                                "left_distance_above_top_of_window",
                                "left_distance_below_bottom_of_window",
                                "left_tilt_angle_from_window_door",
                                "left_depth",
                                "right_extension_from_window_door",
                                "right_distance_above_top_of_window",
                                "right_distance_below_bottom_of_window",
                                "right_tilt_angle_from_window_door",
                                "right_depth"};
constexpr Names kFinShareFields[] = {"name",
                                     "window_or_door_name",
                                     "left_extension_from_window_door",
                                     "left_distance_above_top_of_window",
                                     "left_distance_below_bottom_of_window",
                                     "left_tilt_angle_from_window_door",
                                     "left_depth_as_fraction_of_window_door_width",
                                     "right_extension_from_window_door",
                                     "right_distance_above_top_of_window",
                                     "right_distance_below_bottom_of_window",
                                     "right_tilt_angle_from_window_door",
                                     "right_depth_as_fraction_of_window_door_width"};
constexpr Names kComplianceFields[] = {"building_rotation_for_appendix_g"};

constexpr EnergyClass kClasses[] = {
    {"Version", EnergyKind::kVersion, kVersionFields},
    {"Building", EnergyKind::kBuilding, kBuildingFields},
    {"GlobalGeometryRules", EnergyKind::kRules, kRulesFields},
    {"Zone", EnergyKind::kZone, kZoneFields},
    {"Site:Location", EnergyKind::kLocation, kLocationFields},
    {"BuildingSurface:Detailed", EnergyKind::kSurface, kSurfaceFields, true},
    {"Wall:Detailed", EnergyKind::kSurface, kWallFields, true},
    {"RoofCeiling:Detailed", EnergyKind::kSurface, kWallFields, true},
    {"Floor:Detailed", EnergyKind::kSurface, kWallFields, true},
    {"Wall:Exterior", EnergyKind::kRectangle, kWallRectangleFields},
    {"Roof", EnergyKind::kRectangle, kRoofRectangleFields},
    {"Wall:Adiabatic", EnergyKind::kInterior, kNameAlone},
    {"Wall:Underground", EnergyKind::kInterior, kNameAlone},
    {"Wall:Interzone", EnergyKind::kInterior, kNameAlone},
    {"Ceiling:Adiabatic", EnergyKind::kInterior, kNameAlone},
    {"Ceiling:Interzone", EnergyKind::kInterior, kNameAlone},
    {"Floor:GroundContact", EnergyKind::kInterior, kNameAlone},
    {"Floor:Adiabatic", EnergyKind::kInterior, kNameAlone},
    {"Floor:Interzone", EnergyKind::kInterior, kNameAlone},
    {"FenestrationSurface:Detailed", EnergyKind::kWindow, kWindowFields, true},
    {"Window", EnergyKind::kRectangularWindow, kRectangularWindowFields},
    {"GlazedDoor", EnergyKind::kRectangularWindow, kRectangularWindowFields},
    {"Door", EnergyKind::kRectangularWindow, kDoorFields},
    {"Window:Interzone", EnergyKind::kRectangularWindow, kInteriorWindowFields},
    {"GlazedDoor:Interzone", EnergyKind::kRectangularWindow, kInteriorWindowFields},
    {"Door:Interzone", EnergyKind::kRectangularWindow, kInteriorWindowFields},
    {"Shading:Site:Detailed", EnergyKind::kSiteShading, kDetachedFields, true},
    {"Shading:Building:Detailed", EnergyKind::kBuildingShading, kDetachedFields, true},
    {"Shading:Zone:Detailed", EnergyKind::kZoneShading, kAttachedFields, true},
    {"Shading:Site", EnergyKind::kSiteRectangle, kDetachedRectangleFields},
    {"Shading:Building", EnergyKind::kBuildingRectangle, kDetachedRectangleFields},
    {"Shading:Overhang", EnergyKind::kOverhang, kOverhangFields},
    {"Shading:Overhang:Projection", EnergyKind::kOverhang, kOverhangShareFields},
    {"Shading:Fin", EnergyKind::kFin, kFinFields},
    {"Shading:Fin:Projection", EnergyKind::kFin, kFinShareFields},
    {"GeometryTransform", EnergyKind::kRefused, kNameAlone},
    {"Compliance:Building", EnergyKind::kRefused, kComplianceFields},
    {"WindowProperty:FrameAndDivider", EnergyKind::kNoted, kNameAlone},
};

}  // namespace

const EnergyClass* energy_class(std::string_view name) {
  for (const EnergyClass& known : kClasses) {
    if (same_word(known.name, name)) return &known;
  }
  return nullptr;
}

const EnergyField& EnergyObject::field(std::string_view name) const {
  return fields[static_cast<std::size_t>(std::ranges::find(type->fields, name) -
                                         type->fields.begin())];
}

bool EnergyObject::has_field(std::string_view name) const {
  return std::ranges::find(type->fields, name) != type->fields.end();
}

Expected<Number> EnergyModel::number(const EnergyObject& object, std::string_view name,
                                     const char* otherwise) const {
  const EnergyField& field = object.field(name);
  const bool is_blank = field.text.empty() || same_word(field.text, "autocalculate");
  if (is_blank && otherwise == nullptr) {
    return error(
        ErrorCode::kFormat,
        "the field " + std::string(name) + " of " + quoted_text(object.name()) + " is blank",
        "a number", object.offset);
  }
  auto number = Number::parse(is_blank ? otherwise : field.text, NumberMeaning::kDecimal);
  if (number) return number;
  return error(number.error().code, std::string(name) + ": " + number.error().what,
               number.error().expected, field.offset);
}

}  // namespace gnomon
