// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pixels/rows_of_table.h"

#include <map>
#include <memory>

#include "gnomon/algorithms/angular_rows.h"

namespace gnomon::report {

oracle::NearBorder rows_of_table(const PreparedView& view, const MethodSelection& method) {
  if (method.id != MethodId::kRidgeEdges || method.values.rows == MethodOptionValues::kExactRows) {
    return {};
  }
  const auto rows = std::make_shared<std::map<std::uint32_t, AngularRows>>();
  for (std::uint32_t l = 0; l < view.scene.lights.size(); ++l) {
    const PreparedLight& light = view.scene.lights[l];
    if (light.has_area()) continue;
    rows->emplace(light.light, AngularRows(view.scene, view.frame, method.values, l));
  }
  return [rows](std::uint32_t light, const RationalPoint& point) {
    return rows->at(light).has_edge_near(point);
  };
}

}  // namespace gnomon::report
