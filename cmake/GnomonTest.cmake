# SPDX-License-Identifier: LGPL-3.0-or-later
# gnomon_add_test(<name> SOURCES a_test.cc ... [LIBS gnomon::scene ...] [TIMEOUT seconds])
#
# Makes the GoogleTest program gnomon_<name>_test and one CTest test a test case, called
# <name>.<Suite>.<Case>, with the label <name>. GNOMON_SHARED_SCENES is defined as a string, empty where
# there are no such scenes; GNOMON_EXAMPLES is the directory of the examples.
include(GoogleTest)

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
  target_compile_definitions(${target} PRIVATE
    GNOMON_SHARED_SCENES="${GNOMON_SHARED_SCENES}"
    GNOMON_EXAMPLES="${PROJECT_SOURCE_DIR}/examples")
  gtest_discover_tests(${target}
    TEST_PREFIX "${name}."
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}"
    DISCOVERY_MODE PRE_TEST
    DISCOVERY_TIMEOUT 120
    PROPERTIES LABELS ${name} TIMEOUT ${arg_TIMEOUT})
endfunction()
