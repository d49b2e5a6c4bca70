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
  DESTINATION "${gnomon_package_dir}")
if(gnomon_installed)
  install(EXPORT gnomonTargets NAMESPACE gnomon:: DESTINATION "${gnomon_package_dir}")
endif()

# The manual page is the command's own help, put into form by help2man where that is installed.
if(TARGET gnomon)
  find_program(GNOMON_HELP2MAN help2man)
  mark_as_advanced(GNOMON_HELP2MAN)
  if(GNOMON_HELP2MAN AND NOT CMAKE_CROSSCOMPILING)
    set(gnomon_manual "${PROJECT_BINARY_DIR}/man/gnomon.1")
    add_custom_command(OUTPUT "${gnomon_manual}"
      COMMAND "${CMAKE_COMMAND}" -E make_directory "${PROJECT_BINARY_DIR}/man"
      COMMAND "${GNOMON_HELP2MAN}" --no-info --no-discard-stderr
              "--name=exact shadows of polygons, and the verdict on every other number type"
              --version-string=${PROJECT_VERSION} "--help-option=--help-all"
              "--output=${gnomon_manual}" "$<TARGET_FILE:gnomon>"
      DEPENDS gnomon
      COMMENT "Writing the manual page gnomon.1"
      VERBATIM)
    add_custom_target(gnomon_manual_page ALL DEPENDS "${gnomon_manual}")
    install(FILES "${gnomon_manual}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
  endif()
endif()
