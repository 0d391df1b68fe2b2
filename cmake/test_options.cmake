# roboss_test_options(TARGET ...): how test programs are compiled, so that a first build is short. Call it behind all
# sources of a program. Results do not depend on it: arithmetic is fixed (docs/decisions/0005-fixed-math.md), and the
# layers keep their own options.
# - A release build optimises the sources of tests little (-O1): their time goes by in the layers that they call.
# - CMAKE_UNITY_BUILD compiles several test files as one, those whose private names differ (tools/test_batches). If a new
#   name makes two of them clash, the compiler says "redefinition": run cmake again, and they are put apart.
# - ROBOSS_PRECOMPILE: headers that nearly all tests read are parsed once (g++).
# The preset release has both. Other presets have neither, so that a test that forgets an #include does not compile there.
option(ROBOSS_PRECOMPILE "parse the headers that tests share once (g++)" OFF)
set(ROBOSS_UNITY_TESTS ${CMAKE_UNITY_BUILD})
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tools/test_batches)

if(ROBOSS_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_executable(roboss_test_headers ${CMAKE_SOURCE_DIR}/tests/support/test_headers.cpp)
  target_link_libraries(roboss_test_headers PRIVATE roboss_options GTest::gtest)
  target_include_directories(roboss_test_headers PRIVATE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/tests)
  target_compile_options(roboss_test_headers PRIVATE $<$<CONFIG:Release>:-O1>)
  target_precompile_headers(roboss_test_headers PRIVATE ${CMAKE_SOURCE_DIR}/tests/support/test_headers.h)
endif()

# Compiles the sources of a test program in batches.
function(roboss_test_batches target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  list(TRANSFORM sources PREPEND ${folder}/ REGEX "^[^/]")
  execute_process(COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_SOURCE_DIR}/tools/test_batches ${sources}
    OUTPUT_VARIABLE batches OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE ";" "," batches "${batches}")
  string(REPLACE "\n" ";" batches "${batches}")
  set(number 0)
  foreach(batch ${batches})
    string(REPLACE "," ";" files "${batch}")
    math(EXPR number "${number} + 1")
    set_source_files_properties(${files} PROPERTIES UNITY_GROUP ${target}_${number})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# The tests of a gtest program, each a test of ctest named PREFIX.Suite.Claim. Of a test with a parameter the name is all
# that ctest shows: gtest's text of the parameter would make names long, and they would change with the numbers in it.
function(roboss_discover_tests target prefix)
  gtest_discover_tests(${target} TEST_PREFIX ${prefix}. NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60)
  set_property(GLOBAL APPEND PROPERTY ROBOSS_GTEST_PROGRAMS $<TARGET_FILE:${target}>)
endfunction()

function(roboss_test_options)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    if(TARGET roboss_test_headers)
      target_precompile_headers(${target} REUSE_FROM roboss_test_headers)
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
    if(ROBOSS_UNITY_TESTS)
      roboss_test_batches(${target})
    endif()
  endforeach()
endfunction()
