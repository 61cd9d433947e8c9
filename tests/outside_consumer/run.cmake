# Installs the built project to a fresh prefix, then configures, builds and runs a stranger's project.
#   cmake -DBUILD=<build tree> -DSOURCE=<outside_consumer> -DWORK=<scratch> -DFLAGS=<compiler flags> -P run.cmake
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE "${WORK}")
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
run("${CMAKE_COMMAND}" -S "${SOURCE}" -B "${WORK}/build" -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/consumer")
run("${WORK}/prefix/bin/asperity" --version)

# The installed program finds its library of OpenCV, and names where it looked for it when it is not there.
string(REPEAT "w" 400 pixels)
file(WRITE "${WORK}/blank.pgm" "P5 20 20 255\n${pixels}")
function(detect expected_code expected_text)
  execute_process(COMMAND "${WORK}/prefix/bin/asperity" markers detect "${WORK}/blank.pgm" --family aruco:DICT_4X4_50
                  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL expected_code OR NOT output MATCHES "${expected_text}")
    message(FATAL_ERROR "markers detect ended with ${code}, not ${expected_code} and '${expected_text}':\n${output}")
  endif()
endfunction()
detect(3 "no marker")
file(REMOVE "${WORK}/prefix/lib/asperity/libasperity_vision.so")
detect(1 "prefix/lib/asperity/libasperity_vision.so: ")
