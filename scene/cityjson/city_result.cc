// SPDX-License-Identifier: LGPL-3.0-or-later
// What is done to city objects when all of them are known: vertices in the order of the file,
// solids outwards, groups and semantics in the scene's "extra", warnings, what was left out.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/cityjson/city_reader.h"
#include "scene/files/left_out.h"
#include "scene/files/scene_builder.h"

namespace gnomon {

/// {"groups": {object or kind: ids}, "cityjson": {"version", "referenceSystem", "semantics":
/// [kinds], "solids": [objects]}}. A kind that is called like an object has " surfaces" behind its
/// name.
std::string CityReader::extra() const {
  std::vector<ExtraFact> facts = {{"version", json_string(version_)}};
  if (!reference_system_.empty()) {
    facts.emplace_back("referenceSystem", json_string(reference_system_));
  }
  if (!kinds_.list().empty()) {
    facts.emplace_back("semantics", json_array(kind_names(objects_, kinds_.list())));
  }
  if (!solids_.empty()) facts.emplace_back("solids", json_array(solids_));
  return extra_with_groups(scene_, objects_, kinds_.list(), "cityjson", facts);
}

void CityReader::warn(ReadResult& result) const {
  for (const auto& [type, count] : passed_over_) {
    result.warnings.push_back(counted_as(count, "geometry", "geometries") + " of type " + type +
                              " ignored: it has no surfaces");
  }
  if (without_lod_ != 0) {
    std::vector<Number> lods = lods_;
    std::ranges::sort(lods, {}, [](const Number& lod) { return lod.exact(); });
    std::string there;
    for (const Number& lod : lods) there += (there.empty() ? "" : ", ") + lod.to_text();
    result.warnings.push_back(counted_as(without_lod_, "city object has", "city objects have") +
                              " no geometry of level of detail " + options_.lod +
                              ": left out; in the file: " + (there.empty() ? "none" : there));
  }
  if (turned_solids_ != 0) {
    result.warnings.push_back(counted_as(turned_solids_, "solid looks", "solids look") +
                              " inwards, against the standard: turned over");
  }
  if (underflows_ != 0) {
    result.warnings.push_back(counted_as(underflows_, "coordinate is", "coordinates are") +
                              " too small for full double precision");
  }
}

/// Vertices were added as surfaces needed them, and shall stand in the order of the file, those of
/// instances behind all others.
void CityReader::sort_vertices(const Unit& unit, std::size_t first_vertex,
                               std::size_t first_polygon) {
  std::vector<VertexId> moved(scene_.vertices.size() - first_vertex, kNone);
  std::vector<Position> sorted;
  sorted.reserve(moved.size());
  const auto take = [&](VertexId vertex) {
    moved[vertex - first_vertex] = static_cast<VertexId>(first_vertex + sorted.size());
    sorted.push_back(std::move(scene_.vertices[vertex]));
  };
  for (const VertexId vertex : unit.of_vertex) {
    if (vertex != kNone) take(vertex);
  }
  for (std::size_t i = 0; i < moved.size(); ++i) {
    if (moved[i] == kNone) take(static_cast<VertexId>(first_vertex + i));
  }
  std::ranges::move(sorted, scene_.vertices.begin() + static_cast<std::ptrdiff_t>(first_vertex));
  for (std::size_t i = first_polygon; i < scene_.polygons.size(); ++i) {
    Polygon& polygon = scene_.polygons[i];
    for (VertexId& vertex : polygon.loop) vertex = moved[vertex - first_vertex];
    for (auto& hole : polygon.holes) {
      for (VertexId& vertex : hole) vertex = moved[vertex - first_vertex];
    }
  }
}

/// By the sign of six times the volume, in doubles, and only where rounding cannot change it.
void CityReader::look_outwards(const CityGeometry& geometry, std::size_t first) {
  if (!geometry.is_solid) return;
  constexpr double kCertain = 1e-9;
  const auto coordinates = [this](VertexId vertex, std::size_t axis) {
    return scene_.vertices[vertex][axis].nearest();
  };
  const std::vector<CitySurface>& surfaces = geometry.surfaces;
  for (std::size_t begin = 0; begin < surfaces.size();) {
    std::size_t end = begin;
    double volume = 0, total = 0;
    std::optional<std::array<double, 3>> origin;
    for (; end < surfaces.size() && surfaces[end].solid == surfaces[begin].solid; ++end) {
      const auto& loop = scene_.polygons[first + end].loop;
      if (!surfaces[end].is_outer || loop.empty()) continue;
      if (!origin) {
        origin = {coordinates(loop[0], 0), coordinates(loop[0], 1), coordinates(loop[0], 2)};
      }
      const auto from_origin = [&](std::size_t i, std::size_t axis) {
        return coordinates(loop[i], axis) - (*origin)[axis];
      };
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        for (std::size_t x = 0; x < 3; ++x) {
          const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
          const double plus = from_origin(0, x) * from_origin(i, y) * from_origin(i + 1, z);
          const double minus = from_origin(0, x) * from_origin(i, z) * from_origin(i + 1, y);
          volume += plus - minus;
          total += std::abs(plus) + std::abs(minus);
        }
      }
    }
    if (volume < -kCertain * total) {
      ++turned_solids_;
      for (std::size_t i = begin; i < end; ++i) {
        Polygon& polygon = scene_.polygons[first + i];
        std::ranges::reverse(polygon.loop);
        for (auto& hole : polygon.holes) std::ranges::reverse(hole);
      }
    }
    begin = end;
  }
}

Expected<ReadResult> CityReader::finish(std::string_view text) {
  scene_.extra = extra();
  PlacesInText places(text);
  // Places are known by line and column; a bad surface is named by where it begins.
  for (PolygonProblem& problem : problems_) {
    problem.error.where = places.at(file_, offsets_[problem.polygon]);
  }
  if (!options_.skip_bad && !options_.polygon_offsets) offsets_.clear();
  ReadResult result{std::move(scene_), {}, {}, std::move(offsets_)};
  warn(result);
  leave_out(result, std::move(problems_));
  if (result.scene.polygons.empty()) result.warnings.emplace_back("the scene has no polygons");
  return result;
}

}  // namespace gnomon
