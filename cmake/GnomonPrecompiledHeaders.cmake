# SPDX-License-Identifier: LGPL-3.0-or-later
# gnomon_precompile_headers(<target> <kind>): with GNOMON_PRECOMPILED_HEADERS, compiles the target's sources
# with those headers of libraries that nearly every source includes, read once.
#
# A precompiled header serves only sources with the same macros and floating-point flags, so there are
# three: `plain`, `text` (with fmt, whose targets define a macro) and `tests` (GoogleTest). Sources that
# use CGAL take none: precompiling its headers costs more than their few sources save. Each is made when
# the first target asks for it. Nothing of this is installed, and every source includes what it uses: the
# preset `dev` compiles without.

set(gnomon_headers_plain <algorithm> <array> <atomic> <bit> <charconv> <cmath> <cstdint> <functional>
    <limits> <map> <memory> <mutex> <optional> <span> <string> <string_view> <unordered_map> <utility>
    <vector> <gmpxx.h> <tl/expected.hpp>)
set(gnomon_headers_text ${gnomon_headers_plain} <filesystem> <set> <fmt/format.h>)
set(gnomon_headers_tests ${gnomon_headers_plain} <gmock/gmock.h> <gtest/gtest.h>)
set(gnomon_libraries_plain GMP::GMPXX tl::expected)
set(gnomon_libraries_text ${gnomon_libraries_plain} fmt::fmt)
set(gnomon_libraries_tests ${gnomon_libraries_plain} GTest::gtest GTest::gmock)

function(gnomon_precompile_headers target kind)
  if(NOT GNOMON_PRECOMPILED_HEADERS)
    return()
  endif()
  set(owner gnomon_headers_${kind})
  if(NOT TARGET ${owner})
    set(source "${PROJECT_BINARY_DIR}/precompiled/${kind}.cc")
    file(CONFIGURE OUTPUT "${source}" CONTENT "// Owns the precompiled headers.\n")
    add_library(${owner} OBJECT "${source}")
    gnomon_set_flags(${owner})
    target_link_libraries(${owner} PRIVATE ${gnomon_libraries_${kind}})
    target_precompile_headers(${owner} PRIVATE ${gnomon_headers_${kind}})
    gnomon_prepare_for_cached_headers(${owner})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 forgets that std::string's code from a precompiled header is a system header's, and tells
    # its false warnings about it (GCC bug 105651 and its kind).
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow
                                             -Wno-stringop-overread)
  endif()
  gnomon_prepare_for_cached_headers(${target})
endfunction()

# ccache can keep objects that were compiled with a precompiled header only so.
function(gnomon_prepare_for_cached_headers target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)
  endif()
endfunction()
