// SPDX-License-Identifier: GPL-3.0-or-later
// The sun as EnergyPlus has it: Fourier series of the day of the year for the sine of the
// declination and for the equation of time. An engine must be judged under its own sun, which is
// off by up to 0.64 degrees, and by up to 4.4 degrees where declination and equation of time are
// averaged over 20 days, its default. Reference: EnergyPlus, Engineering Reference, "Sun Position
// Calculations" and "Shadowing Calculations".
#include <array>
#include <cmath>
#include <numbers>

#include "suns/position/sun_model.h"

namespace gnomon::suns {

namespace {

/// Coefficients of 1, sin x, cos x, sin 2x, cos 2x, ... cos 4x.
using Series = std::array<double, 9>;
constexpr Series kSineOfDeclination{0.00561800,  0.0657911,   -0.392779,   0.00064440, -0.00618495,
                                    -0.00010101, -0.00007951, -0.00011691, 0.00002096};
constexpr Series kEquationOfTime{0.00021971,  -0.122649,   0.00762856,  -0.156308,  -0.0530028,
                                 -0.00388702, -0.00123978, -0.00270502, -0.00167992};  // hours

double sum_of(const Series& series, double x) {
  double sum = series[0];
  for (std::size_t k = 1; 2 * k < series.size(); ++k) {
    const auto angle = static_cast<double>(k) * x;
    sum += series[2 * k - 1] * std::sin(angle) + series[2 * k] * std::cos(angle);
  }
  return sum;
}

}  // namespace

SunVector energyplus_sun(const Place& place, CivilTime time, std::chrono::local_days first,
                         int average_days) {
  constexpr double kDegree = std::numbers::pi / 180;
  double sine_of_declination = 0, equation_of_time = 0;
  for (int i = 0; i < average_days; ++i) {
    const CivilTime day = (average_days == 1 ? day_of(time) : first) + std::chrono::days(i);
    const double x = 2 * std::numbers::pi * day_of_year(day) / 366;
    sine_of_declination += sum_of(kSineOfDeclination, x) / average_days;
    equation_of_time += sum_of(kEquationOfTime, x) / average_days;
  }
  const double cosine_of_declination = std::sqrt(1 - sine_of_declination * sine_of_declination);
  const double clock = std::chrono::duration<double, std::ratio<3600>>(time - day_of(time)).count();
  const double zone = static_cast<double>(place.zone.count()) / 60;
  const double hour_angle =
      (15 * (12 - (clock + equation_of_time)) + (15 * zone - place.longitude)) * kDegree;
  const double sine = std::sin(place.latitude * kDegree),
               cosine = std::cos(place.latitude * kDegree);
  return {cosine_of_declination * std::sin(hour_angle),
          sine_of_declination * cosine - cosine_of_declination * sine * std::cos(hour_angle),
          sine_of_declination * sine + cosine_of_declination * cosine * std::cos(hour_angle)};
}

}  // namespace gnomon::suns
