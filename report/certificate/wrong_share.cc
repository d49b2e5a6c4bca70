// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/certificate/wrong_share.h"

#include <algorithm>
#include <vector>

#include "report/facts/facing.h"

namespace gnomon::report {

WrongShare::WrongShare(const Certificate& certificate) {
  if (certificate.scene == nullptr || certificate.prepared == nullptr) return;
  const PreparedScene& prepared = *certificate.prepared;
  const mpq_class width = prepared.geometry.step * (mpz_class(1) << prepared.position_bits);
  unit_ = width * width;
  std::vector<std::uint32_t> lights;
  for (std::uint32_t i = 0; i < prepared.lights.size(); ++i) {
    const std::string& id = certificate.scene->lights[prepared.lights[i].light].id;
    if (std::ranges::count(certificate.lights, id) > 0) lights.push_back(i);
  }
  facing_ = relative_facing_area(prepared, lights);
  for (const Part& part : prepared.parts) {
    areas_[certificate.scene->polygons[part.polygon].id] += relative_area(prepared, part);
  }
}

double WrongShare::of(const oracle::Report& report) const {
  double wrong = 0, compared = 0;
  for (const oracle::LightComparison& light : report.lights) {
    for (const oracle::PolygonComparison& side : light.polygons) {
      const double area = area_of(side.polygon);
      compared += area;
      if (!side.misclassified.zero) wrong += side.misclassified.fraction.upper * area;
    }
  }
  const double all = facing_ > 0 ? facing_ : compared;
  return all > 0 ? wrong / all : 0;
}

}  // namespace gnomon::report
