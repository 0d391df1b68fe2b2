# Lanes: one translation unit for each instruction set, built for it alone. g++ 12 sees uninitialised values inside its own
# intrinsics (bug 105593).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/physics/lanes/lanes_avx2.cpp
    ${CMAKE_SOURCE_DIR}/src/physics/lanes/bodies_avx2.cpp
    ${CMAKE_SOURCE_DIR}/src/physics/lanes/soft_avx2.cpp
    ${CMAKE_SOURCE_DIR}/src/physics/sparse/fronts_avx2.cpp PROPERTIES COMPILE_OPTIONS "-mavx2")
  set_source_files_properties(${CMAKE_SOURCE_DIR}/src/physics/lanes/lanes_avx512.cpp
    ${CMAKE_SOURCE_DIR}/src/physics/lanes/bodies_avx512.cpp
    ${CMAKE_SOURCE_DIR}/src/physics/lanes/soft_avx512.cpp
    ${CMAKE_SOURCE_DIR}/src/physics/sparse/fronts_avx512.cpp PROPERTIES COMPILE_OPTIONS "-mavx512f;-mavx512dq;-mavx512vl")
endif()
# The solver's short loops cost up to 2 % more or less by where they happen to lie.
target_compile_options(roboss_physics PRIVATE -falign-loops=32 -falign-functions=64)
