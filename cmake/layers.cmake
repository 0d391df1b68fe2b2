# roboss_layer(name DEPENDS layers...): src/name/*.cpp becomes the static library roboss_name; every src/name/*_test.cpp goes into one
# test program, roboss_name_test. A layer with external libraries adds them in src/name/layer.cmake (included after the target exists);
# cmake/install.cmake must know each such library, so that an installed RoBOSS finds it again.
# UNITY: no two files of the layer use the same private name, so CMAKE_UNITY_BUILD may compile many of them as one
# (the presets release and check-... do, for shorter first builds). Leave it out for a layer where files share names.
# LIGHT: the layer serves, reads and writes, and computes little: a release build optimises it little (-O1), which takes a
# third less time.
set(roboss_light_options $<$<CONFIG:Release>:-O1>)
add_library(roboss_options INTERFACE)
target_compile_options(roboss_options INTERFACE
  -Wall -Wextra -Wshadow -Wconversion -Werror -ffp-contract=off -fno-fast-math)
# g++ 12 warns of overlapping copies inside std::string::operator+ that cannot happen (GCC bug 105651).
target_compile_options(roboss_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# g++ 13 and 14 see std::sort of the first n of an array reach beyond the array.
target_compile_options(roboss_options INTERFACE
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>:-Wno-array-bounds;-Wno-stringop-overflow>)
# clang counts changes of sign to -Wconversion, g++ does not; g++ is the measure.
target_compile_options(roboss_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)
# Kernels say & and | for lanes' masks and for bool alike.
target_compile_options(roboss_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)
target_compile_features(roboss_options INTERFACE cxx_std_20)
if(ROBOSS_SANITIZE)
  target_compile_options(roboss_options INTERFACE -fsanitize=${ROBOSS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(roboss_options INTERFACE -fsanitize=${ROBOSS_SANITIZE})
endif()

if(ROBOSS_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  include(cmake/test_options.cmake)
endif()

# MODULE: a shared library that a program loads when it needs it, libroboss_name.so, so that no program depends on the
# external libraries of that layer. Its layer.cmake sets module_libraries; where they are missing, it is left out. Its
# functions are hidden, but for those that say otherwise; so its unit tests contain its objects.
function(roboss_module_layer name depends)
  set(module_libraries "")
  include(${CMAKE_SOURCE_DIR}/src/${name}/layer.cmake)
  if(NOT module_libraries)
    message(STATUS "the layer ${name} is left out: its libraries are not here (tools/setup.sh build)")
    return()
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*.cpp)
  file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*_test.cpp)
  list(REMOVE_ITEM sources ${tests} "")
  list(TRANSFORM depends PREPEND roboss_)
  set(target roboss_${name})
  add_library(${target}_objects OBJECT ${sources})
  target_include_directories(${target}_objects PUBLIC ${CMAKE_SOURCE_DIR}/src)
  target_link_libraries(${target}_objects PRIVATE roboss_options PUBLIC ${depends} ${module_libraries})
  set_target_properties(${target}_objects PROPERTIES CXX_VISIBILITY_PRESET hidden)
  target_compile_options(${target}_objects PRIVATE ${roboss_light_options})
  add_library(${target} MODULE)
  set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
  target_link_libraries(${target} PRIVATE ${target}_objects)
  target_link_options(${target} PRIVATE -Wl,--no-undefined -Wl,--as-needed -Wl,--exclude-libs,ALL)
  if(ROBOSS_TESTS AND tests)
    add_executable(${target}_test ${tests})
    roboss_test_options(${target}_test)
    # External libraries bring definitions of their own (_FILE_OFFSET_BITS with Fast DDS 3.1), with which g++ refuses
    # headers that were parsed without them.
    set_target_properties(${target}_test PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
    target_link_libraries(${target}_test PRIVATE ${target}_objects roboss_options GTest::gtest_main)
    target_include_directories(${target}_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)
    roboss_discover_tests(${target}_test ${name})
  endif()
endfunction()

function(roboss_layer name)
  cmake_parse_arguments(ARG "UNITY;MODULE;LIGHT" "" "DEPENDS" ${ARGN})
  if(ARG_MODULE)
    roboss_module_layer(${name} "${ARG_DEPENDS}")
    return()
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*.cpp)
  file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*_test.cpp)
  list(REMOVE_ITEM sources ${tests} "")
  set(target roboss_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:roboss_options>)
    if(ARG_LIGHT)
      target_compile_options(${target} PRIVATE ${roboss_light_options})
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(roboss::${name} ALIAS ${target})
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/src>
    $<INSTALL_INTERFACE:include> $<INSTALL_INTERFACE:include/roboss>)  # <roboss/client/client.h>, and as our headers include each other
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  if(NOT ARG_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  endif()
  # A program outside compiles our inline arithmetic too, and the linker may keep its copy: it needs C++20 and must not fuse.
  target_compile_features(${target} ${scope} cxx_std_20)
  target_compile_options(${target} INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
  foreach(dep ${ARG_DEPENDS})
    target_link_libraries(${target} ${scope} roboss_${dep})
  endforeach()
  set_property(GLOBAL PROPERTY ROBOSS_BELOW_${name} "${ARG_DEPENDS}")
  if(EXISTS ${CMAKE_SOURCE_DIR}/src/${name}/layer.cmake)
    include(${CMAKE_SOURCE_DIR}/src/${name}/layer.cmake)
  endif()
  set_property(GLOBAL APPEND PROPERTY ROBOSS_LAYERS ${name})
  if(ROBOSS_TESTS AND tests)
    add_executable(${target}_test ${tests})
    roboss_test_options(${target}_test)
    target_link_libraries(${target}_test PRIVATE ${target} roboss_options GTest::gtest_main)
    target_include_directories(${target}_test PRIVATE ${CMAKE_SOURCE_DIR}/tests)  # <support/...>: worlds that tests share
    roboss_discover_tests(${target}_test ${name})
  endif()
endfunction()

# Sets `result` to a layer and all layers below it, each once.
function(roboss_layers_of name result)
  set(all ${name})
  get_property(below GLOBAL PROPERTY ROBOSS_BELOW_${name})
  foreach(layer ${below})
    roboss_layers_of(${layer} more)
    list(APPEND all ${more})
  endforeach()
  list(REMOVE_DUPLICATES all)
  set(${result} ${all} PARENT_SCOPE)
endfunction()
