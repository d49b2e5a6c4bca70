# SPDX-License-Identifier: LGPL-3.0-or-later
# Libraries that the benchmarks alone compare with: polyclipping::polyclipping, embree. CGAL is there
# already.
find_package(embree 3 REQUIRED)

find_path(POLYCLIPPING_INCLUDE_DIR clipper.hpp PATH_SUFFIXES polyclipping)
find_library(POLYCLIPPING_LIBRARY polyclipping)
mark_as_advanced(POLYCLIPPING_INCLUDE_DIR POLYCLIPPING_LIBRARY)
if(NOT POLYCLIPPING_INCLUDE_DIR OR NOT POLYCLIPPING_LIBRARY)
  message(FATAL_ERROR "GNOMON_BENCH_PEERS needs Clipper 6 (Debian: libpolyclipping-dev)")
endif()
add_library(polyclipping::polyclipping UNKNOWN IMPORTED)
set_target_properties(polyclipping::polyclipping PROPERTIES
  IMPORTED_LOCATION "${POLYCLIPPING_LIBRARY}"
  INTERFACE_INCLUDE_DIRECTORIES "${POLYCLIPPING_INCLUDE_DIR}")
