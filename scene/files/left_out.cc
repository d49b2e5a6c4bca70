// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/left_out.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "gnomon/scene/groups.h"
#include "scene/base/text_file.h"

namespace gnomon {

void leave_out(ReadResult& result, std::vector<PolygonProblem> problems) {
  if (problems.empty()) return;
  std::ranges::stable_sort(problems, {}, &PolygonProblem::polygon);
  std::vector<Polygon>& polygons = result.scene.polygons;
  auto& offsets = result.polygon_offsets;
  auto problem = problems.begin();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (problem != problems.end() && problem->polygon == i) {
      result.left_out.push_back({std::move(polygons[i].id), std::move(problem->error)});
      while (problem != problems.end() && problem->polygon == i) ++problem;
      continue;
    }
    if (kept != i) {
      polygons[kept] = std::move(polygons[i]);
      if (!offsets.empty()) offsets[kept] = offsets[i];
    }
    ++kept;
  }
  polygons.resize(kept);
  if (!offsets.empty()) offsets.resize(kept);
  std::vector<std::string> ids;
  for (const LeftOutPolygon& polygon : result.left_out) ids.push_back(polygon.id);
  remove_from_groups(result.scene, ids);
}

Expected<void> leave_out_unusable(ReadResult& result, std::string_view text) {
  auto problems = unusable_polygons(result.scene);
  if (!problems) return tl::unexpected(std::move(problems.error()));
  PlacesInText places(text);
  for (PolygonProblem& problem : *problems) {
    ErrorPlace& where = problem.error.where;
    // Indices count what remains, and are of no use to who reads the file.
    where.pointer.clear();
    if (problem.polygon >= result.polygon_offsets.size()) continue;
    where = places.at(std::move(where.file), result.polygon_offsets[problem.polygon]);
  }
  leave_out(result, std::move(*problems));
  std::ranges::stable_sort(result.left_out, {}, [](const LeftOutPolygon& polygon) {
    return std::tuple(polygon.why.where.line, polygon.why.where.column);
  });
  return {};
}

}  // namespace gnomon
