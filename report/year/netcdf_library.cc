// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/year/netcdf_library.h"

#include <dlfcn.h>

#include <string>

namespace gnomon::report {

Expected<NetcdfLibrary> NetcdfLibrary::load() {
  // Never unloaded: what it has registered with other libraries points into it.
  void* library = dlopen(GNOMON_NETCDF_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  std::string missing;
  if (library == nullptr) missing = dlerror();
  NetcdfLibrary result{};
  const auto find = [&](auto& function, const char* name) {
    if (library == nullptr) return;
    void* address = dlsym(library, name);
    if (address == nullptr) missing = std::string(GNOMON_NETCDF_LIBRARY) + " has no " + name;
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(address);
  };
  find(result.create, "nc_create");
  find(result.close, "nc_close");
  find(result.abort, "nc_abort");
  find(result.redef, "nc_redef");
  find(result.enddef, "nc_enddef");
  find(result.def_dim, "nc_def_dim");
  find(result.def_var, "nc_def_var");
  find(result.def_var_chunking, "nc_def_var_chunking");
  find(result.def_var_deflate, "nc_def_var_deflate");
  find(result.def_var_quantize, "nc_def_var_quantize");
  find(result.put_att_text, "nc_put_att_text");
  find(result.put_att_double, "nc_put_att_double");
  find(result.put_var_string, "nc_put_var_string");
  find(result.put_vara_double, "nc_put_vara_double");
  find(result.put_vara_float, "nc_put_vara_float");
  find(result.strerror, "nc_strerror");
  if (missing.empty()) return result;
  return fail(ErrorCode::kFile, "no netCDF file can be written: " + missing,
              "the library of netCDF (Debian: libnetcdf19), or FILE.csv or FILE.npy");
}

}  // namespace gnomon::report
