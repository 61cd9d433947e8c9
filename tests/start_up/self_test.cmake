# What the check of the start-up's libraries must find.
#   cmake -DSCRIPT=<libraries.cmake> -DPROGRAM=<file> -P self_test.cmake
cmake_minimum_required(VERSION 3.22)
function(expect fails most later)
  execute_process(COMMAND "${CMAKE_COMMAND}" -DPROGRAM=${PROGRAM} -DMOST=${most} "-DOPENED_LATER=${later}"
                          -P "${SCRIPT}"
                  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(fails AND code EQUAL 0 OR NOT fails AND NOT code EQUAL 0)
    message(FATAL_ERROR "at most ${most}, none of '${later}' ended with ${code}:\n${output}")
  endif()
endfunction()
expect(OFF 1000 "libno_such_library")
expect(ON 2 "libno_such_library")
expect(ON 1000 "libno_such_library;libc\\.so")
