# SPDX-License-Identifier: LGPL-3.0-or-later
# Read by ctest, for each test program: adds a test a case. Wants `name` (the prefix of the tests' names
# and their label), `program`, `directory` (where tests run) and `timeout`. The list is kept beside the
# program's build files until the program changes.
set(cases "${directory}/gnomon_${name}_test_cases.cmake")
if(NOT EXISTS "${program}")
  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)
  return()
endif()

if(NOT EXISTS "${cases}" OR "${program}" IS_NEWER_THAN "${cases}" OR
   "${CMAKE_CURRENT_LIST_FILE}" IS_NEWER_THAN "${cases}")
  execute_process(COMMAND "${program}" --gtest_list_tests
                  WORKING_DIRECTORY "${directory}"
                  TIMEOUT 120 OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${program} cannot list its tests: ${result}\n${output}")
  endif()
  # GoogleTest prints a suite's name with a dot at the line's beginning and its cases indented, each with
  # the parameter's or type's value behind a '#'. A list of CMake must be free of brackets and semicolons.
  string(REGEX REPLACE " +#[^\n]*" "" output "${output}")
  string(REGEX MATCHALL "[^\n]+" lines "${output}")
  set(script "")
  foreach(line IN LISTS lines)
    string(STRIP "${line}" word)
    if(line MATCHES "^[A-Za-z0-9_/]+\\.$")
      set(suite "${word}")
    elseif(line MATCHES "^  [A-Za-z0-9_/]+$")
      set(test "${name}.${suite}${word}")
      string(REGEX REPLACE "DISABLED_" "" test "${test}")
      set(disabled "")
      if("${suite}${word}" MATCHES "(^|[./])DISABLED_")
        set(disabled " DISABLED TRUE")
      endif()
      string(APPEND script
        "add_test([==[${test}]==] [==[${program}]==] [==[--gtest_filter=${suite}${word}]==] "
        "--gtest_also_run_disabled_tests)\n"
        "set_tests_properties([==[${test}]==] PROPERTIES WORKING_DIRECTORY [==[${directory}]==] "
        "LABELS ${name} TIMEOUT ${timeout} SKIP_REGULAR_EXPRESSION [==[\\[  SKIPPED \\]]==]${disabled})\n")
    endif()
  endforeach()
  file(WRITE "${cases}" "${script}")
endif()
include("${cases}")
