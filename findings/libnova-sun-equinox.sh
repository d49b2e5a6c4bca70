#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# libnova 0.16 (Debian's libnova-dev 0.16-5): ln_get_solar_equ_coords() and the horizon.
#
# Guess: its header calls the result "apparent equatorial coordinates", and ln_get_hrz_from_equ() takes
# equatorial coordinates at a date; so the one goes into the other, and the sun's declination is 0 at the
# moment of an equinox.
# Seen: at the equinox of 2026-03-20 14:46 UTC the declination is -0.144 degrees, and the right ascension
# 359.669 instead of 0: coordinates of the equator and equinox of J2000, 26 years of precession away. The
# sun's azimuth comes out 0.32 degrees off and its altitude 0.19. With ln_get_equ_prec() in between both
# are within 0.006 degrees of NREL's Solar Position Algorithm (azimuth 99.957, altitude 14.665 at latitude
# 33.45, longitude -111.983).
# Where it matters: shadows of low suns. Gnomon takes its suns from ERFA (docs/year.md).
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
chmod 755 .
apt-get download -q libnova-dev=0.16-5 > /dev/null 2>&1
dpkg -x libnova-dev_0.16-5_*.deb package
cat > sun.c <<'C'
#include <libnova/julian_day.h>
#include <libnova/precession.h>
#include <libnova/solar.h>
#include <libnova/transform.h>
#include <stdio.h>

int main(void) {
  struct ln_date date = {2026, 3, 20, 14, 46, 0};
  struct ln_lnlat_posn observer = {-111.983, 33.45};
  const double day = ln_get_julian_day(&date);
  struct ln_equ_posn sun, of_date;
  struct ln_hrz_posn seen;
  ln_get_solar_equ_coords(day, &sun);
  ln_get_hrz_from_equ(&sun, &observer, day, &seen);
  /* Azimuths of the library count from the south. */
  printf("as it comes: declination %.2f, azimuth %.2f, altitude %.2f\n", sun.dec, seen.az - 180, seen.alt);
  ln_get_equ_prec(&sun, day, &of_date);
  ln_get_hrz_from_equ(&of_date, &observer, day, &seen);
  printf("precessed: declination %.2f, azimuth %.2f, altitude %.2f\n", of_date.dec, seen.az - 180, seen.alt);
  return 0;
}
C
cc -I package/usr/include sun.c package/usr/lib/*/libnova.a -lm -o sun
./sun | tee seen.txt
diff seen.txt - <<'SEEN'
as it comes: declination -0.14, azimuth 100.27, altitude 14.86
precessed: declination 0.00, azimuth 99.95, altitude 14.66
SEEN
echo "as found: libnova 0.16-5"
