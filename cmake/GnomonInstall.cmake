# SPDX-License-Identifier: LGPL-3.0-or-later
# The installed CMake package: find_package(gnomon) gives gnomon::kernel, gnomon::scene and so on. It
# looks only for those libraries that the installed components link.
include(CMakePackageConfigHelpers)
set(gnomon_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/gnomon")

set(gnomon_dependencies "")
set(gnomon_find_libuv "")
get_property(gnomon_installed GLOBAL PROPERTY GNOMON_INSTALLED_COMPONENTS)
foreach(component IN LISTS gnomon_installed)
  foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
    get_target_property(libraries gnomon_${component} ${property})
    foreach(library IN LISTS libraries)
      if(library MATCHES "^(GMP|MPFR|fmt|TBB|Threads|CLI11|pugixml)::")
        list(APPEND gnomon_dependencies "${CMAKE_MATCH_1}")
      elseif(library MATCHES "^OpenSSL::")
        list(APPEND gnomon_dependencies OpenSSL)
      elseif(library MATCHES "^tl::expected$")
        list(APPEND gnomon_dependencies tl-expected)
      elseif(library MATCHES "SQLiteCpp")
        list(APPEND gnomon_dependencies SQLiteCpp)
      elseif(library MATCHES "PkgConfig::LIBUV")
        set(gnomon_find_libuv "include(FindPkgConfig)
pkg_check_modules(LIBUV REQUIRED IMPORTED_TARGET GLOBAL libuv)
")
      endif()
    endforeach()
  endforeach()
endforeach()
if("MPFR" IN_LIST gnomon_dependencies)
  list(APPEND gnomon_dependencies GMP)
endif()
list(SORT gnomon_dependencies)  # GMP before MPFR, which links it
list(REMOVE_DUPLICATES gnomon_dependencies)
set(gnomon_find_dependencies "")
foreach(dependency IN LISTS gnomon_dependencies)
  string(APPEND gnomon_find_dependencies "find_dependency(${dependency})\n")
endforeach()
string(APPEND gnomon_find_dependencies "${gnomon_find_libuv}")
string(REPLACE ";" " " gnomon_components_installed "${gnomon_installed}")

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/gnomonConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/cmake/gnomonConfig.cmake"
  INSTALL_DESTINATION "${gnomon_package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/cmake/gnomonConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/cmake/gnomonConfig.cmake"
  "${PROJECT_BINARY_DIR}/cmake/gnomonConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindGMP.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindMPFR.cmake"
  COMPONENT development DESTINATION "${gnomon_package_dir}")
if(gnomon_installed)
  install(EXPORT gnomonTargets NAMESPACE gnomon:: COMPONENT development
          DESTINATION "${gnomon_package_dir}")
endif()

# For those who build without CMake: the library alone, found from where its file lies.
file(RELATIVE_PATH gnomon_pc_up "/${CMAKE_INSTALL_DATADIR}/pkgconfig" "/")
string(REGEX REPLACE "/$" "" gnomon_pc_up "${gnomon_pc_up}")
set(gnomon_pc_libs "")
foreach(component IN ITEMS algorithms result scene kernel)
  if(component IN_LIST gnomon_installed)
    string(APPEND gnomon_pc_libs " -lgnomon_${component}")
  endif()
endforeach()
configure_file("${PROJECT_SOURCE_DIR}/cmake/gnomon.pc.in" "${PROJECT_BINARY_DIR}/cmake/gnomon.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/cmake/gnomon.pc" COMPONENT development
        DESTINATION "${CMAKE_INSTALL_DATADIR}/pkgconfig")

if(TARGET gnomon)
  include(GnomonManual)
endif()
if(PROJECT_IS_TOP_LEVEL)
  include(GnomonPackage)
endif()
