# libsdformat knows SDFormat's versions and frame semantics. It does not show in load_world.h.
find_package(sdformat12 REQUIRED)
target_link_libraries(roboss_sdf PRIVATE sdformat12::sdformat12)
# libsdformat's headers hold a std::regex; with a sanitizer g++ 12 takes its parts for uninitialised (GCC bug 105562).
if(ROBOSS_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set_source_files_properties(
    src/sdf/joint_conversion.cpp src/sdf/libsdformat_errors.cpp src/sdf/libsdformat_reader.cpp src/sdf/load_world.cpp src/sdf/model_conversion.cpp
    src/sdf/urdf.cpp PROPERTIES COMPILE_OPTIONS -Wno-maybe-uninitialized)
endif()
