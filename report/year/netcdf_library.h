// SPDX-License-Identifier: GPL-3.0-or-later
// The library of netCDF, loaded when a file of that kind is written and not before: with all that
// it needs it would take every command of the program twice as long to start.
#ifndef GNOMON_REPORT_YEAR_NETCDF_LIBRARY_H
#define GNOMON_REPORT_YEAR_NETCDF_LIBRARY_H

#include <netcdf.h>

#include "gnomon/kernel/error.h"

namespace gnomon::report {

/// Its functions, by their names without the prefix.
struct NetcdfLibrary {
  decltype(&nc_create) create;
  decltype(&nc_close) close;
  decltype(&nc_abort) abort;
  decltype(&nc_redef) redef;
  decltype(&nc_enddef) enddef;
  decltype(&nc_def_dim) def_dim;
  decltype(&nc_def_var) def_var;
  decltype(&nc_def_var_chunking) def_var_chunking;
  decltype(&nc_def_var_deflate) def_var_deflate;
  decltype(&nc_def_var_quantize) def_var_quantize;
  decltype(&nc_put_att_text) put_att_text;
  decltype(&nc_put_att_double) put_att_double;
  decltype(&nc_put_var_string) put_var_string;
  decltype(&nc_put_vara_double) put_vara_double;
  decltype(&nc_put_vara_float) put_vara_float;
  decltype(&nc_strerror) strerror;

  /// Errors: kFile, where the library is not installed.
  static Expected<NetcdfLibrary> load();
};

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_YEAR_NETCDF_LIBRARY_H
