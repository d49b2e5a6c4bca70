// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene made of an energy model: outer surfaces with their windows as holes and as polygons of
// their own, and what shades them. Coordinates are those of the world, exact but where a note says
// otherwise.
#ifndef GNOMON_SCENE_ENERGYPLUS_ENERGY_SCENE_H
#define GNOMON_SCENE_ENERGYPLUS_ENERGY_SCENE_H

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "gnomon/scene/read.h"
#include "gnomon/scene/unusable.h"
#include "scene/energyplus/energy_model.h"
#include "scene/energyplus/wall_frame.h"
#include "scene/files/extra_groups.h"
#include "scene/model/decimal_vector.h"

namespace gnomon::energy {

/// What the file says once, about all surfaces.
struct Rules {
  FirstCorner first = FirstCorner::kUpperLeft;
  bool is_clockwise = false;
  bool is_world = false;            // no zone and no building axes, for surfaces by vertices
  bool is_rectangle_world = false;  // and for those by length and height
};
/// Errors: kFormat.
Expected<Rules> read_rules(const EnergyModel& model);

struct Zone {
  Number north;  // degrees, clockwise from the building's
  Position origin;
};

/// A wall, roof or floor, counter-clockwise in the coordinates of its zone.
struct Surface {
  std::vector<Position> loop;
  std::optional<WallFrame> frame;  // none of a horizontal one
  std::string zone;                // in lower case
  bool sees_the_sun = false;
  bool is_rectangle = false;
};

/// A window or a door in its surface, likewise.
struct Opening {
  std::vector<Position> loop;  // from its lower left corner
  Length width, height;
  const Surface* base = nullptr;
};

/// The frame of a surface by azimuth, tilt and corner. Errors: kFormat, kNumber, kLimit.
Expected<WallFrame> frame_of_rectangle(const EnergyModel& model, const EnergyObject& object,
                                       const char* tilt_if_blank);

class EnergyScene {
 public:
  EnergyScene(const EnergyModel& model, const ReadOptions& options);
  /// Errors: kFormat, kNumber, kId, kLimit.
  Expected<ReadResult> build();

 private:
  // What others refer to, in the order in which they do.
  Expected<void> read_axes();
  Expected<void> read_surfaces();
  Expected<Surface> surface_of(const EnergyObject& object) const;
  Expected<void> read_openings();
  Expected<Opening> opening_of(const EnergyObject& object, const Surface& base);
  bool is_world(const Surface& surface) const {
    return surface.is_rectangle ? rules_.is_rectangle_world : rules_.is_world;
  }
  const Surface* base_of(const EnergyObject& object, std::string_view field) const;
  Expected<std::vector<Position>> loop_of(const EnergyObject& object) const;

  // Polygons, in the order of the file.
  Expected<void> add(const EnergyObject& object);
  Expected<void> add_detached(const EnergyObject& object);
  Expected<void> add_attached(const EnergyObject& object);
  Expected<void> add_detached_rectangle(const EnergyObject& object);
  Expected<void> add_overhang(const EnergyObject& object);
  Expected<void> add_fins(const EnergyObject& object);
  Expected<void> add_fin(const EnergyObject& object, const Opening& opening, bool is_left);
  /// Null if it never sees the sun.
  Expected<const Opening*> shaded_opening(const EnergyObject& object) const;
  Expected<void> add_surface(const EnergyObject& object);
  Expected<void> add_opening(const EnergyObject& object);
  /// Where coordinates of a surface, or of what belongs to it, are in the world.
  struct Axes {
    const std::string* zone = nullptr;  // in lower case; none of what belongs to no zone
    bool of_building = false;
  };
  Axes axes_of(const Surface& surface) const {
    return is_world(surface) ? Axes{} : Axes{&surface.zone, true};
  }
  /// The polygon has neither holes nor sides yet.
  Expected<Polygon*> add_polygon(const EnergyObject& object, const std::string& name,
                                 const std::vector<Position>& loop, const Axes& axes);
  Expected<std::vector<VertexId>> vertices_of(const EnergyObject& object,
                                              const std::vector<Position>& loop, const Axes& axes);
  Expected<void> add_shade(const EnergyObject& object, const std::string& name,
                           const std::vector<Position>& loop, const Axes& axes);
  void put_into_groups(const std::string& zone, const std::string& kind);
  void note_schedule(const EnergyObject& object);

  void finish(ReadResult& result);
  std::string extra() const;
  void warn(std::vector<std::string>& warnings) const;
  void warn_of_turns(std::vector<std::string>& warnings) const;

  const EnergyModel& model_;
  const ReadOptions& options_;
  Rules rules_;
  Number north_;  // of the building
  bool is_turned_ = true;
  Angle building_angle_;
  std::unordered_map<std::string, Zone> zones_;
  std::unordered_map<std::string, Angle> zone_angles_;
  std::unordered_map<std::string, Surface> surfaces_;  // by name in lower case
  std::unordered_map<std::string, Opening> openings_;
  std::unordered_map<std::string, std::vector<std::vector<Position>>> holes_;  // by surface

  Scene scene_;
  std::unordered_map<std::string, VertexId> vertex_index_;
  std::unordered_map<std::string, std::uint32_t> polygon_index_;  // by name in lower case
  GroupList zone_groups_, kind_groups_;
  std::vector<std::uint64_t> offsets_;
  std::vector<PolygonProblem> problems_;

  std::size_t interior_ = 0, unexposed_ = 0, turned_openings_ = 0, multiplied_ = 0, underflows_ = 0;
  std::vector<std::string> rounded_;              // ids of what was placed by rounded vectors
  std::map<std::string, std::size_t> schedules_;  // of transmittance, and how many have each
};

}  // namespace gnomon::energy

#endif  // GNOMON_SCENE_ENERGYPLUS_ENERGY_SCENE_H
