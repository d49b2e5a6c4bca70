# SPDX-License-Identifier: LGPL-3.0-or-later
# Debian packages by CPack, `./dev package`: gnomon, the command (GPL), and libgnomon-dev, the libraries and
# headers. What they depend on is found by dpkg-shlibdeps for the first; the second names the packages whose
# headers and libraries its own link.
find_program(GNOMON_GZIP gzip)
mark_as_advanced(GNOMON_GZIP)
if(NOT GNOMON_GZIP OR NOT TARGET gnomon)
  return()
endif()

set(gnomon_debian "${PROJECT_BINARY_DIR}/debian")
file(MAKE_DIRECTORY "${gnomon_debian}")
configure_file("${PROJECT_SOURCE_DIR}/packaging/copyright" "${gnomon_debian}/copyright" COPYONLY)
# Debian's form of a changelog has times and people; of a native package its one entry says where the
# changes are told.
string(TIMESTAMP gnomon_day "%a, %d %b %Y 00:00:00 +0000" UTC)
configure_file("${PROJECT_SOURCE_DIR}/packaging/changelog.in" "${gnomon_debian}/changelog" @ONLY)
execute_process(COMMAND "${GNOMON_GZIP}" -9nc "${gnomon_debian}/changelog"
                OUTPUT_FILE "${gnomon_debian}/changelog.gz")
foreach(package IN ITEMS gnomon libgnomon-dev)
  set(component development)
  if(package STREQUAL "gnomon")
    set(component command)
  endif()
  install(FILES "${gnomon_debian}/copyright" "${gnomon_debian}/changelog.gz" COMPONENT ${component}
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" EXCLUDE_FROM_ALL)
endforeach()
# Pages are compressed in a package alone.
install(CODE "
  set(root \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
  if(root MATCHES _CPack_Packages)
    file(GLOB pages \"\${root}/${CMAKE_INSTALL_MANDIR}/man1/gnomon*.1\")
    foreach(page IN LISTS pages)
      execute_process(COMMAND \"${GNOMON_GZIP}\" -9nf \"\${page}\")
    endforeach()
  endif()" COMPONENT command)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
    "exact shadows of polygons, and the verdict on other programs' shadows")
set(CPACK_PACKAGE_CONTACT "Gnomon developers <gnomon@gnomon.invalid>")
set(CPACK_PACKAGE_VENDOR "Gnomon")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
    GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL command development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE gzip)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME gnomon)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
# Loaded by its name when a table is written to netCDF.
string(REPLACE ".so." "" gnomon_netcdf_package "${GNOMON_NETCDF_LIBRARY}")
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS "${gnomon_netcdf_package}")
set(CPACK_DEBIAN_COMMAND_DESCRIPTION
"Gnomon computes which parts of which polygons are lit by point, directional and
area lights, with numbers that do not round, and judges any other program's
result: by how much it is off, where, and which polygon decides there. It reads
OBJ, OFF, PLY, STL, glTF, CityJSON, Radiance, gbXML, HBJSON, IDF and epJSON.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgnomon-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libgmp-dev, libmpfr-dev, libfmt-dev, libtbb-dev, libexpected-dev, libssl-dev, libpugixml-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
"Libraries and headers to classify polygon scenes exactly under point,
directional and area lights, and to judge what others computed; with a CMake
package and a file for pkg-config.")
include(CPack)
