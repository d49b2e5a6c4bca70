// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/position/sun_model.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace gnomon::suns {

namespace {

constexpr std::array<std::pair<SunModelId, std::string_view>, 2> kModels{
    {{SunModelId::kErfa, "erfa"}, {SunModelId::kEnergyPlus, "energyplus"}}};
constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

std::optional<SunModelId> sun_model_by_name(std::string_view name) {
  for (const auto& [model, text] : kModels) {
    if (text == name) return model;
  }
  return std::nullopt;
}

std::string_view name_of(SunModelId model) {
  return kModels[static_cast<std::size_t>(model)].second;
}

SunVector vector_of(const SunAngles& angles) {
  const double azimuth = angles.azimuth * kDegree, altitude = angles.altitude * kDegree;
  return {std::sin(azimuth) * std::cos(altitude), std::cos(azimuth) * std::cos(altitude),
          std::sin(altitude)};
}

SunAngles angles_of(const SunVector& vector) {
  const auto [east, north, up] = vector;
  double azimuth = std::atan2(east, north) / kDegree;
  if (azimuth < 0) azimuth += 360;
  return {azimuth, std::atan2(up, std::hypot(east, north)) / kDegree};
}

}  // namespace gnomon::suns
