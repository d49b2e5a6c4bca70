# SPDX-License-Identifier: LGPL-3.0-or-later
# gnomon_compile_by_rooms(<target> [ALONE room room/source.cc ...])
#
# With GNOMON_COMPILE_BY_ROOMS, compiles the sources of a room together, at most eight in one unit: most
# of a short source's compile time is the reading of headers, and of each template that it shares with
# its neighbours. Names in the unnamed namespaces of one room must therefore differ. What ALONE names is
# compiled source by source: rooms of long sources, and sources with a name that a neighbour has, too.
#
# Without the option each source is compiled by itself, which shows what a source forgets to include.

set(gnomon_files_a_unit 8)

function(gnomon_compile_by_rooms target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "ALONE")
  if(NOT GNOMON_COMPILE_BY_ROOMS)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # A type of a source may have members whose types are private to that source.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(room "${source}" DIRECTORY)
    if(NOT source MATCHES "\\.cc$" OR IS_ABSOLUTE "${source}" OR room IN_LIST arg_ALONE OR
       source IN_LIST arg_ALONE)
      continue()
    endif()
    string(MAKE_C_IDENTIFIER "${room}" room)
    math(EXPR unit "0${files_in_${room}} / ${gnomon_files_a_unit} + 1")
    math(EXPR files_in_${room} "0${files_in_${room}} + 1")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${room}_${unit}")
  endforeach()
endfunction()
