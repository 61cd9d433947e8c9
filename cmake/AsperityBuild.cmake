# Compiler flags, add_module() and add_asperity_fuzzer().

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()
# Only the modules that gain by -O3 are compiled with it (asperity_optimise_fully).
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
string(REPLACE "-O3" "-O2" CMAKE_C_FLAGS_RELEASE "${CMAKE_C_FLAGS_RELEASE}")

# Another checkout hits the cache: its paths are seen from the source tree. A precompiled header is part of what is hashed.
find_program(ASPERITY_CCACHE ccache)
if(ASPERITY_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}" CCACHE_NOHASHDIR=1
      "CCACHE_SLOPPINESS=pch_defines,time_macros" "${ASPERITY_CCACHE}")
endif()

add_library(asperity_flags INTERFACE)
target_compile_options(asperity_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast
  -Wcast-align -Wunused -Wformat=2 -Wimplicit-fallthrough -Werror
  # The same bytes on every machine: no fused multiply-add, which also slows recursive filters.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports these inside Eigen and the standard library after inlining.
  target_compile_options(asperity_flags INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
    -Wno-restrict)
  if(CMAKE_UNITY_BUILD)
    # A type of the unnamed namespace in a .cc file that another one includes: it is still local to one translation unit.
    target_compile_options(asperity_flags INTERFACE -Wno-subobject-linkage)
  endif()
endif()
# Hardening; its cost for the servo is in docs/performance-build.md. --as-needed: a library that nothing uses is not loaded.
include(CheckPIESupported)
check_pie_supported()
add_library(asperity_hardening INTERFACE)
target_compile_options(asperity_hardening INTERFACE
  -fstack-protector-strong $<$<CONFIG:Release>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=2>)
target_link_options(asperity_hardening INTERFACE -Wl,-z,relro,-z,now,-z,noexecstack -Wl,--as-needed -Wl,-O1)
target_link_libraries(asperity_flags INTERFACE asperity_hardening)

if(ASPERITY_SANITIZE)
  add_compile_options(-fsanitize=${ASPERITY_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${ASPERITY_SANITIZE})
endif()
if(ASPERITY_FUZZ)
  # The libraries are instrumented too: coverage of the code under test guides the fuzzer.
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
add_custom_target(fuzzers COMMENT "All fuzz targets")

# What nearly every file includes is parsed once: the standard library and Eigen for the program, GoogleTest for the tests.
# The debug preset does without, and without unity builds, so that each file is known to include what it needs.
set(ASPERITY_STANDARD_HEADERS <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <deque> <exception>
    <filesystem> <fstream> <functional> <iterator> <limits> <map> <memory> <mutex> <numbers> <numeric> <optional> <random>
    <set> <span> <sstream> <stdexcept> <string> <string_view> <system_error> <thread> <tuple> <unordered_map> <utility>
    <variant> <vector> <Eigen/Core> <Eigen/Geometry>)

# asperity_precompile(target): the common headers of a library or program, compiled once for all that use the same flags.
function(asperity_precompile target)
  if(NOT TARGET asperity_precompiled)
    file(WRITE "${CMAKE_BINARY_DIR}/precompiled.cc" "")
    add_library(asperity_precompiled OBJECT "${CMAKE_BINARY_DIR}/precompiled.cc")
    target_link_libraries(asperity_precompiled PRIVATE asperity_flags Eigen3::Eigen)
    target_compile_features(asperity_precompiled PRIVATE cxx_std_20)
    target_precompile_headers(asperity_precompiled PRIVATE ${ASPERITY_STANDARD_HEADERS})
  endif()
  target_precompile_headers(${target} REUSE_FROM asperity_precompiled)
endfunction()

# asperity_small_program(target): the flags and precompiled headers of tests, for programs beside the product. They are
# compiled with -O1: what they call is not.
function(asperity_small_program target)
  if(NOT TARGET asperity_test_precompiled)
    file(WRITE "${CMAKE_BINARY_DIR}/test_precompiled.cc" "")
    add_library(asperity_test_precompiled OBJECT "${CMAKE_BINARY_DIR}/test_precompiled.cc")
    target_link_libraries(asperity_test_precompiled PRIVATE asperity_flags Eigen3::Eigen GTest::gmock GTest::gtest)
    target_compile_features(asperity_test_precompiled PRIVATE cxx_std_20)
    target_compile_options(asperity_test_precompiled PRIVATE $<$<CONFIG:Release>:-O1>)
    set_target_properties(asperity_test_precompiled PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_precompile_headers(asperity_test_precompiled PRIVATE ${ASPERITY_STANDARD_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)
  endif()
  target_link_libraries(${target} PRIVATE asperity_flags)
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  # The precompiled headers are of an object library; a program's flags for position-independent code differ from a library's.
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF UNITY_BUILD OFF)
  target_precompile_headers(${target} REUSE_FROM asperity_test_precompiled)
endfunction()

# asperity_test_program(target): asperity_small_program with GoogleTest.
function(asperity_test_program target)
  asperity_small_program(${target})
  target_link_libraries(${target} PRIVATE GTest::gmock GTest::gtest_main)
endfunction()

# asperity_optimise_fully(target): -O3 in release builds, where it was measured to pay (docs/performance-build.md).
# Without precompiled headers: g++ compiles a file that includes one with the header's -O2, whatever the file's own option.
function(asperity_optimise_fully target)
  set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
endfunction()

set_property(GLOBAL PROPERTY ASPERITY_MODULES "")
set_property(GLOBAL PROPERTY ASPERITY_PLACES "")

# add_module(name DEPENDS module… [PUBLIC target…] [PRIVATE target…])
#   One static library asperity_<name> from modules/<name>/src/*.cc, its headers in
#   include/asperity/<name>/, its tests in test/*_test.cc. DEPENDS names modules of this project
#   and is compared with the #include lines by the test `include_check`.
function(add_module name)
  cmake_parse_arguments(M "" "" "DEPENDS;PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS src/*.cc)
  file(GLOB headers CONFIGURE_DEPENDS include/asperity/${name}/*.h)
  set(target asperity_${name})
  add_library(${target} STATIC ${sources} ${headers})
  add_library(asperity::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX EXPORT_NAME ${name})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_include_directories(${target} PRIVATE src)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:asperity_flags>)
  foreach(dependency IN LISTS M_DEPENDS)
    target_link_libraries(${target} PUBLIC asperity_${dependency})
  endforeach()
  if(M_PUBLIC)
    target_link_libraries(${target} PUBLIC ${M_PUBLIC})
  endif()
  if(M_PRIVATE)
    target_link_libraries(${target} PRIVATE ${M_PRIVATE})
  endif()
  install(TARGETS ${target} EXPORT asperityTargets ARCHIVE DESTINATION lib COMPONENT dev)
  install(DIRECTORY include/ DESTINATION include COMPONENT dev)
  asperity_precompile(${target})
  set_property(GLOBAL APPEND PROPERTY ASPERITY_MODULES ${name})
  set_property(GLOBAL PROPERTY ASPERITY_DEPENDS_${name} "${M_DEPENDS}")

  file(GLOB tests CONFIGURE_DEPENDS test/*_test.cc)
  if(ASPERITY_TESTS AND tests)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE ${target} asperity_testkit ${M_PRIVATE})
    asperity_test_program(${name}_test)
    target_compile_definitions(${name}_test PRIVATE ASPERITY_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
    # A test's own limit counts before ctest's, and a sanitizer makes the longest ten times as long.
    set(limit_s 300)
    if(ASPERITY_SANITIZE)
      set(limit_s 1500)
    endif()
    gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT ${limit_s})
  endif()
endfunction()

# add_own_library(name USED_BY target [COMPONENT package] SOURCES … LIBRARIES target…)
#   libasperity_<name>.so, which own_library_paths() (base/load_library.h) finds beside the programs of the build and in
#   lib/asperity of what is installed. It is built before whatever is linked with USED_BY, which loads it. It belongs to
#   the package of the program, or to that of another COMPONENT (AsperityPackage.cmake).
function(add_own_library name)
  cmake_parse_arguments(L "" "USED_BY;COMPONENT" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT L_COMPONENT)
    set(L_COMPONENT program)
  endif()
  set(target asperity_${name}_library)
  add_library(${target} MODULE ${L_SOURCES})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME asperity_${name}
                        LIBRARY_OUTPUT_DIRECTORY "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  target_link_libraries(${target} PRIVATE ${L_LIBRARIES} asperity_flags)
  add_dependencies(${L_USED_BY} ${target})
  install(TARGETS ${target} LIBRARY DESTINATION lib/asperity COMPONENT ${L_COMPONENT})
endfunction()

# add_own_program(name USED_BY target SOURCES … LIBRARIES target…)
#   A program that ours start, found in the same places.
function(add_own_program name)
  cmake_parse_arguments(P "" "USED_BY" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${P_SOURCES})
  target_link_libraries(${name} PRIVATE ${P_LIBRARIES} asperity_flags)
  target_compile_features(${name} PRIVATE cxx_std_20)
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  add_dependencies(${P_USED_BY} ${name})
  install(TARGETS ${name} RUNTIME DESTINATION lib/asperity COMPONENT program)
endfunction()

# declare_includes(place DEPENDS name…)
#   What a place outside modules/ may include: a folder with its own headers (apps/asperity), its tests
#   (studio/server/test), or one file of it that may include more (apps/asperity/cmd_studio.cc). Names are those of modules
#   and of such folders. Compared with the #include lines by the test `include_check`; a folder's tests may use what the
#   folder may, and testkit.
function(declare_includes place)
  cmake_parse_arguments(D "" "" "DEPENDS" ${ARGN})
  set_property(GLOBAL APPEND PROPERTY ASPERITY_PLACES ${place})
  set_property(GLOBAL PROPERTY ASPERITY_INCLUDES_${place} "${D_DEPENDS}")
endfunction()

# add_asperity_fuzzer(name SOURCE target…): SOURCE defines LLVMFuzzerTestOneInput. With clang and
# ASPERITY_FUZZ a libFuzzer binary; otherwise a program that replays its corpus, fuzz/corpus/<name>/,
# and is a test.
function(add_asperity_fuzzer name source)
  add_executable(fuzz_${name} ${source})
  target_link_libraries(fuzz_${name} PRIVATE ${ARGN} asperity_flags)
  add_dependencies(fuzzers fuzz_${name})
  if(ASPERITY_FUZZ)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    target_compile_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  else()
    if(NOT TARGET asperity_replay_corpus)
      add_library(asperity_replay_corpus OBJECT ${CMAKE_SOURCE_DIR}/testkit/replay_corpus.cc)
      target_link_libraries(asperity_replay_corpus PRIVATE asperity_flags)
      target_compile_features(asperity_replay_corpus PRIVATE cxx_std_20)
    endif()
    target_link_libraries(fuzz_${name} PRIVATE asperity_replay_corpus)
    asperity_small_program(fuzz_${name})
    target_compile_definitions(fuzz_${name} PRIVATE GTEST_HAS_PTHREAD=1)  # as in what was precompiled
    add_test(NAME fuzz_replay.${name}
             COMMAND fuzz_${name} ${CMAKE_CURRENT_SOURCE_DIR}/corpus/${name})
    set_tests_properties(fuzz_replay.${name} PROPERTIES TIMEOUT 120)
  endif()
endfunction()
