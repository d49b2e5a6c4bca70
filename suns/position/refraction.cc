// SPDX-License-Identifier: GPL-3.0-or-later
#include "suns/position/refraction.h"

#include <cmath>
#include <numbers>

namespace gnomon::suns {

double refraction(double altitude, const Air& air) {
  // Half the sun's width, and the refraction at the horizon.
  constexpr double kSet = -(0.26667 + 0.5667);
  if (altitude < kSet) return 0;
  const double angle = (altitude + 10.3 / (altitude + 5.11)) * std::numbers::pi / 180;
  return air.pressure / 1010 * 283 / (273 + air.temperature) * 1.02 / (60 * std::tan(angle));
}

// ISO 2533: 288.15 K at the sea, 6.5 K less for each kilometre.
double standard_pressure(double elevation) {
  return 1013.25 * std::pow(1 - 0.0065 * elevation / 288.15, 5.25588);
}

}  // namespace gnomon::suns
