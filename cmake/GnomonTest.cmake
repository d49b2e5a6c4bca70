# SPDX-License-Identifier: LGPL-3.0-or-later
# gnomon_add_test(<name> SOURCES a_test.cc ... [LIBS gnomon::scene ...] [TIMEOUT seconds])
#
# Makes the GoogleTest program gnomon_<name>_test and one CTest test a test case, called
# <name>.<Suite>.<Case>, with the label <name>. CTest lists the cases when it starts; of parametrised
# ones it takes the names that the source gives them, and no dump of a parameter's or a type's insides.
# GNOMON_SHARED_SCENES is defined as a string, empty where there are no such scenes; GNOMON_EXAMPLES is
# the directory of the examples.
set(gnomon_list_tests "${CMAKE_CURRENT_LIST_DIR}/GnomonListTests.cmake")

function(gnomon_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "SOURCES;LIBS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "gnomon_add_test(${name}): unknown ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 600)
  endif()
  set(target gnomon_${name}_test)
  add_executable(${target} ${arg_SOURCES})
  gnomon_set_flags(${target})
  set_target_properties(${target} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/test_programs")
  target_link_libraries(${target} PRIVATE ${arg_LIBS} gnomon::internals GTest::gtest_main GTest::gmock)
  if(NOT "CGAL::CGAL" IN_LIST arg_LIBS)
    gnomon_precompile_headers(${target} tests)
  endif()
  target_compile_definitions(${target} PRIVATE
    GNOMON_SHARED_SCENES="${GNOMON_SHARED_SCENES}"
    GNOMON_EXAMPLES="${PROJECT_SOURCE_DIR}/examples")

  set(list_file "${CMAKE_CURRENT_BINARY_DIR}/${target}_list.cmake")
  file(GENERATE OUTPUT "${list_file}" CONTENT
"set(name [==[${name}]==])
set(program [==[$<TARGET_FILE:${target}>]==])
set(directory [==[${CMAKE_CURRENT_BINARY_DIR}]==])
set(timeout ${arg_TIMEOUT})
include([==[${gnomon_list_tests}]==])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${list_file}")
endfunction()
