# SPDX-License-Identifier: LGPL-3.0-or-later
# Writes DIRECTORY/gnomon.1 and a page gnomon-COMMAND.1 for each command of PROGRAM, by HELP2MAN; gnomon.1
# last, which says that all are there.
file(REMOVE_RECURSE "${DIRECTORY}")
file(MAKE_DIRECTORY "${DIRECTORY}")
execute_process(COMMAND "${PROGRAM}" completion commands OUTPUT_VARIABLE commands
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" commands "${commands}")

function(write_page name summary)
  # help2man calls one program without a command: this one adds it.
  string(REPLACE " " "-" page "${name}")
  set(program "${DIRECTORY}/${page}")
  string(REPLACE "gnomon" "" command "${name}")
  file(WRITE "${program}" "#!/bin/sh\nexec '${PROGRAM}'${command} \"$@\"\n")
  file(CHMOD "${program}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  execute_process(
    COMMAND "${HELP2MAN}" --no-info --no-discard-stderr "--name=${summary}"
            "--version-string=${VERSION}" --help-option=--help "--output=${DIRECTORY}/${page}.1" "${program}"
    COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE "${program}")
endfunction()

foreach(command IN LISTS commands)
  execute_process(COMMAND "${PROGRAM}" ${command} --help OUTPUT_VARIABLE help
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n]*" summary "${help}")
  write_page("gnomon ${command}" "${summary}")
endforeach()
write_page("gnomon" "exact shadows of polygons, and the verdict on every other number type")
