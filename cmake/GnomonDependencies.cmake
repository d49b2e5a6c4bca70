# SPDX-License-Identifier: LGPL-3.0-or-later
# Libraries that the components link: GMP::GMP, GMP::GMPXX, MPFR::MPFR, tl::expected, fmt::fmt,
# TBB::tbb, OpenSSL::Crypto, pugixml::pugixml, CLI11::CLI11, gnomon_rapidjson (headers), CGAL::CGAL (headers; only
# through CGAL_SOURCES, since its interface carries -frounding-math).

# Whoever adds this project as a subdirectory links these libraries through ours.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL TRUE)

find_package(Threads REQUIRED)
find_package(GMP REQUIRED)
find_package(MPFR REQUIRED)
find_package(tl-expected REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(pugixml REQUIRED)

if(GNOMON_CGAL_KERNELS)
  set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
  set(CGAL_DATA_DIR "${PROJECT_SOURCE_DIR}" CACHE INTERNAL "CGAL asks for it; not used")
  find_package(CGAL REQUIRED QUIET)
endif()

# Debian's RapidJSON configuration has no target in older versions.
find_package(RapidJSON REQUIRED)
if(NOT TARGET gnomon_rapidjson)
  add_library(gnomon_rapidjson INTERFACE)
  target_include_directories(gnomon_rapidjson SYSTEM INTERFACE ${RAPIDJSON_INCLUDE_DIRS})
endif()
if(GNOMON_BUILD_FUZZERS)
  target_compile_options(gnomon_rapidjson INTERFACE
    "-fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tests/fuzzers/ignorelist.txt")
endif()

find_package(OpenSSL REQUIRED COMPONENTS Crypto)
if(GNOMON_BUILD_TOOLS)
  find_package(CLI11 REQUIRED)
  find_package(SQLiteCpp REQUIRED)
  find_package(PkgConfig REQUIRED)
  find_package(PNG REQUIRED)
  pkg_check_modules(LIBUV REQUIRED IMPORTED_TARGET GLOBAL libuv)
  pkg_check_modules(ERFA REQUIRED IMPORTED_TARGET GLOBAL erfa)
  pkg_check_modules(NETCDF REQUIRED IMPORTED_TARGET GLOBAL netcdf)
  # The name under which programs load it: libnetcdf.so.19.
  find_library(GNOMON_NETCDF_FILE netcdf HINTS ${NETCDF_LIBRARY_DIRS} REQUIRED)
  mark_as_advanced(GNOMON_NETCDF_FILE)
  file(REAL_PATH "${GNOMON_NETCDF_FILE}" gnomon_netcdf_path)
  get_filename_component(GNOMON_NETCDF_LIBRARY "${gnomon_netcdf_path}" NAME)
endif()
if(GNOMON_BUILD_BENCH)
  find_package(benchmark REQUIRED)
endif()
