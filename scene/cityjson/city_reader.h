// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene that grows by city objects: of one CityJSON text, or of the lines of a CityJSONSeq, of
// which the first has the transform and the templates, and every other vertices of its own.
#ifndef GNOMON_SCENE_CITYJSON_CITY_READER_H
#define GNOMON_SCENE_CITYJSON_CITY_READER_H

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "gnomon/scene/read.h"
#include "gnomon/scene/unusable.h"
#include "scene/cityjson/city_geometry.h"
#include "scene/cityjson/city_vertices.h"
#include "scene/files/extra_groups.h"
#include "scene/files/readers.h"
#include "scene/json/json_tape.h"

namespace gnomon {

class CityReader {
 public:
  CityReader(const std::string& file, const ReadOptions& options);

  /// A CityJSON object: the whole file, or the first line of a sequence. Errors: kFormat, kIndex,
  /// kId, kNumber, kLimit.
  Expected<void> read_city(const JsonTape& tape);
  /// A CityJSONFeature, on a line that begins at that byte of the file.
  Expected<void> read_feature(const JsonTape& tape, std::uint64_t line_offset);
  /// `text`: the whole file, to name the lines of what was left out; empty if nothing was to be.
  Expected<ReadResult> finish(std::string_view text);

 private:
  static constexpr VertexId kNone = std::numeric_limits<VertexId>::max();

  /// A geometry of an object, not looked into yet.
  struct Candidate {
    JsonNode node;
    const CityGeometryType* type = nullptr;  // null for an instance
    std::uint32_t template_index = 0;        // of an instance
    std::optional<Number> lod;
  };
  struct Template {
    CityGeometry geometry;
    std::optional<Number> lod;
  };
  /// What the surfaces of a text refer to.
  struct Unit {
    const JsonTape& tape;
    CityVertices vertices;
    std::vector<VertexId> of_vertex;  // in the scene, or kNone
    std::uint64_t offset = 0;         // of the text in the file
  };

  Expected<void> read_version(const JsonNode& root);
  Expected<void> read_templates(const JsonNode& root);
  Expected<void> read_objects(const JsonTape& tape, std::uint64_t offset);
  void sort_vertices(const Unit& unit, std::size_t first_vertex, std::size_t first_polygon);
  Expected<void> read_object(Unit& unit, const JsonNode& key, const JsonNode& object);
  Expected<std::optional<Candidate>> candidate(const JsonNode& geometry);
  Expected<std::vector<Candidate>> chosen(const std::vector<Candidate>& candidates);
  Expected<void> add_geometry(Unit& unit, const Candidate& candidate,
                              std::vector<std::uint32_t>& group);
  Expected<void> add_instance(Unit& unit, const Candidate& candidate,
                              std::vector<std::uint32_t>& group);
  /// `vertex(i)` is the scene's vertex for one of the surface's.
  template <class Vertex>
  Expected<void> add_surface(const CityGeometry& geometry, const CitySurface& surface,
                             std::uint64_t offset, bool reversed, const Vertex& vertex,
                             std::vector<std::uint32_t>& group);
  /// Turns solids over whose surfaces look inwards. `first`: the polygon of the first surface.
  void look_outwards(const CityGeometry& geometry, std::size_t first);
  Expected<VertexId> vertex(Unit& unit, std::uint32_t index);
  /// Rounds a position as the scene's numbers are meant, and makes it a vertex. Errors: at `node`.
  Expected<VertexId> add_vertex(Position position, const JsonNode& node);
  std::string extra() const;
  void warn(ReadResult& result) const;

  const std::string& file_;
  const ReadOptions& options_;
  std::optional<Number> wanted_lod_;
  Scene scene_;
  std::string version_, reference_system_;
  std::optional<CityTransform> transform_;
  std::vector<Template> templates_;
  std::vector<Position> template_vertices_;

  std::string prefix_;  // of the ids of the object's surfaces
  std::unordered_set<std::string> prefixes_;
  std::vector<PolygonGroup> objects_;
  GroupList kinds_;
  std::vector<std::string> solids_;     // objects that are one solid of one shell each
  std::vector<std::uint64_t> offsets_;  // of polygons
  std::vector<PolygonProblem> problems_;
  std::map<std::string, std::size_t> passed_over_;  // types of geometries without surfaces
  std::vector<Number> lods_;                        // that were met, each once
  std::size_t without_lod_ = 0;                     // objects that lack the one that was asked for
  std::size_t turned_solids_ = 0;
  std::size_t underflows_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_CITYJSON_CITY_READER_H
