# Compiler settings shared by every target, and the two functions that declare targets.

add_library(toryu_settings INTERFACE)
target_include_directories(toryu_settings INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(toryu_settings INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Woverloaded-virtual>
  -march=${TORYU_CPU} -fno-math-errno)
# All code can be part of a module of Python. GCC would then take every function for one that others may replace, and
# inline none.
target_compile_options(toryu_settings INTERFACE -fPIC -fno-semantic-interposition)
# GCC 12 sees overlapping and endless copies in std::string where there are none (GCC bugs 105651, 105329), and the lanes
# that AVX-512's own headers leave undefined as values that are used (105593). Clang 14 takes a friend that is defined in
# its class for a member, whose names would shadow the class's own. Files that are compiled several at once see each
# other's names.
target_compile_options(toryu_settings INTERFACE
  $<$<AND:$<COMPILE_LANG_AND_ID:CXX,GNU>,$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>>:-Wshadow>
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-restrict -Wno-stringop-overflow -Wno-array-bounds -Wno-maybe-uninitialized>)
if(TORYU_CPU STREQUAL "native" OR TORYU_CPU STREQUAL "x86-64-v4")
  target_compile_options(toryu_settings INTERFACE -mprefer-vector-width=512)
endif()
if(TORYU_WARNINGS_AS_ERRORS)
  target_compile_options(toryu_settings INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
if(TORYU_SANITIZE)
  target_compile_options(toryu_settings INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(toryu_settings INTERFACE -fsanitize=address,undefined)
endif()

message(STATUS "toryu ${PROJECT_VERSION}: ${CMAKE_BUILD_TYPE} build for cpu '${TORYU_CPU}' with ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, sanitizers ${TORYU_SANITIZE}")

# The headers that nearly every file reads are compiled once: half of the time of a build. All targets must have the same
# options for it, so these libraries belong to the settings.
target_link_libraries(toryu_settings INTERFACE Eigen3::Eigen fmt::fmt spdlog::spdlog OpenMP::OpenMP_CXX)
function(toryu_precompiled name) # headers ...
  file(WRITE ${CMAKE_BINARY_DIR}/${name}.cpp "")
  add_library(${name} STATIC ${CMAKE_BINARY_DIR}/${name}.cpp)
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()
set(TORYU_HEADERS <Eigen/Core> <fmt/format.h> <algorithm> <array> <chrono> <cmath> <filesystem>
  <functional> <limits> <map> <memory> <numeric> <optional> <set> <span> <stdexcept> <string> <variant> <vector>)
toryu_precompiled(toryu_headers ${TORYU_HEADERS})
target_link_libraries(toryu_headers PRIVATE toryu_settings)

# toryu_library(NAME SOURCES a.cpp ... LIBRARIES x ...)
function(toryu_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC toryu_settings ${ARG_LIBRARIES})
  target_precompile_headers(${name} REUSE_FROM toryu_headers)
endfunction()

# toryu_program(NAME SOURCES a.cpp ... LIBRARIES x ...)
function(toryu_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE toryu_settings ${ARG_LIBRARIES})
  target_precompile_headers(${name} REUSE_FROM toryu_headers)
endfunction()

# All that the tests labelled `unit` need, for a build of them alone.
add_custom_target(unit_tests)

# toryu_test(NAME SOURCES a.cpp ... LIBRARIES x ... [LABEL unit] [TIMEOUT 300]): a GoogleTest executable, one CTest entry a test case.
# Tests run side by side: one thread each unless a test asks for more. Two tests whose threads wait for each other on the
# same two cores take thirty times as long. Its files are compiled several at once, which is faster: names of one that
# clash with another's belong into a namespace of its own. Of a unit's tests, a suite whose name ends in `Run` takes whole runs:
# it is `validation`, which the sanitizers leave out.
function(toryu_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM toryu_test_headers)
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON)
  if(ARG_LABEL STREQUAL "unit")
    add_dependencies(unit_tests ${name})
  endif()
  set(options NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT OMP_NUM_THREADS=1 LABELS)
  set(runs "*Run.*")
  if(ARG_LABEL STREQUAL "unit")
    gtest_discover_tests(${name} TEST_FILTER "-${runs}" ${options} unit)
    gtest_discover_tests(${name} TEST_FILTER "${runs}" ${options} validation)
  else()
    gtest_discover_tests(${name} ${options} ${ARG_LABEL})
  endif()
endfunction()

# toryu_python_test(NAME SCRIPT test.py [ARGUMENTS a ...] [MODULES folder ...] [LABEL unit] [TIMEOUT 900]
# [ENVIRONMENT A=1 ...]): a unittest file, one CTest entry. Debian's own Python runs it: that one has h5py and VTK. It
# finds the packages of tools/ and tests/, and the modules of the given folders.
function(toryu_python_test name)
  cmake_parse_arguments(ARG "" "SCRIPT;LABEL;TIMEOUT" "ARGUMENTS;MODULES;ENVIRONMENT" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 900)  # some start a hundred processes
  endif()
  add_test(NAME ${name} COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/${ARG_SCRIPT} ${ARG_ARGUMENTS})
  string(JOIN ":" path ${PROJECT_SOURCE_DIR}/tools ${PROJECT_SOURCE_DIR}/tests ${ARG_MODULES})
  set_tests_properties(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT}
    ENVIRONMENT "PYTHONPYCACHEPREFIX=${CMAKE_BINARY_DIR}/pycache;PYTHONPATH=${path};${ARG_ENVIRONMENT}")
endfunction()
