# SPDX-License-Identifier: GPL-3.0-or-later
# The page of reports: bundled from this folder where node is and `npm ci` has been run here, which
# ./dev does where npm is. Without them the program builds as ever, and its reports have no page.
option(GNOMON_REPORT_PAGE "Bundle the page of reports where node and its packages are" ON)
set(gnomon_web "${CMAKE_CURRENT_SOURCE_DIR}/page/web")
find_program(GNOMON_NODE NAMES node nodejs)
mark_as_advanced(GNOMON_NODE)
# So that `npm ci` after configuring is noticed by the next build.
file(GLOB gnomon_web_packages CONFIGURE_DEPENDS "${gnomon_web}/node_modules/.package-lock.json")
set(gnomon_node_version 0)
if(GNOMON_NODE)
  execute_process(COMMAND "${GNOMON_NODE}" --version OUTPUT_VARIABLE gnomon_node_version
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "v" "" gnomon_node_version "${gnomon_node_version}")
endif()
if(GNOMON_REPORT_PAGE AND gnomon_node_version VERSION_GREATER_EQUAL 18 AND gnomon_web_packages)
  file(GLOB gnomon_web_sources CONFIGURE_DEPENDS "${gnomon_web}/src/*.ts" "${gnomon_web}/src/*.css"
       "${gnomon_web}/src/*.html")
  set(gnomon_page_text "${CMAKE_CURRENT_BINARY_DIR}/page_text.cc")
  add_custom_command(
    OUTPUT "${gnomon_page_text}"
    COMMAND "${GNOMON_NODE}" build.mjs "${gnomon_page_text}"
    WORKING_DIRECTORY "${gnomon_web}"
    DEPENDS ${gnomon_web_sources} "${gnomon_web}/build.mjs" "${gnomon_web}/package-lock.json"
    COMMENT "Bundling the page of reports"
    VERBATIM)
  target_sources(gnomon_report PRIVATE "${gnomon_page_text}")
  set_source_files_properties("${gnomon_page_text}" PROPERTIES SKIP_PRECOMPILE_HEADERS ON
                                                               SKIP_UNITY_BUILD_INCLUSION ON)
  set(GNOMON_HAS_PAGE ON)
else()
  message(STATUS "no node 18, or no packages in ${gnomon_web}: reports have no page")
  target_sources(gnomon_report PRIVATE page/no_page.cc)
  set(GNOMON_HAS_PAGE OFF)
endif()
set_property(GLOBAL PROPERTY GNOMON_HAS_PAGE ${GNOMON_HAS_PAGE})
