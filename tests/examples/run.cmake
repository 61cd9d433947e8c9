# Runs a program and looks for lines in what it prints.
#   cmake -DPROGRAM=<file> -DARGS=<list> -DMATCHES=<list of regular expressions> -P run.cmake
execute_process(COMMAND "${PROGRAM}" ${ARGS} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${code}\n${output}${errors}")
endif()
foreach(line IN LISTS MATCHES)
  if(NOT output MATCHES "${line}")
    message(FATAL_ERROR "nothing in the output matches ${line}:\n${output}")
  endif()
endforeach()
