# SPDX-License-Identifier: LGPL-3.0-or-later
# gnomon_add_component(<name>
#   SOURCES room/a.cc ...                      compiled as they are, room by room
#   CGAL_SOURCES room/b.cc ...                 compiled with CGAL's headers and its -frounding-math;
#                                              left out without GNOMON_CGAL_KERNELS
#   HEADERS include/gnomon/<name>/a.h ...      installed
#   LINK gnomon::kernel GMP::GMPXX ...         public: named by the headers
#   LINK_PRIVATE fmt::fmt ...                  used inside only; header-only helpers of the build are
#                                              linked as $<BUILD_INTERFACE:gnomon_rapidjson>
#   [ALONE room room/c.cc ...]                 rooms and sources compiled each by itself always
#   [OPTIMISE -O2]                             in release builds, for code that need not be fast
#   [NO_INSTALL])
#
# Makes the target gnomon_<name>, its alias gnomon::<name>, and puts it into the exported package. A
# component without sources is an interface library.
#
# A header that serves outsiders is in include/gnomon/<name>/ and included as "gnomon/<name>/a.h"; every
# other one is in its room and included as "<name>/<room>/a.h". The second way needs the target
# gnomon::internals, which tests, benchmarks and the command link too, and which is not installed.

set_property(GLOBAL PROPERTY GNOMON_INSTALLED_COMPONENTS "")

add_library(gnomon_internals INTERFACE)
add_library(gnomon::internals ALIAS gnomon_internals)
target_include_directories(gnomon_internals INTERFACE "${PROJECT_SOURCE_DIR}")

function(gnomon_add_component name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_INSTALL" "OPTIMISE"
                        "SOURCES;CGAL_SOURCES;HEADERS;LINK;LINK_PRIVATE;ALONE")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "gnomon_add_component(${name}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(target gnomon_${name})
  if(NOT GNOMON_CGAL_KERNELS)
    set(arg_CGAL_SOURCES "")
  endif()

  if(arg_SOURCES OR arg_CGAL_SOURCES)
    set(scope PUBLIC)
    set(private PRIVATE)
    add_library(${target} ${arg_SOURCES})
    target_link_libraries(${target} PUBLIC ${arg_LINK} PRIVATE ${arg_LINK_PRIVATE})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${arg_OPTIMISE}>)
    gnomon_compile_by_rooms(${target} ALONE ${arg_ALONE})
    if("fmt::fmt" IN_LIST arg_LINK_PRIVATE)
      gnomon_precompile_headers(${target} text)
    else()
      gnomon_precompile_headers(${target} plain)
    endif()
  else()
    set(scope INTERFACE)
    set(private INTERFACE)
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE ${arg_LINK})
  endif()
  add_library(gnomon::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  gnomon_set_flags(${target})
  target_link_libraries(${target} ${private} $<BUILD_INTERFACE:gnomon_internals>)
  if(arg_HEADERS)
    target_sources(${target} ${scope}
      FILE_SET HEADERS BASE_DIRS include FILES ${arg_HEADERS})
  endif()

  if(arg_CGAL_SOURCES)
    add_library(${target}_cgal OBJECT ${arg_CGAL_SOURCES})
    gnomon_set_flags(${target}_cgal)
    target_include_directories(${target}_cgal PRIVATE include)
    target_link_libraries(${target}_cgal PRIVATE ${arg_LINK} ${arg_LINK_PRIVATE}
                          gnomon_internals CGAL::CGAL)
    gnomon_compile_by_rooms(${target}_cgal ALONE ${arg_ALONE})
    get_target_property(pic ${target} POSITION_INDEPENDENT_CODE)
    if(BUILD_SHARED_LIBS OR pic)
      set_target_properties(${target}_cgal PROPERTIES POSITION_INDEPENDENT_CODE ON)
    endif()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_cgal>)
    # CGAL's number types call these; CGAL itself is headers only.
    target_link_libraries(${target} PRIVATE GMP::GMPXX MPFR::MPFR)
  endif()

  if(GNOMON_INSTALL AND NOT arg_NO_INSTALL)
    set_property(GLOBAL APPEND PROPERTY GNOMON_INSTALLED_COMPONENTS ${name})
    set(headers "")
    if(arg_HEADERS)
      set(headers FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
    endif()
    install(TARGETS ${target} EXPORT gnomonTargets
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
            RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT development
            ${headers})
  endif()
endfunction()
