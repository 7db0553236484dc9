# Ends with one line that says what to do. The Makefile prints the file, without CMake's own decoration.
file(REMOVE ${CMAKE_BINARY_DIR}/stopped.txt)
function(hvi_stop)
  string(JOIN "" text ${ARGN})
  file(WRITE ${CMAKE_BINARY_DIR}/stopped.txt "lammps-hvi: ${text}\n")
  message(FATAL_ERROR "${text}")
endfunction()

# runs a script of ours; its last line on stderr is its complaint
macro(hvi_script result)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE ${result} ERROR_VARIABLE complaint RESULT_VARIABLE code
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_STRIP_TRAILING_WHITESPACE)
  if(NOT code EQUAL 0)
    string(REGEX REPLACE ".*\n" "" complaint "${complaint}")
    string(REGEX REPLACE "^lammps-hvi: " "" complaint "${complaint}")
    hvi_stop("${complaint}")
  endif()
endmacro()
