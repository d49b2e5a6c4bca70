// SPDX-License-Identifier: GPL-3.0-or-later
// By how much air lifts the sun.
#ifndef GNOMON_SUNS_POSITION_REFRACTION_H
#define GNOMON_SUNS_POSITION_REFRACTION_H

namespace gnomon::suns {

struct Air {
  double pressure = 1013.25;  // hectopascals, at the place itself
  double temperature = 10;    // degrees Celsius
};

/// Degrees by which a body at a true altitude (degrees) is seen higher; 0 below -0.8333, where the
/// whole sun has set. Reference: J. Meeus, Astronomical Algorithms, formula 16.4 (Saemundsson),
/// with air as in I. Reda, A. Andreas, Solar Position Algorithm for Solar Radiation Applications,
/// NREL 2008, step 3.14.3.
double refraction(double altitude, const Air& air);

/// The pressure of the standard atmosphere at a height above the sea, in metres.
double standard_pressure(double elevation);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_POSITION_REFRACTION_H
