# The start-up's budget without a clock: the program loads at most so many shared libraries before main(), and none of
# those that it opens when they are used (docs/adr/0012).
#   cmake -DPROGRAM=<file> -DMOST=<count> -DOPENED_LATER=<list of regular expressions> -P libraries.cmake
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND ldd "${PROGRAM}" RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE errors)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "ldd ${PROGRAM} ended with ${code}\n${output}${errors}")
endif()
string(REGEX MATCHALL "[^\n]+" libraries "${output}")
list(LENGTH libraries count)
# The C and the C++ library are always there.
if(count LESS 3 OR NOT output MATCHES "libc\\.so")
  message(FATAL_ERROR "the check sees nothing: ldd says\n${output}")
endif()
if(count GREATER MOST)
  message(FATAL_ERROR "${PROGRAM} loads ${count} shared libraries, more than ${MOST}:\n${output}")
endif()
foreach(name IN LISTS OPENED_LATER)
  if(output MATCHES "${name}")
    message(FATAL_ERROR "${PROGRAM} loads ${CMAKE_MATCH_0} at its start; it is to be opened when it is used:\n${output}")
  endif()
endforeach()
message(STATUS "${count} shared libraries")
