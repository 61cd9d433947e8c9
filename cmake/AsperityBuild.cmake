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

find_program(ASPERITY_CCACHE ccache)
if(ASPERITY_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${ASPERITY_CCACHE}")
endif()

add_library(asperity_flags INTERFACE)
target_compile_options(asperity_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast
  -Wcast-align -Wunused -Wformat=2 -Wimplicit-fallthrough -Werror
  # The same bytes on every machine: no fused multiply-add, which also slows recursive filters.
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports these inside Eigen and the standard library after inlining.
  target_compile_options(asperity_flags INTERFACE -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
endif()
# Hardening; what it costs the servo is in docs/performance.md. --as-needed: a library that nothing uses is not loaded.
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

set_property(GLOBAL PROPERTY ASPERITY_MODULES "")

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
  install(TARGETS ${target} EXPORT asperityTargets ARCHIVE DESTINATION lib)
  install(DIRECTORY include/ DESTINATION include)
  set_property(GLOBAL APPEND PROPERTY ASPERITY_MODULES ${name})
  set_property(GLOBAL PROPERTY ASPERITY_DEPENDS_${name} "${M_DEPENDS}")

  file(GLOB tests CONFIGURE_DEPENDS test/*_test.cc)
  if(ASPERITY_TESTS AND tests)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE ${target} asperity_testkit ${M_PRIVATE} asperity_flags GTest::gmock GTest::gtest_main)
    target_compile_definitions(${name}_test PRIVATE ASPERITY_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/test/data")
    gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 120 PROPERTIES TIMEOUT 300)
  endif()
endfunction()

# add_own_library(name USED_BY target SOURCES … LIBRARIES target…)
#   libasperity_<name>.so, which own_library_paths() (base/load_library.h) finds beside the programs of the build and in
#   lib/asperity of what is installed. It is built before whatever is linked with USED_BY, which loads it.
function(add_own_library name)
  cmake_parse_arguments(L "" "USED_BY" "SOURCES;LIBRARIES" ${ARGN})
  set(target asperity_${name}_library)
  add_library(${target} MODULE ${L_SOURCES})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME asperity_${name}
                        LIBRARY_OUTPUT_DIRECTORY "${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  target_link_libraries(${target} PRIVATE ${L_LIBRARIES} asperity_flags)
  add_dependencies(${L_USED_BY} ${target})
  install(TARGETS ${target} LIBRARY DESTINATION lib/asperity)
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
    target_sources(fuzz_${name} PRIVATE ${CMAKE_SOURCE_DIR}/testkit/replay_corpus.cc)
    add_test(NAME fuzz_replay.${name}
             COMMAND fuzz_${name} ${CMAKE_CURRENT_SOURCE_DIR}/corpus/${name})
    set_tests_properties(fuzz_replay.${name} PROPERTIES TIMEOUT 120)
  endif()
endfunction()
