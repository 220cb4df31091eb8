if(NOT SLUICE_TESTS)
  return()
endif()
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
include(GoogleTest)
sluice_header_family(test Eigen3::Eigen fmt::fmt sluice_messages GTest::gmock_main)

# A program made of these sources; every test in it carries the label.
function(sluice_test_of name label sources)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARGN} sluice_options GTest::gmock_main rapidcheck fmt::fmt)
  sluice_precompile(${name} test)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # GCC 12 misreads sums of strings and literals at -O2 (its bug 105651).
    target_compile_options(${name} PRIVATE -Wno-array-bounds)
  endif()
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE
    SLUICE_BIN="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}" SLUICE_SOURCE="${CMAKE_SOURCE_DIR}")
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES LABELS ${label} TIMEOUT 600)
endfunction()

# The files *_test.py of a folder, a ctest each, run by the system's Python and unittest with the package of the build.
function(sluice_python_tests label)
  file(GLOB files CONFIGURE_DEPENDS *_test.py)
  foreach(file ${files})
    cmake_path(GET file STEM name)
    add_test(NAME Python.${name} COMMAND /usr/bin/python3 -B -W error::ResourceWarning -m unittest -v ${name}
             WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    set_tests_properties(Python.${name} PROPERTIES LABELS ${label} TIMEOUT 600 ENVIRONMENT
      "PYTHONPATH=${CMAKE_BINARY_DIR}/lib/sluice/python;SLUICE_SOURCE=${CMAKE_SOURCE_DIR}")
  endforeach()
endfunction()

# One program a folder, made of all its sources.
function(sluice_test name label)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  if(sources)
    sluice_test_of(${name} ${label} "${sources}" ${ARGN})
  endif()
endfunction()
