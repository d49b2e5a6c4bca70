# SPDX-License-Identifier: LGPL-3.0-or-later
# What comes with an installed command: manual pages, one of gnomon and one of each command of it, and the
# completion of bash, zsh and fish. All are written by the command itself and by its own help, so that
# none goes stale.
find_program(GNOMON_HELP2MAN help2man)
mark_as_advanced(GNOMON_HELP2MAN)
if(CMAKE_CROSSCOMPILING)
  return()
endif()

set(gnomon_completions "${PROJECT_BINARY_DIR}/completions")
set(gnomon_completion_files "")
foreach(shell IN ITEMS bash zsh fish)
  set(file "${gnomon_completions}/gnomon.${shell}")
  add_custom_command(OUTPUT "${file}"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${gnomon_completions}"
    COMMAND "$<TARGET_FILE:gnomon>" completion ${shell} > "${file}"
    DEPENDS gnomon
    COMMENT "Writing the completion of ${shell}"
    VERBATIM)
  list(APPEND gnomon_completion_files "${file}")
endforeach()
add_custom_target(gnomon_completion ALL DEPENDS ${gnomon_completion_files})
install(FILES "${gnomon_completions}/gnomon.bash" RENAME gnomon COMPONENT command
        DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
# Where zsh looks depends on the prefix, which is known when it is installed: Debian's packages have a folder
# of their own below /usr, and whatever else is installed has the one that all of zsh's versions know.
install(CODE "
  set(folder site-functions)
  if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
    set(folder vendor-completions)
  endif()
  file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/zsh/\${folder}\" TYPE FILE
       RENAME _gnomon FILES \"${gnomon_completions}/gnomon.zsh\")"
  COMPONENT command)
install(FILES "${gnomon_completions}/gnomon.fish" COMPONENT command
        DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")

if(GNOMON_HELP2MAN)
  set(gnomon_manual "${PROJECT_BINARY_DIR}/man")
  add_custom_command(OUTPUT "${gnomon_manual}/gnomon.1"
    COMMAND "${CMAKE_COMMAND}" -D "PROGRAM=$<TARGET_FILE:gnomon>" -D "HELP2MAN=${GNOMON_HELP2MAN}"
            -D "VERSION=${PROJECT_VERSION}" -D "DIRECTORY=${gnomon_manual}"
            -P "${PROJECT_SOURCE_DIR}/cmake/WriteManual.cmake"
    DEPENDS gnomon "${PROJECT_SOURCE_DIR}/cmake/WriteManual.cmake"
    COMMENT "Writing the manual pages"
    VERBATIM)
  add_custom_target(gnomon_manual_page ALL DEPENDS "${gnomon_manual}/gnomon.1")
  install(DIRECTORY "${gnomon_manual}/" COMPONENT command DESTINATION "${CMAKE_INSTALL_MANDIR}/man1"
          FILES_MATCHING PATTERN "*.1")
endif()
