# SPDX-License-Identifier: GPL-3.0-or-later
# Configures, builds and runs the consumer in WORK_DIR; WAY is find_package or add_subdirectory.

# run(COMMAND...): stops with everything it printed if it fails; leaves its output in `output`.
macro(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE errors)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}\n${output}\n${errors}")
  endif()
endmacro()

set(options "")
if(WAY STREQUAL "find_package")
  file(REMOVE_RECURSE "${WORK_DIR}")
  set(prefix "${WORK_DIR}/prefix")
  run("${CMAKE_COMMAND}" --install "${GNOMON_BINARY_DIR}" --prefix "${prefix}" --config "${CONFIG}")
  list(APPEND options "-DCMAKE_PREFIX_PATH=${prefix}")

  # What is installed must stand alone: no path of the tree or of the build in it.
  file(GLOB package_files "${prefix}/${LIBDIR}/cmake/gnomon/*.cmake")
  if(NOT package_files)
    message(FATAL_ERROR "no CMake package under ${prefix}/${LIBDIR}/cmake/gnomon")
  endif()
  foreach(file IN LISTS package_files)
    file(READ "${file}" text)
    foreach(directory IN ITEMS "${GNOMON_SOURCE_DIR}" "${GNOMON_BINARY_DIR}")
      string(FIND "${text}" "${directory}" position)
      if(NOT position EQUAL -1)
        message(FATAL_ERROR "${file} names ${directory}")
      endif()
    endforeach()
  endforeach()
else()
  # The library is compiled again here, room by room, without optimisation and without CGAL's kernels, as a
  # project may want it, so that this takes a fraction of the first time. The folder is kept from run to run.
  set(CONFIG Debug)
  list(APPEND options "-DGNOMON_DIR=${GNOMON_SOURCE_DIR}" -DGNOMON_WARNINGS_AS_ERRORS=ON
       -DGNOMON_COMPILE_BY_ROOMS=ON -DGNOMON_CGAL_KERNELS=OFF)
endif()

run("${CMAKE_COMMAND}" -S "${CONSUMER_DIR}" -B "${WORK_DIR}/build" -G "${GENERATOR}"
    "-DCMAKE_BUILD_TYPE=${CONFIG}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_EXE_LINKER_FLAGS=${LINK_FLAGS}" ${options})
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build" --parallel 2)
run("${WORK_DIR}/build/consumer")
message("${output}")
if(NOT output STREQUAL "lit fraction of the floor: 3/4\n")
  message(FATAL_ERROR "the consumer printed another answer")
endif()

# The same without CMake.
find_program(PKG_CONFIG_PROGRAM pkg-config)
if(WAY STREQUAL "find_package" AND PKG_CONFIG_PROGRAM)
  set(ENV{PKG_CONFIG_PATH} "${prefix}/share/pkgconfig:$ENV{PKG_CONFIG_PATH}")
  run("${PKG_CONFIG_PROGRAM}" --cflags --libs gnomon)
  separate_arguments(flags UNIX_COMMAND "${output}")
  run("${COMPILER}" "${CONSUMER_DIR}/consumer.cc" -o "${WORK_DIR}/by_pkg_config" ${flags})
  run("${WORK_DIR}/by_pkg_config")
  if(NOT output STREQUAL "lit fraction of the floor: 3/4\n")
    message(FATAL_ERROR "the consumer built by pkg-config printed another answer")
  endif()
endif()
