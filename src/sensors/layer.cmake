# The ray tracer is built once for AVX2 and once for any processor (see src/physics/layer.cmake; AVX-512 gained nothing). g++
# says that vectors of 32 bytes are passed otherwise without AVX; they are never passed between files. Unity files: those with
# flags of their own, and one whose Impl has members of private types, are compiled apart.
set(apart ray_avx2.cpp ray_tracer.cpp ray_scene.cpp)
list(TRANSFORM apart PREPEND ${CMAKE_SOURCE_DIR}/src/sensors/)
set_source_files_properties(${apart} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/sensors/ray_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2")
endif()
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/sensors/ray_tracer.cpp PROPERTIES COMPILE_OPTIONS "-Wno-psabi")
