// SPDX-License-Identifier: GPL-3.0-or-later
// The sun by ERFA, the free form of the IAU's Standards of Fundamental Astronomy: the Earth's place
// around the sun, parallax from the observer's own place, aberration, precession and nutation, and
// the turn of the Earth. The bending of light by the sun is left out, since it is of light that
// passes the sun.
#include <erfa.h>
#include <erfam.h>

#include <array>
#include <cmath>

#include "suns/position/sun_model.h"

namespace gnomon::suns {

Expected<SunVector> erfa_sun(const Place& place, CivilTime time) {
  const auto since_1970 =
      std::chrono::duration_cast<std::chrono::seconds>(time.time_since_epoch() - place.zone);
  constexpr double kJulianDateOf1970 = 2440587.5;
  const auto days = std::chrono::floor<std::chrono::days>(since_1970);
  // A Julian date in two parts keeps all digits.
  const double date = kJulianDateOf1970 + static_cast<double>(days.count());
  const double of_day = static_cast<double>((since_1970 - days).count()) / ERFA_DAYSEC;
  const int year = static_cast<int>(date_of(time).year());
  if (year <= 1960 || year > 2500) {
    return fail(ErrorCode::kUsage, "the year " + std::to_string(year) + ": no sun for it",
                "a year from 1961 to 2500");
  }
  eraASTROM star{};
  double equation_of_origins = 0;
  // Without pressure there is no refraction; temperature, humidity and wave length do not count.
  const int status =
      eraApco13(date, of_day, 0, place.longitude * ERFA_DD2R, place.latitude * ERFA_DD2R,
                place.elevation, 0, 0, 0, 0, 0, 0.55, &star, &equation_of_origins);
  std::array<double, 2> tai{}, tt{};
  const int to_tai = eraUtctai(date, of_day, &tai[0], &tai[1]);
  const int to_tt = eraTaitt(tai[0], tai[1], &tt[0], &tt[1]);
  // Positive: a time for which the leap seconds are not known yet.
  if (status < 0 || to_tai < 0 || to_tt < 0) {
    return fail(ErrorCode::kUsage, "no sun for " + iso_text(time, place.zone),
                "a year from 1961 to 2500");
  }
  double around_sun[2][3], around_barycentre[2][3];
  eraEpv00(tt[0], tt[1], around_sun, around_barycentre);
  std::array<double, 3> to_sun{}, direction{}, seen{}, turned{};
  for (int k = 0; k < 3; ++k) {
    to_sun[k] = around_barycentre[0][k] - around_sun[0][k] - star.eb[k];
  }
  double distance = 0;
  eraPn(to_sun.data(), &distance, direction.data());
  eraAb(direction.data(), star.v, star.em, star.bm1, seen.data());
  eraRxp(star.bpn, seen.data(), turned.data());
  double right_ascension = 0, declination = 0;
  eraC2s(turned.data(), &right_ascension, &declination);
  double azimuth = 0, zenith = 0, hour_angle = 0, observed_declination = 0, observed_ascension = 0;
  eraAtioq(eraAnp(right_ascension), declination, &star, &azimuth, &zenith, &hour_angle,
           &observed_declination, &observed_ascension);
  return SunVector{std::sin(azimuth) * std::sin(zenith), std::cos(azimuth) * std::sin(zenith),
                   std::cos(zenith)};
}

}  // namespace gnomon::suns
