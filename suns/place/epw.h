// SPDX-License-Identifier: GPL-3.0-or-later
// The place of a weather file of EnergyPlus (EPW): its first line, LOCATION,city,state,country,
// source,WMO number,latitude,longitude,time zone,elevation. Reference: EnergyPlus, Auxiliary
// Programs, "EnergyPlus Weather File (EPW) Data Dictionary".
#ifndef GNOMON_SUNS_PLACE_EPW_H
#define GNOMON_SUNS_PLACE_EPW_H

#include <filesystem>

#include "gnomon/kernel/error.h"
#include "suns/place/place.h"

namespace gnomon::suns {

/// Only the first line is looked at. Errors: kFile; kSyntax with the place in the file.
Expected<Place> read_epw_place(const std::filesystem::path& file);

}  // namespace gnomon::suns

#endif  // GNOMON_SUNS_PLACE_EPW_H
