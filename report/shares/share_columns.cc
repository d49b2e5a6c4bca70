// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/shares/share_columns.h"

namespace gnomon::report {

ShareColumns::ShareColumns(const Scene& scene, const PreparedScene& prepared)
    : scene_(&scene), prepared_(&prepared), weights_(prepared) {
  for (std::uint32_t polygon = 0; polygon + 1 < prepared.first_part.size(); ++polygon) {
    if (prepared.first_part[polygon] == prepared.first_part[polygon + 1]) continue;  // dropped
    columns_.push_back({polygon, Side::kFront});
    if (scene.is_two_sided(scene.polygons[polygon])) columns_.push_back({polygon, Side::kBack});
  }
}

std::string ShareColumns::name(std::size_t column) const {
  const std::string& id = scene_->polygons[polygon(column)].id;
  return side(column) == Side::kFront ? id : id + "#back";
}

std::vector<std::string> ShareColumns::names() const {
  std::vector<std::string> names;
  names.reserve(size());
  for (std::size_t column = 0; column < size(); ++column) names.push_back(name(column));
  return names;
}

void ShareColumns::read_lit(const LightResult& light, std::span<double> lit) const {
  for (std::size_t column = 0; column < size(); ++column) {
    lit[column] = shares(light, column).lit.middle();
  }
}

}  // namespace gnomon::report
