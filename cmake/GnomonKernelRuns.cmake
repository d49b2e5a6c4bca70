# SPDX-License-Identifier: LGPL-3.0-or-later
# gnomon_compile_on_kernels(<run> <header> [ROUNDED_ONLY] [WATCHED])
#
# Writes a source for each kernel of kernels.def that instantiates the class template <run>, which <header>
# defines, for the kernel's struct. The lists gnomon_kernel_runs and gnomon_cgal_kernel_runs of the calling
# directory get the sources. ROUNDED_ONLY: exact kernels are left out. WATCHED: one source more, for the kernel
# of watched runs (kernel/watched/), which is in no list.
#
# With GNOMON_COMPILE_BY_ROOMS up to four runs of a kernel are compiled together: they read the same
# headers and share most of the kernel's code, so that a further method costs its own code alone.
set(gnomon_kernels_def "${PROJECT_SOURCE_DIR}/kernel/include/gnomon/kernel/kernels.def")

function(gnomon_compile_on_kernels run header)
  cmake_parse_arguments(PARSE_ARGV 2 arg "ROUNDED_ONLY;WATCHED" "" "")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${gnomon_kernels_def}")
  file(STRINGS "${gnomon_kernels_def}" lines REGEX "^GNOMON_(CGAL_)?KERNEL[(]")
  set(run_header "${header}")
  if(arg_WATCHED)
    list(APPEND lines "GNOMON_KERNEL(kWatched, \"watched\", WatchedKernel, \"kernel/watched/watched_kernel.h\", false, ")
  endif()
  foreach(line IN LISTS lines)
    if(NOT line MATCHES
       "^GNOMON_(CGAL_)?KERNEL[(]k[A-Za-z0-9]+, \"([a-z0-9]+)\", ([A-Za-z0-9]+), \"([^\"]+)\", (true|false), ")
      message(FATAL_ERROR "${gnomon_kernels_def}: this line is not understood:\n${line}")
    endif()
    set(needs_cgal "${CMAKE_MATCH_1}")
    set(name "${CMAKE_MATCH_2}")
    set(kernel "${CMAKE_MATCH_3}")
    set(kernel_header "${CMAKE_MATCH_4}")
    if(arg_ROUNDED_ONLY AND CMAKE_MATCH_5)
      continue()
    endif()
    set(source "${CMAKE_CURRENT_BINARY_DIR}/kernel_runs/${run}_${name}.cc")
    configure_file("${PROJECT_SOURCE_DIR}/algorithms/run/kernel_run.cc.in" "${source}" @ONLY)
    get_property(run_count GLOBAL PROPERTY gnomon_runs_of_${name})
    math(EXPR unit "0${run_count} / 4 + 1")
    math(EXPR run_count "0${run_count} + 1")
    set_property(GLOBAL PROPERTY gnomon_runs_of_${name} ${run_count})
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "kernel_${name}_${unit}")
    if(needs_cgal)
      list(APPEND gnomon_cgal_kernel_runs "${source}")
    else()
      list(APPEND gnomon_kernel_runs "${source}")
    endif()
  endforeach()
  set(gnomon_kernel_runs "${gnomon_kernel_runs}" PARENT_SCOPE)
  set(gnomon_cgal_kernel_runs "${gnomon_cgal_kernel_runs}" PARENT_SCOPE)
endfunction()
