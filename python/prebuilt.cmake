# SPDX-License-Identifier: GPL-3.0-or-later
# The Python module of a build directory that has it, for a wheel: nothing is compiled twice, and what
# is packaged is what was tested.
if(NOT SKBUILD)
  message(FATAL_ERROR "GNOMON_PREBUILT is for wheels: pip wheel . --config-settings cmake.define.GNOMON_PREBUILT=DIR")
endif()
set(gnomon_prebuilt_module "${GNOMON_PREBUILT}/python/gnomon/_native.${SKBUILD_SOABI}${CMAKE_SHARED_MODULE_SUFFIX}")
set(gnomon_prebuilt_stub "${GNOMON_PREBUILT}/python/gnomon/_native.pyi")
foreach(file IN ITEMS "${gnomon_prebuilt_module}" "${gnomon_prebuilt_stub}")
  if(NOT EXISTS "${file}")
    message(FATAL_ERROR "${file} is missing; expected a build with GNOMON_BUILD_PYTHON for this Python")
  endif()
endforeach()
add_custom_target(gnomon_python)
add_custom_target(gnomon_python_stub)
install(FILES "${gnomon_prebuilt_module}" "${gnomon_prebuilt_stub}" DESTINATION gnomon COMPONENT python)
