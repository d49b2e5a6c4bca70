# SPDX-License-Identifier: LGPL-3.0-or-later
# gnomon_set_flags(<target>): language, warnings and floating-point discipline of an own target.
#
# -ffp-contract=off is part of the correctness of every proven error bound: a fused multiply-add
# rounds once where the proof counts twice. -ffast-math must never be added anywhere. -frounding-math
# belongs to the sources that use CGAL alone (CGAL_SOURCES of gnomon_add_component).

function(gnomon_set_flags target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    target_compile_features(${target} INTERFACE cxx_std_20)
    target_compile_options(${target} INTERFACE -ffp-contract=off)
    return()
  endif()
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # The Python module links the same archives into a shared object. All sources have the same flag, since a
  # precompiled header serves none that differs, and nobody replaces our functions at load time.
  # -ftls-model=initial-exec would make thread-local variables faster, but also those of the standard library
  # behind std::call_once, and then a program that has loaded that library before could not load the module.
  target_compile_options(${target} PRIVATE -fPIC -fno-semantic-interposition)
  target_compile_options(${target} PUBLIC -ffp-contract=off PRIVATE -Wall -Wextra -Wpedantic)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 sees overlaps in std::string's operator+ where there are none (GCC bug 105651).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # RapidJSON 1.1 compares its iterators by members that C++20 also tries the other way round.
    target_compile_options(${target} PRIVATE -Wno-ambiguous-reversed-operator)
  endif()
  if(GNOMON_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(GNOMON_SANITIZE)
    # GCC's flow analysis gives false warnings in instrumented library code.
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=all
                                             -fno-omit-frame-pointer -Wno-maybe-uninitialized)
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
  endif()
  if(GNOMON_BUILD_FUZZERS)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link,address,undefined
                                             -fno-sanitize-recover=all -fno-omit-frame-pointer)
    # Overflow checks of 128-bit products call a function that only compiler-rt has.
    target_link_options(${target} PUBLIC -fsanitize=address,undefined --rtlib=compiler-rt
                                         --unwindlib=libgcc)
  endif()
  if(GNOMON_COVERAGE)
    target_compile_options(${target} PRIVATE --coverage)
    target_link_options(${target} PUBLIC --coverage)
  endif()
endfunction()
