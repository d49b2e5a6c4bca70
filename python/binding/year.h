// SPDX-License-Identifier: GPL-3.0-or-later
// The lit shares of all sides under the suns of a year, as gnomon year computes them.
#ifndef GNOMON_PYTHON_BINDING_YEAR_H
#define GNOMON_PYTHON_BINDING_YEAR_H

#include <atomic>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "python/binding/loaded_scene.h"
#include "python/binding/run_options.h"
#include "suns/year/asked_suns.h"

namespace gnomon::python {

struct Year {
  suns::YearOptions asked;
  std::vector<suns::SunTime> times;  // one a row
  std::vector<std::string> sides;    // one a column; walls with their windows last
  std::vector<double> lit;           // row by row
  std::string geometry, kernel, checksum;
};

/// `gross`: with columns of whole walls. Errors: as of gnomon year; kInterrupted.
Expected<Year> year(const LoadedScene& loaded, const suns::AskedSuns& asked, bool gross,
                    const RunNames& names, const std::atomic<bool>& stop);

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_YEAR_H
