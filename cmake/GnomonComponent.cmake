# SPDX-License-Identifier: LGPL-3.0-or-later
# gnomon_add_component(<name>
#   SOURCES src/a.cc ...                       compiled as they are
#   CGAL_SOURCES src/b.cc ...                  compiled with CGAL's headers and its -frounding-math;
#                                              left out without GNOMON_CGAL_KERNELS
#   HEADERS include/gnomon/<name>/a.h ...      installed
#   LINK gnomon::kernel GMP::GMPXX ...         public: named by the headers
#   LINK_PRIVATE fmt::fmt ...                  used inside only; header-only helpers of the build are
#                                              linked as $<BUILD_INTERFACE:gnomon_rapidjson>
#   [NO_INSTALL])
#
# Makes the target gnomon_<name>, its alias gnomon::<name>, and puts it into the exported package. A
# component without sources is an interface library.

set_property(GLOBAL PROPERTY GNOMON_INSTALLED_COMPONENTS "")

function(gnomon_add_component name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_INSTALL" ""
                        "SOURCES;CGAL_SOURCES;HEADERS;LINK;LINK_PRIVATE")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "gnomon_add_component(${name}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  set(target gnomon_${name})
  if(NOT GNOMON_CGAL_KERNELS)
    set(arg_CGAL_SOURCES "")
  endif()

  if(arg_SOURCES OR arg_CGAL_SOURCES)
    set(scope PUBLIC)
    add_library(${target} ${arg_SOURCES})
    target_link_libraries(${target} PUBLIC ${arg_LINK} PRIVATE ${arg_LINK_PRIVATE})
  else()
    set(scope INTERFACE)
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE ${arg_LINK})
  endif()
  add_library(gnomon::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  gnomon_set_flags(${target})
  target_sources(${target} ${scope}
    FILE_SET HEADERS BASE_DIRS include FILES ${arg_HEADERS})

  if(arg_CGAL_SOURCES)
    add_library(${target}_cgal OBJECT ${arg_CGAL_SOURCES})
    gnomon_set_flags(${target}_cgal)
    target_include_directories(${target}_cgal PRIVATE include)
    target_link_libraries(${target}_cgal PRIVATE ${arg_LINK} ${arg_LINK_PRIVATE} CGAL::CGAL)
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
    install(TARGETS ${target} EXPORT gnomonTargets
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
            RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
            FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
endfunction()
